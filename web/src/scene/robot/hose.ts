import {
  BufferAttribute,
  BufferGeometry,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  Object3D,
  Vector3,
} from 'three'
import type { StatedEnd, StatedHose } from './levels'

const RINGS = 22 // of which the hose bends; between two it is straight
const SAMPLES = 40 // of the curve, to find its length
const ROUNDS = 12 // of halving, to find how far it bulges

/** An end of a hose: a point of a link, m, and the direction in which the hose leaves it. */
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

  /** Return a hose between links; null: one of them is missing. */
  static between(stated: StatedHose, links: Readonly<Record<string, Object3D>>): Hose | null {
    const on = ({ link: name, point, direction }: StatedEnd): HoseEnd | null => {
      const link = links[name]
      return link === undefined ? null : { link, point, direction }
    }
    const [first, second] = [on(stated.ends[0]), on(stated.ends[1])]
    if (first === null || second === null) return null
    return new Hose([first, second], stated.length, stated.radius)
  }

  /** Place the rings where the links are now; root: of the robot. Their world frames are
   * current. */
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

const RIB = 0.55 // of a rib, radii of the hose
const DEEP = 0.13 // of the groove between two ribs, radii
const MOST_RIBS = 110
const COLLAR = 1.34 // of the clamp at an end, radii
const CLAMPED = 1.6 // of its length, radii
const RUBBER = { colour: [0.0105, 0.0105, 0.0115], rough: 0.62 } as const
const CLAMP = { colour: [0.09, 0.092, 0.1], rough: 0.45 } as const

/** Resolution of drawn hoses. */
export interface HoseDetail {
  readonly sides: number
  readonly ribbed: boolean
}

interface Circle {
  /** The ring, with the fraction of the way to the next one. */
  readonly at: number
  readonly radius: number
  /** m along the hose from there */
  readonly beyond: number
  /** of the normal: how much it leans along the hose */
  readonly lean: number
  readonly clamp: boolean
  /** A surface joins it to the circle before. */
  readonly joined: boolean
}

/** Return the mesh of a hose; its vertices name rings by `skinIndex` and `skinWeight`. */
export function hoseMesh(hose: Hose, { sides, ribbed }: HoseDetail): Mesh {
  const circles = [
    ...clampAt(hose, 0),
    ...tube(hose, ribbed),
    ...clampAt(hose, hose.rings.length - 1),
  ]
  const count = circles.length * (sides + 1)
  const position = new Float32Array(count * 3)
  const normal = new Float32Array(count * 3)
  const colour = new Float32Array(count * 3)
  const finish = new Uint8Array(count * 2)
  const bone = new Uint8Array(count * 4)
  const weight = new Uint8Array(count * 4)
  const index: number[] = []
  circles.forEach((circle, row) => {
    const ring = Math.min(Math.floor(circle.at), hose.rings.length - 1)
    const onward = Math.round(255 * (circle.at - ring))
    const { colour: paint, rough } = circle.clamp ? CLAMP : RUBBER
    // the grooves lie in the shade of the ribs
    const shade = circle.clamp ? 1 : Math.min(1, (circle.radius / hose.radius) ** 5)
    const level = Math.sqrt(1 - circle.lean ** 2)
    for (let i = 0; i <= sides; i++) {
      const v = row * (sides + 1) + i
      const angle = (2 * Math.PI * i) / sides
      const x = Math.cos(angle)
      const y = Math.sin(angle)
      position.set([x * circle.radius, y * circle.radius, circle.beyond], v * 3)
      normal.set([x * level, y * level, circle.lean], v * 3)
      colour.set(
        paint.map((value) => value * shade),
        v * 3,
      )
      finish.set([255 * rough, 0], v * 2)
      bone.set([ring, Math.min(ring + 1, hose.rings.length - 1), 0, 0], v * 4)
      weight.set([255 - onward, onward, 0, 0], v * 4)
      if (!circle.joined || i === sides) continue
      const before = v - sides - 1
      index.push(before, before + 1, v, v, before + 1, v + 1)
    }
  })
  const geometry = new BufferGeometry()
  geometry.setAttribute('position', new BufferAttribute(position, 3))
  geometry.setAttribute('normal', new BufferAttribute(normal, 3))
  geometry.setAttribute('color', new BufferAttribute(colour, 3))
  geometry.setAttribute('finish', new BufferAttribute(finish, 2, true))
  geometry.setAttribute('skinIndex', new BufferAttribute(bone, 4))
  geometry.setAttribute('skinWeight', new BufferAttribute(weight, 4, true))
  geometry.setIndex(index)
  const mesh = new Mesh(geometry, new MeshStandardMaterial({ vertexColors: true }))
  mesh.name = 'hose'
  return mesh
}

function tube(hose: Hose, ribbed: boolean): Circle[] {
  const spans = hose.rings.length - 1
  const ribs = Math.min(MOST_RIBS, Math.max(spans, Math.round(hose.length / (RIB * hose.radius))))
  const steps = ribbed ? ribs * 4 : spans
  return Array.from({ length: steps + 1 }, (_, i) => {
    const turn = (Math.PI / 2) * i
    const groove = ribbed ? DEEP * (0.5 - 0.5 * Math.cos(turn)) : DEEP / 3
    return {
      at: (spans * i) / steps,
      radius: hose.radius * (1 - groove),
      beyond: 0,
      lean: ribbed ? 0.55 * Math.sin(turn) : 0,
      clamp: false,
      joined: i > 0,
    }
  })
}

/** Return a short cylinder about the ring at an end: it reaches into the link and over the hose. */
function clampAt(hose: Hose, at: number): Circle[] {
  const outer = hose.radius * COLLAR
  const half = (hose.radius * CLAMPED) / 2
  const circle = (radius: number, beyond: number, lean: number, joined: boolean): Circle => ({
    at,
    radius,
    beyond,
    lean,
    clamp: true,
    joined,
  })
  const bevel = hose.radius * 0.1
  return [
    circle(0, -half, -1, false),
    circle(outer - bevel, -half, -1, true),
    circle(outer, bevel - half, 0, true),
    circle(outer, half - bevel, 0, true),
    circle(outer - bevel, half, 1, true),
    circle(0, half, 1, true),
  ]
}
