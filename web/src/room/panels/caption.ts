import { Quaternion, Vector3 } from 'three'
import type { Viewer } from '../ports'
import { Panel, type Surroundings } from './panel'
import { TEXT } from './pen'

/** mm */
const WIDTH = 640
const HEIGHT = 104
const EDGE = 24
/** m before the eyes, and below them. */
const AHEAD = 1.1
const BELOW = 0.48
/** s for which a sentence stays, and more for each letter. */
const SHOWN_S = 3
const LETTER_S = 0.05
/** Time constant, s, with which it follows the gaze. */
const EASE = 0.25
const UP = new Vector3(0, 1, 0)

const to = new Vector3()
const turn = new Quaternion()

/** What happens, as a sentence low in the view, for who cannot hear it or looks elsewhere. It is in
 * nobody's way: no pointer meets it. */
export class Caption {
  readonly panel: Panel
  private text = ''
  /** s; NaN: it is not shown yet. */
  private until = Number.NaN

  constructor(
    ports: Surroundings,
    private readonly wanted: () => boolean,
  ) {
    this.panel = new Panel(
      WIDTH,
      HEIGHT,
      (pen) => pen.lines(EDGE, 34, this.text, TEXT.read, WIDTH - 2 * EDGE, 'ink', 2),
      ports,
    )
    this.panel.group.visible = false
  }

  /** Show a sentence in place of the one before. */
  say(text: string): void {
    this.text = text
    this.until = Number.NaN
    this.panel.repaint()
  }

  /** Before each picture. now, step: s. */
  update({ head, look }: Viewer, now: number, step: number): void {
    const { group } = this.panel
    if (this.text !== '' && Number.isNaN(this.until)) {
      this.until = now + SHOWN_S + LETTER_S * this.text.length
    }
    const shown = this.text !== '' && now < this.until && this.wanted()
    const appears = shown && !group.visible
    group.visible = shown
    if (!shown) {
      this.text = ''
      return
    }
    to.set(0, 0, -1).applyQuaternion(look).setY(0)
    if (to.lengthSq() < 1e-4) to.set(0, 0, -1)
    to.normalize()
    turn.setFromAxisAngle(UP, Math.atan2(-to.x, -to.z))
    to.multiplyScalar(AHEAD).add(head)
    to.y -= BELOW
    const share = appears ? 1 : 1 - Math.exp(-step / EASE)
    group.position.lerp(to, share)
    group.quaternion.slerp(turn, share)
    this.panel.update()
  }
}
