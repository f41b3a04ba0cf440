import { Vector3 } from 'three'
import type { Label } from './labels'
import type { Stage } from './stage'

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
    for (const { sprite } of this.labels) {
      if (!sprite.visible) continue
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
