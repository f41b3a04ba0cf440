import {
  type Edge,
  fromSegment,
  type Ground,
  isOn,
  nearestEdge,
  type Place,
  type Support,
} from '../place/supports'

/** The reason for which nothing may stand at a place. */
export type Hindrance = 'edge' | 'thing' | 'robot' | 'person'

/** The part of a robot or an object that must be free. radius, tall: of an upright cylinder on its
 * support. apart: least distance to the middle of a robot's base. m */
export interface Foot {
  readonly radius: number
  readonly tall: number
  readonly apart: number
}

/** A robot's base: the arm above it moves, and is watched by physics. */
export const BASE: Foot = { radius: 0.12, tall: 0.5, apart: 0.35 }

/** What stands around a place; bases: of the other robots. */
export type Around = Ground

/** m: heights that differ less are one level. */
const FLAT = 0.01
/** rad and m: a heading so near to square with an edge so near is squared. */
const SQUARE = (6 * Math.PI) / 180
const NEAR_EDGE = 0.6

const edge: Edge = { distance: 0, direction: 0 }

/** Return why a foot cannot stand at a place; null: it can. */
export function hindranceAt(place: Place, foot: Foot, around: Around): Hindrance | null {
  const { x, y, z } = place
  const { radius, tall } = foot
  const top = z + tall
  for (const support of around.supports) {
    if (support.name === place.support) {
      if (nearestEdge(support, x, y, edge).distance < radius) return 'edge'
    } else if (support.height > z + FLAT && support.height < top) {
      const over = isOn(support, x, y) || nearestEdge(support, x, y, edge).distance < radius
      if (over) return 'thing'
    }
  }
  for (const { ax, ay, bx, by, low, high } of around.walls) {
    if (high < z + FLAT || low > top) continue
    if (fromSegment(x, y, ax, ay, bx, by) < radius) return 'thing'
  }
  for (const other of around.bases) {
    const near = Math.hypot(other.x - x, other.y - y) < foot.apart
    if (near && Math.abs(other.z - z) < 0.5) return 'robot'
  }
  for (const { kind, x: ox, y: oy, radius: wide, low, high } of around.obstacles) {
    if (high < z + FLAT || low > top) continue
    if (Math.hypot(ox - x, oy - y) < radius + wide) return kind
  }
  return null
}

/** Return a heading, rad, square to the nearest edge of its support if it nearly is. */
export function squared(heading: number, place: Place, supports: readonly Support[]): number {
  const support = supports.find(({ name }) => name === place.support)
  if (support === undefined) return heading
  nearestEdge(support, place.x, place.y, edge)
  if (edge.distance > NEAR_EDGE) return heading
  const quarter = Math.PI / 2
  const off = (heading - edge.direction) / quarter
  const by = (Math.round(off) - off) * quarter
  return Math.abs(by) < SQUARE ? heading + by : heading
}
