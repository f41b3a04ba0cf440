import { type PlaybackClock, positionAt } from './clock'
import type { Course } from './course'

/** Delay with which streamed states are shown, s: a state that is 100 ms late leaves no gap. */
const STREAM_DELAY = 0.12
/** s: a stamp farther from its arrival is of another clock, for example of a replayed bag; such a
 * state counts from its arrival. */
const OTHER_CLOCK = 1
const HISTORY = 64
/** A joint this far from the course, rad or m, in this number of states has left it. */
const OFF_COURSE = 0.01
const OFF_STATES = 4
/** A step larger than this is eased out over EASE, s. */
const STEP = 0.002
const EASE = 0.12
/** s between two pictures, at most, while something moves. */
const PICTURE = 1 / 30

/** The source of the shown pose. */
export type PoseSource = 'none' | 'course' | 'states'

/** The pose of an arm at any display instant: from its course and playback clock while it is on
 * the course, else from the joint states, with a small delay. A late, lost or early message moves
 * nothing: the states correct the course only if they contradict it, and every correction is
 * eased. */
export class ClockedArm {
  source: PoseSource = 'none'
  /** rad or m, in the order of the names: the last pose that `sample` wrote. */
  readonly positions: Float64Array
  private readonly places = new Map<string, number>()
  /** The last report. */
  private readonly reported: Float64Array
  private course: Course | null = null
  private clock: PlaybackClock = { stamp: 0, position: 0, rate: 0 }
  private onCourse = false
  /** States in a row that contradict the course. */
  private contradictions = 0
  private readonly stamps = new Float64Array(HISTORY)
  private readonly states: Float64Array
  private newest = -1
  private count = 0
  private readonly jointCount: number
  private readonly scratch: Float64Array
  private shownAt = Number.NaN
  private readonly step: Float64Array
  private steppedAt = Number.NEGATIVE_INFINITY
  private changed = false

  /** jointNames: in the order of a course's positions. */
  constructor(readonly jointNames: readonly string[]) {
    const count = jointNames.length
    this.jointCount = count
    for (let i = 0; i < count; i++) this.places.set(jointNames[i] as string, i)
    this.states = new Float64Array(HISTORY * count)
    this.reported = new Float64Array(count)
    this.scratch = new Float64Array(count)
    this.positions = new Float64Array(count)
    this.step = new Float64Array(count)
  }

  has(joint: string): boolean {
    return this.places.has(joint)
  }

  /** Take over the course that is loaded; null, or one of other joints: there is none. */
  setCourse(course: Course | null): void {
    this.course = course?.jointCount === this.jointCount ? course : null
    this.contradictions = 0
    this.changed = true
  }

  /** Take over the clock; onCourse: the arm follows its course by the clock. */
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

  /** Take a state by the names of its joints; unknown joints are ignored, missing ones keep their
   * position. stamp, now: s of lab time of its publication and its arrival. */
  take(
    names: readonly string[],
    positions: ArrayLike<number>,
    stamp: number,
    now: number = stamp,
  ): void {
    for (let i = 0; i < names.length; i++) {
      const place = this.places.get(names[i] as string)
      if (place !== undefined) this.reported[place] = positions[i] as number
    }
    const own = Math.abs(now - stamp) > OTHER_CLOCK ? now : stamp
    const newest = this.count > 0 ? (this.stamps[this.newest] as number) : Number.NEGATIVE_INFINITY
    if (own <= newest) {
      // Overtaken on its way: ignored. Older by far: its clock was set, earlier states are void.
      if (newest - own < OTHER_CLOCK) return
      this.count = 0
    }
    // No state was left to show: catch up with the missed motion, eased.
    if (this.source === 'states' && this.shownAt - STREAM_DELAY > newest) this.changed = true
    this.newest = (this.newest + 1) % HISTORY
    this.count = Math.min(this.count + 1, HISTORY)
    this.stamps[this.newest] = own
    const begin = this.newest * this.jointCount
    this.states.set(this.reported, begin)
    this.compare(own, begin)
  }

  /** Write the pose at a lab time, s, into `positions`; return whether there is one. Times decrease
   * only where the lab's clock is set back. Allocates nothing. */
  sample(time: number): boolean {
    const source = this.choose()
    if (source === 'none') return false
    if (source === 'course') this.course?.sample(positionAt(this.clock, time), this.scratch)
    else this.sampleStates(time - STREAM_DELAY)
    this.ease(time, source)
    return true
  }

  /** Return whether it moves after a lab time, s, without any further message. */
  moves(time: number): boolean {
    if (this.changed || time < this.steppedAt + EASE) return true
    const source = this.choose()
    if (source === 'states') return this.hasWay()
    if (source === 'none' || this.course === null) return false
    const { rate } = this.clock
    const position = positionAt(this.clock, time)
    return rate > 0 ? position < this.course.duration : rate < 0 && position > 0
  }

  /** Return whether the newest state differs from the shown pose. */
  private hasWay(): boolean {
    const begin = this.newest * this.jointCount
    for (let joint = 0; joint < this.jointCount; joint++) {
      if (this.states[begin + joint] !== this.positions[joint]) return true
    }
    return false
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
    const setBack = time < this.shownAt - OTHER_CLOCK
    if (this.changed || setBack || source !== this.source) {
      this.changed = false
      this.source = source
      let most = 0
      for (let joint = 0; joint < this.jointCount; joint++) {
        const left = (this.positions[joint] as number) - (this.scratch[joint] as number)
        this.step[joint] = left
        most = Math.max(most, Math.abs(left))
      }
      // Without a pose there is nothing to ease from.
      const steps = most > STEP && !Number.isNaN(this.shownAt)
      // Ease from the previous picture, if it is recent and of the same clock.
      const begin = Math.min(Math.max(this.shownAt, time - PICTURE), time)
      this.steppedAt = steps ? begin : Number.NEGATIVE_INFINITY
    }
    const left = 1 - (time - this.steppedAt) / EASE
    if (left > 0) {
      const share = Math.min(left, 1)
      for (let joint = 0; joint < this.jointCount; joint++) {
        this.scratch[joint] =
          (this.scratch[joint] as number) + share * (this.step[joint] as number)
      }
    }
    this.positions.set(this.scratch)
    this.shownAt = time
  }
}
