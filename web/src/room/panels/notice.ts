/** s for which a sentence stays. */
const SHOWN_S = 8

/** A sentence that a panel shows for some seconds. */
export class Notice {
  text = ''
  private now = 0
  private shownAt = 0

  /** changed: called when the text has changed. */
  constructor(private readonly changed: () => void) {}

  readonly say = (text: string): void => {
    this.text = text
    this.shownAt = this.now
    this.changed()
  }

  /** now: s. */
  update(now: number): void {
    this.now = now
    if (this.text === '' || now - this.shownAt <= SHOWN_S) return
    this.text = ''
    this.changed()
  }
}
