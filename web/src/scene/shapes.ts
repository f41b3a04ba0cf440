import {
  BoxGeometry,
  type BufferGeometry,
  Color,
  ConeGeometry,
  CylinderGeometry,
  Matrix4,
  MeshStandardMaterial,
  SphereGeometry,
  SRGBColorSpace,
  Vector3,
} from 'three'
import type { KindPart } from './instances'

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

/** Return the kind of which an object's primitive is an instance: its shape and how dense it is. */
export function kindOf({ primitive: { type }, color: { a } }: Shape): string {
  const known = type === SPHERE || type === CYLINDER || type === CONE ? type : BOX
  return a < 1 ? `primitive ${known} ${a.toFixed(3)}` : `primitive ${known}`
}

/** Return what the primitives of a kind share: one of size 1 about its centre. */
export function primitiveParts({ primitive, color }: Shape): KindPart[] {
  const material = new MeshStandardMaterial({
    roughness: 0.6,
    metalness: 0,
    opacity: color.a,
    transparent: color.a < 1,
  })
  return [{ geometry: geometryOf(primitive.type), material, local: new Matrix4() }]
}

/** Return what makes an object's primitive of one of size 1. */
export function scaleOf({ primitive, size }: Shape): Vector3 {
  const [a = 0, b = 0, c = 0] = Array.from(primitive.dimensions)
  switch (primitive.type) {
    case BOX:
      return new Vector3(a, b, c)
    case SPHERE:
      return new Vector3(a, a, a)
    // height, radius
    case CYLINDER:
    case CONE:
      return new Vector3(b, b, a)
    default:
      return new Vector3(size.x, size.y, size.z)
  }
}

export function colourOf({ color: { r, g, b } }: Shape): Color {
  return new Color().setRGB(r, g, b, SRGBColorSpace)
}

function geometryOf(type: number): BufferGeometry {
  switch (type) {
    case SPHERE:
      return new SphereGeometry(1, 32, 20)
    // three's stand along y, ROS's along z
    case CYLINDER:
      return new CylinderGeometry(1, 1, 1, 36).rotateX(Math.PI / 2)
    case CONE:
      return new ConeGeometry(1, 1, 36).rotateX(Math.PI / 2)
    default:
      return new BoxGeometry(1, 1, 1)
  }
}
