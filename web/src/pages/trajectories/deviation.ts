import type { Course } from '../../playback/course'

interface Deviation {
  /** Place of the joint, from 0. */
  readonly joint: number
  /** rad or m, never negative */
  readonly amount: number
  /** s */
  readonly time: number
  readonly row: number
}

/** Return where `other` is farthest from `course`, at the frames of `course`; null: the same
 * everywhere. Beyond its end a motion stays at its last pose. */
export function largestDeviation(course: Course, other: Course): Deviation | null {
  const { jointCount } = course
  const pose = new Float64Array(jointCount)
  const otherPose = new Float64Array(jointCount)
  let largest: Deviation | null = null
  for (let frame = 0; frame < course.frameCount; frame++) {
    const time = course.timeOf(frame)
    course.sample(time, pose)
    other.sample(time, otherPose)
    for (let joint = 0; joint < jointCount; joint++) {
      const amount = Math.abs((pose[joint] as number) - (otherPose[joint] as number))
      if (amount > (largest?.amount ?? 0))
        largest = { joint, amount, time, row: course.rowOf(frame) }
    }
  }
  return largest
}
