import type { Course } from '../../playback/course'
import type { MotionDocument, MotionJoint, PackedArray } from '../../playback/motion'
import { unpack } from '../../playback/motion'
import type { Diagnostic } from '../../words/diagnostic'
import { jointName } from '../../words/words'
import type { Mark, Strip } from './strip'

export type Channel = 'angles' | 'velocities' | 'proxies' | 'difference'

const DEGREES = 180 / Math.PI

function unitOf(joint: MotionJoint, channel: Channel): { unit: string; scale: number } {
  const linear = joint.kind === 'prismatic'
  if (channel === 'proxies') return { unit: linear ? 'N' : 'N·m', scale: 1 }
  const base = linear ? { unit: 'mm', scale: 1000 } : { unit: '°', scale: DEGREES }
  return channel === 'angles' || channel === 'difference'
    ? base
    : { unit: `${base.unit}/s`, scale: base.scale }
}

function limitsOf(joint: MotionJoint, channel: Channel): [number | null, number | null] {
  if (channel === 'angles') return [joint.lower, joint.upper]
  if (channel === 'velocities' && joint.velocity !== null) return [-joint.velocity, joint.velocity]
  return [null, null]
}

function packedOf(motion: MotionDocument, channel: Channel): PackedArray | null {
  if (channel === 'angles' || channel === 'difference') return motion.positions
  return channel === 'velocities' ? motion.velocities : motion.effort_proxies
}

/** Return which channels a motion has. */
export function channelsOf(motion: MotionDocument): Channel[] {
  const all: Channel[] = ['angles', 'velocities', 'proxies']
  return all.filter((channel) => packedOf(motion, channel) !== null)
}

/** Return the times of the frames, s. */
export function timesOf(course: Course): Float64Array {
  return Float64Array.from({ length: course.frameCount }, (_, frame) => course.timeOf(frame))
}

function column(values: ArrayLike<number>, index: number, count: number, scale: number) {
  const length = values.length / count
  const out = new Float64Array(length)
  for (let i = 0; i < length; i++) out[i] = (values[i * count + index] ?? Number.NaN) * scale
  return out
}

/** Return a strip for each joint, in degrees or mm; compared: positions of another motion, (frames
 * of `motion`, joints) rad or m, for angles and differences only. */
export function stripsOf(
  motion: MotionDocument,
  channel: Channel,
  compared: Float64Array | null = null,
): Strip[] {
  const packed = packedOf(motion, channel)
  if (packed === null) return []
  let values: ArrayLike<number> = unpack(packed)
  let second = compared
  if (channel === 'difference' && compared !== null) {
    values = Float64Array.from(values, (value, i) => value - (compared[i] as number))
    second = null
  }
  const { joints } = motion.robot
  return joints.map((joint, index) => {
    const { unit, scale } = unitOf(joint, channel)
    const [lower, upper] = limitsOf(joint, channel)
    return {
      label: jointName(joint.name, index),
      unit,
      values: column(values, index, joints.length, scale),
      compared: second && column(second, index, joints.length, scale),
      lower: lower === null ? null : lower * scale,
      upper: upper === null ? null : upper * scale,
      colour: index,
    }
  })
}

/** Return the findings that name rows, with their numbers, places in time and joints. */
export function marksOf(
  findings: readonly Diagnostic[],
  joints: readonly MotionJoint[],
  course: Course,
): Mark[] {
  return findings.flatMap((finding, index) => {
    if (finding.first_row === 0) return []
    const strip = joints.findIndex((joint) => joint.name === finding.joint)
    return {
      number: index + 1,
      severity: finding.severity,
      from: course.timeOfRow(finding.first_row),
      to: course.timeOfRow(Math.max(finding.last_row, finding.first_row)),
      strip: strip < 0 ? null : strip,
    }
  })
}

/** Return the positions of `other` at the frames of `course`, (frames, joints). */
export function positionsAt(course: Course, other: Course): Float64Array {
  const { jointCount } = other
  const pose = new Float64Array(jointCount)
  const out = new Float64Array(course.frameCount * jointCount)
  for (let frame = 0; frame < course.frameCount; frame++) {
    other.sample(course.timeOf(frame), pose)
    out.set(pose, frame * jointCount)
  }
  return out
}
