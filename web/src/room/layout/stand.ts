import { MathUtils, type Object3D, Quaternion, Vector3 } from 'three'
import type { Preferences } from '../ports'
import { dock, type Edge } from './dock'

const LARGEST = 2
/** rad, m and s: a panel that is this far from its wanted place, for so long, follows. */
const SLACK_TURN = MathUtils.degToRad(30)
const SLACK_WAY = 0.6
const WAIT = 0.5
const EASE = 0.3
/** m: nearer it is moved away from the eyes. */
const NEAREST = 0.75

const UP = new Vector3(0, 1, 0)
const X = new Vector3(1, 0, 0)
const away = new Vector3()
const back = new Vector3()
const wanted = new Vector3()
const turned = new Quaternion()
const tilt = new Quaternion()

/** Keeps a panel readable: it stands still, and follows once it has been in a wrong place for a
 * while; never under a pointer. */
export class Stand {
  private readonly place = new Vector3()
  private readonly turn = new Quaternion()
  private wrongSince = Number.NaN
  private movedAt = Number.NEGATIVE_INFINITY
  private here = false

  /** edge: of a screen that is taller than wide, at which it stands. size: of 1 m at `readAt`.
   * exact: its wanted place is where it is to be, without slack. */
  constructor(
    private readonly panel: Object3D,
    private readonly edge: Edge = 'bottom',
    private readonly size = 1,
    private readonly exact = false,
  ) {}

  /** at: its wanted place in the floor space, m. now, step: s. held: a pointer is over it. Beyond
   * `readAt` it grows; with `still` it does not glide. On a screen it lies flat in the picture.
   * Returns whether it moves. */
  update(
    at: Vector3,
    head: Vector3,
    now: number,
    step: number,
    held: boolean,
    {
      readAt,
      still,
      screen,
      textScale,
    }: Pick<Preferences, 'readAt' | 'still' | 'screen' | 'textScale'>,
  ): boolean {
    if (screen !== null) {
      this.here = false
      return dock(this.panel, at, screen, this.edge)
    }
    back.subVectors(at, head)
    const distance = back.length()
    if (distance < NEAREST && distance > 1e-3) {
      back.setY(0).normalize().multiplyScalar(NEAREST)
      wanted.set(head.x + back.x, at.y, head.z + back.z)
    } else wanted.copy(at)
    away.subVectors(head, wanted)
    turned.setFromAxisAngle(UP, Math.atan2(away.x, away.z))
    const pitch = Math.atan2(away.y, Math.hypot(away.x, away.z))
    turned.multiply(tilt.setFromAxisAngle(X, -pitch))
    if (!this.here) {
      this.here = true
      this.movedAt = Number.NEGATIVE_INFINITY
      this.place.copy(wanted)
      this.turn.copy(turned)
      this.panel.position.copy(wanted)
      this.panel.quaternion.copy(turned)
    }
    const { exact } = this
    const slack = exact ? 0.01 : SLACK_WAY
    const wrong = this.place.distanceTo(wanted) > slack || this.turn.angleTo(turned) > SLACK_TURN
    if (!wrong || held) this.wrongSince = Number.NaN
    else if (Number.isNaN(this.wrongSince) && !exact) this.wrongSince = now
    else if (exact || now - this.wrongSince > WAIT) {
      this.wrongSince = Number.NaN
      this.movedAt = now
      this.place.copy(wanted)
      this.turn.copy(turned)
    }
    const moves = now - this.movedAt < 3 * EASE
    if (moves) {
      const share = still ? 1 : 1 - Math.exp((-4 * step) / EASE)
      this.panel.position.lerp(this.place, share)
      this.panel.quaternion.slerp(this.turn, share)
    }
    const far = this.panel.position.distanceTo(head) / readAt
    const scale = MathUtils.clamp(far, 0.85, LARGEST) * this.size * textScale
    // small changes of the distance do not make text swim
    const swims = Math.abs(this.panel.scale.x - scale) < 0.08 * this.size
    if (!swims) this.panel.scale.setScalar(scale)
    return moves
  }
}
