/** Ages that are kept of one window: a lab of ten robots sends fewer in a second. */
const MOST = 1024

/** How old messages were when they came, over a window. */
export class Ages {
  private readonly ages = new Float64Array(MOST)
  private readonly sorted = new Float64Array(MOST)
  private taken = 0

  /** Of the window that ended last, s. */
  count = 0
  p50 = Number.NaN
  p95 = Number.NaN
  most = Number.NaN

  /** age: s; one that is not known is left out. */
  add(age: number): void {
    if (Number.isNaN(age)) return
    this.ages[this.taken % MOST] = age
    this.taken++
  }

  /** End the window and begin the next one. */
  close(): void {
    this.count = this.taken
    const kept = Math.min(this.taken, MOST)
    const values = this.sorted.subarray(0, kept)
    values.set(this.ages.subarray(0, kept))
    values.sort()
    const at = (share: number) =>
      values[Math.min(Math.floor(share * kept), kept - 1)] ?? Number.NaN
    this.p50 = at(0.5)
    this.p95 = at(0.95)
    this.most = at(1)
    this.taken = 0
  }
}
