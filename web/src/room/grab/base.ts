import { Vector3 } from 'three'
import { type Ground, isOn, landing, type Place } from '../place/supports'
import { type Around, BASE, type Hindrance, hindranceAt, squared } from './clearance'
import type { Grip } from './object'

/** m: a press that moves less carries nothing. */
const TOUCH = 0.03
/** m: the ray carries no farther. */
export const FARTHEST = 6
/** m: a hand holds a base from this height above it. */
const ABOVE = 0.3
/** rad/s and m/s at full stick. */
export const TURN_SPEED = 1.6
const SHIFT_SPEED = 0.8
/** rad that a base turns for each that one hand turns like a key, beyond what happens by itself. */
const KEY = 2.5
const STEADY = 0.4
/** rad: smaller turns are noise. */
const LEAST_TURN = 1e-4

/** A pointer that holds a base, in the lab's frame. near: the hand holds it, else the ray. */
export interface Hold extends Grip {
  readonly near: boolean
  /** Of the wrist about its ray, rad, to the left. */
  readonly roll: number
}

/** Deflection of the stick of the first pointer, -1 to 1: x to the right, y towards the user. */
interface Stick {
  readonly x: number
  readonly y: number
}

/** A robot's base that is carried, in the lab's frame. */
interface BaseGrab {
  readonly place: Place
  /** About z, rad: as it is turned, and as it stands, square to a near edge. */
  heading: number
  stands: number
  moved: boolean
  /** The landing of the pointer, and the surface there. */
  readonly land: Place
  /** From there, or from the middle of two, to the base; z is not used. */
  readonly offset: Vector3
  /** Place of the base when the first pointer took hold. */
  readonly start: Vector3
  /** Direction from the first pointer to the second, rad. */
  between: number
  /** Roll of the one hand when it took hold, and how far that has turned the base, rad. */
  roll: number
  twist: number
}

const direction = new Vector3()
const origin = new Vector3()
const down = new Vector3(0, 0, -1)
const UP = new Vector3(0, 0, 1)
const other: Place = { x: 0, y: 0, z: 0, support: '' }

type Surfaces = Pick<Ground, 'supports' | 'walls'>

export function newBaseGrab(): BaseGrab {
  const place = () => ({ x: 0, y: 0, z: 0, support: 'floor' })
  return {
    place: place(),
    heading: 0,
    stands: 0,
    moved: false,
    land: place(),
    offset: new Vector3(),
    start: new Vector3(),
    between: 0,
    roll: 0,
    twist: 0,
  }
}

/** Begin at the place of a base. */
export function begin(grab: BaseGrab, { x, y, z }: Vector3, heading: number): void {
  Object.assign(grab.place, { x, y, z })
  grab.heading = heading
  grab.stands = heading
  grab.moved = false
}

/** Let a pointer carry the base from its present place. */
export function hold(grab: BaseGrab, by: Hold, around: Surfaces): void {
  const { place, land, start, offset } = grab
  grab.roll = by.roll
  grab.twist = 0
  start.set(place.x, place.y, place.z)
  if (lands(by, around, land)) offset.set(place.x - land.x, place.y - land.y, 0)
  else offset.set(0, 0, 0)
}

/** Let a second pointer carry and turn the base with the first from now on: about their middle. */
export function join(grab: BaseGrab, first: Hold, second: Hold, around: Surfaces): void {
  const { place, land, start, offset } = grab
  grab.between = directionOf(first, second)
  start.set(place.x, place.y, place.z)
  if (landsBetween(first, second, around, land)) offset.set(place.x - land.x, place.y - land.y, 0)
}

/** Carry a base for `step`, s: the first pointer moves it; a second one, the stick, or the first
 * hand turned like a key, turns it.
 * Returns why it cannot stand under the pointer, empty: it can; null: no new place. */
export function carry(
  grab: BaseGrab,
  first: Hold,
  second: Hold | null,
  stick: Stick,
  step: number,
  around: Around,
): Hindrance | '' | null {
  if (second !== null) {
    const between = directionOf(first, second)
    const { sin, cos, atan2 } = Math
    const apart = between - grab.between
    const by = atan2(sin(apart), cos(apart))
    turn(grab, by)
    grab.offset.applyAxisAngle(UP, by)
    grab.between = between
  } else {
    const way = first.roll - grab.roll
    const twist = KEY * Math.sign(way) * Math.max(Math.abs(way) - STEADY, 0)
    turn(grab, twist - grab.twist)
    grab.twist = twist
  }
  turn(grab, -stick.x * TURN_SPEED * step)
  if (stick.y !== 0) {
    direction.copy(first.ray.direction).setZ(0).normalize()
    grab.offset.addScaledVector(direction, -stick.y * SHIFT_SPEED * step)
  }
  const { land } = grab
  const landed =
    second === null ? lands(first, around, land) : landsBetween(first, second, around, land)
  grab.stands = squared(grab.heading, grab.place, around.supports)
  if (!landed) return null
  const x = land.x + grab.offset.x
  const y = land.y + grab.offset.y
  if (!grab.moved && Math.hypot(x - grab.start.x, y - grab.start.y) < TOUCH) return null
  settle(land, x, y, around)
  const hindrance = hindranceAt(land, BASE, around)
  if (hindrance !== null) return hindrance
  grab.moved = true
  Object.assign(grab.place, land)
  return ''
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
function lands({ near, ray, place }: Hold, around: Surfaces, into: Place): boolean {
  if (!near) return landing(around, ray.origin, ray.direction, FARTHEST, into)
  origin.copy(place).setZ(place.z + ABOVE)
  return landing(around, origin, down, FARTHEST, into)
}

/** Write the middle of the landings of two pointers, on the surface of the first. */
function landsBetween(first: Hold, second: Hold, around: Surfaces, into: Place): boolean {
  if (!lands(second, around, other) || !lands(first, around, into)) return false
  into.x = (into.x + other.x) / 2
  into.y = (into.y + other.y) / 2
  return true
}

/** Move a landing to x, y: on its own surface, or on the highest one below that. */
function settle(land: Place, x: number, y: number, { supports }: Surfaces): void {
  for (const support of supports) {
    if (support.height > land.z + 0.01 || !isOn(support, x, y)) continue
    land.z = support.height
    land.support = support.name
    break
  }
  land.x = x
  land.y = y
}
