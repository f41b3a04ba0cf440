import type { LabFollower } from '../../lab/follower'
import type { Surroundings } from '../panels/panel'
import { Panel } from '../panels/panel'
import { GAP, HIT, PANEL_THEME, type Pen, TEXT } from '../panels/pen'
import type { Lab, Speech } from '../ports'
import type { Drawings } from '../scene/drawings'

export const BOARD_WIDTH = 760
export const BOARD_HEIGHT = 600
export const EDGE = 26
/** mm from the top at which the content of a tab begins, and at which it ends. */
export const TOP = 112
export const BOTTOM = BOARD_HEIGHT - 62
const NOTICE_S = 10
/** s that it is left alone when another one comes. */
const READ_S = 1.5
const MOST_WAITING = 3
/** s between two checks whether the text of the shown tab has changed. */
const ASK_PERIOD = 1
/** mm */
const UNDO_WIDTH = 180
const UNDO_HEIGHT = 50
/** mm between two tabs; and the width of a tab's margins, in letters. */
const TAB_GAP = 8
const TAB_MARGIN = 2.5

/** A page of the board. */
export interface Tab {
  readonly id: string
  readonly words: string
  /** Return the text that changes with time; the tab is repainted when it differs. */
  says?(): string
  draw(pen: Pen): void
}

/** The ports of a tab that lists something of the lab. */
export interface TabPorts extends Speech, Lab {
  repaintBoard(): void
}

/** An act that can be undone: what was done, and the words of the button. undo: null where the
 * person may not. */
interface Undoable {
  readonly words: string
  readonly label: string
  readonly undo: (() => void) | null
}

/** Return a tab of another part of the pages. */
export type MakeTab = (ports: TabPorts, follower: LabFollower, drawings: Drawings) => Tab

/** The panel beside the person, with tabs for the catalogues, the lab and the room. */
export class Board {
  readonly panel: Panel
  tabs: readonly Tab[] = []
  private chosen = 0
  private stands = ''
  private notice = ''
  private warns = false
  private noticedAt = 0
  private readonly waiting: { readonly text: string; readonly warns: boolean }[] = []
  private now = 0
  private askedAt = 0
  /** What was done and can be undone; null: nothing. */
  private undoable: Undoable | null = null
  /** The changing text of the tab when it was last read. */
  private said = ''

  constructor(ports: Surroundings) {
    this.panel = new Panel(BOARD_WIDTH, BOARD_HEIGHT, (pen) => this.draw(pen), ports)
  }

  /** A problem that lasts; shown when there is no newer sentence. */
  set standing(text: string) {
    if (text === this.stands) return
    this.stands = text
    this.panel.repaint()
  }

  /** Offer to undo an act of anybody; null: there is none. */
  offer(act: Undoable | null): void {
    this.undoable = act
    this.panel.repaint()
  }

  /** Show a tab by its id. */
  open(id: string): void {
    this.chosen = Math.max(
      this.tabs.findIndex((tab) => tab.id === id),
      0,
    )
    this.panel.repaint()
  }

  /** Show a sentence at the bottom for a while, after those before it could be read. */
  say(text: string, warns = true): void {
    if ((this.waiting.at(-1)?.text ?? this.notice) === text) return
    this.waiting.push({ text, warns })
    if (this.waiting.length > MOST_WAITING) this.waiting.shift()
    this.next()
  }

  private next(): void {
    const read = this.notice === '' || this.now - this.noticedAt > READ_S
    const [first] = this.waiting
    if (first === undefined || !read) return
    this.waiting.shift()
    this.notice = first.text
    this.warns = first.warns
    this.noticedAt = this.now
    this.panel.repaint()
  }

  update(now: number): void {
    this.now = now
    if (now - this.askedAt > ASK_PERIOD) {
      this.askedAt = now
      const says = this.tabs[this.chosen]?.says?.() ?? ''
      if (says !== this.said) this.panel.repaint()
      this.said = says
    }
    this.next()
    if (this.notice !== '' && now - this.noticedAt > NOTICE_S) {
      this.notice = ''
      this.panel.repaint()
    }
    this.panel.update()
  }

  private draw(pen: Pen): void {
    // A tab is as wide as its word in the reader's language.
    const room = BOARD_WIDTH - 2 * EDGE - (this.tabs.length - 1) * TAB_GAP
    const letters = this.tabs.reduce((sum, { words }) => sum + words.length + TAB_MARGIN, 0)
    let x = EDGE
    this.tabs.forEach(({ id, words }, i) => {
      const width = (room * (words.length + TAB_MARGIN)) / Math.max(letters, 1)
      const open = () => {
        this.chosen = i
      }
      pen.button(`tab ${id}`, x, 24, width, words, open, {
        chosen: i === this.chosen,
        small: true,
      })
      x += width + TAB_GAP
    })
    this.tabs[this.chosen]?.draw(pen)
    const { undoable } = this
    const undo = undoable?.undo ?? null
    const text = undoable?.words || this.notice || this.stands
    if (text === '') return
    const warns = undoable !== null || this.notice === '' || this.warns
    const ink = warns ? PANEL_THEME.states.PAUSED : PANEL_THEME.colours.second
    const wide = BOARD_WIDTH - 2 * EDGE - (undo === null ? 0 : UNDO_WIDTH + EDGE)
    pen.lines(EDGE, BOTTOM + 18, text, TEXT.small, wide, ink, 2)
    if (undoable === null || undo === null) return
    const left = BOARD_WIDTH - EDGE - UNDO_WIDTH
    const look = { primary: true, small: true }
    pen.button('undo', left, BOTTOM + 4, UNDO_WIDTH, undoable.label, undo, look, UNDO_HEIGHT)
  }
}

/** Draw a page of cards, with ‹ and › if there are more; `page` is the number of the page. */
export function drawCards<T>(
  pen: Pen,
  top: number,
  entries: readonly T[],
  page: { value: number },
  card: (entry: T, x: number, y: number, width: number, height: number) => void,
): void {
  const columns = 4
  const width = (BOARD_WIDTH - 2 * EDGE - (columns - 1) * GAP) / columns
  const height = (BOTTOM - top - HIT - 2 * GAP) / 2
  const each = columns * 2
  const pages = Math.max(Math.ceil(entries.length / each), 1)
  page.value = Math.min(page.value, pages - 1)
  entries.slice(page.value * each, (page.value + 1) * each).forEach((entry, i) => {
    const x = EDGE + (i % columns) * (width + GAP)
    const y = top + Math.floor(i / columns) * (height + GAP)
    card(entry, x, y, width, height)
  })
  if (pages === 1) return
  const y = BOTTOM - HIT
  const turn = (by: number) => () => {
    page.value += by
  }
  const right = BOARD_WIDTH - EDGE
  pen.button('previous', right - 290, y, 90, '‹', turn(-1), { enabled: page.value > 0 })
  const place = `${page.value + 1} / ${pages}`
  pen.text(right - 145, y + HIT / 2, place, TEXT.small, 90, 'second', 400, 'center')
  pen.button('next', right - 90, y, 90, '›', turn(1), { enabled: page.value < pages - 1 })
}
