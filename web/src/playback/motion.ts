import type { Diagnostic } from '../words/diagnostic'

/** A motion to look at: an accepted trajectory, or the rows of a refused one. The gateway serves
 * it as JSON, `mrlab show` puts it into a page; `mrlab_ros/app/show/` writes it. */
export interface MotionDocument {
  readonly schema: 'mrlab.motion.1'
  readonly title: string
  readonly verdict: 'accepted' | 'refused' | 'ambiguous'
  /** The finding in one sentence. */
  readonly message: string
  readonly robot: MotionRobot
  /** Hz */
  readonly frame_rate: number
  /** s from the first frame, one a frame; null: frame i is at i / frame_rate. */
  readonly times: PackedArray | null
  /** Rows of the workspace's matrix, from 1, where only some are shown; null: frame i is row i +
   * 1. */
  readonly rows: PackedArray | null
  /** (frames, joints) rad or m, in the order of robot.joints. */
  readonly positions: PackedArray
  /** (frames) 0 open, 1 closed; null: no gripper. */
  readonly gripper: PackedArray | null
  /** (frames, joints) rad/s or m/s; null: not derived. */
  readonly velocities: PackedArray | null
  /** (frames, joints) nominal, a proxy and no torque; null: not derived. */
  readonly effort_proxies: PackedArray | null
  readonly findings: readonly Diagnostic[]
  readonly source: { readonly file: string; readonly variable: string; readonly sha256: string }
}

interface MotionRobot {
  readonly model: string
  /** Its name for people; empty: none is known. */
  readonly product: string
  readonly end_effector: string
  /** URDF with package:// URIs, end effector included. */
  readonly urdf: string
  readonly joints: readonly MotionJoint[]
}

export interface MotionJoint {
  readonly name: string
  readonly kind: 'revolute' | 'continuous' | 'prismatic'
  /** rad or m; null: no limit */
  readonly lower: number | null
  readonly upper: number | null
  /** rad/s or m/s; null: no limit */
  readonly velocity: number | null
}

/** Return whether two motions are of the same robot: their joints can be compared. */
export function sameJoints(motion: MotionDocument, other: MotionDocument): boolean {
  const { model, joints } = motion.robot
  return model === other.robot.model && joints.length === other.robot.joints.length
}

/** A finding of the converter, `mrlab_msgs/msg/Diagnostic`; its number is its place in the list,
 * from 1. */
/** A numeric array as base64 of its little-endian bytes. */
export interface PackedArray {
  readonly dtype: 'float32' | 'float64' | 'uint32' | 'uint8'
  readonly shape: readonly number[]
  readonly data: string
}

type NumericArray = Float32Array | Float64Array | Uint32Array | Uint8Array

const KINDS = {
  float32: Float32Array,
  float64: Float64Array,
  uint32: Uint32Array,
  uint8: Uint8Array,
} as const

/** Return the numbers of a packed array, row by row. Throws a RangeError if the bytes and the
 * shape contradict each other. */
export function unpack(packed: PackedArray): NumericArray {
  const text = atob(packed.data)
  const bytes = new Uint8Array(text.length)
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i)
  const Kind = KINDS[packed.dtype]
  const count = packed.shape.reduce((product, size) => product * size, 1)
  if (bytes.length !== count * Kind.BYTES_PER_ELEMENT) {
    throw new RangeError(
      `a packed array holds ${bytes.length} bytes; expected ${packed.shape.join(' x ')} of ` +
        `${packed.dtype}`,
    )
  }
  return new Kind(bytes.buffer)
}
