import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DynamicDrawUsage,
  type Group,
  Mesh,
  MeshBasicMaterial,
} from 'three'
import { AFTER_PANELS } from './glyphs'

const MM = 0.001
const BEFORE = 0.8
/** mm, of a line. */
const THICK = 2.2

const colour = new Color()

/** Curves of a panel that move on, as ribbons of one mesh. */
export class Graphs {
  private readonly geometry = new BufferGeometry()
  private readonly material = new MeshBasicMaterial({ vertexColors: true, toneMapped: false })
  private readonly places: BufferAttribute
  private readonly colours: BufferAttribute
  private readonly mesh: Mesh

  /** samples: of each curve. */
  constructor(
    group: Group,
    private readonly curves: number,
    private readonly samples: number,
  ) {
    const count = curves * samples * 2
    this.places = new BufferAttribute(new Float32Array(count * 2), 2)
    this.places.setUsage(DynamicDrawUsage)
    this.colours = new BufferAttribute(new Uint8Array(count * 3), 3, true)
    const index: number[] = []
    for (let curve = 0; curve < curves; curve++) {
      for (let i = 0; i < samples - 1; i++) {
        const a = 2 * (curve * samples + i)
        index.push(a, a + 1, a + 2, a + 2, a + 1, a + 3)
      }
    }
    this.geometry.setAttribute('position', this.places)
    this.geometry.setAttribute('color', this.colours)
    this.geometry.setIndex(new BufferAttribute(Uint16Array.from(index), 1))
    this.mesh = new Mesh(this.geometry, this.material)
    this.mesh.renderOrder = AFTER_PANELS
    this.mesh.frustumCulled = false
    this.mesh.position.z = BEFORE * MM
    group.add(this.mesh)
  }

  paint(colours: readonly string[]): void {
    const each = this.samples * 2
    for (let curve = 0; curve < this.curves; curve++) {
      colour.set(colours[curve % colours.length] as string)
      for (let i = 0; i < each; i++) {
        this.colours.setXYZ(curve * each + i, colour.r, colour.g, colour.b)
      }
    }
    this.colours.needsUpdate = true
  }

  /** Set a point of a curve, mm from the panel's middle. */
  set(curve: number, sample: number, x: number, y: number): void {
    const first = 2 * (curve * this.samples + sample)
    this.places.setXY(first, x * MM, (y + THICK / 2) * MM)
    this.places.setXY(first + 1, x * MM, (y - THICK / 2) * MM)
  }

  end(): void {
    this.places.needsUpdate = true
  }

  dispose(): void {
    this.mesh.removeFromParent()
    this.geometry.dispose()
    this.material.dispose()
  }
}
