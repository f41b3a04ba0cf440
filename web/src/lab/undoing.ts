import { signal } from '@preact/signals'
import type { Link } from '../link/link'
import { type Undoable, undoableReader, undoType } from '../protocol/mrlab_msgs'
import { spoken } from '../words/diagnostic'
import { type Lab, order } from './commands'
import { seconds } from './followed_robot'

/** The newest act of anybody that can be undone, for as long as it can. */
export class Undoing {
  /** null: there is none. */
  readonly act = signal<Undoable | null>(null)
  private readonly end: () => void
  private timer: ReturnType<typeof setTimeout> | undefined

  constructor(private readonly link: Pick<Link, 'subscribe' | 'labTime'>) {
    this.end = link.subscribe('undoable', undoableReader, (message) => this.offer(message))
  }

  /** Undo it, for all; returns whether it is undone. */
  async undo(lab: Lab): Promise<boolean> {
    const act = this.act.value
    if (act === null) return false
    this.act.value = null
    const answer = await order(lab, 'lab/undo', undoType, { id: act.id })
    // What was refused can be tried again, unless there is something newer.
    if (answer === null && this.act.value === null) this.offer(act)
    if (answer?.values?.some(({ key }) => key === 'missing')) lab.say(spoken(answer))
    return answer !== null
  }

  dispose(): void {
    clearTimeout(this.timer)
    this.end()
  }

  private offer(act: Undoable): void {
    clearTimeout(this.timer)
    const left = act.id === '' ? 0 : seconds(act.until) - this.link.labTime()
    this.act.value = left > 0 ? act : null
    if (left > 0)
      this.timer = setTimeout(() => {
        this.act.value = null
      }, left * 1000)
  }
}
