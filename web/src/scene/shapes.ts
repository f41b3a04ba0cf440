import {
  BoxGeometry,
  type BufferGeometry,
  Color,
  ConeGeometry,
  CylinderGeometry,
  Mesh,
  MeshStandardMaterial,
  SphereGeometry,
  SRGBColorSpace,
} from 'three'

/** What an object looks like: the fields of mrlab_msgs/msg/SceneObject that say so. */
export interface Shape {
  readonly size: { readonly x: number; readonly y: number; readonly z: number }
  readonly color: {
    readonly r: number
    readonly g: number
    readonly b: number
    readonly a: number
  }
  readonly mesh: string
  /** type as in shape_msgs/msg/SolidPrimitive; 0: none */
  readonly primitive: { readonly type: number; readonly dimensions: ArrayLike<number> }
}

const BOX = 1
const SPHERE = 2
const CYLINDER = 3
const CONE = 4

/** Return the primitive of an object, or the box about it where it has none. */
export function primitiveOf(shape: Shape): Mesh<BufferGeometry, MeshStandardMaterial> {
  const { r, g, b, a } = shape.color
  const material = new MeshStandardMaterial({
    color: new Color().setRGB(r, g, b, SRGBColorSpace),
    roughness: 0.6,
    metalness: 0,
    opacity: a,
    transparent: a < 1,
  })
  const mesh = new Mesh(geometryOf(shape), material)
  mesh.castShadow = true
  mesh.receiveShadow = true
  return mesh
}

function geometryOf({ primitive, size }: Shape): BufferGeometry {
  const [a = 0, b = 0, c = 0] = Array.from(primitive.dimensions)
  switch (primitive.type) {
    case BOX:
      return new BoxGeometry(a, b, c)
    case SPHERE:
      return new SphereGeometry(a, 40, 24)
    // height, radius; three's stand along y, ROS's along z
    case CYLINDER:
      return new CylinderGeometry(b, b, a, 40).rotateX(Math.PI / 2)
    case CONE:
      return new ConeGeometry(b, a, 40).rotateX(Math.PI / 2)
    default:
      return new BoxGeometry(size.x, size.y, size.z)
  }
}
