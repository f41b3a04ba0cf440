import { Matrix4, Mesh, MeshBasicMaterial, type Object3D, Ray, RingGeometry, Vector3 } from 'three'
import { placeRobotType } from '../../protocol/mrlab_msgs'
import type { LabScene } from '../../scene/lab/lab_scene'
import type { Pose } from '../../scene/stage/pose'
import { order, type RoomContext } from '../context'
import type { Hit, Pointer, Signal, Target } from '../input/pointer'
import { isClear, isOn, landing, type Place } from '../place/supports'
import { upright } from '../scene/frames'
import { ArmShape } from './arm_shape'

/** m: what of a robot's base can be taken hold of. */
const RADIUS = 0.18
const HEIGHT = 0.32
const RING = 0.27
const REACH = 0.09
/** m: a press that moves less carries nothing. */
const TOUCH = 0.03
/** m: bases keep this distance from each other. */
const APART = 0.35
/** m: the ray carries no farther. */
const FARTHEST = 6
/** s between two places that the lab is told of. */
const PERIOD = 0.2
/** s after which the lab's own place is shown again. */
const SETTLE = 0.8
/** rad/s and m/s at full stick. */
const TURN_SPEED = 1.6
const SHIFT_SPEED = 0.8

const inverse = new Matrix4()
const local = new Ray()
const meets = new Vector3()
const beam = new Ray()

interface Holder {
  readonly pointer: Pointer
  readonly near: boolean
  readonly from: Vector3
}

/** A robot's base: it is carried with one pointer, turned with two or with a stick, and stays
 * upright on what is below it. */
export class RobotHandle implements Target {
  private readonly shape: ArmShape | null
  private readonly ring: Mesh<RingGeometry, MeshBasicMaterial>
  private readonly holders: Holder[] = []
  private readonly place: Place = { x: 0, y: 0, z: 0, support: 'floor' }
  private readonly land: Place = { x: 0, y: 0, z: 0, support: 'floor' }
  private readonly offset = new Vector3()
  private readonly start = new Vector3()
  private heading = 0
  private between = 0
  private hovering = 0
  private moved = false
  private toldAt = 0
  private releasedAt = Number.NEGATIVE_INFINITY
  private now = 0
  /** Where the lab says it stands; null: not known yet. */
  private standing: Pose | null = null
  /** Places that the lab was told of and has not answered. */
  private unanswered = 0
  /** Whether it is shown where its holder has it, and not where the lab says. */
  private ahead = false

  /** touched: it was touched while robots are chosen. stick: of a pointer's controller. */
  constructor(
    readonly name: string,
    readonly base: Object3D,
    private readonly scene: LabScene,
    private readonly context: RoomContext,
    private readonly touched: (name: string) => void,
    private readonly stick: (pointer: Pointer, axis: 'x' | 'y') => number,
  ) {
    const look = { color: 0x6cb6ff, transparent: true, opacity: 0.9, depthWrite: false }
    const links = scene.robot(name)?.root.links
    this.shape = links === undefined ? null : new ArmShape(links)
    this.ring = new Mesh(new RingGeometry(RING - 0.025, RING, 48), new MeshBasicMaterial(look))
    this.ring.position.z = 0.003
    this.ring.visible = false
    base.add(this.ring)
  }

  get carried(): boolean {
    return this.holders.length > 0 && this.moved
  }

  cast(ray: Ray, hit: Hit): boolean {
    if (this.context.choosing && this.shape?.cast(ray, hit)) return true
    inverse.copy(this.base.matrixWorld).invert()
    local.copy(ray).applyMatrix4(inverse)
    if (!meetsBase(local, meets)) return false
    hit.point.copy(meets).applyMatrix4(this.base.matrixWorld)
    hit.distance = hit.point.distanceTo(ray.origin)
    return true
  }

  /** While robots are chosen a fingertip touches the whole arm. */
  face(point: Vector3, hit: Hit): number {
    if (!this.context.choosing || this.shape === null) return Number.NaN
    hit.point.copy(point)
    return this.shape.distance(point)
  }

  reaches(point: Vector3): boolean {
    if (this.context.choosing) return false
    inverse.copy(this.base.matrixWorld).invert()
    meets.copy(point).applyMatrix4(inverse)
    const out = Math.hypot(meets.x, meets.y) - RADIUS
    return out < REACH && meets.z > -REACH && meets.z < HEIGHT + REACH
  }

  on(signal: Signal): void {
    const { pointer } = signal
    switch (signal.kind) {
      case 'enter':
        this.hovering++
        this.context.feedback('hover', signal)
        break
      case 'leave':
        this.hovering--
        break
      case 'down':
        this.context.feedback('press', signal)
        if (this.context.choosing) this.touched(this.name)
        else this.grab(pointer)
        break
      case 'up':
      case 'cancel': {
        const index = this.holders.findIndex((holder) => holder.pointer === pointer)
        if (index < 0) break
        this.holders.splice(index, 1)
        if (this.holders.length > 0) this.hold(this.holders[0] as Holder)
        else if (this.moved) this.release()
        break
      }
    }
    this.ring.visible = this.hovering > 0 || this.holders.length > 0
  }

  /** Take over where the lab says it stands. */
  show(pose: Pose): void {
    this.standing = pose
  }

  /** Before each picture: carry it. now, step: s. */
  update(now: number, step: number): void {
    this.now = now
    const [first, second] = this.holders
    if (first !== undefined) this.carry(first, second, step)
    const ahead = this.carried || this.unanswered > 0 || now - this.releasedAt < SETTLE
    if (ahead) {
      this.scene.placeRobot(
        this.name,
        upright(this.place.x, this.place.y, this.place.z, this.heading),
      )
    } else if (this.ahead && this.standing !== null) {
      // somebody else may have put it elsewhere meanwhile, or the lab refused the place
      this.scene.placeRobot(this.name, this.standing)
      this.context.stir()
    }
    this.ahead = ahead
    if (this.carried && now - this.toldAt > PERIOD) this.tell()
  }

