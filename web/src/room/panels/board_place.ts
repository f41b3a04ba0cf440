import { MathUtils, type PerspectiveCamera, type Quaternion, Vector3 } from 'three'
import type { Viewer } from '../anchor/alignment'
import type { RoomContext } from '../context'
import type { Board } from './board'
import { Stand } from './stand'

/** rad: a board that is this far to the side of where one looks, for so long, s, comes along. */
const ASIDE = (75 * Math.PI) / 180
const ASIDE_S = 1.5
const SIDE = (36 * Math.PI) / 180
/** rad: half of what the board takes of the view, on a screen. */
const HALF_SCREEN = (15.5 * Math.PI) / 180
/** m */
const AWAY = 0.95
const AWAY_SCREEN = 1.35
const BELOW_EYES = 0.22

const at = new Vector3()

/** Keeps the board at the hand that does not work, a little to the side of where one looks. */
export class BoardPlace {
  private readonly stand: Stand
  private yaw = 0
  private asideSince = Number.NaN

  constructor(
    private readonly board: Board,
    private readonly context: RoomContext,
  ) {
    this.stand = new Stand(board.panel.group)
  }

  /** Take where somebody looks as straight ahead. */
  face(look: Quaternion): void {
    this.yaw = yawOf(look)
  }

  /** Before each picture. now, step: s. screen: the camera of the view without a headset. Returns
   * whether the board moves. */
  update(
    { head, look }: Viewer,
    now: number,
    step: number,
    screen: PerspectiveCamera | null,
  ): boolean {
    const yaw = yawOf(look)
    const off = Math.abs(Math.atan2(Math.sin(yaw - this.yaw), Math.cos(yaw - this.yaw)))
    if (off < ASIDE) this.asideSince = Number.NaN
    else if (Number.isNaN(this.asideSince)) this.asideSince = now
    else if (now - this.asideSince > ASIDE_S) this.yaw = yaw
    const { leftHanded } = this.context
    const aside = screen === null ? SIDE : Math.min(SIDE, halfView(screen) - HALF_SCREEN)
    const side = this.yaw + (leftHanded ? -aside : aside)
    at.set(-Math.sin(side), 0, -Math.cos(side)).multiplyScalar(
      screen === null ? AWAY : AWAY_SCREEN,
    )
    at.add(head).setY(head.y - BELOW_EYES)
    return this.stand.update(at, head, now, step, this.board.panel.pointers > 0, this.context)
  }
}

/** Return half of what a camera sees from left to right, rad. */
function halfView({ fov, aspect }: PerspectiveCamera): number {
  return Math.atan(Math.tan(MathUtils.degToRad(fov) / 2) * aspect)
}

/** Return the heading of a look about the vertical, rad; 0 looks along -z. */
function yawOf({ x, y, z, w }: Quaternion): number {
  return Math.atan2(2 * (w * y + x * z), 1 - 2 * (x * x + y * y))
}
