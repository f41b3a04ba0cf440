import { Vector2 } from 'three'
import type { RoomStage } from '../scene/stage'
import { RayPointer, type Target } from './pointer'

/** The mouse, or a finger on a touch screen, as a pointer into the room. */
export class Mouse {
  readonly pointer = new RayPointer('mouse', 'none')
  private readonly at = new Vector2(2, 2)
  private readonly undo: (() => void)[] = []

  constructor(
    private readonly stage: RoomStage,
    private readonly targets: readonly Target[],
  ) {
    const { canvas } = stage
    const move = (event: PointerEvent) => this.move(event)
    const down = (event: PointerEvent) => {
      if (event.button !== 0 || stage.renderer.xr.isPresenting) return
      this.move(event)
      this.update(performance.now() / 1000)
      this.pointer.press('select')
      // A drag of a target does not turn the view.
      stage.controls.enabled = this.pointer.captured === null
      if (!stage.controls.enabled) canvas.setPointerCapture(event.pointerId)
    }
    const up = () => {
      this.pointer.release('select')
      stage.controls.enabled = true
    }
    const out = () => {
      if (this.pointer.captured === null) this.at.set(2, 2)
    }
    const events = { pointermove: move, pointerdown: down, pointerup: up, pointercancel: up }
    for (const [name, listener] of Object.entries(events)) {
      canvas.addEventListener(name, listener as EventListener, { capture: true })
      this.undo.push(() => canvas.removeEventListener(name, listener as EventListener, true))
    }
    canvas.addEventListener('pointerleave', out)
    this.undo.push(() => canvas.removeEventListener('pointerleave', out))
  }

  /** Before each picture without a headset. now: s. */
  update(now: number): void {
    const { camera, canvas } = this.stage
    const { ray, place } = this.pointer
    ray.origin.setFromMatrixPosition(camera.matrixWorld)
    ray.direction.set(this.at.x, this.at.y, 0.5).unproject(camera).sub(ray.origin).normalize()
    place.copy(ray.origin)
    const inside = Math.abs(this.at.x) <= 1 && Math.abs(this.at.y) <= 1
    this.pointer.aim(now, inside || this.pointer.captured !== null, this.targets)
    canvas.style.cursor = this.pointer.hovered === null ? 'grab' : 'pointer'
  }

  dispose(): void {
    for (const undo of this.undo) undo()
    this.pointer.drop()
  }

  private move({ clientX, clientY }: PointerEvent): void {
    this.stage.invalidate()
    const box = this.stage.canvas.getBoundingClientRect()
    this.at.set(
      ((clientX - box.left) / box.width) * 2 - 1,
      1 - ((clientY - box.top) / box.height) * 2,
    )
  }
}
