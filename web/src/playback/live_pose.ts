import type { Course } from './course'
import type { RemotePlayer } from './player'

/** The clock and the joint states agree where no joint differs by more, rad or m. */
const SAME = 0.02

/** Where a robot's joints are at the instant of a picture. While it plays a trajectory that is here,
 * its playback's clock says so, as long as the joint states bear it out; otherwise they say so. */
export class LivePose {
  private readonly places = new Map<string, number>()
  private readonly reported: Float64Array
  private readonly byClock: Float64Array
  private course: Course | null = null
  private agrees = false

  /** jointNames: of the arm, in the order of a trajectory's positions. */
  constructor(
    readonly jointNames: readonly string[],
    private readonly player: RemotePlayer,
  ) {
    for (const [place, name] of jointNames.entries()) this.places.set(name, place)
    this.reported = new Float64Array(jointNames.length)
    this.byClock = new Float64Array(jointNames.length)
  }

  /** Take over the frames of the trajectory that is loaded; null: they are not here. */
  setCourse(course: Course | null): void {
    this.course = course?.jointCount === this.jointNames.length ? course : null
    this.agrees = false
  }

  /** Take over joint states of `stamp`, s of lab time; joints of others are left out. */
  take(names: readonly string[], positions: ArrayLike<number>, stamp: number): void {
    for (let i = 0; i < names.length; i++) {
      const place = this.places.get(names[i] as string)
      if (place !== undefined) this.reported[place] = positions[i] as number
    }
    // what was sent before the clock was set anew says nothing about it
    if (this.course !== null && this.player.playing && stamp >= this.player.since) {
      this.agrees = this.deviation(this.course, stamp) <= SAME
    }
  }

  /** Whether it moves by the clock now: another picture is due without any message. */
  get moves(): boolean {
    return this.agrees && this.course !== null && this.player.playing
  }

  /** Return the positions now, rad or m, in the order of the names; the next call reuses them. */
  now(): Float64Array {
    if (!this.moves || this.course === null) return this.reported
    this.course.sample(this.player.position(), this.byClock)
    return this.byClock
  }

  /** Return the largest difference between joint states and clock, rad or m. */
  private deviation(course: Course, stamp: number): number {
    course.sample(this.player.positionAt(stamp), this.byClock)
    let largest = 0
    for (let joint = 0; joint < this.reported.length; joint++) {
      const apart = (this.reported[joint] as number) - (this.byClock[joint] as number)
      largest = Math.max(largest, Math.abs(apart))
    }
    return largest
  }
}
