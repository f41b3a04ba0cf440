/** A rectangle of the view: its middle and its size, rad. az: to the right of the view's middle, el:
 * upwards. */
export interface Box {
  readonly az: number
  readonly el: number
  readonly width: number
  readonly height: number
}

/** Directions of points on a thing, az and el in turn, rad. */
export type Silhouette = readonly number[]

/** A panel that wants a place. */
export interface Wish {
  /** Direction of the thing beside which it wants to be. */
  readonly az: number
  readonly el: number
  readonly width: number
  readonly height: number
  /** 1: rather to the right of it, -1: to the left. */
  readonly side: 1 | -1
}

/** All that a panel must not cover. */
export interface Crowd {
  readonly robots: readonly Silhouette[]
  /** Persons, the board, and panels that have their places. */
  readonly boxes: readonly Box[]
}

/** Largest part of a robot that a panel may cover. */
export const MOST_COVERED = 0.1
const deg = Math.PI / 180
const STEP = 3 * deg
const ACROSS = 60 * deg
/** Looked for above and below the thing. */
const UP = 30 * deg
const DOWN = 36 * deg
/** Eyes rest here, and turn no farther without the head. */
const REST = -12 * deg
const HIGHEST = 20 * deg
const LOWEST = -48 * deg
/** Of a place that is kept: so far from its thing. */
const FARTHEST = 45 * deg
const GAP = 1 * deg
/** Cost, rad, of a box that is overlapped, and of a whole robot that is covered. */
const HARM = 10
/** The places that are tried, rad from the thing: the nearest first, which end the search early. */
const OFFSETS = offsets()

/** Return the part of a robot that a box covers. */
export function covered(box: Box, robot: Silhouette): number {
  let inside = 0
  for (let i = 0; i < robot.length; i += 2) {
    if (Math.abs((robot[i + 1] as number) - box.el) >= box.height / 2) continue
    if (Math.abs(turn((robot[i] as number) - box.az)) < box.width / 2) inside++
  }
  return inside / Math.max(robot.length / 2, 1)
}

/** Return whether two boxes overlap, or nearly touch. */
export function overlaps(a: Box, b: Box): boolean {
  return (
    Math.abs(turn(a.az - b.az)) < (a.width + b.width) / 2 + GAP &&
    Math.abs(a.el - b.el) < (a.height + b.height) / 2 + GAP
  )
}

/** Return whether a panel may stay where it is. */
export function stays(box: Box, wish: Wish, crowd: Crowd): boolean {
  if (Math.hypot(turn(box.az - wish.az), box.el - wish.el) > FARTHEST) return false
  return clear(box, crowd)
}

/** Return whether a box covers nothing that it must not. */
export function clear(box: Box, crowd: Crowd): boolean {
  if (crowd.boxes.some((other) => overlaps(box, other))) return false
  return crowd.robots.every((robot) => covered(box, robot) <= MOST_COVERED)
}

/** Return the best place for a panel: it covers no robot by more than 10%, and no box, if there is
 * such a place; beside its thing, on the wanted side, and where eyes rest. */
export function settle(wish: Wish, crowd: Crowd): Box {
  const { width, height, side } = wish
  let best: Box = { az: wish.az, el: wish.el, width, height }
  let least = Number.POSITIVE_INFINITY
  const robots = crowd.robots.map((robot) => aside(robot, wish.az))
  const half = width / 2
  for (const { across, up } of OFFSETS) {
    const az = wish.az + across
    const el = Math.min(Math.max(wish.el + up, LOWEST), HIGHEST)
    const wrong = across * side < 0 ? 4 * deg : 0
    const rest = 0.3 * Math.abs(el - REST)
    let cost = Math.hypot(across, el - wish.el) + wrong + rest
    if (cost >= least) continue
    const box = { az, el, width, height }
    for (const other of crowd.boxes) if (overlaps(box, other)) cost += HARM
    for (const robot of robots) {
      if (cost >= least) break
      let inside = 0
      for (let i = 0; i < robot.length; i += 2) {
        const off = (robot[i] as number) - across
        if (off <= -half || off >= half) continue
        if (Math.abs((robot[i + 1] as number) - el) < height / 2) inside++
      }
      const part = inside / Math.max(robot.length / 2, 1)
      cost += part > MOST_COVERED ? part * (1 + HARM) : part
    }
    if (cost >= least) continue
    least = cost
    best = box
  }
  return best
}

/** Return a silhouette with az from a direction on. */
function aside(robot: Silhouette, az: number): Float64Array {
  const found = Float64Array.from(robot)
  for (let i = 0; i < found.length; i += 2) found[i] = turn((found[i] as number) - az)
  return found
}

function offsets(): { readonly across: number; readonly up: number }[] {
  const found = []
  for (let across = -ACROSS; across <= ACROSS + 1e-9; across += STEP) {
    for (let up = -DOWN; up <= UP + 1e-9; up += STEP) found.push({ across, up })
  }
  return found.sort((a, b) => Math.hypot(a.across, a.up) - Math.hypot(b.across, b.up))
}

/** Return an angle between -pi and pi. */
export function turn(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI))
}
