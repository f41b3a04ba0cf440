import { GAP, HIT, type Pen, TEXT } from './pen'

const PAGE = 4
const TOP = 86
const ARROW = 90

/** One that can be chosen. */
export interface Choice {
  readonly id: string
  readonly words: string
  readonly note: string
}

/** The actions of a paged list. */
interface ListActions {
  choose(id: string): void
  back(): void
}

/** A list of a panel, a page at a time. */
export class PagedList {
  page = 0

  /** edge: mm at each side. back: words of the button that leaves the list. */
  draw(
    pen: Pen,
    edge: number,
    entries: readonly Choice[],
    back: string,
    actions: ListActions,
  ): void {
    const { width, height } = pen
    const pages = Math.max(Math.ceil(entries.length / PAGE), 1)
    this.page = Math.min(this.page, pages - 1)
    const first = this.page * PAGE
    entries.slice(first, first + PAGE).forEach(({ id, words, note }, i) => {
      const y = TOP + i * (HIT + GAP)
      const label = note === '' || note === words ? words : `${words} · ${note}`
      pen.button(`choose ${id}`, edge, y, width - 2 * edge, label, () => actions.choose(id))
    })
    const y = height - HIT - edge
    pen.button('back', edge, y, 190, back, () => actions.back())
    if (pages === 1) return
    const turn = (by: number) => () => {
      this.page += by
    }
    const right = width - edge
    pen.button('previous', right - 3 * ARROW - GAP, y, ARROW, '‹', turn(-1), {
      enabled: this.page > 0,
    })
    const place = `${this.page + 1} / ${pages}`
    const middle = right - 1.5 * ARROW - GAP / 2
    pen.text(middle, y + HIT / 2, place, TEXT.small, 80, 'second', 400, 'center')
    pen.button('next', right - ARROW, y, ARROW, '›', turn(1), { enabled: this.page < pages - 1 })
  }
}
