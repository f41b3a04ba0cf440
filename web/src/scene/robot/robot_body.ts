import {
  type Bone,
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  type Material,
  Matrix3,
  Matrix4,
  Mesh,
  type MeshDepthMaterial,
  MeshLambertMaterial,
  MeshPhongMaterial,
  MeshStandardMaterial,
  type Object3D,
  Skeleton,
  SkinnedMesh,
  Sphere,
  type Texture,
  Vector3,
} from 'three'
import type { ShadowFit } from '../stage/shadow_fit'

/** Of a mesh that says nothing of its surface. */
const ROUGH = 0.6
/** Most links of a body: their numbers are bytes. */
const MOST_LINKS = 255

const point = new Vector3()

/** The links as bones; of a robot at rest they are uploaded once. */
class Links extends Skeleton {
  moved = true

  override update(): void {
    if (!this.moved) return
    this.moved = false
    super.update()
  }
}

/** A mesh of a link that can be drawn as a part of the body. */
export interface Part {
  readonly mesh: Mesh
  readonly link: Object3D
  /** Its vertices in the link's frame. */
  readonly inLink: Matrix4
  /** Bones of a mesh that bends, which its `skinIndex` names, in place of the link. */
  readonly bones?: readonly Object3D[]
}

/** All links of a robot as one mesh, each link a bone: one draw call in place of one a link and
 * material. A textured or transparent part stays a mesh of its own. */
export class RobotBody extends SkinnedMesh<BufferGeometry, Material | Material[]> {
  /** The box about the part of each link, in the link's frame. */
  readonly boxes: readonly Box3[]
  private readonly balls: readonly Sphere[]
  private readonly ranges = new Map<string, { readonly start: number; readonly count: number }>()

  private constructor(
    parts: readonly Part[],
    readonly own: MeshStandardMaterial,
    shadow: MeshDepthMaterial,
  ) {
    const links = [...new Set(parts.flatMap(({ link, bones }) => bones ?? [link]))]
    const ordered = links.flatMap((link) =>
      parts.filter((part) => (part.bones?.[0] ?? part.link) === link),
    )
    const geometry = geometryOf(ordered, links, own.map)
    super(geometry, own)
    this.name = 'body'
    this.boxes = boxesOf(geometry, links.length)
    this.balls = this.boxes.map((box) => box.getBoundingSphere(new Sphere()))
    let start = 0
    for (const { mesh, link } of ordered) {
      const count = mesh.geometry.index?.count ?? mesh.geometry.getAttribute('position').count
      const before = this.ranges.get(link.name)
      this.ranges.set(link.name, {
        start: before?.start ?? start,
        count: (before?.count ?? 0) + count,
      })
      start += count
    }
    // A skeleton reads only the world matrix of a bone, which a link has.
    this.bind(
      new Links(
        links as Bone[],
        links.map(() => new Matrix4()),
      ),
      new Matrix4(),
    )
    // A material of its own: three recompiles a shadow's program between meshes with and without
    // bones.
    this.customDepthMaterial = shadow
    // where its links are now is known to the processor of vertices alone
    this.frustumCulled = false
  }

  /** Return the parts as one body; null: there is none. own: a material made by bodyMaterial. */
  static of(
    parts: readonly Part[],
    own: MeshStandardMaterial,
    shadow: MeshDepthMaterial,
  ): RobotBody | null {
    const bones = new Set(parts.flatMap((part) => part.bones ?? [part.link]))
    if (bones.size === 0 || bones.size > MOST_LINKS) return null
    return new RobotBody(parts, own, shadow)
  }

  /** Its links have moved. */
  follow(): void {
    ;(this.skeleton as Links).moved = true
  }

  /** Widen a shadow to the present places of its links. */
  castInto(shadow: ShadowFit): void {
    const { balls, skeleton } = this
    for (let i = 0; i < balls.length; i++) {
      const { center, radius } = balls[i] as Sphere
      if (radius < 0) continue
      point.copy(center).applyMatrix4((skeleton.bones[i] as Bone).matrixWorld)
      shadow.take(point, radius)
    }
  }

  /** Return an upper bound of its height, m in the scene, whose y is up. */
  top(): number {
    const { boxes, skeleton } = this
    let highest = Number.NEGATIVE_INFINITY
    for (let i = 0; i < boxes.length; i++) {
      const { min, max } = boxes[i] as Box3
      if (max.x < min.x) continue
      const { elements } = (skeleton.bones[i] as Bone).matrixWorld
      const x = elements[1] as number
      const y = elements[5] as number
      const z = elements[9] as number
      const across = x * (x > 0 ? max.x : min.x) + y * (y > 0 ? max.y : min.y)
      const here = (elements[13] as number) + across + z * (z > 0 ? max.z : min.z)
      highest = Math.max(highest, here)
    }
    return highest
  }

