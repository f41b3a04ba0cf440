import type { Quaternion, Vector3 } from 'three'

/** m: points that are nearer say too little of a direction. */
export const NEAREST = 0.4

/** Where the lab's origin is in the floor space, and its heading about the vertical. */
export interface Footing {
  readonly x: number
  readonly z: number
  /** rad; 0: the lab's x points along -z */
  readonly yaw: number
}

/** Return where the lab stands by two points that were touched in the floor space: its origin is
 * below the first, its x points to the second. null: they are too near to each other. Heights do not
 * count: each headset knows its floor. */
export function footingOf(first: Vector3, second: Vector3): Footing | null {
  const x = second.x - first.x
  const z = second.z - first.z
  if (Math.hypot(x, z) < NEAREST) return null
  return { x: first.x, z: first.z, yaw: Math.atan2(-x, -z) }
}

/** Write a footing on a floor of a height, m. */
export function stand(
  { x, z, yaw }: Footing,
  floor: number,
  position: Vector3,
  turn: Quaternion,
): void {
  position.set(x, floor, z)
  turn.set(0, Math.sin(yaw / 2), 0, Math.cos(yaw / 2))
}
