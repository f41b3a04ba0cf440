import { unpack } from './motion'
import type { SessionTrack } from './session'

/** Samples of several values over time, linear in between; the ends hold. */
export class Track {
  readonly columns: number
  readonly count: number
  private readonly times: ArrayLike<number>
  private readonly values: ArrayLike<number>
  private last = 0

  constructor(track: SessionTrack) {
    this.times = unpack(track.times)
    this.values = unpack(track.values)
    this.columns = track.values.shape[1] ?? 0
    this.count = this.times.length
  }

  /** Write the values at `time`, s, into `into`; an empty track leaves it unchanged. */
  sample(time: number, into: Float64Array): void {
    if (this.count === 0) return
    const index = this.indexAt(time)
    const begin = index * this.columns
    const start = this.times[index] as number
    const end = this.times[index + 1]
    const share =
      end === undefined || end <= start
        ? 0
        : Math.min(Math.max((time - start) / (end - start), 0), 1)
    for (let i = 0; i < this.columns; i++) {
      const value = this.values[begin + i] as number
      const next = share > 0 ? (this.values[begin + this.columns + i] as number) : value
      into[i] = value + share * (next - value)
    }
  }

  /** Return the last sample not after `time`; usually the one of the last call or the next. */
  private indexAt(time: number): number {
    let low = 0
    let high = this.count - 1
    if ((this.times[this.last] as number) <= time) low = this.last
    else high = this.last
    while (low < high) {
      const middle = (low + high + 1) >> 1
      if ((this.times[middle] as number) <= time) low = middle
      else high = middle - 1
    }
    this.last = low
    return low
  }
}

/** Return whether one of some spans holds at `time`; null: without an end. Without spans: true. */
export function within(
  spans: readonly (readonly [number, number | null])[],
  time: number,
): boolean {
  if (spans.length === 0) return true
  for (const [from, to] of spans) {
    if (from <= time && (to === null || time < to)) return true
  }
  return false
}

/** Return the value of the last change not after `time`; `none` before the first. */
export function changeAt(
  changes: readonly (readonly [number, string])[],
  time: number,
  none = '',
): string {
  let found = none
  for (const [since, value] of changes) {
    if (since > time) break
    found = value
  }
  return found
}
