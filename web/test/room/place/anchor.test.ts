import { Object3D, Quaternion, Vector3 } from 'three'
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest'
import { SceneAnchor } from '../../../src/room/place/anchor'

const KEY = 'mrlab.room.anchor'
const floor = {} as XRReferenceSpace
const kept = new Map<string, string>()

/** A headset that keeps so many places, and says where each is. */
class Headset {
  readonly places = new Set<string>()
  readonly session = {
    restorePersistentAnchor: async (handle: string) => {
      if (this.refusals-- > 0) throw new DOMException('later', 'OperationError')
      if (!this.places.has(handle)) throw new DOMException('unknown', 'InvalidStateError')
      return this.anchor()
    },
    deletePersistentAnchor: async (handle: string) => {
      this.places.delete(handle)
    },
  } as unknown as XRSession
  readonly frame = {
    createAnchor: async () => this.anchor(),
    getPose: () => (this.tracked ? { transform: { matrix: this.pose.toArray() } } : undefined),
  } as unknown as XRFrame
  pose = new Object3D().matrix.clone().makeTranslation(1, 0, 2)
  tracked = true
  refusals = 0
  private made = 0

  constructor(private readonly most: number) {}

  private anchor(): XRAnchor {
    return {
      anchorSpace: {},
      delete: () => undefined,
      requestPersistentHandle: async () => {
        if (this.places.size >= this.most) throw new DOMException('full', 'QuotaExceededError')
        const handle = `place ${this.made++}`
        this.places.add(handle)
        return handle
      },
    } as unknown as XRAnchor
  }
}

const settled = () => new Promise((resolve) => setTimeout(resolve))

afterEach(() => {
  vi.useRealTimers()
})

