import {
  BufferGeometry,
  Float32BufferAttribute,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  RingGeometry,
  Vector3,
} from 'three'
import type { RayPointer } from './pointer'

/** Size of the cursor, as a part of the distance to it. */
const CURSOR = 0.008
const FARTHEST = 10

/** A short ray, and a cursor at the hit as feedback. */
export class PointerLook {
  readonly group = new Group()
  private readonly line: Line<BufferGeometry, LineBasicMaterial>
  private readonly cursor: Mesh<RingGeometry, MeshBasicMaterial>
  private readonly ahead = new Vector3()

  /** length: of the ray that is drawn, m. */
  constructor(length: number) {
    const geometry = new BufferGeometry()
    geometry.setAttribute('position', new Float32BufferAttribute([0, 0, 0, 0, 0, -length], 3))
    geometry.setAttribute('color', new Float32BufferAttribute([1, 1, 1, 0.9, 1, 1, 1, 0], 4))
    const look = { transparent: true, depthWrite: false, toneMapped: false }
    this.line = new Line(geometry, new LineBasicMaterial({ ...look, vertexColors: true }))
    this.cursor = new Mesh(
      new RingGeometry(0.55, 1, 32),
      new MeshBasicMaterial({ ...look, color: 0xffffff, depthTest: false }),
    )
    this.cursor.renderOrder = 20
    this.line.frustumCulled = false
    this.group.add(this.line, this.cursor)
  }

  update(pointer: RayPointer, shown: boolean): void {
    this.group.visible = shown
    if (!shown) return
    const { ray, hit } = pointer
    this.line.position.copy(ray.origin)
    this.line.lookAt(this.ahead.copy(ray.origin).sub(ray.direction))
    const meets = pointer.captured !== null || hit.distance < FARTHEST
    this.cursor.visible = meets
    if (!meets) return
    this.cursor.position.copy(hit.point)
    this.cursor.lookAt(ray.origin)
    this.cursor.scale.setScalar(CURSOR * Math.max(hit.distance, 0.3))
    this.cursor.material.color.set(pointer.captured === null ? 0xffffff : 0x6cb6ff)
  }

  dispose(): void {
    this.group.removeFromParent()
    this.line.geometry.dispose()
    this.line.material.dispose()
    this.cursor.geometry.dispose()
    this.cursor.material.dispose()
  }
}
