import { Group } from 'three'
import { expect, it, vi } from 'vitest'
import { People } from '../../../src/lab/people/people'
import { createPresence, presenceReader } from '../../../src/protocol/mrlab_msgs'
import { en } from '../../../src/words/en'
import { FakeLink } from '../../fake_link'

vi.mock('../../../src/lab/people/avatar', () => ({
  AvatarShapes: class {},
  Avatar: class {
    readonly group = new Group()
    constructor(
      _shapes: unknown,
      readonly name: string,
      readonly part: number,
    ) {}
    take(): void {}
    update(): void {}
  },
}))

it('draws avatars between displays in one place only', () => {
  const link = new FakeLink()
  const world = new Group()
  const people = new People(link, world, 'b', en, () => undefined)
  const come = (id: string, frame: string) => {
    const message = createPresence()
    message.id = id
    message.header.frame_id = frame
    link.deliver('presence', presenceReader, message)
    people.update(performance.now() / 1000, 0.01)
  }
  const drawn = () => world.children.map(({ visible }) => visible)
  expect(people.isFirst).toBe(true)
  come('c', 'c')
  expect([drawn(), people.isFirst]).toEqual([[false], true])
  come('c', 'world')
  expect([drawn(), people.isFirst]).toEqual([[true], false])
  people.frame = 'b'
  people.update(performance.now() / 1000, 0.01)
  expect(drawn()).toEqual([false])
  // Another place, in which we may be as well: those of the lab's are joined first.
  expect(people.joinable).toBe('world')
  come('c', 'attic')
  expect([people.joinable, people.isFirst, drawn()]).toEqual(['attic', false, [false]])
  people.frame = 'attic'
  people.update(performance.now() / 1000, 0.01)
  expect([drawn(), people.anyIn('attic'), people.anyIn('world')]).toEqual([[true], true, false])
  people.frame = 'b'
  come('c', 'c')
  come('a', 'a')
  expect(people.isFirst).toBe(false)
  expect(people.present.map(({ aligned }) => aligned)).toEqual([false, false])
})
