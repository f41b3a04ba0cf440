import { Matrix4, type Object3D, type Quaternion, Vector3 } from 'three'

/** The kind of anchor that holds the scene in place: a persistent one, one of this session, or none
 * but the floor space. */
export type Hold = 'kept' | 'session' | 'none'

const KEY = 'mrlab.room.anchor'
/** ms within which the place of an earlier session is found again; otherwise it is another room. */
const FOUND_MS = 4000
const UP = new Vector3(0, 1, 0)
const matrix = new Matrix4()
const scale = new Vector3()
const forward = new Vector3()
const offset = new Vector3()

/** Holds the group that contains the whole lab. World poses are stored nowhere: after a recentre
 * the anchor's own pose gives the place of the group. */
export class SceneAnchor {
  hold: Hold = 'none'
  private session: XRSession | null = null
  private anchor: XRAnchor | null = null
  private wanted = false
  /** Number of the newest place: an answer about an older one is ignored. */
  private placing = 0
  /** End of the search for a restored anchor, ms; NaN: it was found, or there is none. */
  private waitsUntil = Number.NaN

  /** refused: called if the headset does not keep the place, or only for this session. */
  constructor(
    private readonly group: Object3D,
    private readonly refused: (hold: Hold) => void,
  ) {}

  /** True while the anchor of an earlier session is searched for. */
  get waits(): boolean {
    return performance.now() < this.waitsUntil
  }

  /** True if the group is at an anchor of an earlier session. */
  get found(): boolean {
    return this.anchor !== null && Number.isNaN(this.waitsUntil)
  }

  /** Restore the anchor of an earlier session, if there is one. */
  async restore(session: XRSession): Promise<void> {
    this.session = session
    // A place that was chosen without a headset is no place of this room.
    this.wanted = false
    const place = ++this.placing
    const handle = localStorage.getItem(KEY)
    if (handle === null || session.restorePersistentAnchor === undefined) return
    try {
      const anchor = await session.restorePersistentAnchor(handle)
      if (place !== this.placing) return
      this.anchor = anchor
      this.hold = 'kept'
      this.waitsUntil = performance.now() + FOUND_MS
    } catch {
      // the headset forgot it
      this.forget()
    }
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

  /** Follow the anchor; create the wanted one. */
  update(frame: XRFrame, space: XRReferenceSpace): void {
    if (this.wanted) {
      this.wanted = false
      this.make(frame, space)
    }
    if (this.anchor === null) return
    const pose = frame.getPose(this.anchor.anchorSpace, space)
    // Not tracked: it stays at its last place.
    if (pose === undefined) return
    matrix.fromArray(pose.transform.matrix)
    matrix.decompose(this.group.position, this.group.quaternion, scale)
    this.waitsUntil = Number.NaN
  }

  /** Forget the anchors of a session that ended. */
  end(): void {
    this.session = null
    this.anchor = null
    this.wanted = false
    this.hold = 'none'
    this.waitsUntil = Number.NaN
    this.placing++
  }

  private release(): void {
    const { anchor } = this
    this.anchor = null
    this.hold = 'none'
    this.waitsUntil = Number.NaN
    this.placing++
    anchor?.delete()
  }

  /** Delete the kept place: a headset has few for all pages and apps, and deletes none itself. */
  private async forget(): Promise<void> {
    const handle = localStorage.getItem(KEY)
    if (handle === null) return
    localStorage.removeItem(KEY)
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
      await this.forget()
      const handle = await anchor.requestPersistentHandle()
      if (place !== this.placing) {
        await this.session?.deletePersistentAnchor?.(handle)
        return
      }
      localStorage.setItem(KEY, handle)
      this.hold = 'kept'
    } catch {
      // As if all places of the headset were taken.
      if (place === this.placing) this.refused(this.hold)
    }
  }
}
