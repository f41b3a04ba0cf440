import { Box3, type Object3D, Vector3 } from 'three'
import type { Panel, Surroundings } from '../panels/panel'
import type { Frames, Preferences } from '../ports'
import { type Box, type Crowd, clear, settle, stays, turn, type Wish } from './layout'
import { Stand } from './stand'

/** s between two looks at whether a panel still stands well, and after none was found for it. */
const PERIOD = 0.25
const PAUSE = 1
/** m from the eyes: nearer than the robot, and never farther. */
const NEAREST = 0.8
const FARTHEST = 1.3
const BEFORE_ROBOT = 0.25
/** Size of a panel of the scene: 640 mm are 24 degrees at reading distance. */
const SHRUNK = 0.594
const MM = 0.001
/** m: half a person's width, half the thickness of an arm, and from one point on it to the next. */
const PERSON = 0.3
const ARM = 0.08
const EVERY = 0.05

const at = new Vector3()
const point = new Vector3()
const before = new Vector3()
const box = new Box3()

/** A panel of a thing in the scene. */
export interface Shown {
  readonly panel: Panel
  /** True if it is to be seen now. */
  readonly visible: boolean
  /** True while its thing is carried: it comes along. */
  readonly carried: boolean
  /** Write the middle of its thing, in the scene; false: it is not there. */
  about(into: Vector3): boolean
}

/** All that panels keep off. */
export interface Surround {
  /** The links of each robot. */
  robots(): Iterable<readonly Object3D[]>
  /** The heads of other people, in the scene. */
  people(): Iterable<Vector3>
  readonly board: Panel
}

interface Entry {
  readonly shown: Shown
  readonly stand: Stand
  /** Its place in the scene, m. */
  readonly place: Vector3
  /** What it takes of the view there; null: it has no place. */
  taken: Box | null
  /** When its place is looked at again, s. */
  due: number
}

/** Keeps the panels of the scene beside their things, off robots, people, the board and each other,
 * at a constant size in the view. */
export class Arrangement {
  private readonly entries: Entry[] = []

  constructor(
    private readonly ports: Frames & Preferences & Surroundings,
    private readonly surround: Surround,
  ) {}

  add(shown: Shown): void {
    const stand = new Stand(shown.panel.group, 'bottom', SHRUNK, true)
    this.entries.push({ shown, stand, place: new Vector3(), taken: null, due: 0 })
  }

  remove(shown: Shown): void {
    const index = this.entries.findIndex((entry) => entry.shown === shown)
    if (index >= 0) this.entries.splice(index, 1)
  }

  /** Before each picture, once robots are posed. now, step: s. */
  update(now: number, step: number): void {
    let crowd: Crowd | null = null
    // one search a picture: several would be seen as a stutter
    let searched = false
    for (const entry of this.entries) {
      const { shown, stand } = entry
      const { group } = shown.panel
      group.visible = shown.visible && shown.about(at)
      if (!group.visible) {
        entry.taken = null
        continue
      }
      if (entry.taken === null || shown.carried || (now >= entry.due && !searched)) {
        searched = true
        crowd ??= this.crowd()
        entry.due = now + (this.place(entry, crowd) ? PERIOD : PAUSE)
      }
      const held = shown.panel.pointers > 0 && !shown.carried
      const { head } = this.ports
      if (stand.update(entry.place, head, now, step, held, this.ports)) this.ports.stir()
    }
  }

