import { BufferAttribute, BufferGeometry, Mesh, MeshStandardMaterial } from 'three'
import type { Hose } from './hose'

const RIB = 0.55 // of a rib, radii of the hose
const DEEP = 0.13 // of the groove between two ribs, radii
const MOST_RIBS = 110
const COLLAR = 1.34 // of the clamp at an end, radii
const CLAMPED = 1.6 // of its length, radii
const RUBBER = { colour: [0.0105, 0.0105, 0.0115], rough: 0.62 } as const
const CLAMP = { colour: [0.09, 0.092, 0.1], rough: 0.45 } as const

/** How finely hoses are drawn. */
export interface HoseDetail {
  readonly sides: number
  readonly ribbed: boolean
}

interface Circle {
  /** Which ring, with a part of the way to the next one. */
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
