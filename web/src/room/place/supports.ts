import type { Pose } from '../../protocol/geometry_msgs'

/** Least vertical part of the normal of a horizontal surface: cos of 10 degrees. */
const LEVEL = 0.985
/** Most vertical part of the normal of an upright one: cos of 75 degrees. */
const UPRIGHT = 0.26
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

/** An upright plane, such as a wall: its ends in the lab's frame and its height, m. */
export interface Wall {
  readonly ax: number
  readonly ay: number
  readonly bx: number
  readonly by: number
  readonly low: number
  readonly high: number
}

/** An upright cylinder around an object or a person, m. */
export interface Obstacle {
  readonly kind: 'thing' | 'person'
  readonly x: number
  readonly y: number
  readonly radius: number
  readonly low: number
  readonly high: number
}

/** All that decides where something may stand. bases: of the robots, each with the robot's name as
 * its support. */
export interface Ground {
  readonly supports: readonly Support[]
  readonly walls: readonly Wall[]
  readonly bases: Iterable<Place>
  readonly obstacles: Iterable<Obstacle>
}

const ENDLESS: Support = { name: FLOOR, height: 0, outline: new Float64Array() }

/** Return the floor and every level plane, the highest first. Devices disagree on the direction of
 * normals: a plane is level by gravity alone. */
export function supportsOf(surfaces: readonly SurfaceShape[]): Support[] {
  const found: Support[] = []
  for (const surface of surfaces) {
    const { name, label, pose, triangles } = surface
    if (label === 'ceiling' || label === FLOOR || triangles.length > 0) continue
    const { x, y } = pose.orientation
    if (Math.abs(1 - 2 * (x * x + y * y)) < LEVEL) continue
    const corners = cornersOf(surface)
    if (corners.length < 3) continue
    const outline = Float64Array.from(corners.flatMap((corner) => [corner.x, corner.y]))
    const height = corners.reduce((sum, { z }) => sum + z, 0) / corners.length
    found.push({ name, height, outline })
  }
  found.sort((a, b) => b.height - a.height)
  return [...found, ENDLESS]
}

/** Return every upright plane, from its one end to the other. */
export function wallsOf(surfaces: readonly SurfaceShape[]): Wall[] {
  const found: Wall[] = []
  for (const surface of surfaces) {
    const { x, y } = surface.pose.orientation
    if (surface.triangles.length > 0 || Math.abs(1 - 2 * (x * x + y * y)) > UPRIGHT) continue
    const corners = cornersOf(surface)
    const [first] = corners
    if (first === undefined) continue
    // the ends are those corners that are farthest apart across the floor
    const away = (from: { x: number; y: number }) =>
      corners.reduce((most, each) => (apart(each, from) > apart(most, from) ? each : most), first)
    const a = away(first)
    const b = away(a)
    const heights = corners.map(({ z }) => z)
    const low = Math.min(...heights)
    found.push({ ax: a.x, ay: a.y, bx: b.x, by: b.y, low, high: Math.max(...heights) })
  }
  return found
}

/** Return the corners of a plane in the lab's frame. */
function cornersOf({ pose, vertices }: SurfaceShape): { x: number; y: number; z: number }[] {
  const { x, y, z, w } = pose.orientation
  const { position: p } = pose
  return vertices.map((vertex) => {
    // q v q*, written out
    const tx = 2 * (y * vertex.z - z * vertex.y)
    const ty = 2 * (z * vertex.x - x * vertex.z)
    const tz = 2 * (x * vertex.y - y * vertex.x)
    return {
      x: p.x + vertex.x + w * tx + y * tz - z * ty,
      y: p.y + vertex.y + w * ty + z * tx - x * tz,
      z: p.z + vertex.z + w * tz + x * ty - y * tx,
    }
  })
}

function apart(a: { x: number; y: number }, b: { x: number; y: number }): number {
  return Math.hypot(a.x - b.x, a.y - b.y)
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
 * away, and before any wall; false: there is none. Coordinates of the lab's frame; allocates
 * nothing. */
export function landing(
  { supports, walls }: Pick<Ground, 'supports' | 'walls'>,
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
  if (least === Number.POSITIVE_INFINITY) return false
  return !walls.some((wall) => crosses(wall, origin, direction, least))
}

/** Return whether a ray meets a wall before `share` of its direction. */
function crosses(
  { ax, ay, bx, by, low, high }: Wall,
  origin: { readonly x: number; readonly y: number; readonly z: number },
  direction: { readonly x: number; readonly y: number; readonly z: number },
  share: number,
): boolean {
  const wx = bx - ax
  const wy = by - ay
  const across = direction.x * wy - direction.y * wx
  if (Math.abs(across) < 1e-9) return false
  const t = ((ax - origin.x) * wy - (ay - origin.y) * wx) / across
  const u = ((ax - origin.x) * direction.y - (ay - origin.y) * direction.x) / across
  const z = origin.z + t * direction.z
  return t > 0 && t < share && u >= 0 && u <= 1 && z >= low && z <= high
}

/** The nearest edge of a surface: how far, m, and its direction, rad. */
export interface Edge {
  distance: number
  direction: number
}

/** Write the edge of a support that is nearest to a point; an endless one has none. */
export function nearestEdge({ outline }: Support, x: number, y: number, into: Edge): Edge {
  into.distance = Number.POSITIVE_INFINITY
  const count = outline.length / 2
  for (let i = 0, j = count - 1; i < count; j = i++) {
    const ax = outline[2 * j] as number
    const ay = outline[2 * j + 1] as number
    const bx = outline[2 * i] as number
    const by = outline[2 * i + 1] as number
    const distance = fromSegment(x, y, ax, ay, bx, by)
    if (distance >= into.distance) continue
    into.distance = distance
    into.direction = Math.atan2(by - ay, bx - ax)
  }
  return into
}

/** Return the distance of a point from the line between two others, m. */
export function fromSegment(
  x: number,
  y: number,
  ax: number,
  ay: number,
  bx: number,
  by: number,
): number {
  const dx = bx - ax
  const dy = by - ay
  const share = ((x - ax) * dx + (y - ay) * dy) / Math.max(dx * dx + dy * dy, 1e-12)
  const along = Math.min(Math.max(share, 0), 1)
  return Math.hypot(ax + along * dx - x, ay + along * dy - y)
}