  dispose(): void {
    this.ring.removeFromParent()
    this.ring.geometry.dispose()
    this.ring.material.dispose()
  }

  private grab(pointer: Pointer): void {
    if (this.holders.length === 0) {
      const { position, quaternion: q } = this.base
      this.place.x = position.x
      this.place.y = position.y
      this.place.z = position.z
      this.heading = Math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
      this.moved = false
    }
    const near = this.reaches(pointer.place)
    const holder = { pointer, near, from: pointer.place.clone() }
    this.holders.push(holder)
    if (this.holders.length === 1) this.hold(holder)
    else this.between = this.angle()
  }

  /** Take where it is now as where a holder carries it from. */
  private hold(holder: Holder): void {
    this.start.set(this.place.x, this.place.y, this.place.z)
    this.offset.set(0, 0, 0)
    this.point(holder, meets)
    this.offset.set(this.place.x - meets.x, this.place.y - meets.y, 0)
  }

  /** Write where a holder points at, in the lab's frame. */
  private point({ pointer, near }: Holder, into: Vector3): boolean {
    const { world, supports } = this.context
    inverse.copy(world.matrixWorld).invert()
    beam.copy(pointer.ray).applyMatrix4(inverse)
    if (near) {
      into.copy(pointer.place).applyMatrix4(inverse)
      beam.origin.copy(into).setZ(into.z + 0.3)
      beam.direction.set(0, 0, -1)
    }
    if (!landing(supports, beam.origin, beam.direction, FARTHEST, this.land)) return false
    into.set(this.land.x, this.land.y, this.land.z)
    return true
  }

  private angle(): number {
    const [first, second] = this.holders
    if (first === undefined || second === undefined) return 0
    inverse.copy(this.context.world.matrixWorld).invert()
    meets.copy(second.pointer.place).sub(first.pointer.place).transformDirection(inverse)
    return Math.atan2(meets.y, meets.x)
  }

  private carry(first: Holder, second: Holder | undefined, step: number): void {
    if (second !== undefined) {
      const angle = this.angle()
      this.turn(angle - this.between)
      this.between = angle
    }
    this.turn(-this.stick(first.pointer, 'x') * TURN_SPEED * step)
    const shift = -this.stick(first.pointer, 'y') * SHIFT_SPEED * step
    if (shift !== 0) {
      inverse.copy(this.context.world.matrixWorld).invert()
      meets.copy(first.pointer.ray.direction).transformDirection(inverse).setZ(0).normalize()
      this.offset.addScaledVector(meets, shift)
    }
    if (!this.point(first, meets)) return
    const x = meets.x + this.offset.x
    const y = meets.y + this.offset.y
    if (!this.moved && Math.hypot(x - this.start.x, y - this.start.y) < TOUCH) return
    const wanted = this.below(x, y)
    const clear = isClear(wanted, APART, this.others())
    this.ring.material.color.set(clear ? 0x6cb6ff : 0xff5c4d)
    if (!clear) return
    this.moved = true
    this.place.x = wanted.x
    this.place.y = wanted.y
    this.place.z = wanted.z
    this.place.support = wanted.support
  }

  private turn(by: number): void {
    if (Math.abs(by) < 1e-4) return
    this.heading += by
    this.moved = true
  }

  /** Return the place at x, y on what the pointer landed on, or on what is below that. */
  private below(x: number, y: number): Place {
    const { supports } = this.context
    for (const support of supports) {
      if (support.height > this.land.z + 0.01 || !isOn(support, x, y)) continue
      this.land.z = support.height
      this.land.support = support.name
      break
    }
    this.land.x = x
    this.land.y = y
    return this.land
  }

  private *others(): Iterable<Place> {
    for (const base of this.context.bases) if (base.support !== this.name) yield base
  }

  private release(): void {
    this.releasedAt = this.now
    this.tell()
  }

  private tell(): void {
    this.toldAt = this.now
    const pose = upright(this.place.x, this.place.y, this.place.z, this.heading)
    this.unanswered++
    order(this.context, 'lab/place_robot', placeRobotType, { robot: this.name, pose }).then(
      (answer) => {
        this.unanswered--
        this.releasedAt = answer === null ? Number.NEGATIVE_INFINITY : this.now
      },
    )
  }
}

/** Write where a ray, in the base's frame, meets the base or the ring around it. */
function meetsBase({ origin: o, direction: d }: Ray, into: Vector3): boolean {
  let least = Number.POSITIVE_INFINITY
  const a = d.x * d.x + d.y * d.y
  const b = o.x * d.x + o.y * d.y
  const c = o.x * o.x + o.y * o.y - RADIUS * RADIUS
  const root = b * b - a * c
  if (a > 1e-9 && root >= 0) {
    const share = (-b - Math.sqrt(root)) / a
    const z = o.z + share * d.z
    if (share > 0 && z >= 0 && z <= HEIGHT) least = share
  }
  for (const [height, radius] of LIDS) {
    const share = (height - o.z) / d.z
    if (!(share > 0) || share >= least) continue
    if (Math.hypot(o.x + share * d.x, o.y + share * d.y) < radius) least = share
  }
  if (least === Number.POSITIVE_INFINITY) return false
  into.copy(d).multiplyScalar(least).add(o)
  return true
}

const LIDS = [
  [0, RING + 0.04],
  [HEIGHT, RADIUS],
] as const
