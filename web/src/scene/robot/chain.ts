import { Matrix4, Quaternion, Vector3 } from 'three'

/** A joint of a chain, and the transform from the joint before. */
export interface ChainJoint {
  /** Of its frame at 0 in that of the joint before, or of the base. */
  readonly rest: Matrix4
  readonly axis: Vector3
  readonly prismatic: boolean
  /** rad or m */
  readonly lower: number
  readonly upper: number
  /** Place in the positions; -1: it does not move. */
  readonly place: number
}

/** Sweeps over the joints after which the farthest place has settled. */
const SWEEPS = 6
/** Starts of a search: a joint's best depends on the others, and one start finds no more than a
 * hill. */
const STARTS = 6
/** Spreads the joints of a start; the golden ratio repeats nothing. */
const SPREAD = 0.6180339887498949

const turn = new Quaternion()
const move = new Matrix4()
const from = new Vector3()
const across = new Vector3()
const side = new Vector3()

/** From a robot's base to its tool: where the tool is at some joint positions, and how far it
 * reaches. In the frame of the base, m. */
export class Chain {
  private readonly frames: readonly Matrix4[]
  private readonly axes: readonly Vector3[]

  /** end: of the tool in the frame of the last joint. */
  constructor(
    private readonly joints: readonly ChainJoint[],
    private readonly end: Matrix4,
  ) {
    this.frames = joints.map(() => new Matrix4())
    this.axes = joints.map(() => new Vector3())
  }

  /** Write where the tool is. Allocates nothing. */
  tool(positions: ArrayLike<number>, into: Vector3): Vector3 {
    let before: Matrix4 | null = null
    for (let i = 0; i < this.joints.length; i++) {
      const joint = this.joints[i] as ChainJoint
      const frame = this.frames[i] as Matrix4
      if (before === null) frame.copy(joint.rest)
      else frame.multiplyMatrices(before, joint.rest)
      ;(this.axes[i] as Vector3).copy(joint.axis).transformDirection(frame)
      const value = joint.place < 0 ? 0 : (positions[joint.place] ?? 0)
      if (joint.prismatic) {
        move.makeTranslation(joint.axis.x * value, joint.axis.y * value, joint.axis.z * value)
      } else move.makeRotationFromQuaternion(turn.setFromAxisAngle(joint.axis, value))
      frame.multiply(move)
      before = frame
    }
    into.setFromMatrixPosition(this.end)
    return before === null ? into : into.applyMatrix4(before)
  }

  /** Write the farthest place along a direction that the tool reaches within its limits. Each
   * joint in turn moves to its optimum while the others are held, from several starts. scratch: as
   * long as the positions. */
  farthest(direction: Vector3, scratch: Float64Array, into: Vector3): Vector3 {
    let most = Number.NEGATIVE_INFINITY
    for (let start = 0; start < STARTS; start++) {
      for (let i = 0; i < this.joints.length; i++) {
        const { place, lower, upper } = this.joints[i] as ChainJoint
        const share = ((start + 0.5) / STARTS + i * SPREAD * (start + 1)) % 1
        if (place >= 0) scratch[place] = lower + share * (upper - lower)
      }
      for (let sweep = 0; sweep < SWEEPS; sweep++) this.sweep(direction, scratch)
      this.tool(scratch, tried)
      if (tried.dot(direction) <= most) continue
      most = tried.dot(direction)
      into.copy(tried)
    }
    return into
  }

  /** Move each joint to its optimum, from the last to the first, while those before it are held. */
  private sweep(direction: Vector3, positions: Float64Array): void {
    this.tool(positions, at)
    for (let i = this.joints.length - 1; i >= 0; i--) {
      const { place, prismatic, lower, upper } = this.joints[i] as ChainJoint
      if (place < 0) continue
      const axis = this.axes[i] as Vector3
      const now = positions[place] as number
      if (prismatic) {
        const next = axis.dot(direction) > 0 ? upper : lower
        at.addScaledVector(axis, next - now)
        positions[place] = next
        continue
      }
      from.setFromMatrixPosition(this.frames[i] as Matrix4)
      across.subVectors(at, from)
      const along = across.dot(axis)
      across.addScaledVector(axis, -along)
      side.crossVectors(axis, across)
      const a = across.dot(direction)
      const b = side.dot(direction)
      if (Math.hypot(a, b) < 1e-9) continue
      const by = within(Math.atan2(b, a), now, lower, upper, a, b)
      at.copy(from)
        .addScaledVector(axis, along)
        .addScaledVector(across, Math.cos(by))
        .addScaledVector(side, Math.sin(by))
      positions[place] = now + by
    }
  }
}

const at = new Vector3()
const tried = new Vector3()

/** Return the angle within a joint's limits that is nearest to the optimum of a cos + b sin. */
function within(
  best: number,
  now: number,
  lower: number,
  upper: number,
  a: number,
  b: number,
): number {
  for (const by of [best, best - 2 * Math.PI, best + 2 * Math.PI]) {
    if (now + by >= lower && now + by <= upper) return by
  }
  const gain = (by: number) => a * Math.cos(by) + b * Math.sin(by)
  return gain(lower - now) > gain(upper - now) ? lower - now : upper - now
}
