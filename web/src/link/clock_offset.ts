/** The offset between two clocks: the exchange with the least round trip of a sliding window. The
 * same as `mrlab_ros/gateway/link/clock.py`. */

/** s: a round trip that is older says little about a clock that drifts. */
const WINDOW_S = 30
/** s of correction a second: a clock that is read for motion must not jump. */
const SLEW = 0.05
/** An error from which on it jumps all the same, s, as after a sleep of the machine. */
const JUMP_S = 0.5
/** Two exchanges that differ by more than their round trips explain, and by this, s, have one of
 * the clocks set between them: the older one says nothing any more, and the offset jumps. */
const SET_S = 0.05

/** One question and answer. at: s on the own clock; offset: s, theirs minus own. */
export interface Exchange {
  readonly at: number
  readonly roundTrip: number
  readonly offset: number
}

/** Return the exchange of four times, s: own, theirs, theirs, own. */
export function exchange(asked: number, came: number, answered: number, back: number): Exchange {
  return {
    at: back,
    roundTrip: back - asked - (answered - came),
    offset: (came - asked + (answered - back)) / 2,
  }
}

/** Return whether no clock was set between two exchanges. */
function agree(older: Exchange, newer: Exchange): boolean {
  const explained = (older.roundTrip + newer.roundTrip) / 2 + SET_S
  return Math.abs(older.offset - newer.offset) <= explained
}

/** Slews from one estimate to the next. */
export class ClockOffset {
  private window: Exchange[] = []
  private target = Number.NaN
  private held = Number.NaN
  private heldAt = 0

  /** The least of the window, s; NaN: the window is empty. */
  get roundTrip(): number {
    return this.best()?.roundTrip ?? Number.NaN
  }

  /** Take another exchange into account. */
  add(found: Exchange): void {
    const current = this.offset(found.at)
    const recent = this.window.filter((each) => each.at >= found.at - WINDOW_S)
    const agreeing = recent.filter((each) => agree(each, found))
    this.window = [...agreeing, found]
    this.target = this.best()?.offset ?? Number.NaN
    const wasSet = agreeing.length < recent.length
    const jumps = wasSet || Number.isNaN(current) || Math.abs(this.target - current) > JUMP_S
    this.held = jumps ? this.target : current
    this.heldAt = found.at
  }

  /** Return the offset to add to the own clock at `at`, s; NaN before the first exchange. */
  offset(at: number): number {
    const most = SLEW * Math.max(0, at - this.heldAt)
    return this.held + Math.max(-most, Math.min(most, this.target - this.held))
  }

  /** Forget the exchanges: the other clock is another one now. */
  clear(): void {
    this.window = []
    this.target = Number.NaN
    this.held = Number.NaN
  }

  private best(): Exchange | undefined {
    let best: Exchange | undefined
    for (const each of this.window) {
      if (best === undefined || each.roundTrip < best.roundTrip) best = each
    }
    return best
  }
}
