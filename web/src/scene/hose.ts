import { Matrix4, Object3D, Vector3 } from 'three'
import type { StatedEnd, StatedHose } from './levels'

const RINGS = 22 // of which the hose bends; between two it is straight
const SAMPLES = 40 // of the curve, to find its length
const ROUNDS = 12 // of halving, to find how far it bulges

/** Where a hose ends: a point of a link, m, and the direction in which it leaves there. */
interface HoseEnd {
  readonly link: Object3D
  readonly point: Vector3
  readonly direction: Vector3
}

const inverse = new Matrix4()
const from = new Vector3()
const to = new Vector3()
const out = new Vector3()
const back = new Vector3()
const along = new Vector3()
const side = new Vector3()
const across = new Vector3()
const place = new Vector3()
const frame = new Matrix4()

/** A hose of one length between two links: a curve that leaves both ends in their directions and
 * bulges as far as its length asks. It is drawn as rings, which are bones of a robot's body. */
export class Hose {
  /** From the first end to the second; z of each points along the hose. */
  readonly rings: readonly Object3D[] = Array.from({ length: RINGS }, ring)
  private readonly lengths = new Float64Array(SAMPLES + 1)

  /** length, radius: m. */
  constructor(
    readonly ends: readonly [HoseEnd, HoseEnd],
    readonly length: number,
    readonly radius: number,
  ) {}

  /** Return a hose between links; null where one of them is not there. */
  static between(stated: StatedHose, links: Readonly<Record<string, Object3D>>): Hose | null {
    const on = ({ link: name, point, direction }: StatedEnd): HoseEnd | null => {
      const link = links[name]
      return link === undefined ? null : { link, point, direction }
    }
    const [first, second] = [on(stated.ends[0]), on(stated.ends[1])]
    if (first === null || second === null) return null
    return new Hose([first, second], stated.length, stated.radius)
  }

  /** Place the rings where the links are now; root: of the robot. Their world frames are current. */
  follow(root: Object3D): void {
    const [first, second] = this.ends
    inverse.copy(root.matrixWorld).invert()
    frame.multiplyMatrices(inverse, first.link.matrixWorld)
    from.copy(first.point).applyMatrix4(frame)
    out.copy(first.direction).transformDirection(frame)
    // any direction across, the same one of the link at every pose
    side.set(first.direction.y, first.direction.z, first.direction.x).cross(first.direction)
    side.transformDirection(frame)
    frame.multiplyMatrices(inverse, second.link.matrixWorld)
    to.copy(second.point).applyMatrix4(frame)
    back.copy(second.direction).transformDirection(frame)
    const bulge = this.bulge()
    this.measure(bulge)
    const whole = this.lengths[SAMPLES] as number
    let sample = 0
    for (let i = 0; i < RINGS; i++) {
      const goal = (whole * i) / (RINGS - 1)
      while (sample < SAMPLES - 1 && (this.lengths[sample + 1] as number) < goal) sample++
      const low = this.lengths[sample] as number
      const high = this.lengths[sample + 1] as number
      const t = (sample + (high > low ? (goal - low) / (high - low) : 0)) / SAMPLES
      slope(Math.min(t, 1), bulge)
      // carried along without a turn about the hose
      side.addScaledVector(along, -side.dot(along)).normalize()
      across.crossVectors(along, side)
      point(Math.min(t, 1), bulge)
      frame.makeBasis(side, across, along).setPosition(place)
      const ring = this.rings[i] as Object3D
      ring.matrixWorld.multiplyMatrices(root.matrixWorld, frame)
    }
  }

  /** Return how far the curve keeps its directions, m, so that it is as long as the hose. */
  private bulge(): number {
    let low = from.distanceTo(to) * 0.1
    let high = this.length
    for (let round = 0; round < ROUNDS; round++) {
      const middle = (low + high) / 2
      if (this.measure(middle) > this.length) high = middle
      else low = middle
    }
    return (low + high) / 2
  }

  /** Fill in the length of the curve up to each sample; return that of all, m. */
  private measure(bulge: number): number {
    let length = 0
    let { x, y, z } = from
    for (let i = 1; i <= SAMPLES; i++) {
      point(i / SAMPLES, bulge)
      length += Math.hypot(place.x - x, place.y - y, place.z - z)
      this.lengths[i] = length
      x = place.x
      y = place.y
      z = place.z
    }
    return length
  }
}

function ring(): Object3D {
  const made = new Object3D()
  made.name = 'hose'
  return made
}

/** Set `place` to the point of the curve, t 0 to 1. */
function point(t: number, bulge: number): void {
  const u = 1 - t
  const first = u * u * (u + 3 * t)
  place
    .copy(from)
    .multiplyScalar(first)
    .addScaledVector(to, 1 - first)
  place.addScaledVector(out, 3 * u * u * t * bulge).addScaledVector(back, 3 * u * t * t * bulge)
}

/** Set `along` to the direction of the curve, t 0 to 1. */
function slope(t: number, bulge: number): void {
  const u = 1 - t
  along.subVectors(to, from).multiplyScalar(6 * u * t)
  along.addScaledVector(out, 3 * (u * u - 2 * u * t) * bulge)
  along.addScaledVector(back, 3 * (2 * u * t - t * t) * bulge)
  if (along.lengthSq() < 1e-12) along.subVectors(to, from)
  along.normalize()
}
