import type { Group, Object3D, Vector3 } from 'three'
import { Label } from '../../scene/stage/labels'
import { BOARD_HEIGHT, BOARD_WIDTH, EDGE } from '../board/board'
import type { Surroundings } from '../panels/panel'
import { Panel } from '../panels/panel'
import { GAP, HIT, type Pen, TEXT } from '../panels/pen'
import type { Speech } from '../ports'
import { STEPS, type Tour } from './tour'

const HEIGHT = 176
const MM = 0.001
const BELOW = 24 // mm, of the board
const PROMPT = 0.032 // of the distance to it
const OVER = 0.07 // m, of a prompt over the hand

/** The input device of a person, on which the text of a prompt depends. */
type Means = 'mouse' | 'controller' | 'hand'

/** The tour's own panel below the board, and a prompt at the working hand. */
export class TourPanel {
  readonly panel: Panel
  private means: Means = 'mouse'
  private prompt: Label | null = null
  private said = ''

  /** board: the panel hangs below it. floor: the floor space, in which hands are. */
  constructor(
    private readonly ports: Speech & Surroundings,
    private readonly tour: Tour,
    board: Group,
    private readonly floor: Object3D,
  ) {
    this.panel = new Panel(BOARD_WIDTH, HEIGHT, (pen) => this.draw(pen), ports)
    this.hang(0)
    this.panel.group.visible = tour.step !== null
    board.add(this.panel.group)
  }

  /** Set the additional distance below the board, mm. */
  hang(lower: number): void {
    this.panel.group.position.y = -(BOARD_HEIGHT / 2 + BELOW + HEIGHT / 2 + lower) * MM
  }

  /** Before each picture. hand: place of the working hand; null: there is none. */
  update(means: Means, hand: Vector3 | null): void {
    const { step } = this.tour
    this.panel.group.visible = step !== null
    if (step === null) {
      this.promptAt('', null)
      return
    }
    if (means !== this.means) {
      this.means = means
      this.panel.repaint()
    }
    const { gestures } = this.ports.words.room.tour
    this.promptAt(means === 'mouse' ? '' : gestures[means][step], hand)
    this.panel.update()
  }

  dispose(): void {
    this.panel.dispose()
    this.prompt?.dispose()
  }

  private promptAt(words: string, hand: Vector3 | null): void {
    if (words !== this.said) {
      this.said = words
      this.prompt?.dispose()
      this.prompt = words === '' ? null : new Label(words, PROMPT)
      this.prompt?.paint('#1B2129', '#FFE08A')
      if (this.prompt !== null) this.floor.add(this.prompt.sprite)
    }
    if (this.prompt === null) return
    this.prompt.sprite.visible = hand !== null
    if (hand !== null) this.prompt.sprite.position.copy(hand).setY(hand.y + OVER)
  }

  private draw(pen: Pen): void {
    const { step, number } = this.tour
    if (step === null) return
    const w = this.ports.words.room.tour
    pen.text(EDGE, 34, w.title(number, STEPS.length), TEXT.small, 500, 'accent', 600)
    pen.lines(EDGE, 66, w.steps[step], TEXT.body, BOARD_WIDTH - 2 * EDGE, 'ink', 2)
    const y = HEIGHT - HIT - 14
    const act = (what: () => void) => () => {
      what()
      this.panel.repaint()
    }
    const width = 170
    const right = BOARD_WIDTH - EDGE - width
    pen.button(
      'skip_tour',
      right,
      y,
      width,
      w.end,
      act(() => this.tour.skip()),
    )
    pen.button(
      'next_step',
      right - width - GAP,
      y,
      width,
      w.next,
      act(() => this.tour.next()),
    )
  }
}
