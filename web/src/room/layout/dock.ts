import {
  MathUtils,
  Mesh,
  type Object3D,
  type PerspectiveCamera,
  PlaneGeometry,
  Vector3,
} from 'three'

/** m before the eyes: nearer than robots, so that nothing of a room hides a panel. */
const BEFORE = 0.5
/** m: a panel is drawn as large as it would be there, or smaller where its robot is far. */
const NEAREST = 1.05
const LARGEST = 3
/** Free margins as parts of the picture's half height: at its top, for the page's own text, and
 * elsewhere. */
const FREE_TOP = 0.2
const FREE = 0.03
/** Largest part of the picture's width and height that a panel takes, of a wide and of a tall
 * picture. */
const WIDE = { width: 0.38, height: 0.86 } as const
const TALL = { width: 0.94, height: 0.42 } as const

/** The edge at which a panel stands in a picture that is taller than wide. */
export type Edge = 'top' | 'bottom'

const local = new Vector3()
const placed = new Vector3()

/** Sides of a panel and of all that hangs from it, m, in its own frame. */
interface Extent {
  left: number
  right: number
  bottom: number
  top: number
}

const extent: Extent = { left: 0, right: 0, bottom: 0, top: 0 }

/** Put a panel flat into the picture of a screen, as near to `at`, in the scene, as it fits whole.
 * Returns whether it moves. */
export function dock(
  panel: Object3D,
  at: Vector3,
  camera: PerspectiveCamera,
  edge: Edge,
): boolean {
  const half = Math.tan(MathUtils.degToRad(camera.fov) / 2)
  const wide = half * camera.aspect
  const tall = wide < half
  extent.left = extent.bottom = Number.POSITIVE_INFINITY
  extent.right = extent.top = Number.NEGATIVE_INFINITY
  measure(panel, 0, 0)
  const { left, right, bottom, top } = extent
  const most = tall ? TALL : WIDE
  local.copy(at).applyMatrix4(camera.matrixWorldInverse)
  const scale = Math.min(
    1 / NEAREST,
    LARGEST / local.length(),
    (most.width * 2 * wide) / (right - left),
    (most.height * 2 * half) / (top - bottom),
  )
  const ahead = local.z < -0.1
  let x = ahead ? local.x / -local.z : Math.sign(local.x) * wide
  let y = ahead ? local.y / -local.z : 0
  if (tall) y = edge === 'top' ? half : -half
  const free = FREE * half
  x = MathUtils.clamp(x, -wide + free - scale * left, wide - free - scale * right)
  y = MathUtils.clamp(y, -half + free - scale * bottom, (1 - FREE_TOP) * half - scale * top)
  placed.set(x, y, -1).multiplyScalar(BEFORE).applyMatrix4(camera.matrixWorld)
  const moves = placed.distanceToSquared(panel.position) > 1e-8 || panel.scale.x !== scale * BEFORE
  panel.position.copy(placed)
  panel.quaternion.setFromRotationMatrix(camera.matrixWorld)
  panel.scale.setScalar(scale * BEFORE)
  return moves
}

/** Widen the extent by the visible children of an object whose middle is at x, y. */
function measure(object: Object3D, x: number, y: number): void {
  for (const child of object.children) {
    if (!child.visible) continue
    const { position, scale } = child
    if (child instanceof Mesh && child.geometry instanceof PlaneGeometry) {
      const { width, height } = child.geometry.parameters
      const across = (width * scale.x) / 2
      const along = (height * scale.y) / 2
      extent.left = Math.min(extent.left, x + position.x - across)
      extent.right = Math.max(extent.right, x + position.x + across)
      extent.bottom = Math.min(extent.bottom, y + position.y - along)
      extent.top = Math.max(extent.top, y + position.y + along)
    }
    measure(child, x + position.x, y + position.y)
  }
}
