import { signal } from '@preact/signals'
import type { Link } from '../link/link'
import { type Undoable, undoableReader, undoType } from '../protocol/mrlab_msgs'
import { type Lab, order } from './commands'

/** The newest act of anybody that can be undone. */
export class Undoing {
  /** null: there is none. */
  readonly act = signal<Undoable | null>(null)
  private readonly end: () => void

  constructor(link: Pick<Link, 'subscribe'>) {
    this.end = link.subscribe('undoable', undoableReader, (message) => {
      this.act.value = message.id === '' ? null : message
    })
  }

  /** Undo it, for all; returns whether it is undone. */
  async undo(lab: Lab): Promise<boolean> {
    const act = this.act.value
    if (act === null) return false
    this.act.value = null
    return (await order(lab, 'lab/undo', undoType, { id: act.id })) !== null
  }

  dispose(): void {
    this.end()
  }
}
