import { Matrix4, type Object3D, type Quaternion, Vector3 } from 'three'
import type { Speech } from '../ports'

/** The kind of anchor that holds the scene in place: a persistent one, one of this session, or none
 * but the floor space. */
export type Hold = 'kept' | 'session' | 'none'

const KEY = 'mrlab.room.anchor'
/** ms for which the scene waits for the place of an earlier session; the search goes on after it. */
const FOUND_MS = 4000
/** ms of it in which only an anchor of the lab's place counts; then any of this room does. */
const OWN_MS = 2000
/** ms between two attempts to restore a place that the headset refused. */
const RETRY_MS = 2000
/** A headset has few places for all pages and apps. */
const MOST_PLACES = 4
const UP = new Vector3(0, 1, 0)
const ONE = new Vector3(1, 1, 1)
const matrix = new Matrix4()
const placed = new Matrix4()
const scale = new Vector3()
const forward = new Vector3()
const offset = new Vector3()

interface AnchorNews {
  /** The headset does not keep the place, or only for this session. */
  refused(hold: Hold): void
  /** An earlier place was found after the scene was placed elsewhere. */
  returned(): void
}

/** Return what says the news of an anchor to the person. */
export function anchorNews({ words: { room }, say }: Speech): AnchorNews {
  return {
    refused: (hold) => say(hold === 'session' ? room.anchorSession : room.anchorNone),
    returned: () => say(room.earlierPlace),
  }
}

/** An anchor that this headset keeps, and the id of the lab's place that it holds; one anchor may
 * hold several, an empty id any. */
interface Kept {
  readonly handle: string
  readonly place: string
}

/** Return the anchors that this headset keeps, the newest first. */
function keptAnchors(): Kept[] {
  const lines = localStorage.getItem(KEY)?.split('\n') ?? []
  return lines.map((line) => {
    const [handle = '', place = ''] = line.split('\t')
    return { handle, place }
  })
}

function store(kept: readonly Kept[]): void {
  const lines = kept.map(({ handle, place }) => (place === '' ? handle : `${handle}\t${place}`))
  if (lines.length === 0) localStorage.removeItem(KEY)
  else localStorage.setItem(KEY, lines.join('\n'))
}

function keptHandles(): string[] {
  return [...new Set(keptAnchors().map(({ handle }) => handle))]
}

/** Return whether an anchor is known to hold places of the lab. */
function holdsAny(handle: string): boolean {
  return keptAnchors().some((kept) => kept.handle === handle && kept.place !== '')
}

/** Return whether an anchor is known to hold a place of the lab. */
function holds(handle: string, place: string): boolean {
  return keptAnchors().some((kept) => kept.handle === handle && kept.place === place)
}

/** Holds the group that contains the whole lab. World poses are stored nowhere: after a recentre
 * the anchor's own pose gives the place of the group. A headset keeps the places of several rooms;
 * each is searched for during the whole session. */
export class SceneAnchor {
  hold: Hold = 'none'
  private session: XRSession | null = null
  private anchor: XRAnchor | null = null
  /** The handle of `anchor`; empty: it is not persistent. */
  private handle = ''
  private wanted = false
  /** Number of the newest place: an answer about an older one is ignored. */
  private placing = 0
  /** End of the wait for a restored anchor, ms; NaN: it is over. */
  private waitsUntil = Number.NaN
  /** The restored anchors of earlier sessions that were not found in this room yet, by handle. */
  private readonly restored = new Map<string, XRAnchor>()
  /** The handle of an earlier place that was found after the scene was placed; empty: none. */
  private earlier = ''
  private retryAt = Number.POSITIVE_INFINITY
  /** Id of the lab's place; empty: the lab has not said. */
  private labPlace = ''
  /** The place that `handle` was last kept for. */
  private heldFor = ''

  constructor(
    private readonly group: Object3D,
    private readonly news: AnchorNews,
  ) {}

  /** True while the scene waits for the place of an earlier session. */
  get waits(): boolean {
    return performance.now() < this.waitsUntil
  }

  /** True if the group is at an anchor. */
  get held(): boolean {
    return this.anchor !== null
  }

  /** True if an earlier place of this room is known, and the scene stands elsewhere. */
  get canPutBack(): boolean {
    return this.earlier !== ''
  }

