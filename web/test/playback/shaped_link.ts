/** A link with jitter, loss and stalls, without time of its own: messages come out in order of
 * arrival. The same numbers in each run. */
export class ShapedLink<T> {
  private seed = 1
  private readonly queue: { at: number; message: T }[] = []
  private readonly stalls: { from: number; to: number }[]

  /** jitter: s, of each message; loss: share; stalls: s, [from, length]; nothing arrives in one. */
  constructor(
    private readonly jitter: number,
    private readonly loss: number,
    stalls: readonly (readonly [number, number])[],
  ) {
    this.stalls = stalls.map(([from, length]) => ({ from, to: from + length }))
  }

  /** Send at a time; sure: it is not lost, as a state over TCP, but it is late all the same. */
  send(now: number, message: T, sure = false): void {
    const lost = this.random() < this.loss
    let at = now + this.random() * this.jitter
    for (const { from, to } of this.stalls) if (at >= from && at < to) at = to
    if (!lost || sure) this.queue.push({ at, message })
  }

  /** Return the messages that arrived by `now` and were not taken yet. */
  arrived(now: number): T[] {
    const here = this.queue.filter(({ at }) => at <= now).sort((a, b) => a.at - b.at)
    for (const each of here) this.queue.splice(this.queue.indexOf(each), 1)
    return here.map(({ message }) => message)
  }

  private random(): number {
    this.seed = (this.seed * 48271) % 2147483647
    return this.seed / 2147483647
  }
}
