import type { Course } from '../../playback/course'

export interface Deviation {
  /** Place of the joint, from 0. */
  readonly joint: number
  /** rad or m, never negative */
  readonly amount: number
  /** s */
  readonly time: number
  readonly row: number
}

/** Return where `other` is farthest from `course`, at the frames of `course`; null: the same
 * everywhere. Beyond its end a motion stays at its last pose.
 * delay: s by which `other` is taken earlier; then only frames count at which both are there. */
export function largestDeviation(course: Course, other: Course, delay = 0): Deviation | null {
  const { jointCount } = course
  const pose = new Float64Array(jointCount)
  const otherPose = new Float64Array(jointCount)
  let largest: Deviation | null = null
  for (let frame = 0; frame < course.frameCount; frame++) {
    const time = course.timeOf(frame)
    const late = time + delay
    if (delay !== 0 && (late < 0 || late > other.duration)) continue
    course.sample(time, pose)
    other.sample(late, otherPose)
    for (let joint = 0; joint < jointCount; joint++) {
      const amount = Math.abs((pose[joint] as number) - (otherPose[joint] as number))
      if (amount > (largest?.amount ?? 0))
        largest = { joint, amount, time, row: course.rowOf(frame) }
    }
  }
  return largest
}

/** Instants at which motions are compared to find their delay. */
const INSTANTS = 400
/** Share of the greatest energy below which two parts say nothing of each other. */
const LEAST_ENERGY = 0.05
/** Steps of the search between two instants, to either side. */
const FINER = 20

/** Return by how much `other` is later than `course`, s; 0 where neither moves. As
 * `mrlab_ros/core/trajectory/comparison.py`: the lag at which their velocities have the most in
 * common, of those at which both are there for half of the shorter. */
export function delayOf(course: Course, other: Course): number {
  const step = Math.max(course.duration, other.duration) / INSTANTS
  if (step === 0) return 0
  const first = velocities(course, step)
  const second = velocities(other, step)
  const least = Math.min(first.length, second.length) / 2
  const found: { lag: number; share: number; energy: number }[] = []
  let greatest = 0
  for (let lag = 1 - first.length; lag < second.length; lag++) {
    const begin = Math.max(-lag, 0)
    const end = Math.min(first.length, second.length - lag)
    if (end - begin < least) continue
    let [common, energy] = [0, 0]
    for (let i = begin; i < end; i++) {
      const a = first[i] as Float64Array
      const b = second[i + lag] as Float64Array
      for (let joint = 0; joint < a.length; joint++) {
        const [v, w] = [a[joint] as number, b[joint] as number]
        common += v * w
        energy += v * v + w * w
      }
    }
    greatest = Math.max(greatest, energy)
    found.push({ lag, share: energy > 0 ? (2 * common) / energy : 0, energy })
  }
  let best = { lag: 0, share: 0, energy: 0 }
  for (const each of found)
    if (each.energy > LEAST_ENERGY * greatest && each.share > best.share) best = each
  return best.share > 0 ? refined(course, other, best.lag * step, step) : 0
}

/** Return the delay near `delay` that leaves the least error but for a constant of each joint. */
function refined(course: Course, other: Course, delay: number, step: number): number {
  const pose = new Float64Array(course.jointCount)
  const otherPose = new Float64Array(course.jointCount)
  let [best, least] = [delay, Number.POSITIVE_INFINITY]
  for (let k = -FINER; k <= FINER; k++) {
    const late = delay + (k * step) / FINER
    const sum = new Float64Array(course.jointCount)
    const squares = new Float64Array(course.jointCount)
    let count = 0
    for (let time = 0; time <= course.duration; time += step) {
      if (time + late < 0 || time + late > other.duration) continue
      course.sample(time, pose)
      other.sample(time + late, otherPose)
      count++
      for (let joint = 0; joint < pose.length; joint++) {
        const off = (otherPose[joint] as number) - (pose[joint] as number)
        sum[joint] = (sum[joint] as number) + off
        squares[joint] = (squares[joint] as number) + off * off
      }
    }
    let left = 0
    for (let joint = 0; joint < pose.length; joint++)
      left += (squares[joint] as number) - (sum[joint] as number) ** 2 / count
    if (count > 1 && left / count < least) [best, least] = [late, left / count]
  }
  return best
}

/** Return the change of every joint from each instant to the next. */
function velocities(course: Course, step: number): Float64Array[] {
  const found: Float64Array[] = []
  const before = new Float64Array(course.jointCount)
  const after = new Float64Array(course.jointCount)
  course.sample(0, before)
  for (let time = step; time <= course.duration + step / 2; time += step) {
    course.sample(time, after)
    found.push(after.map((value, joint) => value - (before[joint] as number)))
    before.set(after)
  }
  return found
}
