import { Matrix4, type Object3D, type Quaternion, Vector3 } from 'three'
import type { URDFRobot } from 'urdf-loader'

const LEAST_ARM = 0.03 // m, of a link that shows how its joint is turned
const ONE = new Vector3(1, 1, 1)

/** A joint that turns. frame: at 0 in that of its link, z along its axis, x towards the next
 * joint; length: how far that is, m. */
export interface Turn {
  readonly joint: string
  readonly frame: Matrix4
  readonly length: number
}

interface Resting {
  readonly joint: Object3D
  readonly axis: Vector3
  readonly restPosition: Vector3
  readonly restTurn: Quaternion
}

const restOf = ({ restPosition, restTurn }: Resting) =>
  new Matrix4().compose(restPosition, restTurn, ONE)

/** Return where a joint turns. all: the joints that move. */
export function turnOf(
  joint: string,
  found: Resting,
  tip: Object3D,
  all: readonly Resting[],
): Turn {
  const path: Object3D[] = []
  let node: Object3D | null = tip
  for (; node !== null && node !== found.joint; node = node.parent) path.unshift(node)
  const at = new Matrix4()
  const out = new Vector3()
  for (const each of node === null ? [] : path) {
    const inner = all.find((one) => one.joint === each)
    at.multiply(inner === undefined ? each.matrix : restOf(inner))
    out.setFromMatrixPosition(at).projectOnPlane(found.axis)
    if (out.length() > LEAST_ARM) break
  }
  const length = out.length()
  // any direction across the axis
  if (length < LEAST_ARM) out.set(1, 0.1, 0.01).projectOnPlane(found.axis)
  out.normalize()
  const across = new Vector3().crossVectors(found.axis, out)
  const basis = new Matrix4().makeBasis(out, across, found.axis)
  return { joint, frame: restOf(found).multiply(basis), length }
}

/** Write where a turning joint is now in the frame of the robot's base. */
export function placeTurn(root: URDFRobot, { joint, frame }: Turn, into: Matrix4): void {
  const link = root.joints[joint]?.parent
  if (!link) return
  root.updateWorldMatrix(true, false)
  link.updateWorldMatrix(true, false)
  into.copy(root.matrixWorld).invert().multiply(link.matrixWorld).multiply(frame)
}
