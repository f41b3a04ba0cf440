import type { Pose } from '../../protocol/geometry_msgs'

/** Least vertical part of the normal of a horizontal surface: cos of 10 degrees. */
const LEVEL = 0.985
const FLOOR = 'floor'

/** A level surface that robots stand on, in the lab's frame, m. */
export interface Support {
  readonly name: string
  readonly height: number
  /** x, y, x, y, ... of its outline; empty: it has no end. */
  readonly outline: Float64Array
}

/** The fields of mrlab_msgs/msg/Surface from which supports are made. */
export interface SurfaceShape {
  readonly name: string
  readonly label: string
  readonly pose: Pose
  readonly vertices: readonly { readonly x: number; readonly y: number; readonly z: number }[]
  readonly triangles: ArrayLike<number>
}

export interface Place {
  x: number
  y: number
  z: number
  /** name of the surface, or of the robot that stands there */
  support: string
}

/** The level surfaces, and the robots' bases, each with the robot's name as its support. */
export interface Ground {
  readonly supports: readonly Support[]
  readonly bases: Iterable<Place>
}

const ENDLESS: Support = { name: FLOOR, height: 0, outline: new Float64Array() }

/** Return the floor and every level plane, the highest first. Devices disagree on the direction of
 * normals: a plane is level by gravity alone. */
export function supportsOf(surfaces: readonly SurfaceShape[]): Support[] {
  const found: Support[] = []
  for (const { name, label, pose, vertices, triangles } of surfaces) {
    if (label === 'ceiling' || label === FLOOR || triangles.length > 0) continue
    if (vertices.length < 3) continue
    const { x, y, z, w } = pose.orientation
    if (Math.abs(1 - 2 * (x * x + y * y)) < LEVEL) continue
    const outline = new Float64Array(vertices.length * 2)
    let height = 0
    vertices.forEach((vertex, i) => {
      // q v q*, written out
      const tx = 2 * (y * vertex.z - z * vertex.y)
      const ty = 2 * (z * vertex.x - x * vertex.z)
      const tz = 2 * (x * vertex.y - y * vertex.x)
      outline[2 * i] = pose.position.x + vertex.x + w * tx + y * tz - z * ty
      outline[2 * i + 1] = pose.position.y + vertex.y + w * ty + z * tx - x * tz
      height += (pose.position.z + vertex.z + w * tz + x * ty - y * tx) / vertices.length
    })
    found.push({ name, height, outline })
  }
  found.sort((a, b) => b.height - a.height)
  return [...found, ENDLESS]
}

/** Return whether a point is on a support; even-odd rule. */
export function isOn({ outline }: Support, x: number, y: number): boolean {
  const count = outline.length / 2
  if (count === 0) return true
  let inside = false
  for (let i = 0, j = count - 1; i < count; j = i++) {
    const xi = outline[2 * i] as number
    const yi = outline[2 * i + 1] as number
    const xj = outline[2 * j] as number
    const yj = outline[2 * j + 1] as number
    if (yi > y !== yj > y && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) inside = !inside
  }
  return inside
}

/** Find the first landing of a ray that points downwards, at most `most`, m across the floor,
 * away; false: there is none. Coordinates of the lab's frame; allocates nothing. */
export function landing(
  supports: readonly Support[],
  origin: { readonly x: number; readonly y: number; readonly z: number },
  direction: { readonly x: number; readonly y: number; readonly z: number },
  most: number,
  into: Place,
): boolean {
  if (direction.z > -0.01) return false
  let least = Number.POSITIVE_INFINITY
  for (const support of supports) {
    const share = (support.height - origin.z) / direction.z
    if (share <= 0 || share >= least) continue
    const x = origin.x + share * direction.x
    const y = origin.y + share * direction.y
    if (Math.hypot(x - origin.x, y - origin.y) > most || !isOn(support, x, y)) continue
    least = share
    into.x = x
    into.y = y
    into.z = support.height
    into.support = support.name
  }
  return least < Number.POSITIVE_INFINITY
}

/** Return whether a place keeps `distance`, m, from others on the same level. */
export function isClear(
  place: Place,
  distance: number,
  others: Iterable<{ readonly x: number; readonly y: number; readonly z: number }>,
): boolean {
  for (const other of others) {
    const near = Math.hypot(other.x - place.x, other.y - place.y) < distance
    if (near && Math.abs(other.z - place.z) < 0.5) return false
  }
  return true
}
