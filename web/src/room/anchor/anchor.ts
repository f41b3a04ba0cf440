import { Matrix4, type Object3D, type Quaternion, Vector3 } from 'three'

/** What holds the scene in place: a persistent anchor, one of this session, or nothing but the floor
 * space itself. */
export type Hold = 'kept' | 'session' | 'none'

const KEY = 'mrlab.room.anchor'
const UP = new Vector3(0, 1, 0)
const matrix = new Matrix4()
const scale = new Vector3()
const forward = new Vector3()
const offset = new Vector3()

/** Holds the one group that all of the lab is below. World poses are stored nowhere: after a
 * recentre the anchor's own pose says where the group is now. */
export class SceneAnchor {
  hold: Hold = 'none'
  private anchor: XRAnchor | null = null
  private wanted = false

  constructor(private readonly group: Object3D) {}

  /** Bring back the anchor of an earlier session; false: there is none, or it is not here. */
  async restore(session: XRSession): Promise<boolean> {
    const handle = localStorage.getItem(KEY)
    if (handle === null || session.restorePersistentAnchor === undefined) return false
    try {
      this.anchor = await session.restorePersistentAnchor(handle)
      this.hold = 'kept'
      return true
    } catch {
      // another room, or the headset forgot it
      localStorage.removeItem(KEY)
      return false
    }
  }

  /** Put the group's origin on the floor so that `centre`, in the group's frame, is `away`, m, before
   * the eyes, and hold it there from the next frame on. floor: its height, m. */
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

  /** Follow the anchor; make one where it is wanted. */
  update(frame: XRFrame, space: XRReferenceSpace): void {
    if (this.wanted) {
      this.wanted = false
      this.make(frame, space)
    }
    if (this.anchor === null) return
    const pose = frame.getPose(this.anchor.anchorSpace, space)
    // not tracked now: it stays where it was seen last
    if (pose === undefined) return
    matrix.fromArray(pose.transform.matrix)
    matrix.decompose(this.group.position, this.group.quaternion, scale)
  }

  /** Forget what belongs to a session that ended. */
  end(): void {
    this.anchor = null
    this.wanted = false
    this.hold = 'none'
  }

  private release(): void {
    const { anchor } = this
    this.anchor = null
    this.hold = 'none'
    anchor?.delete()
  }

  private make(frame: XRFrame, space: XRReferenceSpace): void {
    if (frame.createAnchor === undefined) return
    const { position: p, quaternion: q } = this.group
    const pose = new XRRigidTransform(
      { x: p.x, y: p.y, z: p.z },
      { x: q.x, y: q.y, z: q.z, w: q.w },
    )
    frame
      .createAnchor(pose, space)
      ?.then((anchor) => {
        this.anchor = anchor
        this.hold = 'session'
        return anchor.requestPersistentHandle?.()
      })
      .then((handle) => {
        if (handle === undefined) return
        localStorage.setItem(KEY, handle)
        this.hold = 'kept'
      })
      // refused, as where the headset's places are all taken: the line on the board says so
      .catch(() => undefined)
  }
}
