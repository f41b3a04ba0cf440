import type { Object3D } from 'three'

/** As a message has it: m, and a unit quaternion. */
export interface Pose {
  readonly position: { readonly x: number; readonly y: number; readonly z: number }
  readonly orientation: {
    readonly x: number
    readonly y: number
    readonly z: number
    readonly w: number
  }
}

/** Smaller changes are not seen: m, and of a quaternion's numbers. */
const STILL = 1e-5

/** Write a pose into an object's own position and quaternion; return whether that changes it. */
export function place(object: Object3D, pose: Pose): boolean {
  const { position: p, orientation: q } = pose
  const { position, quaternion } = object
  const change =
    Math.abs(position.x - p.x) +
    Math.abs(position.y - p.y) +
    Math.abs(position.z - p.z) +
    Math.abs(quaternion.x - q.x) +
    Math.abs(quaternion.y - q.y) +
    Math.abs(quaternion.z - q.z) +
    Math.abs(quaternion.w - q.w)
  if (change < STILL) return false
  position.set(p.x, p.y, p.z)
  quaternion.set(q.x, q.y, q.z, q.w)
  return true
}