  /** Find a place for an entry whose thing is at `at`; return whether it covers nothing there. */
  private place(entry: Entry, around: Crowd): boolean {
    const { head, leftHanded, textScale } = this.ports
    const { panel } = entry.shown
    const size = (MM * SHRUNK * textScale) / this.ports.readAt
    const distance = at.distanceTo(head)
    const wish: Wish = {
      ...directionOf(at, head),
      width: 2 * Math.atan((panel.width * size) / 2),
      height: 2 * Math.atan((panel.height * size) / 2),
      side: leftHanded ? -1 : 1,
    }
    const others = this.entries.flatMap((other) =>
      other === entry || other.taken === null
        ? []
        : [{ ...other.taken, ...directionOf(other.place, head) }],
    )
    const crowd = { robots: around.robots, boxes: [...around.boxes, ...others] }
    if (entry.taken !== null) {
      entry.taken = { ...wish, ...directionOf(entry.place, head) }
      if (stays(entry.taken, wish, crowd)) return true
    }
    const found = settle(wish, crowd)
    entry.taken = found
    const away = Math.min(Math.max(distance - BEFORE_ROBOT, NEAREST), FARTHEST)
    const flat = Math.cos(found.el) * away
    entry.place.set(
      head.x + Math.sin(found.az) * flat,
      head.y + Math.sin(found.el) * away,
      head.z - Math.cos(found.az) * flat,
    )
    return clear(found, crowd)
  }

  private crowd(): Crowd {
    const { head } = this.ports
    const robots: number[][] = []
    for (const links of this.surround.robots()) robots.push(silhouette(links, head))
    const boxes: Box[] = []
    for (const person of this.surround.people()) {
      const { az, el } = directionOf(person, head)
      const wide = 2 * Math.atan(PERSON / Math.max(person.distanceTo(head), PERSON))
      boxes.push({ az, el, width: wide, height: wide })
    }
    const { board } = this.surround
    if (board.group.visible && this.ports.screen === null) boxes.push(boxOf(board.group, head))
    return { robots, boxes }
  }
}

/** Return the direction of a place of the scene from the eyes. */
function directionOf(place: Vector3, head: Vector3): { az: number; el: number } {
  const x = place.x - head.x
  const y = place.y - head.y
  const z = place.z - head.z
  return { az: Math.atan2(x, -z), el: Math.atan2(y, Math.hypot(x, z)) }
}

/** Return directions of points on both edges of an arm, evenly from each link to its parent. */
function silhouette(links: readonly Object3D[], head: Vector3): number[] {
  const found: number[] = []
  for (const link of links) {
    // a link is below its joint, which is below its parent
    const parent = link.parent?.parent
    if (parent == null) continue
    point.setFromMatrixPosition(link.matrixWorld)
    before.setFromMatrixPosition(parent.matrixWorld)
    const steps = Math.floor(point.distanceTo(before) / EVERY)
    for (let i = 0; i < steps; i++) {
      push(found, at2.lerpVectors(before, point, (i + 0.5) / steps), head)
    }
  }
  return found
}

const at2 = new Vector3()

function push(into: number[], place: Vector3, head: Vector3): void {
  const { az, el } = directionOf(place, head)
  const wide = Math.atan(ARM / Math.max(place.distanceTo(head), ARM))
  into.push(az - wide, el, az + wide, el)
}

/** Return the rectangle of the view that a panel and all that hangs from it takes. */
function boxOf(object: Object3D, head: Vector3): Box {
  box.setFromObject(object)
  let [left, right, low, high] = [1, -1, 1, -1].map((sign) => sign * Number.POSITIVE_INFINITY) as [
    number,
    number,
    number,
    number,
  ]
  const middle = directionOf(box.getCenter(point), head).az
  for (let corner = 0; corner < 8; corner++) {
    at2.set(
      corner & 1 ? box.max.x : box.min.x,
      corner & 2 ? box.max.y : box.min.y,
      corner & 4 ? box.max.z : box.min.z,
    )
    const { az, el } = directionOf(at2, head)
    const across = turn(az - middle)
    left = Math.min(left, across)
    right = Math.max(right, across)
    low = Math.min(low, el)
    high = Math.max(high, el)
  }
  return {
    az: middle + (left + right) / 2,
    el: (low + high) / 2,
    width: right - left,
    height: high - low,
  }
}
