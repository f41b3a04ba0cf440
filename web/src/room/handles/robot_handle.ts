import { Matrix4, Mesh, MeshBasicMaterial, type Object3D, Ray, RingGeometry, Vector3 } from 'three'
import { order } from '../../lab/commands'
import { placeRobotType } from '../../protocol/mrlab_msgs'
import type { LabScene } from '../../scene/lab/lab_scene'
import type { Pose } from '../../scene/stage/pose'
import { begin, carry, type Hold, hold, join, newBaseGrab } from '../grab/base'
import type { Hit, Pointer, Signal, Target } from '../input/pointer'
import type { Surroundings } from '../panels/panel'
import type { Ground, Place } from '../place/supports'
import type { Choosing, Frames, Lab, Speech } from '../ports'
import { upright } from '../scene/frames'
import { ArmShape } from './arm_shape'
import { Carry } from './carry'

/** m: the cylinder of a robot's base that can be grabbed. */
const RADIUS = 0.18
const HEIGHT = 0.32
const RING = 0.27
const REACH = 0.09
/** s between two places that are sent to the lab. */
const PERIOD = 0.2
/** s after which the lab's own place is shown again. */
const SETTLE = 0.8
/** Colour of the ring at a place that may be taken, and at one beside another base. */
export const CLEAR = 0x6cb6ff
export const BLOCKED = 0xff5c4d

const inverse = new Matrix4()
const local = new Ray()
const meets = new Vector3()

/** The ports of a robot's handle. */
export type HandlePorts = Speech & Lab & Frames & Ground & Surroundings

interface Holder {
  readonly pointer: Pointer
  /** The pointer in the lab's frame. */
  readonly hold: { -readonly [Part in keyof Hold]: Hold[Part] }
}

/** A robot's base: it is carried with one pointer, turned with two or with a stick, and stays
 * upright on the surface below it. */
export class RobotHandle implements Target {
  private readonly shape: ArmShape | null
  private readonly ring: Mesh<RingGeometry, MeshBasicMaterial>
  private readonly holders: Holder[] = []
  private readonly grab = newBaseGrab()
  private hovering = 0
  private releasedAt = Number.NEGATIVE_INFINITY
  private now = 0
  /** Its pose as the lab reports it; null: unknown. */
  private standing: Pose | null = null
  private readonly moves: Carry
  /** True while it is shown at its holder instead of at the pose of the lab. */
  private ahead = false

  /** stick: of a pointer's controller. */
  constructor(
    readonly name: string,
    readonly base: Object3D,
    private readonly scene: LabScene,
    private readonly ports: HandlePorts,
    private readonly choosing: Choosing,
    private readonly stick: (pointer: Pointer, axis: 'x' | 'y') => number,
  ) {
    const look = { color: CLEAR, transparent: true, opacity: 0.9, depthWrite: false }
    const links = scene.robot(name)?.root.links
    this.moves = new Carry(ports, { robot: name }, PERIOD, (pose, hand) => this.tell(pose, hand))
    this.shape = links === undefined ? null : new ArmShape(links)
    this.ring = new Mesh(new RingGeometry(RING - 0.025, RING, 48), new MeshBasicMaterial(look))
    this.ring.position.z = 0.003
    this.ring.visible = false
    base.add(this.ring)
  }

  get carried(): boolean {
    return this.holders.length > 0 && this.grab.moved
  }

  cast(ray: Ray, hit: Hit): boolean {
    if (this.choosing.on && this.shape?.cast(ray, hit)) return true
    inverse.copy(this.base.matrixWorld).invert()
    local.copy(ray).applyMatrix4(inverse)
    if (!meetsBase(local, meets)) return false
    hit.point.copy(meets).applyMatrix4(this.base.matrixWorld)
    hit.distance = hit.point.distanceTo(ray.origin)
    return true
  }

  /** While robots are chosen a fingertip touches the whole arm. */
  face(point: Vector3, hit: Hit): number {
    if (!this.choosing.on || this.shape === null) return Number.NaN
    hit.point.copy(point)
    return this.shape.distance(point)
  }

