/** The steps of the tour, in order. */
export const STEPS = ['place', 'load', 'play', 'scrub', 'halt'] as const
export type Step = (typeof STEPS)[number]

/** State of the lab that a tour observes. */
export interface Seen {
  readonly robots: number
  readonly loaded: boolean
  readonly playing: boolean
  /** Number of completed drags of timelines in this room. */
  readonly scrubs: number
  readonly halted: boolean
}

/** A tour of the room: a step ends when it is done or skipped. */
export class Tour {
  private index: number
  private scrubs = 0
  private halted = false
  private robots = 0
  private begun = false

  /** done: it ended; taken: it was seen already. */
  constructor(
    taken: boolean,
    private readonly done: () => void,
  ) {
    this.index = taken ? STEPS.length : 0
  }

  /** null: it is over, or was taken already. */
  get step(): Step | null {
    return STEPS[this.index] ?? null
  }

  /** The number of the step from 1 on. */
  get number(): number {
    return this.index + 1
  }

  begin(): void {
    this.index = 0
    this.begun = false
    this.halted = false
  }

  /** Skip the step. */
  next(): void {
    if (this.step === null) return
    this.index++
    this.begun = false
    this.halted = false
    if (this.step === null) this.done()
  }

  /** End it. */
  skip(): void {
    if (this.step === null) return
    this.index = STEPS.length
    this.done()
  }

  /** Take the present state of the lab; returns whether the step was done. */
  see(seen: Seen): boolean {
    if (!this.begun) {
      // A state from before the step does not complete it.
      this.begun = true
      this.robots = seen.robots
      this.scrubs = seen.scrubs
    }
    if (!this.isDone(seen)) return false
    this.next()
    return true
  }

  private isDone(seen: Seen): boolean {
    switch (this.step) {
      case 'place':
        return seen.robots > this.robots
      case 'load':
        return seen.loaded
      case 'play':
        return seen.playing
      case 'scrub':
        return seen.scrubs > this.scrubs
      case 'halt':
        // It halted, and was cleared.
        this.halted ||= seen.halted
        return this.halted && !seen.halted
      default:
        return false
    }
  }
}
