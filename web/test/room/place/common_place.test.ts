import { beforeEach, describe, expect, it } from 'vitest'
import {
  createSurface,
  type SetSurfacesRequest,
  setSurfacesType,
} from '../../../src/protocol/mrlab_msgs'
import { CommonPlace } from '../../../src/room/place/common_place'
import { en } from '../../../src/words/en'
import { FakeLink } from '../../fake_link'

describe('the common place of headsets', () => {
  const people = { isFirst: true, setAligned: (aligned: boolean) => news.push(aligned) }
  const touching = {
    canUndo: false,
    end: () => {
      touching.canUndo = false
    },
  }
  let link: FakeLink
  let news: boolean[]
  let tellings: number
  let said: string[]
  let place: CommonPlace

  const ordered = () =>
    link.calls.map(({ request }) => (request as SetSurfacesRequest).surfaces.length)

  beforeEach(() => {
    people.isFirst = true
    touching.canUndo = false
    news = []
    said = []
    tellings = 0
    link = new FakeLink()
    link.answer('physics/set_surfaces', setSurfacesType, () => ({ success: true, message: '' }))
    const ports = { link, words: en, scene: true, say: (text: string) => said.push(text) }
    const scan = { tellAgain: () => tellings++ }
    place = new CommonPlace(ports as never, 'quest', people, people, scan as never, touching)
  })

  it('is defined by the first, after it has listened for others', () => {
    expect(place.aligned).toBe(true)
    place.begin(10)
    place.update(10.5)
    place.tell([createSurface()])
    expect([place.aligned, news, ordered()]).toEqual([false, [false], []])
    place.update(11.5)
    expect([place.aligned, news, tellings]).toEqual([true, [false, true], 1])
    // Who comes later changes nothing.
    people.isFirst = false
    place.update(12)
    place.tell([createSurface()])
    expect([news, tellings, ordered(), said]).toEqual([[false, true], 1, [1], []])
    place.end()
    expect(ordered()).toEqual([1, 0])
  })

  it('tells the lab no surfaces of a person who may not set them', () => {
    const ports = { link, words: en, scene: false, say: (text: string) => said.push(text) }
    const scan = { tellAgain: () => tellings++ }
    place = new CommonPlace(ports as never, 'quest', people, people, scan as never, touching)
    place.begin(10)
    place.update(11.5)
    place.tell([createSurface()])
    place.end()
    expect([news, ordered()]).toEqual([[false, true, true], []])
  })

  it('is joined by touch only, and left when the touch is undone', () => {
    people.isFirst = false
    place.begin(10)
    place.update(11.5)
    place.update(12)
    place.tell([createSurface()])
    expect([place.aligned, said.length, ordered()]).toEqual([false, 1, [0]])
    touching.canUndo = true
    place.update(13)
    place.tell([createSurface()])
    expect([place.aligned, tellings, ordered()]).toEqual([true, 1, [0, 1]])
    touching.canUndo = false
    place.update(14)
    expect([place.aligned, ordered()]).toEqual([false, [0, 1, 0]])
    place.end()
    expect([place.aligned, ordered()]).toEqual([true, [0, 1, 0]])
  })

  it('is free once the others have left', () => {
    people.isFirst = false
    place.begin(10)
    place.update(11.5)
    people.isFirst = true
    place.update(20)
    expect([place.aligned, tellings]).toEqual([true, 1])
  })

  it('gives the lab its surfaces again where the lab lost them', () => {
    place.begin(10)
    place.update(11.5)
    place.keep([])
    expect(tellings).toBe(1)
    place.tell([createSurface()])
    place.keep([{ source: 'quest' }, { source: 'pico' }])
    expect(tellings).toBe(1)
    place.keep([{ source: 'pico' }])
    expect(tellings).toBe(2)
  })
})