  reaches(point: Vector3): boolean {
    if (this.choosing.on) return false
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
        this.ports.feedback('hover', signal)
        break
      case 'leave':
        this.hovering--
        break
      case 'down':
        this.ports.feedback('press', signal)
        if (this.choosing.on) this.choosing.touch(this.name)
        else this.take(pointer)
        break
      case 'up':
      case 'cancel': {
        const index = this.holders.findIndex((holder) => holder.pointer === pointer)
        if (index < 0) break
        this.holders.splice(index, 1)
        if (this.holders[0] !== undefined) hold(this.grab, this.aim(this.holders[0]), this.ports)
        else if (this.grab.moved) this.release()
        break
      }
    }
    this.ring.visible = this.hovering > 0 || this.holders.length > 0
  }

  /** Take over its pose from the lab. */
  show(pose: Pose): void {
    this.standing = pose
  }

  /** Before each picture: carry it. now, step: s. */
  update(now: number, step: number): void {
    this.now = now
    this.carry(step)
    const ahead = this.carried || this.moves.unanswered || now - this.releasedAt < SETTLE
    if (ahead) this.scene.placeRobot(this.name, this.pose())
    else if (this.ahead && this.standing !== null) {
      // another client may have moved it meanwhile, or the lab refused the place
      this.scene.placeRobot(this.name, this.standing)
      this.ports.stir()
    }
    this.ahead = ahead
    if (this.carried) this.moves.move(this.pose(), now)
  }

  dispose(): void {
    this.ring.removeFromParent()
    this.ring.geometry.dispose()
    this.ring.material.dispose()
  }

  private take(pointer: Pointer): void {
    const { position, quaternion: q } = this.base
    const near = this.reaches(pointer.place)
    const holder = { pointer, hold: { near, roll: 0, ray: new Ray(), place: new Vector3() } }
    this.holders.push(holder)
    const [first, second] = this.holders
    if (first === undefined) return
    if (second !== undefined) {
      join(this.grab, this.aim(first), this.aim(second), this.ports)
      return
    }
    const heading = Math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
    begin(this.grab, position, heading)
    hold(this.grab, this.aim(first), this.ports)
  }

  /** Bring a pointer into the lab's frame. */
  private aim({ pointer, hold }: Holder): Hold {
    inverse.copy(this.ports.world.matrixWorld).invert()
    hold.ray.copy(pointer.ray).applyMatrix4(inverse)
    hold.place.copy(pointer.place).applyMatrix4(inverse)
    hold.roll = pointer.roll
    return hold
  }

  private carry(step: number): void {
    const [first, second] = this.holders
    if (first === undefined) return
    const turning = second === undefined ? null : this.aim(second)
    const stick = { x: this.stick(first.pointer, 'x'), y: this.stick(first.pointer, 'y') }
    const { supports, walls, obstacles } = this.ports
    const around = { supports, walls, obstacles, bases: this.others() }
    const hindrance = carry(this.grab, this.aim(first), turning, stick, step, around)
    if (hindrance !== null) this.ring.material.color.set(hindrance === '' ? CLEAR : BLOCKED)
  }

  private pose(): Pose {
    const { place, stands } = this.grab
    return upright(place.x, place.y, place.z, stands)
  }

  private *others(): Iterable<Place> {
    for (const base of this.ports.bases) if (base.support !== this.name) yield base
  }

  private release(): void {
    this.releasedAt = this.now
    const pose = this.pose()
    this.moves.end(() => this.tell(pose, ''))
  }

  /** hand: the one that carries it on; empty: it stays there. */
  private async tell(pose: Pose, hand: string): Promise<unknown> {
    const answer = await order(this.ports, 'lab/place_robot', placeRobotType, {
      robot: this.name,
      pose,
      hand,
    })
    this.releasedAt = answer === null ? Number.NEGATIVE_INFINITY : this.now
    return answer
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
