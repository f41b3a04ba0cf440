import { InstancedMesh, Matrix4, MeshBasicMaterial, SphereGeometry } from 'three'
import type { SceneTheme } from './theme'

const MOST = 64
const DOT = 0.012 // m

/** Where robots touch something. */
export class Contacts {
  readonly mesh: InstancedMesh<SphereGeometry, MeshBasicMaterial>
  private readonly matrix = new Matrix4()

  constructor() {
    const material = new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 })
    this.mesh = new InstancedMesh(new SphereGeometry(DOT, 16, 12), material, MOST)
    this.mesh.count = 0
    this.mesh.renderOrder = 5
    this.mesh.frustumCulled = false
  }

  /** Show contacts at these points of the world, m. */
  set(contacts: readonly { readonly point: { x: number; y: number; z: number } }[]): void {
    this.mesh.count = Math.min(contacts.length, MOST)
    for (let i = 0; i < this.mesh.count; i++) {
      const point = contacts[i]?.point
      if (point !== undefined)
        this.mesh.setMatrixAt(i, this.matrix.makeTranslation(point.x, point.y, point.z))
    }
    this.mesh.instanceMatrix.needsUpdate = true
  }

  setTheme(theme: SceneTheme): void {
    // a grasp touches too: red is for what went wrong
    this.mesh.material.color.set(theme.info)
  }

  dispose(): void {
    this.mesh.removeFromParent()
    this.mesh.geometry.dispose()
    this.mesh.material.dispose()
    this.mesh.dispose()
  }
}
