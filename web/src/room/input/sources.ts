import { Matrix4, type Object3D, Quaternion, Vector3 } from 'three'
import { InputModel } from './models'
import { type Hand, type Pointer, RayPointer, type Target, TouchPointer } from './pointer'
import { PointerLook } from './pointer_look'

/** Least deflection of a stick. */
const DEAD_ZONE = 0.2

interface Source {
  readonly source: XRInputSource
  /** True once its place was measured: a device that only guesses is believed. */
  measured: boolean
  readonly ray: RayPointer
  readonly touch: TouchPointer
  readonly look: PointerLook
  /** null: real hands are seen as they are. */
  readonly model: InputModel | null
}

/** A source in a frame. */
interface Tracked {
  frame: XRFrame
  space: XRReferenceSpace
  source: XRInputSource
  pose: XRPose | undefined
}

/** The controllers and hands of a session as pointers. */
export class XrInputs {
  private readonly sources = new Map<XRInputSource, Source>()
  private readonly matrix = new Matrix4()
  private readonly quaternion = new Quaternion()
  private readonly scale = new Vector3()
  private readonly thumb = new Vector3()
  /** Reused for each source of each frame. */
  private readonly at = {} as Tracked
  private readonly finger = new Vector3()
  private readonly undo: (() => void)[] = []

  /** targets: the present targets. marked: takes the place, in the floor space, of a press on no
   * target; returns whether the press is used up. */
  constructor(
    private readonly session: XRSession,
    private readonly parent: Object3D,
    private readonly targets: readonly Target[],
    private readonly marked: (point: Vector3) => boolean,
  ) {
    const sources = () => this.follow()
    session.addEventListener('inputsourceschange', sources)
    this.undo.push(() => session.removeEventListener('inputsourceschange', sources))
    for (const [event, button] of [
      ['select', 'select'],
      ['squeeze', 'grip'],
    ] as const) {
      const start = ({ inputSource }: XRInputSourceEvent) => {
        const source = this.sources.get(inputSource)
        if (source === undefined) return
        // Over a panel a press belongs to the panel; elsewhere it may mark a point of the room.
        const free = source.ray.hovered === null && source.touch.hovered === null
        if (free && this.marked(source.touch.place)) return
        source.ray.press(button)
      }
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
      yield touch
    }
  }

  /** True if hands are tracked and no controllers are held. */
  get hasHands(): boolean {
    for (const { source } of this.sources.values()) if (source.hand !== undefined) return true
    return false
  }

  /** Return the place of a hand or its controller in the floor space; null: it is not tracked. */
  hand(side: 'left' | 'right'): Vector3 | null {
    for (const { source, ray } of this.sources.values()) {
      if (source.handedness === side && ray.tracked) return ray.place
    }
    return null
  }

  /** Read the poses of a frame and point. now: s. */
  update(frame: XRFrame, space: XRReferenceSpace, now: number): void {
    for (const each of this.sources.values()) {
      const { source, ray, touch, look } = each
      const pose = frame.getPose(source.targetRaySpace, space)
      if (pose !== undefined && !pose.emulatedPosition) each.measured = true
      const guessed = each.measured && pose?.emulatedPosition === true
      const here = pose !== undefined && !guessed
      // A dragged target does not follow a guessed pose.
      const follows = ray.captured === null ? pose !== undefined : here
      if (pose !== undefined && follows) {
        this.matrix.fromArray(pose.transform.matrix)
        this.matrix.decompose(ray.ray.origin, this.quaternion, this.scale)
        ray.ray.direction.set(0, 0, -1).applyQuaternion(this.quaternion)
        const { x, y, z, w } = this.quaternion
        // of the sine, how high its right side is
        ray.roll = Math.asin(Math.min(Math.max(2 * (x * y + w * z), -1), 1))
      }
      const at = this.at
      at.frame = frame
      at.space = space
      at.source = source
      at.pose = pose
      touch.aim(now, this.moveTip(at, ray, touch) && here, this.targets)
      if (follows) this.moveHold(at, ray, each.model)
      const touching = touch.hovered !== null
      ray.aim(now, follows, this.targets, touching)
      look.update(ray, pose !== undefined && !touching)
    }
  }

  /** Move a fingertip, of a controller its tip; return whether it is tracked. */
  private moveTip(at: Tracked, ray: RayPointer, touch: TouchPointer): boolean {
    const { source, pose } = at
    if (source.hand === undefined) {
      touch.place.copy(ray.ray.origin)
      return pose !== undefined
    }
    return joint(at, 'index-finger-tip', touch.place)
  }

  /** Move the place at which a pointer holds things: between thumb and finger, or the grip. */
  private moveHold(at: Tracked, ray: RayPointer, model: InputModel | null): void {
    const { frame, space, source } = at
    if (source.hand !== undefined) {
      model?.bend(frame, space)
      if (!joint(at, 'index-finger-tip', this.finger) || !joint(at, 'thumb-tip', this.thumb))
        return
      ray.place.lerpVectors(this.thumb, this.finger, 0.5)
      return
    }
    const grip = source.gripSpace ? frame.getPose(source.gripSpace, space) : undefined
    model?.place(grip)
    if (grip === undefined) ray.place.copy(ray.ray.origin)
    else setPlace(ray.place, grip.transform.position)
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

  /** Pulse a controller for some ms; hands have no actuator. */
  pulse(pointer: Pointer, strength: number, duration: number): void {
    for (const { source, ray, touch } of this.sources.values()) {
      if (ray === pointer || touch === pointer)
        source.gamepad?.hapticActuators?.[0]?.pulse(strength, duration)
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
      const touch = new TouchPointer('touch', hand)
      const look = new PointerLook(source.hand ? 0.25 : 0.35)
      this.parent.add(look.group)
      const seen = source.hand != null && this.session.environmentBlendMode !== 'opaque'
      this.sources.set(source, {
        source,
        measured: false,
        ray: new RayPointer('ray', hand),
        touch,
        look,
        model: seen ? null : new InputModel(source, this.parent),
      })
    }
  }

  private remove({ source, ray, touch, look, model }: Source): void {
    this.sources.delete(source)
    ray.drop()
    touch.drop()
    look.dispose()
    model?.dispose()
  }
}

function setPlace(into: Vector3, { x, y, z }: DOMPointReadOnly): void {
  into.set(x, y, z)
}

/** Write the place of a joint of a hand; false: it is not visible. */
function joint({ frame, space, source }: Tracked, name: XRHandJoint, into: Vector3): boolean {
  const found = source.hand?.get(name)
  const pose = found === undefined ? undefined : frame.getJointPose?.(found, space)
  if (pose == null) return false
  setPlace(into, pose.transform.position)
  return true
}