describe('the anchor of the scene', () => {
  let group: Object3D
  let refusals: string[]
  let returns: number
  let anchor: SceneAnchor

  async function placeAt(headset: Headset, x: number): Promise<void> {
    anchor.put(new Vector3(x, 0, 0), new Quaternion())
    anchor.update(headset.frame, floor)
    await settled()
  }

  beforeEach(() => {
    kept.clear()
    vi.stubGlobal('localStorage', {
      getItem: (key: string) => kept.get(key) ?? null,
      setItem: (key: string, value: string) => kept.set(key, value),
      removeItem: (key: string) => kept.delete(key),
    })
    vi.stubGlobal('XRRigidTransform', class {})
    vi.useFakeTimers({ toFake: ['performance'] })
    group = new Object3D()
    refusals = []
    returns = 0
    anchor = new SceneAnchor(group, {
      refused: (hold) => refusals.push(hold),
      returned: () => returns++,
    })
  })

  it('takes one place of the headset however often the scene is moved', async () => {
    const headset = new Headset(8)
    await anchor.restore(headset.session)
    for (let x = 0; x < 12; x++) await placeAt(headset, x)
    expect(anchor.hold).toBe('kept')
    expect([...headset.places]).toEqual([kept.get(KEY)])
    expect(refusals).toEqual([])
  })

  it('comes back in the next session, though the desktop view had placed the scene before', async () => {
    const headset = new Headset(8)
    await anchor.restore(headset.session)
    await placeAt(headset, 3)
    const handle = kept.get(KEY)
    anchor.end()
    anchor.put(new Vector3(9, 0, 9), new Quaternion())
    await anchor.restore(headset.session)
    anchor.update(headset.frame, floor)
    await settled()
    expect(kept.get(KEY)).toBe(handle)
    expect(group.position.toArray()).toEqual([1, 0, 2])
    expect(anchor.held).toBe(true)
    // a recentre moves the anchor in the floor space, and the scene with it
    headset.pose.makeTranslation(4, 0, 5)
    anchor.update(headset.frame, floor)
    expect(group.position.toArray()).toEqual([4, 0, 5])
    // Out of view it keeps its last place.
    headset.tracked = false
    headset.pose.makeTranslation(7, 0, 7)
    anchor.update(headset.frame, floor)
    expect(group.position.toArray()).toEqual([4, 0, 5])
  })

  /** Place the scene where the place of an earlier session is not tracked in time. */
  async function placeElsewhere(headset: Headset): Promise<void> {
    headset.places.add('earlier')
    kept.set(KEY, 'earlier')
    headset.tracked = false
    await anchor.restore(headset.session)
    anchor.update(headset.frame, floor)
    expect([anchor.waits, anchor.held]).toEqual([true, false])
    vi.advanceTimersByTime(5000)
    expect([anchor.waits, anchor.held]).toEqual([false, false])
    await placeAt(headset, 1)
    expect(kept.get(KEY)).toBe('place 0\nearlier')
    expect(returns).toBe(0)
    headset.tracked = true
    anchor.update(headset.frame, floor)
    anchor.update(headset.frame, floor)
    expect([anchor.canPutBack, returns]).toEqual([true, 1])
  }

  it('of an earlier session that is found late is offered, and taken back', async () => {
    const headset = new Headset(8)
    await placeElsewhere(headset)
    await anchor.putBack()
    expect([...headset.places]).toEqual(['earlier'])
    expect([kept.get(KEY), anchor.canPutBack, anchor.hold]).toEqual(['earlier', false, 'kept'])
  })

  it('of an earlier session that is found late is given up on request only', async () => {
    const headset = new Headset(8)
    await placeElsewhere(headset)
    await anchor.keepHere()
    expect([...headset.places]).toEqual(['place 0'])
    expect([kept.get(KEY), anchor.canPutBack]).toEqual(['place 0', false])
  })

  it('survives five refusals of the headset', async () => {
    const headset = new Headset(8)
    headset.places.add('earlier')
    headset.refusals = 5
    kept.set(KEY, 'earlier')
    await anchor.restore(headset.session)
    for (let i = 0; i < 5; i++) {
      expect([anchor.held, kept.get(KEY)]).toEqual([false, 'earlier'])
      vi.advanceTimersByTime(2000)
      anchor.update(headset.frame, floor)
      await settled()
    }
    anchor.update(headset.frame, floor)
    expect([anchor.canPutBack, returns, kept.get(KEY)]).toEqual([true, 1, 'earlier'])
  })

  it('gives up the oldest of too many rooms', async () => {
    const headset = new Headset(8)
    for (const handle of ['d', 'c', 'b', 'a']) headset.places.add(handle)
    kept.set(KEY, 'd\nc\nb\na')
    headset.tracked = false
    await anchor.restore(headset.session)
    await placeAt(headset, 1)
    expect(kept.get(KEY)).toBe('place 0\nd\nc\nb')
    expect(headset.places.has('a')).toBe(false)
  })

  it('moves nothing in the real room when the floor space is recentred', () => {
    anchor.put(new Vector3(1, 0, 2), new Quaternion())
    const moved = new Object3D().matrix.makeRotationY(Math.PI / 2).setPosition(1, 0, 0)
    anchor.recentre({ matrix: new Float32Array(moved.toArray()) } as unknown as XRRigidTransform)
    const at = group.position.clone().applyMatrix4(moved)
    expect(at.distanceTo(new Vector3(1, 0, 2))).toBeLessThan(1e-6)
  })

  it('says so where the headset keeps no more places, and holds for this session', async () => {
    const headset = new Headset(0)
    await anchor.restore(headset.session)
    await placeAt(headset, 1)
    expect(anchor.hold).toBe('session')
    expect(refusals).toEqual(['session'])
    expect(kept.has(KEY)).toBe(false)
  })

  it('lets an answer about an older place be about nothing', async () => {
    const headset = new Headset(8)
    await anchor.restore(headset.session)
    anchor.put(new Vector3(1, 0, 0), new Quaternion())
    anchor.update(headset.frame, floor)
    anchor.put(new Vector3(2, 0, 0), new Quaternion())
    await settled()
    expect(anchor.hold).toBe('none')
    anchor.update(headset.frame, floor)
    await settled()
    expect([...headset.places]).toEqual([kept.get(KEY)])
  })

  it('of the place in which the lab stands goes before others of the same room', async () => {
    const headset = new Headset(8)
    anchor.goTo('a')
    await anchor.restore(headset.session)
    await placeAt(headset, 1)
    expect([anchor.placeHere('a'), kept.get(KEY)]).toEqual(['', 'place 0'])
    // The same anchor may hold several places, until the scene is moved.
    for (const place of ['a', 'b', 'b']) anchor.holdFor(place)
    expect(kept.get(KEY)).toBe('place 0\tb\nplace 0\ta')
    expect(['a', 'b', 'c'].map((place) => anchor.placeHere(place))).toEqual(['a', 'b', 'b'])
    expect([anchor.goTo('b'), anchor.goTo('c')]).toEqual([true, false])
    anchor.goTo('b')
    kept.set(KEY, 'place 1\ta\nplace 2\tb')
    for (const place of ['place 1', 'place 2']) headset.places.add(place)
    anchor.end()
    await anchor.restore(headset.session)
    anchor.update(headset.frame, floor)
    expect(anchor.at('b')).toBe(true)
    // The lab goes elsewhere, as with a scene that is loaded, and back.
    anchor.goTo('a')
    anchor.update(headset.frame, floor)
    expect([anchor.at('a'), anchor.hold, returns]).toEqual([true, 'kept', 0])
    anchor.goTo('b')
    expect(anchor.at('b')).toBe(true)
  })
})
