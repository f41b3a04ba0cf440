import type { StateName } from '../../design/tokens'
import { Panel, type Surroundings } from './panel'
import { PANEL_THEME, type Pen, TEXT } from './pen'

const WIDTH = 300
const HEIGHT = 84
const EDGE = 12
const SIDE = HEIGHT - 2 * EDGE

/** The content of a chip. picture: null: none. word: of its state. */
export interface ChipShown {
  readonly name: string
  readonly state: StateName
  readonly word: string
  readonly picture: HTMLImageElement | null
  readonly playable: boolean
}

/** Stands for a panel that is not open: picture, name, state, play. */
export class Chip {
  readonly panel: Panel
  private last: ChipShown | null = null

  /** open: show the whole panel. play: play or pause. */
  constructor(
    surroundings: Surroundings,
    private readonly open: () => void,
    private readonly play: () => void,
  ) {
    this.panel = new Panel(WIDTH, HEIGHT, (pen) => this.draw(pen), surroundings)
  }

  show(shown: ChipShown): void {
    const { last } = this
    this.last = shown
    const keys = ['name', 'state', 'word', 'picture', 'playable'] as const
    if (last === null || keys.some((key) => last[key] !== shown[key])) this.panel.repaint()
  }

  private draw(pen: Pen): void {
    const { last } = this
    if (last === null) return
    const { name, state, word, picture, playable } = last
    const halted = state === 'COLLISION_HALT'
    const colour = PANEL_THEME.states[state]
    const left = picture === null ? EDGE + 8 : EDGE + SIDE + 10
    const right = playable ? WIDTH - EDGE - SIDE : WIDTH - EDGE
    pen.whole('open', right, HEIGHT, this.open)
    if (picture !== null) pen.context.drawImage(picture, EDGE, EDGE, SIDE, SIDE)
    pen.text(left, 28, name, TEXT.body, right - left - 6, 'ink', 650)
    if (halted) pen.box(left - 6, 44, right - left, 32, colour)
    const ink = halted ? PANEL_THEME.colours.on_halt : colour
    pen.text(left, 60, word, TEXT.small, right - left - 6, ink, 600)
    if (!playable) return
    const moving = state === 'PLAYING' || state === 'ADJUSTING'
    pen.button(
      'play',
      right,
      EDGE,
      SIDE,
      moving ? 'Ⅱ' : '▶',
      this.play,
      { primary: !halted },
      SIDE,
    )
  }
}
