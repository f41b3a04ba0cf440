import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  type ShadowMaterial,
  Shape,
  ShapeGeometry,
} from 'three'
import type { ShownSurface } from '../../scene/lab/surfaces'
import { place } from '../../scene/stage/pose'

/** Drawn first: what is behind a real thing finds its depth there. */
const FIRST = -20
/** The floor has its own shadow, and hides nothing that stands in the room. */
const FLOORS = new Set(['floor', 'ceiling'])

/** The real surfaces of a visible room: invisible, they hide what is behind them and take the
 * shadows of robots. */
export class Grounds {
  readonly group = new Group()
  private readonly hiding = new MeshBasicMaterial({
    colorWrite: false,
    side: DoubleSide,
    // A base that stands on the surface is not cut by it.
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 16,
  })
  private hides = true
  private geometries: BufferGeometry[] = []
  private readonly hiders = new Group()

  /** shadow: the look of a shadow on the floor. */
  constructor(private readonly shadow: ShadowMaterial) {
    this.group.add(this.hiders)
  }

  /** Hide what is behind real things, or show it. */
  hide(on: boolean): void {
    this.hides = on
    this.hiders.visible = on
  }

  /** Take over the surfaces of the room. */
  set(surfaces: readonly ShownSurface[]): void {
    this.clear()
    for (const surface of surfaces) {
      if (surface.vertices.length < 3 || FLOORS.has(surface.label)) continue
      const geometry = shapeOf(surface)
      this.geometries.push(geometry)
      const hider = new Mesh(geometry, this.hiding)
      hider.renderOrder = FIRST
      place(hider, surface.pose)
      this.hiders.add(hider)
      const { x, y } = surface.pose.orientation
      const up = 1 - 2 * (x * x + y * y)
      if (surface.triangles.length > 0 || Math.abs(up) < LEVEL) continue
      const lit = new Mesh(geometry, this.shadow)
      lit.receiveShadow = true
      place(lit, surface.pose)
      this.group.add(lit)
    }
    this.hiders.visible = this.hides
  }

  dispose(): void {
    this.clear()
    this.group.removeFromParent()
    this.hiding.dispose()
  }

  private clear(): void {
    for (const geometry of this.geometries) geometry.dispose()
    this.geometries = []
    this.hiders.clear()
    this.group.clear()
    this.group.add(this.hiders)
  }
}

const LEVEL = 0.985

function shapeOf({ vertices, triangles }: ShownSurface): BufferGeometry {
  if (triangles.length === 0) {
    const outline = new Shape()
    vertices.forEach(({ x, y }, i) => {
      if (i === 0) outline.moveTo(x, y)
      else outline.lineTo(x, y)
    })
    return new ShapeGeometry(outline)
  }
  const geometry = new BufferGeometry()
  const places = new Float32Array(vertices.flatMap(({ x, y, z }) => [x, y, z]))
  geometry.setAttribute('position', new BufferAttribute(places, 3))
  geometry.setIndex(new BufferAttribute(Uint32Array.from(triangles), 1))
  return geometry
}