  /** Draw it with a material; `failing` names a link that gets another one. */
  paint(material: Material, failing: string, marked: Material): void {
    const { geometry } = this
    geometry.clearGroups()
    const range = failing === '' ? undefined : this.ranges.get(failing)
    if (range === undefined) {
      this.material = material
      return
    }
    const { start, count } = range
    const end = start + count
    const all = geometry.index?.count ?? 0
    if (start > 0) geometry.addGroup(0, start, 0)
    geometry.addGroup(start, count, 1)
    if (end < all) geometry.addGroup(end, all - end, 0)
    this.material = [material, marked]
  }

  /** Free it, and take it out of the picture. */
  release(): void {
    this.removeFromParent()
    this.geometry.dispose()
    this.skeleton.dispose()
  }
}

/** Return the meshes below a robot that a body can take in. linkOf: the link of a mesh. */
export function partsBelow(root: Object3D, linkOf: (mesh: Mesh) => Object3D | null): Part[] {
  root.updateWorldMatrix(true, true)
  const parts: Part[] = []
  root.traverse((node) => {
    if (!(node instanceof Mesh) || !fits(node)) return
    const link = linkOf(node)
    if (link === null) return
    const inLink = link.matrixWorld.clone().invert().multiply(node.matrixWorld)
    parts.push({ mesh: node, link, inLink })
  })
  return parts
}

/** Take the meshes of parts out of their links, with the nodes that are empty then. */
export function detach(parts: readonly Part[]): void {
  for (const { mesh, link } of parts) {
    let empty: Object3D | null = mesh
    while (empty !== null && empty !== link && empty.children.length === 0) {
      const above: Object3D | null = empty.parent
      empty.removeFromParent()
      empty = above
    }
  }
}

/** Return the picture of the drawings on parts; null: there are none. */
export function atlasOf(parts: readonly Part[]): Texture | null {
  for (const { mesh } of parts) {
    const found = plain(mesh.material as Material | Material[])
    if (found !== null && found.map !== null) return found.map
  }
  return null
}

/** Return the material of bodies: colour, roughness and metalness are in the vertices, drawings in
 * an atlas, which is white elsewhere. */
export function bodyMaterial(atlas: Texture | null): MeshStandardMaterial {
  const material = new MeshStandardMaterial({
    vertexColors: true,
    roughness: 1,
    metalness: 1,
    map: atlas,
  })
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace(
        '#include <common>',
        '#include <common>\nattribute vec2 finish;\nvarying vec2 vFinish;',
      )
      .replace('#include <begin_vertex>', '#include <begin_vertex>\nvFinish = finish;')
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nvarying vec2 vFinish;')
      .replace(
        '#include <roughnessmap_fragment>',
        '#include <roughnessmap_fragment>\nroughnessFactor *= vFinish.x;',
      )
      .replace(
        '#include <metalnessmap_fragment>',
        '#include <metalnessmap_fragment>\nmetalnessFactor *= vFinish.y;',
      )
  }
  return material
}

type Plain = MeshStandardMaterial | MeshPhongMaterial | MeshLambertMaterial

function plain(material: Material | Material[]): Plain | null {
  const kinds = [MeshStandardMaterial, MeshPhongMaterial, MeshLambertMaterial]
  const found = kinds.find((kind) => material instanceof kind)
  return found === undefined ? null : (material as Plain)
}

function fits({ material, geometry }: Mesh): boolean {
  const found = plain(material as Material | Material[])
  if (found === null || found.transparent || found.opacity < 1) return false
  // other textures than an atlas are not for vertices that have their colour
  if (found.map !== null && found.map.userData.white === undefined) return false
  const painted = found.vertexColors && geometry.getAttribute('color') !== undefined
  if (painted && geometry.getAttribute('finish') === undefined) return false
  return geometry.getAttribute('position') !== undefined
}

