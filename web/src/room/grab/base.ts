import { Vector3 } from 'three'
import { isClear, isOn, landing, type Place, type Support } from '../place/supports'
import type { Grip } from './object'

/** m: a press that moves less carries nothing. */
const TOUCH = 0.03
/** m: bases keep this distance from each other. */
const APART = 0.35
/** m: the ray carries no farther. */
const FARTHEST = 6
/** m: a hand holds a base from this height above it. */
const ABOVE = 0.3
/** rad/s and m/s at full stick. */
const TURN_SPEED = 1.6
const SHIFT_SPEED = 0.8
/** rad: smaller turns are noise. */
const LEAST_TURN = 1e-4

/** A pointer that holds a base, in the lab's frame. near: the hand holds it, else the ray. */
export interface Hold extends Grip {
  readonly near: boolean
}

/** Deflection of the stick of the first pointer, -1 to 1: x to the right, y towards the user. */
interface Stick {
  readonly x: number
  readonly y: number
}

/** The level surfaces, and the bases of the other robots. */
interface Surrounding {
  readonly supports: readonly Support[]
  readonly others: Iterable<Place>
}

/** A robot's base that is carried, in the lab's frame. */
interface BaseGrab {
  readonly place: Place
  /** About z, rad. */
  heading: number
  moved: boolean
  /** The landing of the pointer, and the surface there. */
  readonly land: Place
  /** From there to the base; z is not used. */
  readonly offset: Vector3
  /** Place of the base when the first pointer took hold. */
  readonly start: Vector3
  /** Direction from the first pointer to the second, rad. */
  between: number
}

const direction = new Vector3()
const origin = new Vector3()
const down = new Vector3(0, 0, -1)

export function newBaseGrab(): BaseGrab {
  const place = () => ({ x: 0, y: 0, z: 0, support: 'floor' })
  return {
    place: place(),
    heading: 0,
    moved: false,
    land: place(),
    offset: new Vector3(),
    start: new Vector3(),
    between: 0,
  }
}

/** Begin at the place of a base. */
export function begin(grab: BaseGrab, { x, y, z }: Vector3, heading: number): void {
  Object.assign(grab.place, { x, y, z })
  grab.heading = heading
  grab.moved = false
}

/** Let a pointer carry the base from its present place. */
export function hold(grab: BaseGrab, by: Hold, supports: readonly Support[]): void {
  const { place, land, start, offset } = grab
  start.set(place.x, place.y, place.z)
  if (lands(by, supports, land)) offset.set(place.x - land.x, place.y - land.y, 0)
  else offset.set(0, 0, 0)
}

/** Let a second pointer turn the base from now on. */
export function join(grab: BaseGrab, first: Hold, second: Hold): void {
  grab.between = directionOf(first, second)
}

/** Carry a base for `step`, s: the first pointer moves it; a second one, or the stick, turns it.
 * Returns whether the place under the pointer is clear of other bases; null: no new place. */
export function carry(
  grab: BaseGrab,
  first: Hold,
  second: Hold | null,
  stick: Stick,
  step: number,
  { supports, others }: Surrounding,
): boolean | null {
  if (second !== null) {
    const between = directionOf(first, second)
    turn(grab, between - grab.between)
    grab.between = between
  }
  turn(grab, -stick.x * TURN_SPEED * step)
  if (stick.y !== 0) {
    direction.copy(first.ray.direction).setZ(0).normalize()
    grab.offset.addScaledVector(direction, -stick.y * SHIFT_SPEED * step)
  }
  if (!lands(first, supports, grab.land)) return null
  const x = grab.land.x + grab.offset.x
  const y = grab.land.y + grab.offset.y
  if (!grab.moved && Math.hypot(x - grab.start.x, y - grab.start.y) < TOUCH) return null
  settle(grab.land, x, y, supports)
  if (!isClear(grab.land, APART, others)) return false
  grab.moved = true
  Object.assign(grab.place, grab.land)
  return true
}

function turn(grab: BaseGrab, by: number): void {
  if (Math.abs(by) < LEAST_TURN) return
  grab.heading += by
  grab.moved = true
}

function directionOf(first: Hold, second: Hold): number {
  return Math.atan2(second.place.y - first.place.y, second.place.x - first.place.x)
}

/** Write the landing of a pointer; false: there is none. */
function lands({ near, ray, place }: Hold, supports: readonly Support[], into: Place): boolean {
  if (!near) return landing(supports, ray.origin, ray.direction, FARTHEST, into)
  origin.copy(place).setZ(place.z + ABOVE)
  return landing(supports, origin, down, FARTHEST, into)
}

/** Move a landing to x, y: on its own surface, or on the highest one below that. */
function settle(land: Place, x: number, y: number, supports: readonly Support[]): void {
  for (const support of supports) {
    if (support.height > land.z + 0.01 || !isOn(support, x, y)) continue
    land.z = support.height
    land.support = support.name
    break
  }
  land.x = x
  land.y = y
}
