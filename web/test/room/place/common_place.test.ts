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
  let link: FakeLink
  /** Frames of the others. */
  let others: string[]
  /** Frames that were told of this display. */
  let news: string[]
  let tellings: number
  let said: string[]
  let held: string
  let kept: string[]
  let found: boolean
  let waits: boolean
  let touching: { joined: { frame: string } | null; begin(): void; end(): void }
  let place: CommonPlace

  const people = {
    id: 'own',
    get isFirst() {
      return others.length === 0
    },
    get joinable() {
      return others[0] ?? 'world'
    },
    anyIn: (frame: string) => others.includes(frame),
  }
  const ordered = () =>
    link.calls.map(({ request }) => (request as SetSurfacesRequest).surfaces.length)

  function made(scene = true): CommonPlace {
    const ports = { link, words: en, scene, say: (text: string) => said.push(text) }
    const presence = { setFrame: (frame: string) => news.push(frame) }
    const scan = { tellAgain: () => tellings++ }
    const anchor = {
      get waits() {
        return waits
      },
      goTo: () => found,
      placeHere: () => held,
      holdFor: (id: string) => kept.push(id),
    }
    const { link: _, ...rest } = ports
    const all = { ...rest, link } as never
    return new CommonPlace(all, 'quest', people, presence, scan, touching, anchor)
  }

  beforeEach(() => {
    others = []
    news = []
    said = []
    kept = []
    held = ''
    found = waits = false
    tellings = 0
    touching = {
      joined: null,
      begin: () => undefined,
      end: () => {
        touching.joined = null
      },
    }
    link = new FakeLink()
    link.answer('physics/set_surfaces', setSurfacesType, () => ({ success: true, message: '' }))
    place = made()
    place.goTo('hall')
  })

  it('is defined by the first, after it has listened for others', () => {
    expect(place.aligned).toBe(true)
    place.begin(10)
    place.update(10.5)
    place.tell([createSurface()])
    expect([place.aligned, news, ordered()]).toEqual([false, ['own'], []])
    place.update(11.5)
    expect([place.aligned, news, tellings]).toEqual([true, ['own', 'world'], 1])
    // Its anchor holds the place from now on. Who comes later changes nothing.
    expect(kept).toEqual(['hall'])
    others = ['world']
    place.update(12)
    place.tell([createSurface()])
    expect([news.length, tellings, ordered(), said]).toEqual([2, 1, [1], []])
    place.end()
    expect(ordered()).toEqual([1, 0])
  })

  it('tells the lab no surfaces of a person who may not set them', () => {
    place = made(false)
    place.begin(10)
    place.update(11.5)
    place.tell([createSurface()])
    place.end()
    expect([news, ordered()]).toEqual([['own', 'world', 'world'], []])
  })

  it('is joined by touch, and left when the touch is undone', () => {
    others = ['world']
    place.begin(10)
    place.update(11.5)
    place.update(12)
    place.tell([createSurface()])
    expect([place.aligned, said.length, ordered()]).toEqual([false, 1, [0]])
    touching.joined = { frame: 'world' }
    place.update(13)
    place.tell([createSurface()])
    expect([place.aligned, tellings, ordered(), kept]).toEqual([true, 1, [0, 1], ['hall']])
    touching.joined = null
    place.update(14)
    expect([place.aligned, ordered()]).toEqual([false, [0, 1, 0]])
    place.end()
    expect([place.aligned, ordered()]).toEqual([true, [0, 1, 0]])
  })

  it('is free once the others have left', () => {
    others = ['world']
    place.begin(10)
    place.update(11.5)
    others = []
    place.update(20)
    expect([place.aligned, tellings]).toEqual([true, 1])
  })

  it('is known by an anchor that holds it, without a touch', () => {
    others = ['world']
    held = 'hall'
    place.begin(10)
    place.update(11.5)
    expect([place.aligned, news.at(-1), said]).toEqual([true, 'world', []])
  })

  it('is another one for headsets in another room, whose surfaces count while nobody is in the lab’s', () => {
    held = 'attic'
    place.begin(10)
    waits = true
    place.update(11.5)
    expect(news).toEqual(['own'])
    waits = false
    place.update(11.6)
    expect([place.aligned, news.at(-1)]).toEqual([true, 'attic'])
    others = ['world']
    place.update(12)
    expect([place.aligned, news.at(-1), ordered(), said.length]).toEqual([false, 'attic', [0], 1])
    // The lab comes to the attic: those there are in its place, the others no more.
    found = true
    place.goTo('attic')
    others = ['hall']
    place.update(13)
    expect([place.aligned, news.at(-1), tellings]).toEqual([true, 'world', 2])
    found = false
    others = ['world', 'hall']
    place.goTo('hall')
    others = ['world']
    place.update(14)
    expect([place.aligned, news.at(-1)]).toEqual([false, 'attic'])
  })

  it('comes along with the lab where nobody is known to be in the new place', () => {
    place.begin(10)
    place.update(11.5)
    place.goTo('fair')
    place.update(12)
    expect([place.aligned, news, kept]).toEqual([true, ['own', 'world'], ['hall', 'fair']])
  })

  it('is shared with somebody else who is not in the lab’s place', () => {
    others = ['world', 'ben']
    place.begin(10)
    place.update(11.5)
    touching.joined = { frame: 'ben' }
    place.update(12)
    expect([place.aligned, news.at(-1)]).toEqual([false, 'ben'])
    // Who moves the scene alone has left those with whom it was aligned; a touch brings back.
    place.moved()
    place.update(13)
    expect(news.at(-1)).toBe('own')
    touching.joined = { frame: 'ben' }
    place.update(14)
    expect(news.at(-1)).toBe('ben')
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
