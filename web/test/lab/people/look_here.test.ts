import { Group } from 'three'
import { expect, it, vi } from 'vitest'
import { LookHere } from '../../../src/lab/people/look_here'
import {
  createLookHere,
  createRecorderState,
  lookHereReader,
} from '../../../src/protocol/mrlab_msgs'
import { en } from '../../../src/words/en'
import { FakeLink } from '../../fake_link'

vi.mock('../../../src/scene/stage/labels', () => ({
  Label: class {
    readonly sprite = new Group()
    constructor(readonly text: string) {}
    paint(): void {}
    dispose(): void {}
  },
}))

it('marks where a replay stands until it goes on, and what a person points at for a while', () => {
  const link = new FakeLink()
  const told = vi.fn()
  const look = new LookHere(link, new Group(), en, told)
  const stop = { ...createRecorderState(), code: 'tour_stop', message: 'stop 1', position: 4 }
  const values = [{ key: 'place', value: '[0.1, 0.2, 0.3]' }]
  look.stand({ ...stop, values })
  look.stand({ ...stop, values })
  expect(told).toHaveBeenCalledExactlyOnceWith('stop 1')
  const now = performance.now() / 1000
  expect(look.update(now + 3600)).toBe(false)
  expect(look.point?.toArray()).toEqual([0.1, 0.2, 0.3])
  look.stand(createRecorderState())
  expect(look.point).toBe(null)

  look.stand({ ...stop, values })
  const point = { x: 7, y: 8, z: 9 }
  link.deliver('look_here', lookHereReader, { ...createLookHere(), name: 'Anna', point })
  look.stand({ ...stop, values })
  expect(look.point?.toArray()).toEqual([7, 8, 9])
  expect(look.update(now + 1)).toBe(true)
  look.update(now + 60)
  expect(look.point).toBe(null)
})
