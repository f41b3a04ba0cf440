import {
  type BufferGeometry,
  type Color,
  InstancedMesh,
  type Material,
  Matrix4,
  Mesh,
  MeshDepthMaterial,
  type Object3D,
  type Vector3,
} from 'three'
import { geometryOf, partsBelow } from '../robot/robot_body'

const FIRST = 16 // instances for which there is room at first

const matrix = new Matrix4()

/** A mesh of a kind, in the frame of the instance. */
export interface KindPart {
  readonly geometry: BufferGeometry
  readonly material: Material
  readonly local: Matrix4
}

/** One thing that is drawn as an instance of a kind: `frame` says where. */
export interface Instance {
  readonly kind: string
  readonly frame: Object3D
  readonly scale: Vector3
  /** Multiplies the kind's own; null: it stays. */
  readonly colour: Color | null
}

interface Kind {
  readonly parts: readonly KindPart[]
  readonly meshes: InstancedMesh[]
  readonly instances: Instance[]
  /** Of each instance, 16 numbers; those of the picture before. */
  drawn: Float32Array
  fresh: boolean
}

/** Things of which many are alike: those of one kind are one draw call a material. */
export class Instances {
  private readonly kinds = new Map<string, Kind>()
  private readonly shadow = new MeshDepthMaterial()

  /** parent: of the meshes, and of the frames of instances. */
  constructor(private readonly parent: Object3D) {}

  has(kind: string): boolean {
    return this.kinds.has(kind)
  }

  /** Set the meshes of a kind. The caller owns geometries and materials. */
  define(kind: string, parts: readonly KindPart[]): void {
    const made = { parts, meshes: [], instances: [], drawn: new Float32Array(), fresh: true }
    this.kinds.set(kind, made)
  }

  /** Draw one more of a kind that is defined. */
  add(instance: Instance): void {
    const kind = this.kinds.get(instance.kind)
    if (kind === undefined) throw new RangeError(`the kind '${instance.kind}' is not defined`)
    kind.instances.push(instance)
    kind.fresh = true
  }

  remove(instance: Instance): void {
    const kind = this.kinds.get(instance.kind)
    const index = kind?.instances.indexOf(instance) ?? -1
    if (kind === undefined || index < 0) return
    kind.instances.splice(index, 1)
    kind.fresh = true
  }

  /** Before each picture: put each where its frame is. */
  update(): void {
    for (const kind of this.kinds.values()) {
      if (kind.fresh) this.fill(kind)
      this.move(kind)
    }
  }

  dispose(): void {
    for (const kind of this.kinds.values()) this.clear(kind)
    this.kinds.clear()
    this.shadow.dispose()
  }

  /** Make room for the instances there are, and give them their colours. */
  private fill(kind: Kind): void {
    const { instances } = kind
    const count = instances.length
    const room = kind.meshes[0]?.instanceMatrix.count ?? 0
    if (count > room) {
      this.clear(kind)
      const capacity = Math.max(FIRST, 2 * count)
      for (const { geometry, material } of kind.parts) {
        const mesh = new InstancedMesh(geometry, material, capacity)
        mesh.frustumCulled = false
        mesh.castShadow = mesh.receiveShadow = true
        mesh.customDepthMaterial = this.shadow
        kind.meshes.push(mesh)
        this.parent.add(mesh)
      }
      kind.drawn = new Float32Array(capacity * 16)
    }
    kind.drawn.fill(Number.NaN)
    for (const mesh of kind.meshes) {
      mesh.count = count
      mesh.visible = count > 0
      instances.forEach(({ colour }, i) => {
        if (colour !== null) mesh.setColorAt(i, colour)
      })
      if (mesh.instanceColor !== null) mesh.instanceColor.needsUpdate = true
    }
    kind.fresh = false
  }

  private move({ parts, meshes, instances, drawn }: Kind): void {
    let moved = false
    for (let i = 0; i < instances.length; i++) {
      const { frame, scale } = instances[i] as Instance
      matrix.compose(frame.position, frame.quaternion, scale)
      if (same(matrix.elements, drawn, i * 16)) continue
      moved = true
      drawn.set(matrix.elements, i * 16)
      for (let part = 0; part < parts.length; part++) {
        const { local } = parts[part] as KindPart
        const { array } = (meshes[part] as InstancedMesh).instanceMatrix
        placed.multiplyMatrices(matrix, local).toArray(array, i * 16)
      }
    }
    if (!moved) return
    for (const mesh of meshes) mesh.instanceMatrix.needsUpdate = true
  }

  private clear(kind: Kind): void {
    for (const mesh of kind.meshes) {
      mesh.removeFromParent()
      mesh.dispose()
    }
    kind.meshes.length = 0
  }
}

const placed = new Matrix4()

function same(elements: readonly number[], drawn: Float32Array, from: number): boolean {
  for (let i = 0; i < 16; i++) {
    if (Math.fround(elements[i] as number) !== drawn[from + i]) return false
  }
  return true
}

/** Return what is below an object as the parts of a kind: its opaque meshes as one, which is drawn
 * with `own`, made by bodyMaterial; null: one of them cannot be. */
export function partsOf(object: Object3D, own: Material): KindPart[] | null {
  const opaque = partsBelow(object, () => object)
  const merged = new Set(opaque.map(({ mesh }) => mesh))
  const inverse = object.matrixWorld.clone().invert()
  const parts: KindPart[] = []
  if (opaque.length > 0) {
    const geometry = geometryOf(opaque, [object], null)
    parts.push({ geometry, material: own, local: new Matrix4() })
  }
  let fits = true
  object.traverse((node) => {
    if (!(node instanceof Mesh) || merged.has(node)) return
    if (Array.isArray(node.material)) fits = false
    else {
      const local = inverse.clone().multiply(node.matrixWorld)
      parts.push({ geometry: node.geometry, material: node.material as Material, local })
    }
  })
  return fits && parts.length > 0 ? parts : null
}
