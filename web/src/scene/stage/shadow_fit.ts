import { type DirectionalLight, Matrix4, Vector3 } from 'three'

/** m by which the square of a shadow grows: its edges would shimmer if it followed each motion. */
const STEP = 0.5
/** m by which a place may move and is still the same one. */
const SAME = 0.01
/** m from the sun to the nearest that casts a shadow. */
const BEFORE = 0.5
/** m behind the last that casts one, for the floor on which it falls. */
const BEYOND = 4
/** m, against surfaces that shade themselves. */
const BIAS = 0.0024
/** Texels, for the same: how far a surface is moved along its normal. */
const TEXELS = 5

const ball = new Vector3()

/** Fits the shadow of a sun to the meshes that cast it: a square about a place, grown to contain
 * them. It shrinks when it is put about another place. */
export class ShadowFit {
  /** The scene's frame in that of the light, whose z points to the sun. */
  private readonly inLight = new Matrix4()
  private readonly towards: Vector3
  private readonly middle = new Vector3(Number.NaN, 0, 0)
  private half = 0
  // from the middle, in the frame of the light
  private readonly low = new Vector3()
  private readonly high = new Vector3()
  private stale = true

  /** towards: the sun, a direction of the scene. */
  constructor(
    private readonly sun: DirectionalLight,
    towards: Vector3,
  ) {
    this.towards = towards.clone().normalize()
    this.inLight.lookAt(this.towards, new Vector3(), new Vector3(0, 1, 0)).transpose()
  }

  /** Cover a square about a place of the scene. half: of its side, m. */
  about(middle: Vector3, half: number): void {
    if (half === this.half && this.middle.distanceTo(middle) < SAME) return
    this.middle.copy(middle)
    this.half = half
    this.low.setScalar(-half)
    this.high.setScalar(half)
    this.stale = true
  }

  /** Cover a ball of the scene, too. radius: m. */
  take(centre: Vector3, radius: number): void {
    const { low, high } = this
    ball.subVectors(centre, this.middle).applyMatrix4(this.inLight)
    for (let axis = 0; axis < 3; axis++) {
      const at = ball.getComponent(axis)
      if (at - radius < low.getComponent(axis)) {
        low.setComponent(axis, Math.floor((at - radius) / STEP) * STEP)
        this.stale = true
      }
      if (at + radius > high.getComponent(axis)) {
        high.setComponent(axis, Math.ceil((at + radius) / STEP) * STEP)
        this.stale = true
      }
    }
  }

  /** Set the sun to all that was taken in. */
  apply(): void {
    if (!this.stale) return
    this.stale = false
    const { sun, low, high, towards, middle } = this
    const { camera, mapSize } = sun.shadow
    camera.left = low.x
    camera.right = high.x
    camera.bottom = low.y
    camera.top = high.y
    camera.near = BEFORE
    camera.far = BEFORE + high.z - low.z + BEYOND
    camera.updateProjectionMatrix()
    const texel = Math.max((high.x - low.x) / mapSize.x, (high.y - low.y) / mapSize.y)
    sun.shadow.bias = -BIAS / (camera.far - camera.near)
    sun.shadow.normalBias = TEXELS * texel
    sun.target.position.copy(middle)
    sun.position
      .copy(towards)
      .multiplyScalar(high.z + BEFORE)
      .add(middle)
    sun.target.updateMatrixWorld()
  }
}
