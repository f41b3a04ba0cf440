import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineLoop,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Shape,
  ShapeGeometry,
} from 'three'
import { type Pose, place } from '../stage/pose'
import type { SceneTheme } from '../stage/theme'

const CREASE = 25 // deg, from which an edge of a mesh is drawn
// A wall before the robots would hide them, and the grid represents the floor.
const OUTLINES = new Set(['floor', 'ceiling'])
const FAINT = new Set(['wall', 'door', 'window', 'global_mesh'])

/** A surface of the room: the fields of mrlab_msgs/msg/Surface. */
export interface ShownSurface {
  readonly name: string
  /** Who measured it; empty: the lab's own. */
  readonly source?: string
  readonly label: string
  readonly pose: Pose
  /** Of a plane its outline, m. */
  readonly vertices: readonly { readonly x: number; readonly y: number; readonly z: number }[]
  /** Three vertices each; empty: a plane. */
  readonly triangles: ArrayLike<number>
}

/** The surfaces of the room, drawn so that things before and behind them stay visible. */
export class LabSurfaces {
  readonly group = new Group()
  private readonly solid = material(0.16)
  private readonly faint = material(0.05)
  private readonly edge = new LineBasicMaterial({ transparent: true, opacity: 0.75 })

  /** Take over the surfaces that there are. */
  set(surfaces: readonly ShownSurface[]): void {
    this.clear()
    for (const surface of surfaces) {
      if (surface.vertices.length < 3) continue
      const part = surface.triangles.length > 0 ? this.mesh(surface) : this.plane(surface)
      part.name = surface.name
      place(part, surface.pose)
      this.group.add(part)
    }
  }

  /** Tables and the like: walls and the room's mesh are seen through. */
  get met(): Object3D[] {
    const met: Object3D[] = []
    this.group.traverse((node) => {
      if (node instanceof Mesh && node.material === this.solid) met.push(node)
    })
    return met
  }

  setTheme(theme: SceneTheme): void {
    for (const each of [this.solid, this.faint, this.edge]) each.color.set(theme.second)
  }

  dispose(): void {
    this.clear()
    this.group.removeFromParent()
    for (const each of [this.solid, this.faint, this.edge]) each.dispose()
  }

  private clear(): void {
    this.group.traverse((node) => {
      if (node instanceof Mesh || node instanceof LineSegments) node.geometry.dispose()
    })
    this.group.clear()
  }

  private plane({ label, vertices }: ShownSurface): Group {
    const part = new Group()
    const outline = new Shape()
    for (const [i, { x, y }] of vertices.entries()) {
      if (i === 0) outline.moveTo(x, y)
      else outline.lineTo(x, y)
    }
    if (!OUTLINES.has(label)) part.add(new Mesh(new ShapeGeometry(outline), this.fill(label)))
    const line = new BufferGeometry().setFromPoints([...outline.getPoints()])
    part.add(new LineLoop(line, this.edge))
    return part
  }

  private mesh({ label, vertices, triangles }: ShownSurface): Group {
    const geometry = new BufferGeometry()
    const places = new Float32Array(vertices.length * 3)
    for (const [i, { x, y, z }] of vertices.entries()) places.set([x, y, z], i * 3)
    geometry.setAttribute('position', new BufferAttribute(places, 3))
    geometry.setIndex(new BufferAttribute(Uint32Array.from(triangles), 1))
    const part = new Group()
    part.add(new Mesh(geometry, this.fill(label)))
    part.add(new LineSegments(new EdgesGeometry(geometry, CREASE), this.edge))
    return part
  }

  private fill(label: string): MeshBasicMaterial {
    return FAINT.has(label) ? this.faint : this.solid
  }
}

function material(opacity: number): MeshBasicMaterial {
  return new MeshBasicMaterial({ transparent: true, opacity, side: DoubleSide, depthWrite: false })
}
