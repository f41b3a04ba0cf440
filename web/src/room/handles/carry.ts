import { moveWriter } from '../../protocol/mrlab_msgs'
import type { Pose } from '../../scene/stage/pose'
import type { Lab } from '../ports'

/** What a hand carries: an object or a robot's base. */
export type Carried = { readonly object: string } | { readonly robot: string }

/** Tells the lab where a hand has what it carries. A call takes it, its moves go over a topic of which
 * only the newest counts, and a call puts it down. Calls go one after the other. */
export class Carry {
  private hand = ''
  private sequence = 0
  private taken = false
  private sentAt = Number.NEGATIVE_INFINITY
  private last: Promise<unknown> = Promise.resolve()
  private waiting = 0

  /** period: s between two moves. take: calls the lab; its answer is null where it refused. */
  constructor(
    private readonly lab: Lab,
    private readonly carried: Carried,
    private readonly period: number,
    private readonly take: (pose: Pose, hand: string) => Promise<unknown>,
  ) {}

  /** True while a call is unanswered. */
  get unanswered(): boolean {
    return this.waiting > 0
  }

  /** True from when the lab has given it to this hand until it is put down. */
  get held(): boolean {
    return this.taken
  }

  /** Say where it is now, if that is due; the first time it is taken there. now: s. */
  move(pose: Pose, now: number): void {
    if (now - this.sentAt <= this.period) return
    this.sentAt = now
    if (this.hand === '') {
      const hand = crypto.getRandomValues(new Uint32Array(3)).join('-')
      this.hand = hand
      this.decide(() => this.take(pose, hand)).then((answer) => {
        if (this.hand === hand) this.taken = answer !== null
      })
    } else if (this.taken) {
      const where = { object: '', robot: '', ...this.carried, pose }
      this.lab.link.publish('moves', moveWriter, {
        hand: this.hand,
        sequence: ++this.sequence,
        ...where,
      })
    }
  }

  /** Take it anew with the next move. */
  again(): void {
    this.hand = ''
    this.taken = false
    this.sequence = 0
  }

  /** Put it down by a call, after all calls before. */
  end(call: () => Promise<unknown>): void {
    this.again()
    this.sentAt = Number.NEGATIVE_INFINITY
    this.decide(call)
  }

  private decide(call: () => Promise<unknown>): Promise<unknown> {
    this.waiting++
    const answer = this.last.then(call).finally(() => this.waiting--)
    this.last = answer.catch(() => undefined)
    return answer
  }
}
