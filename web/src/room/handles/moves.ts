/** Sends the newest of values that change in each frame: one call at a time, `period`, s, apart. */
export class Moves<T> {
  private calling = false
  private last: T | null = null
  private sentAt = Number.NEGATIVE_INFINITY

  constructor(
    private readonly period: number,
    private readonly call: (value: T) => Promise<unknown>,
  ) {}

  /** True while a value is unanswered. */
  get unanswered(): boolean {
    return this.calling
  }

  /** Return whether a value may be sent now, s. */
  due(now: number): boolean {
    return !this.calling && now - this.sentAt > this.period
  }

  /** Send a value; if one is unanswered, as soon as it is answered. now: s. */
  send(value: T, now: number): void {
    if (this.calling) {
      this.last = value
      return
    }
    this.calling = true
    this.sentAt = now
    void this.call(value).then(() => {
      const { last } = this
      this.calling = false
      this.last = null
      if (last !== null) this.send(last, now)
    })
  }
}
