import type { Ray, Vector3 } from 'three'

/** The ray of a pointer, and the place at which its hand holds things, m. */
export interface Grip {
  readonly ray: Ray
  readonly place: Vector3
}

/** An object that a pointer carries: in the hand, or at a distance, m, along the ray. */
export interface Grab {
  readonly inHand: boolean
  readonly distance: number
  /** From the hand or the place on the ray to the object. */
  readonly offset: Vector3
}

/** Take hold of an object whose centre is at `centre`. */
export function grab(grip: Grip, centre: Vector3, inHand: boolean): Grab {
  const offset = centre.clone()
  const distance = offset.sub(grip.ray.origin).dot(grip.ray.direction)
  const held = inHand ? grip.place : grip.ray.at(distance, offset)
  return { inHand, distance, offset: centre.clone().sub(held) }
}

/** Write the centre of a carried object into `into`. */
export function carried({ inHand, distance, offset }: Grab, grip: Grip, into: Vector3): Vector3 {
  if (inHand) into.copy(grip.place)
  else grip.ray.at(distance, into)
  return into.add(offset)
}
