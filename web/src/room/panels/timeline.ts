import type { Group } from 'three'
import type { RemotePlayer } from '../../playback/player'
import { fixed } from '../../words/words'
import { LiveInk } from './live_ink'
import { PANEL_THEME, type Pen, TEXT } from './pen'

const THICK = 8
const KNOB = 30
/** s between two seeks of one drag. */
const SEEK_PERIOD = 0.05
/** s between two paintings of the running time. */
const READ_PERIOD = 0.1
/** mm from the track to the middle of the row below it that says the time. */
const BELOW = 10
/** Letters of the row. */
const MOST = 64
/** The boxes of a timeline: its bar and its knob. */
const BAR = 0
const DISC = 1

/** The rectangle of a timeline in its panel, mm from the left top corner. */
export interface Track {
  readonly x: number
  readonly y: number
  readonly width: number
  readonly height: number
}

/** A place on the timeline, s: a bar, a word above it. */
export interface Mark {
  readonly time: number
  readonly colour: string
  readonly words: string
}

/** The timeline of a panel: bar, knob and time are apart, so that the passing time repaints
 * nothing. */
export class Timeline {
  private readonly ink: LiveInk
  private said = ''
  /** mm, of the bar when it was drawn last. */
  private length = Number.NaN
  /** Number of completed drags. */
  scrubs = 0
  private scrub: number | null = null
  private soughtAt = 0
  private now = 0
  private readAt = Number.NaN

  /** width, height: of the panel, mm. noteAt: returns the text at its right end for a position, s.
   * stir: requests a picture. */
  constructor(
    group: Group,
    width: number,
    height: number,
    private readonly track: Track,
    private readonly noteAt: (position: number) => string,
    private readonly stir: () => void,
  ) {
    this.ink = new LiveInk(group, { letters: MOST, boxes: 2 }, width, height)
    this.ink.fill(BAR, PANEL_THEME.colours.accent, 'box')
    this.ink.fill(DISC, PANEL_THEME.colours.accent, 'disc')
  }

  /** Return its position, s: of a drag, else of the lab. */
  position(player: RemotePlayer): number {
    return this.scrub ?? player.position()
  }

  /** Before each picture; null: there is nothing to show. now: s. */
  update(player: RemotePlayer | null, now: number): void {
    this.now = now
    this.ink.visible = player !== null
    if (player === null) return
    if (Number.isNaN(this.readAt)) {
      this.read(player)
      // not in the same picture as other panels
      this.readAt -= READ_PERIOD * Math.random()
    } else if (now - this.readAt > READ_PERIOD) this.read(player)
    const { x, y, width, height } = this.track
    const share = player.duration > 0 ? this.position(player) / player.duration : 0
    const length = Math.max(share * width, 0.1)
    if (length === this.length) return
    this.length = length
    const middle = y + height / 2
    this.ink.move(BAR, x, middle - THICK / 2, length, THICK)
    this.ink.move(DISC, x + length - KNOB / 2, middle - KNOB / 2, KNOB, KNOB)
  }

  /** Paint the static part: the track and its marks. */
  draw(pen: Pen, player: RemotePlayer, marks: readonly Mark[]): void {
    const { x, y, width, height } = this.track
    const middle = y + height / 2
    const { duration } = player
    pen.box(x, middle - THICK / 2, width, THICK, PANEL_THEME.colours.hairline)
    for (const { time, colour, words } of marks) {
      const at = x + (duration > 0 ? time / duration : 0) * width
      const half = words === '' ? 16 : 20
      pen.box(at - 2.5, middle - half, 5, 2 * half, colour)
      if (words !== '') pen.text(at, middle - 30, words, TEXT.small, 120, 'second', 400, 'center')
    }
    pen.zone({
      id: 'timeline',
      x,
      y,
      width,
      height,
      enabled: true,
      drags: true,
      press: (share, final) => this.seek(player, share * duration, final),
    })
  }

  dispose(): void {
    this.ink.dispose()
  }

  /** Paint the time. */
  private read(player: RemotePlayer): void {
    this.readAt = this.now
    const position = this.position(player)
    const time = `${fixed(position, 1)} / ${fixed(player.duration, 1)} s`
    const note = this.noteAt(position)
    const { ink, second } = PANEL_THEME.colours
    const said = `${time} ${note} ${ink}`
    if (said === this.said) return
    this.said = said
    const { x, y, width, height } = this.track
    const row = y + height + BELOW
    this.ink.begin()
    this.ink.put(time, x, row, ink)
    this.ink.put(note, x + width, row, second, 'right')
    this.ink.end()
    this.stir()
  }

  private seek(player: RemotePlayer, position: number, final: boolean): void {
    this.scrub = final ? null : position
    if (final) this.scrubs++
    this.read(player)
    if (!final && this.now - this.soughtAt < SEEK_PERIOD) return
    this.soughtAt = this.now
    player.seek(position)
  }
}