/** Return the parts as one geometry: colour and finish in the vertices, `links` as bones. */
export function geometryOf(
  parts: readonly Part[],
  links: readonly Object3D[],
  atlas: Texture | null,
): BufferGeometry {
  let vertices = 0
  let corners = 0
  for (const { mesh } of parts) {
    if (mesh.geometry.getAttribute('normal') === undefined) mesh.geometry.computeVertexNormals()
    const count = mesh.geometry.getAttribute('position').count
    vertices += count
    corners += mesh.geometry.index?.count ?? count
  }
  const position = new Float32Array(vertices * 3)
  const normal = new Float32Array(vertices * 3)
  const colour = new Float32Array(vertices * 3)
  const finish = new Uint8Array(vertices * 2)
  const bone = new Uint8Array(vertices * 4)
  const weight = new Uint8Array(vertices * 4)
  const drawn = new Uint16Array(atlas === null ? 0 : vertices * 2)
  const white = (atlas?.userData.white ?? [0, 0]) as readonly [number, number]
  const index = vertices > 65535 ? new Uint32Array(corners) : new Uint16Array(corners)
  let at = 0
  let corner = 0
  const turn = new Matrix3()
  for (const { mesh, link, inLink, bones } of parts) {
    const { geometry } = mesh
    const first = links.indexOf(bones?.[0] ?? link)
    const painted = geometry.getAttribute('finish')
    const places = geometry.getAttribute('position')
    const normals = geometry.getAttribute('normal')
    const material = plain(mesh.material as Material | Material[])
    const look = material?.color ?? new Color(0xb9bfc7)
    const standard = material instanceof MeshStandardMaterial ? material : null
    const onAtlas = material?.map === null ? undefined : geometry.getAttribute('uv')
    turn.getNormalMatrix(inLink)
    for (let i = 0; i < places.count; i++) {
      const v = at + i
      point
        .fromBufferAttribute(places, i)
        .applyMatrix4(inLink)
        .toArray(position, v * 3)
      point
        .fromBufferAttribute(normals, i)
        .applyNormalMatrix(turn)
        .toArray(normal, v * 3)
      if (painted === undefined) {
        look.toArray(colour, v * 3)
        finish[v * 2] = 255 * (standard?.roughness ?? ROUGH)
        finish[v * 2 + 1] = 255 * (standard?.metalness ?? 0)
      } else {
        point.fromBufferAttribute(geometry.getAttribute('color'), i).toArray(colour, v * 3)
        finish[v * 2] = Math.round(255 * painted.getX(i))
        finish[v * 2 + 1] = Math.round(255 * painted.getY(i))
      }
      if (atlas !== null) {
        drawn[v * 2] = Math.round(65535 * (onAtlas?.getX(i) ?? white[0]))
        drawn[v * 2 + 1] = Math.round(65535 * (onAtlas?.getY(i) ?? white[1]))
      }
      if (bones === undefined) {
        bone[v * 4] = first
        weight[v * 4] = 255
      } else {
        const named = geometry.getAttribute('skinIndex')
        const shares = geometry.getAttribute('skinWeight')
        for (let k = 0; k < 2; k++) {
          bone[v * 4 + k] = first + named.getComponent(i, k)
          weight[v * 4 + k] = Math.round(255 * shares.getComponent(i, k))
        }
      }
    }
    const { index: own } = geometry
    const count = own?.count ?? places.count
    // A mirrored part shows its other side.
    const mirrored = inLink.determinant() < 0
    for (let i = 0; i < count; i++) {
      const place = mirrored ? i - (i % 3) + 2 - (i % 3) : i
      index[corner + i] = at + (own?.getX(place) ?? place)
    }
    corner += count
    at += places.count
  }
  const geometry = new BufferGeometry()
  geometry.setAttribute('position', new BufferAttribute(position, 3))
  geometry.setAttribute('normal', new BufferAttribute(normal, 3))
  geometry.setAttribute('color', new BufferAttribute(colour, 3))
  geometry.setAttribute('finish', new BufferAttribute(finish, 2, true))
  geometry.setAttribute('skinIndex', new BufferAttribute(bone, 4))
  geometry.setAttribute('skinWeight', new BufferAttribute(weight, 4, true))
  if (atlas !== null) geometry.setAttribute('uv', new BufferAttribute(drawn, 2, true))
  geometry.setIndex(new BufferAttribute(index, 1))
  return geometry
}

function boxesOf(geometry: BufferGeometry, links: number): Box3[] {
  const boxes = Array.from({ length: links }, () => new Box3())
  const places = geometry.getAttribute('position')
  const bones = geometry.getAttribute('skinIndex')
  for (let i = 0; i < places.count; i++) {
    boxes[bones.getX(i)]?.expandByPoint(point.fromBufferAttribute(places, i))
  }
  return boxes
}