  /** Return whether the group is at an anchor that holds a place of the lab. */
  at(place: string): boolean {
    return this.held && holds(this.handle, place)
  }

  /** Return the place of the lab that the group's anchor holds, `wanted` if it does; empty: none. */
  placeHere(wanted: string): string {
    if (!this.held || this.handle === '') return ''
    const here = keptAnchors().filter(
      ({ handle, place }) => handle === this.handle && place !== '',
    )
    return here.some(({ place }) => place === wanted) ? wanted : (here[0]?.place ?? '')
  }

  /** Keep that the group's anchor holds a place of the lab: the headset is known to be there. */
  holdFor(place: string): void {
    const { handle } = this
    if (handle === '' || place === this.heldFor) return
    this.heldFor = place
    if (holds(handle, place)) return
    const others = keptAnchors().filter((kept) => kept.handle !== handle || kept.place !== '')
    store([{ handle, place }, ...others])
  }

  /** The lab stands in another place now: the scene goes to the anchor that holds it, if this
   * headset has found one here; else it stays. Returns whether it is there. */
  goTo(place: string): boolean {
    this.labPlace = place
    if (this.handle === '' || this.at(place)) return this.handle !== ''
    for (const [handle, anchor] of this.restored) {
      if (!holds(handle, place)) continue
      if (this.anchor !== null) this.restored.set(this.handle, this.anchor)
      this.adopt(handle, anchor)
      return true
    }
    return false
  }

  /** Restore the anchors of earlier sessions, if there are any. */
  async restore(session: XRSession): Promise<void> {
    this.session = session
    // A place that was chosen without a headset is no place of this room.
    this.wanted = false
    this.placing++
    if (keptHandles().length === 0 || session.restorePersistentAnchor === undefined) return
    this.waitsUntil = performance.now() + FOUND_MS
    await this.seek(session)
  }

  /** Put the scene back at the earlier place, and give up its present one. */
  async putBack(): Promise<void> {
    const { earlier, handle } = this
    const anchor = this.restored.get(earlier)
    if (anchor === undefined) return
    this.release()
    this.wanted = false
    this.adopt(earlier, anchor)
    await this.forget(handle)
  }

  /** Leave the scene at its present place, and give up the earlier one. */
  async keepHere(): Promise<void> {
    await this.forget(this.earlier)
  }

  /** Put the group's origin on the floor so that `centre`, in the group's frame, is `away`, m,
   * before the eyes, and hold it there from the next frame on. floor: its height, m. */
  place(head: Vector3, look: Quaternion, centre: Vector3, away: number, floor: number): void {
    forward.set(0, 0, -1).applyQuaternion(look).setY(0)
    if (forward.lengthSq() < 1e-4) forward.set(0, 0, -1)
    forward.normalize()
    this.group.quaternion.setFromAxisAngle(UP, Math.atan2(-forward.x, -forward.z))
    offset.copy(centre).applyQuaternion(this.group.quaternion).setY(0)
    this.group.position.copy(head).addScaledVector(forward, away).sub(offset).setY(floor)
    this.release()
    this.wanted = true
  }

  /** Put the group at a place of the floor space, and hold it there from the next frame on. */
  put(position: Vector3, turn: Quaternion): void {
    this.group.position.copy(position)
    this.group.quaternion.copy(turn)
    this.release()
    this.wanted = true
  }

  /** Follow the anchor; create the wanted one; search for earlier ones. */
  update(frame: XRFrame, space: XRReferenceSpace): void {
    if (this.wanted) {
      this.wanted = false
      this.make(frame, space)
    }
    this.find(frame, space)
    if (this.anchor === null) return
    const pose = frame.getPose(this.anchor.anchorSpace, space)
    // Not tracked: it stays at its last place.
    if (pose === undefined) return
    matrix.fromArray(pose.transform.matrix)
    matrix.decompose(this.group.position, this.group.quaternion, scale)
  }

  /** The origin of the floor space has moved; transform: the new origin in the old space. Nothing
   * moves in the real room, even while no anchor is tracked. */
  recentre({ matrix: moved }: XRRigidTransform): void {
    const { group } = this
    matrix.fromArray(moved).invert()
    matrix.multiply(placed.compose(group.position, group.quaternion, ONE))
    matrix.decompose(group.position, group.quaternion, scale)
  }

