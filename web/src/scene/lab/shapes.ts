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
import type { Label } from '../stage/labels'
import type { Stage } from '../stage/stage'
import type { KindPart } from './instances'

/** The fields of mrlab_msgs/msg/SceneObject that describe the look of an object. */
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

/** Return the geometry that primitives of a kind share, of size 1 about its centre. */
export function primitiveParts({ primitive, color }: Shape): KindPart[] {
  const material = new MeshStandardMaterial({
    roughness: 0.6,
    metalness: 0,
    opacity: color.a,
    transparent: color.a < 1,
  })
  return [{ geometry: geometryOf(primitive.type), material, local: new Matrix4() }]
}

/** Return the transform from a primitive of size 1 to an object's. */
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
    // The axis is y in three, z in ROS.
    case CYLINDER:
      return new CylinderGeometry(1, 1, 1, 36).rotateX(Math.PI / 2)
    case CONE:
      return new ConeGeometry(1, 1, 36).rotateX(Math.PI / 2)
    default:
      return new BoxGeometry(1, 1, 1)
  }
}

const ABOVE = -0.25 // of a label's centre: just above its point, in its own heights
const STEP = 1.08 // from one place above a point to the next
const MOST_STEPS = 6

/** Keeps labels from hiding each other: the later ones move up, seen from the camera. */
export class LabelSpacing {
  private readonly at = new Vector3()
  /** left, top, right, bottom of each label that has its place, CSS pixels */
  private readonly taken: number[] = []

  /** labels: the most important one first. */
  constructor(
    private readonly stage: Stage,
    private readonly labels: readonly Label[],
  ) {}

  /** Place the labels for the picture that is drawn next. */
  place(): void {
    const { camera, canvas } = this.stage
    // a sprite without attenuation is as large as at distance 1
    const pixels = canvas.clientHeight / (2 * Math.tan((camera.fov * Math.PI) / 360))
    this.taken.length = 0
    for (const label of this.labels) {
      const { sprite } = label
      if (!sprite.visible) continue
      label.fit(pixels)
      this.stage.toScreen(sprite.position, this.at)
      const width = sprite.scale.x * pixels
      const height = sprite.scale.y * pixels
      const left = this.at.x - width * sprite.center.x
      for (let step = 0; step < MOST_STEPS; step++) {
        const up = ABOVE - step * STEP
        const bottom = this.at.y + height * up
        sprite.center.y = up
        if (!this.isTaken(left, bottom - height, left + width, bottom)) {
          this.taken.push(left, bottom - height, left + width, bottom)
          break
        }
      }
    }
  }

  private isTaken(left: number, top: number, right: number, bottom: number): boolean {
    const { taken } = this
    for (let i = 0; i < taken.length; i += 4) {
      const apart =
        right <= (taken[i] as number) ||
        left >= (taken[i + 2] as number) ||
        bottom <= (taken[i + 1] as number) ||
        top >= (taken[i + 3] as number)
      if (!apart) return true
    }
    return false
  }
}
