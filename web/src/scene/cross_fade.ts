/** Which of two levels of detail is shown, and how far the one has dissolved into the other. */
export class CrossFade {
  /** Of the far level, 0 to 1; the near level has the rest. */
  share = 0
  private far = false
  private began = Number.NEGATIVE_INFINITY
  private length = 0
  private settled = false

  /** border: m, from where on the far level is shown; it stays until a part `hysteresis` of that
   * nearer. duration: s in which one dissolves into the other, asked for at each change; 0: at once. */
  constructor(
    private readonly border: number,
    private readonly hysteresis: number,
    private readonly duration: () => number,
  ) {}

  /** Return whether both levels are shown at a time, s, to an eye at a distance, m. */
  step(distance: number, now: number): boolean {
    const far = distance >= this.border * (this.far ? 1 - this.hysteresis : 1)
    if (far !== this.far) {
      const left = 1 - this.progress(now)
      this.far = far
      this.length = this.settled ? this.duration() : 0
      // one that turns back goes on from where it is
      this.began = now - left * this.length
    }
    this.settled = true
    const progress = this.progress(now)
    this.share = far ? progress : 1 - progress
    return progress < 1
  }

  /** End at once what dissolves. */
  end(): void {
    this.length = 0
    this.share = this.far ? 1 : 0
  }

  private progress(now: number): number {
    if (this.length <= 0) return 1
    return Math.min(Math.max((now - this.began) / this.length, 0), 1)
  }
}