  /** Forget the anchors of a session that ended. */
  end(): void {
    this.session = null
    this.anchor = null
    this.handle = ''
    this.wanted = false
    this.hold = 'none'
    this.waitsUntil = Number.NaN
    this.retryAt = Number.POSITIVE_INFINITY
    this.restored.clear()
    this.earlier = ''
    this.placing++
  }

  /** Ask the headset for each kept place that it has not restored. A refusal may pass: it is asked
   * again. */
  private async seek(session: XRSession): Promise<void> {
    this.retryAt = Number.POSITIVE_INFINITY
    let refusals = 0
    for (const handle of keptHandles()) {
      if (handle === this.handle || this.restored.has(handle)) continue
      try {
        const anchor = await session.restorePersistentAnchor?.(handle)
        if (session !== this.session) return
        if (anchor !== undefined) this.restored.set(handle, anchor)
      } catch {
        refusals++
      }
    }
    if (refusals > 0 && session === this.session) this.retryAt = performance.now() + RETRY_MS
  }

  /** Take the first earlier place that is tracked; offer it if the scene was placed meanwhile. */
  private find(frame: XRFrame, space: XRReferenceSpace): void {
    if (this.session !== null && performance.now() >= this.retryAt) this.seek(this.session)
    if (this.earlier !== '') return
    const any = performance.now() > this.waitsUntil - FOUND_MS + OWN_MS
    for (const [handle, anchor] of this.restored) {
      if (frame.getPose(anchor.anchorSpace, space) === undefined) continue
      const own = this.labPlace === '' || holds(handle, this.labPlace)
      if (this.waits) {
        if (!own && !any) continue
        this.adopt(handle, anchor)
      } else {
        // That of another place of this room is where it is to be.
        if (!own && holdsAny(handle) && this.at(this.labPlace)) continue
        this.earlier = handle
        this.news.returned()
      }
      return
    }
  }

  private adopt(handle: string, anchor: XRAnchor): void {
    this.restored.delete(handle)
    this.earlier = ''
    this.anchor = anchor
    this.handle = handle
    this.heldFor = ''
    this.hold = 'kept'
    this.waitsUntil = Number.NaN
  }

  private release(): void {
    const { anchor } = this
    this.anchor = null
    this.hold = 'none'
    this.waitsUntil = Number.NaN
    this.placing++
    anchor?.delete()
  }

  /** Delete a kept place: a headset deletes none itself. */
  private async forget(handle: string): Promise<void> {
    if (handle === '') return
    this.restored.delete(handle)
    if (this.earlier === handle) this.earlier = ''
    store(keptAnchors().filter((kept) => kept.handle !== handle))
    await this.session?.deletePersistentAnchor?.(handle).catch(() => undefined)
  }

  private make(frame: XRFrame, space: XRReferenceSpace): void {
    if (frame.createAnchor === undefined) return
    const { position: p, quaternion: q } = this.group
    const pose = new XRRigidTransform(
      { x: p.x, y: p.y, z: p.z },
      { x: q.x, y: q.y, z: q.z, w: q.w },
    )
    const asked = frame.createAnchor(pose, space)
    if (asked !== undefined) this.keep(asked, this.placing)
  }

  private async keep(asked: Promise<XRAnchor>, place: number): Promise<void> {
    try {
      const anchor = await asked
      if (place !== this.placing) {
        anchor.delete()
        return
      }
      this.anchor = anchor
      this.hold = 'session'
      if (anchor.requestPersistentHandle === undefined) return
      const { handle: before } = this
      this.handle = ''
      await this.forget(before)
      for (const old of keptHandles().slice(MOST_PLACES - 1)) await this.forget(old)
      const handle = await anchor.requestPersistentHandle()
      if (place !== this.placing) {
        await this.session?.deletePersistentAnchor?.(handle)
        return
      }
      store([{ handle, place: '' }, ...keptAnchors()])
      this.handle = handle
      this.heldFor = ''
      this.hold = 'kept'
    } catch {
      // As if all places of the headset were taken.
      if (place === this.placing) this.news.refused(this.hold)
    }
  }
}
