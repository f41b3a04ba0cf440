import { Quaternion, Vector3 } from 'three'
import type { Viewer } from '../ports'
import type { RoomStage } from '../scene/stage'
import type { SceneAnchor } from './anchor'
import type { RoomScan } from './scan'
import type { Place } from './supports'

/** Distance of the scene's middle from the eyes, m. */
const AWAY = 1.5
const at = new Vector3()

/** The eyes of the desktop view. */
export const SEATED: Viewer = { head: new Vector3(0, 1.6, 0.9), look: new Quaternion() }

/** Places the scene before a person who enters, unless an anchor of an earlier session places
 * it. */
export class Alignment {
  private aligned = false

  constructor(
    private readonly stage: RoomStage,
    private readonly anchor: SceneAnchor,
    private readonly scan: RoomScan,
    private readonly bases: () => Iterable<Place>,
  ) {}

  /** A session begins. */
  begin(session: XRSession): void {
    this.aligned = false
    this.anchor.restore(session)
  }

  /** True if the scene is still to be put before the eyes. */
  get due(): boolean {
    return !this.aligned && !this.anchor.waits && !this.anchor.held
  }

  /** Put the scene's middle on the floor before a person. */
  align({ head, look }: Viewer): void {
    at.set(0, 0, 0)
    let count = 0
    for (const { x, y, z } of this.bases()) {
      at.x += x
      at.y += y
      at.z += z
      count++
    }
    if (count > 0) at.divideScalar(count).applyQuaternion(this.stage.world.quaternion)
    const floor = Number.isNaN(this.scan.floor) ? 0 : this.scan.floor
    this.anchor.place(head, look, at, count > 0 ? AWAY : 0, floor)
    this.stage.anchor.updateMatrixWorld(true)
    this.aligned = true
  }
}
