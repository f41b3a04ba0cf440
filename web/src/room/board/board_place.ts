import { type Quaternion, Vector3 } from 'three'
import { Stand } from '../layout/stand'
import type { Preferences, Viewer } from '../ports'
import type { Board } from './board'

/** rad and s: a board that is this far from the direction of the look, for so long, follows. */
const ASIDE = (75 * Math.PI) / 180
const ASIDE_S = 1.5
const SIDE = (36 * Math.PI) / 180
/** m */
const AWAY = 0.95
const BELOW_EYES = 0.22
/** Of the board: body text has 1.0 degree, the whole 34 x 27. */
const SIZE = 0.76

const at = new Vector3()

/** Keeps the board at the side of the idle hand, beside the direction of the look. */
export class BoardPlace {
  private readonly stand: Stand
  private yaw = 0
  private asideSince = Number.NaN

  /** away: true while something is placed. */
  constructor(
    private readonly board: Board,
    private readonly ports: Preferences,
    private readonly away: () => boolean,
  ) {
    this.stand = new Stand(board.panel.group, 'top', SIZE)
  }

  /** Take the direction of a look as straight ahead. */
  face(look: Quaternion): void {
    this.yaw = yawOf(look)
  }

  /** Before each picture. now, step: s. Returns whether the board moves. */
  update({ head, look }: Viewer, now: number, step: number): boolean {
    // On a screen it lies at the edge; in a headset it would stand before what is placed.
    this.board.panel.group.visible = this.ports.screen !== null || !this.away()
    const yaw = yawOf(look)
    const off = Math.abs(Math.atan2(Math.sin(yaw - this.yaw), Math.cos(yaw - this.yaw)))
    if (this.ports.screen !== null) this.yaw = yaw
    else if (off < ASIDE) this.asideSince = Number.NaN
    else if (Number.isNaN(this.asideSince)) this.asideSince = now
    else if (now - this.asideSince > ASIDE_S) this.yaw = yaw
    const side = this.yaw + (this.ports.leftHanded ? -SIDE : SIDE)
    at.set(-Math.sin(side), 0, -Math.cos(side)).multiplyScalar(AWAY)
    at.add(head).setY(head.y - BELOW_EYES)
    return this.stand.update(at, head, now, step, this.board.panel.pointers > 0, this.ports)
  }
}

/** Return the heading of a look about the vertical, rad; 0 looks along -z. */
function yawOf({ x, y, z, w }: Quaternion): number {
  return Math.atan2(2 * (w * y + x * z), 1 - 2 * (x * x + y * y))
}
