import type { MotionDocument } from './motion'
import { unpack } from './motion'

/** A position this close to a frame, in frames, is that frame: i / f * f need not round to i. */
const ON_FRAME = 1e-6

/** The frames of a motion: where every joint is at any time. Linear in joint space between two
 * frames, the first frame's value before it and the last one's after it; a gripper is never
 * interpolated. The same rules as `mrlab_ros/core/trajectory/trajectory.py`. */
export class Course {
  /** s, of the last frame from the first */
  readonly duration: number
  readonly frameCount: number

  /** times: s, one a frame, rising; null: frame i is at i / frameRate. positions: row by row. */
  constructor(
    readonly frameRate: number,
    readonly jointCount: number,
    readonly positions: Float32Array | Float64Array,
    readonly gripper: Uint8Array | null = null,
    readonly times: Float64Array | null = null,
    readonly rows: Uint32Array | null = null,
  ) {
    this.frameCount = jointCount > 0 ? positions.length / jointCount : 0
    if (!Number.isInteger(this.frameCount) || this.frameCount < 1) {
      throw new RangeError(
        `a motion has ${positions.length} positions; expected some for each of ${jointCount} joints`,
      )
    }
    this.duration = this.timeOf(this.frameCount - 1)
  }

  /** Return the time of a frame, s. */
  timeOf(frame: number): number {
    return this.times === null ? frame / this.frameRate : (this.times[frame] ?? 0)
  }

  /** Return the row of the workspace's matrix that a frame is, from 1. */
  rowOf(frame: number): number {
    return this.rows === null ? frame + 1 : (this.rows[frame] ?? 0)
  }

  /** Return the last frame whose time is not after `time`, s; the first or last one outside. */
  frameAt(time: number): number {
    const last = this.frameCount - 1
    const { times } = this
    if (times === null) {
      return Math.min(Math.max(Math.floor(time * this.frameRate + ON_FRAME), 0), last)
    }
    const reached = time + ON_FRAME / this.frameRate
    let low = 0
    let high = last
    while (low < high) {
      const middle = (low + high + 1) >> 1
      if ((times[middle] as number) <= reached) low = middle
      else high = middle - 1
    }
    return low
  }

  /** Return the time at which a row of the workspace's matrix, from 1, or the one before it, is. */
  timeOfRow(row: number): number {
    const { rows } = this
    if (rows === null) return this.timeOf(Math.min(Math.max(row - 1, 0), this.frameCount - 1))
    let frame = 0
    while (frame + 1 < rows.length && (rows[frame + 1] as number) <= row) frame++
    return this.timeOf(frame)
  }

  /** Write the joint positions at `time`, s, into `into`, and return the frame. A joint without a
   * number (NaN) in a frame keeps its number of the frame before. */
  sample(time: number, into: Float64Array): number {
    const frame = this.frameAt(time)
    const { jointCount, positions } = this
    const begin = frame * jointCount
    let share = 0
    if (frame < this.frameCount - 1) {
      const start = this.timeOf(frame)
      const step = this.timeOf(frame + 1) - start
      share = (time - start) / step
      if (!(share * step * this.frameRate > ON_FRAME)) share = 0
    }
    for (let joint = 0; joint < jointCount; joint++) {
      let value = positions[begin + joint] as number
      if (Number.isNaN(value)) value = this.valueBefore(frame, joint)
      if (share > 0) {
        const next = positions[begin + jointCount + joint] as number
        if (!Number.isNaN(next)) value += share * (next - value)
      }
      into[joint] = value
    }
    return frame
  }

  /** Return whether the gripper is closed at `time`, s; null: there is none. */
  gripperAt(time: number): boolean | null {
    return this.gripper === null ? null : this.gripper[this.frameAt(time)] === 1
  }

  private valueBefore(frame: number, joint: number): number {
    for (let i = frame - 1; i >= 0; i--) {
      const value = this.positions[i * this.jointCount + joint] as number
      if (!Number.isNaN(value)) return value
    }
    return 0
  }
}

/** Return the frames of a motion document. */
export function courseOf(motion: MotionDocument): Course {
  const times = motion.times === null ? null : unpack(motion.times)
  const rows = motion.rows === null ? null : unpack(motion.rows)
  const gripper = motion.gripper === null ? null : unpack(motion.gripper)
  const positions = unpack(motion.positions)
  const right =
    (positions instanceof Float32Array || positions instanceof Float64Array) &&
    (times === null || times instanceof Float64Array) &&
    (rows === null || rows instanceof Uint32Array) &&
    (gripper === null || gripper instanceof Uint8Array)
  if (!right) throw new TypeError('a motion document holds an array of another type')
  return new Course(
    motion.frame_rate,
    motion.robot.joints.length,
    positions,
    gripper as Uint8Array | null,
    times as Float64Array | null,
    rows as Uint32Array | null,
  )
}
