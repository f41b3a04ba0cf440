import { type PlaybackClock, positionAt } from './clock'
import type { Course } from './course'

/** Streamed states are shown this much later, s: one that is 100 ms late leaves no gap. */
const STREAM_DELAY = 0.12
const HISTORY = 64
/** A joint this far from the course, rad or m, in so many states is not on it. */
const OFF_COURSE = 0.01
const OFF_STATES = 4
/** A step larger than this is eased out over EASE, s. */
const STEP = 0.002
const EASE = 0.12

/** Where the shown pose comes from. */
export type PoseSource = 'none' | 'course' | 'states'

/** The pose of an arm at any display instant: from its course and playback clock while it is on it,
 * else from the joint states as they came. A late, lost or early message moves nothing: the states
 * correct the course only where they contradict it, and every correction is eased. */
export class ClockedArm {
  source: PoseSource = 'none'
  private course: Course | null = null
  private clock: PlaybackClock = { stamp: 0, position: 0, rate: 0 }
  private onCourse = false
  /** States in a row that contradict the course. */
  private contradictions = 0
  private readonly stamps = new Float64Array(HISTORY)
  private readonly states: Float64Array
  private newest = -1
  private count = 0
  private readonly scratch: Float64Array
  /** What was shown last, and when. */
  private readonly shown: Float64Array
  private shownAt = Number.NaN
  private readonly step: Float64Array
  private steppedAt = Number.NEGATIVE_INFINITY
  private changed = false

  constructor(readonly jointCount: number) {
    this.states = new Float64Array(HISTORY * jointCount)
    this.scratch = new Float64Array(jointCount)
    this.shown = new Float64Array(jointCount)
    this.step = new Float64Array(jointCount)
  }

  /** Take over the course that is loaded, its joints in this arm's order; null: none. */
  setCourse(course: Course | null): void {
    this.course = course
    this.contradictions = 0
    this.changed = true
  }

  /** Take over the clock; onCourse: whether the arm stands or moves on its course by the clock. */
  setClock(clock: PlaybackClock, onCourse: boolean): void {
    const { stamp, position, rate } = this.clock
    if (stamp === clock.stamp && position === clock.position && rate === clock.rate) {
      if (onCourse === this.onCourse) return
    }
    this.clock = { stamp: clock.stamp, position: clock.position, rate: clock.rate }
    this.onCourse = onCourse
    this.contradictions = 0
    this.changed = true
  }

  /** Take a state, in this arm's order, of a lab time, s; one that came too late is left out. */
  takeState(stamp: number, positions: ArrayLike<number>): void {
    if (this.newest >= 0 && stamp <= (this.stamps[this.newest] as number)) return
    this.newest = (this.newest + 1) % HISTORY
    this.count = Math.min(this.count + 1, HISTORY)
    this.stamps[this.newest] = stamp
    const begin = this.newest * this.jointCount
    for (let joint = 0; joint < this.jointCount; joint++) {
      this.states[begin + joint] = positions[joint] ?? 0
    }
    this.compare(stamp, begin)
  }

  /** Write the pose at a lab time, s, into `into`; return whether there is one. Times must not
   * decrease. Allocates nothing. */
  sample(time: number, into: Float64Array): boolean {
    const source = this.choose()
    if (source === 'none') return false
    if (source === 'course') this.course?.sample(positionAt(this.clock, time), this.scratch)
    else this.sampleStates(time - STREAM_DELAY)
    this.ease(time, source)
    into.set(this.scratch)
    return true
  }

  private choose(): PoseSource {
    if (this.course !== null && this.onCourse && this.contradictions < OFF_STATES) return 'course'
    return this.count > 0 ? 'states' : 'none'
  }

  private compare(stamp: number, begin: number): void {
    // a state from before the clock was taken says nothing about it
    if (this.course === null || !this.onCourse || stamp < this.clock.stamp) return
    this.course.sample(positionAt(this.clock, stamp), this.scratch)
    let most = 0
    for (let joint = 0; joint < this.jointCount; joint++) {
      const found = this.states[begin + joint] as number
      most = Math.max(most, Math.abs(found - (this.scratch[joint] as number)))
    }
    if (most <= OFF_COURSE) this.contradictions = 0
    else if (++this.contradictions === OFF_STATES) this.changed = true
  }

  private sampleStates(time: number): void {
    let index = this.newest
    let after = index
    for (let back = 1; back < this.count && (this.stamps[index] as number) > time; back++) {
      after = index
      index = (this.newest - back + HISTORY) % HISTORY
    }
    const start = this.stamps[index] as number
    const end = this.stamps[after] as number
    const share = end > start ? Math.min(Math.max((time - start) / (end - start), 0), 1) : 0
    for (let joint = 0; joint < this.jointCount; joint++) {
      const from = this.states[index * this.jointCount + joint] as number
      const to = this.states[after * this.jointCount + joint] as number
      this.scratch[joint] = from + share * (to - from)
    }
  }

  /** Spread the step that another clock, course or source makes. */
  private ease(time: number, source: PoseSource): void {
    if (this.changed || source !== this.source) {
      this.changed = false
      this.source = source
      let most = 0
      for (let joint = 0; joint < this.jointCount; joint++) {
        const left = (this.shown[joint] as number) - (this.scratch[joint] as number)
        this.step[joint] = left
        most = Math.max(most, Math.abs(left))
      }
      // what is nowhere yet has nothing to come from
      const steps = most > STEP && !Number.isNaN(this.shownAt)
      this.steppedAt = steps ? this.shownAt : Number.NEGATIVE_INFINITY
    }
    const left = 1 - (time - this.steppedAt) / EASE
    if (left > 0) {
      const share = Math.min(left, 1)
      for (let joint = 0; joint < this.jointCount; joint++) {
        this.scratch[joint] =
          (this.scratch[joint] as number) + share * (this.step[joint] as number)
      }
    }
    this.shown.set(this.scratch)
    this.shownAt = time
  }
}
