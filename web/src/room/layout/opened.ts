/** The one thing of the scene whose panel is open; the others have chips. */
export class Opened {
  /** null: the first one there is; empty: none, a person closed it. */
  private chosen: string | null = null
  private there: readonly string[] = []

  /** The name of the open one; empty: none. */
  get name(): string {
    const { chosen, there } = this
    if (chosen === '') return ''
    return chosen !== null && there.includes(chosen) ? chosen : (there[0] ?? '')
  }

  open(name: string): void {
    this.chosen = name
  }

  close(): void {
    this.chosen = ''
  }

  /** Take over the things that have panels, systems first. */
  keep(there: readonly string[]): void {
    const { chosen } = this
    const gone = chosen !== null && this.there.includes(chosen) && !there.includes(chosen)
    if (there.length === 0 || gone) this.chosen = null
    this.there = there
  }
}
