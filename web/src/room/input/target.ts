import { type Ray, Vector3 } from 'three'
import type { Pointer } from './pointer'

/** Where a pointer meets a target. */
export interface Hit {
  /** m from the pointer's origin */
  distance: number
  /** in the scene, m */
  readonly point: Vector3
  /** m from the left and from the top, on a panel */
  u: number
  v: number
}

export function newHit(): Hit {
  return { distance: Number.POSITIVE_INFINITY, point: new Vector3(), u: 0, v: 0 }
}

/** select: trigger, pinch, touch or the left mouse button; grip: the squeeze or the right one. */
export type Button = 'select' | 'grip'

/** down and up bracket a capture, in which every move goes to the target, hit or not; cancel ends it
 * without an effect. */
export type Signal =
  | { readonly kind: 'enter' | 'leave' | 'move' | 'cancel'; readonly pointer: Pointer }
  | { readonly kind: 'down' | 'up'; readonly pointer: Pointer; readonly button: Button }

/** Something that pointers can point at: a panel, a robot's base, an object. */
export interface Target {
  /** Whether the ray meets it; fills `hit` where it does. */
  cast(ray: Ray, hit: Hit): boolean
  /** Whether a hand at `point` can take hold of it. */
  reaches?(point: Vector3): boolean
  /** Return how far a fingertip is in front of its face, m, and fill u and v; NaN: not before it. */
  face?(point: Vector3, hit: Hit): number
  on(signal: Signal): void
}
