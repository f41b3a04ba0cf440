import { Matrix4, type Object3D, Quaternion, Vector3 } from 'three'
import { type Hand, type Pointer, RayPointer, TouchPointer } from './pointer'
import { PointerLook } from './pointer_look'
import type { Target } from './target'

/** A stick this far out counts. */
const DEAD_ZONE = 0.2

interface Source {
  readonly source: XRInputSource
  readonly ray: RayPointer
  readonly touch: TouchPointer | null
  readonly look: PointerLook
}

/** The controllers and hands of a session as pointers. */
export class XrInputs {
  private readonly sources = new Map<XRInputSource, Source>()
  private readonly matrix = new Matrix4()
  private readonly quaternion = new Quaternion()
  private readonly scale = new Vector3()
  private readonly undo: (() => void)[] = []

  /** targets: what there is to point at now. */
  constructor(
    private readonly session: XRSession,
    private readonly parent: Object3D,
    private readonly targets: readonly Target[],
  ) {
    const sources = () => this.follow()
    session.addEventListener('inputsourceschange', sources)
    this.undo.push(() => session.removeEventListener('inputsourceschange', sources))
    for (const [event, button] of [
      ['select', 'select'],
      ['squeeze', 'grip'],
    ] as const) {
      const start = ({ inputSource }: XRInputSourceEvent) =>
        this.sources.get(inputSource)?.ray.press(button)
      const end = ({ inputSource }: XRInputSourceEvent) =>
        this.sources.get(inputSource)?.ray.release(button)
      session.addEventListener(`${event}start`, start)
      session.addEventListener(`${event}end`, end)
      this.undo.push(
        () => session.removeEventListener(`${event}start`, start),
        () => session.removeEventListener(`${event}end`, end),
      )
    }
    this.follow()
  }

  /** The pointers there are now. */
  *pointers(): Iterable<Pointer> {
    for (const { ray, touch } of this.sources.values()) {
      yield ray
      if (touch !== null) yield touch
    }
  }

  /** Read the poses of a frame and point. now: s. */
  update(frame: XRFrame, space: XRReferenceSpace, now: number): void {
    for (const each of this.sources.values()) {
      const { source, ray, touch, look } = each
      if (touch !== null) {
        const tip = source.hand?.get('index-finger-tip')
        const joint = tip === undefined ? undefined : frame.getJointPose?.(tip, space)
        if (joint != null) setPlace(touch.place, joint.transform.position)
        touch.aim(now, joint != null, this.targets)
      }
      const pose = frame.getPose(source.targetRaySpace, space)
      if (pose !== undefined) {
        this.matrix.fromArray(pose.transform.matrix)
        this.matrix.decompose(ray.ray.origin, this.quaternion, this.scale)
        ray.ray.direction.set(0, 0, -1).applyQuaternion(this.quaternion)
        const grip = source.gripSpace ? frame.getPose(source.gripSpace, space) : undefined
        if (grip === undefined) ray.place.copy(ray.ray.origin)
        else setPlace(ray.place, grip.transform.position)
      }
      const touching = touch?.hovered != null
      ray.aim(now, pose !== undefined, this.targets, touching)
      look.update(ray, pose !== undefined && !touching)
    }
  }

  /** Return the stick of a pointer's controller: x to the right, y towards the user, 0 at rest. */
  stick(pointer: Pointer, axis: 'x' | 'y'): number {
    for (const { source, ray } of this.sources.values()) {
      if (ray !== pointer) continue
      const value = source.gamepad?.axes[axis === 'x' ? 2 : 3] ?? 0
      return Math.abs(value) < DEAD_ZONE ? 0 : value
    }
    return 0
  }

  /** Let a controller be felt; hands have nothing to feel with. ms. */
  pulse(pointer: Pointer, strength: number, duration: number): void {
    for (const { source, ray } of this.sources.values()) {
      if (ray === pointer) source.gamepad?.hapticActuators?.[0]?.pulse(strength, duration)
    }
  }

  dispose(): void {
    for (const undo of this.undo) undo()
    for (const each of [...this.sources.values()]) this.remove(each)
  }

  private follow(): void {
    const now = new Set(this.session.inputSources)
    for (const each of [...this.sources.values()]) if (!now.has(each.source)) this.remove(each)
    for (const source of now) {
      if (this.sources.has(source) || source.targetRayMode === 'gaze') continue
      const hand = source.handedness as Hand
      const touch = source.hand ? new TouchPointer('touch', hand) : null
      const look = new PointerLook(source.hand ? 0.25 : 0.35)
      this.parent.add(look.group)
      this.sources.set(source, { source, ray: new RayPointer('ray', hand), touch, look })
    }
  }

  private remove({ source, ray, touch, look }: Source): void {
    this.sources.delete(source)
    ray.drop()
    touch?.drop()
    look.dispose()
  }
}

function setPlace(into: Vector3, { x, y, z }: DOMPointReadOnly): void {
  into.set(x, y, z)
}
