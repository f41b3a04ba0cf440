import { Matrix4, type Ray, Vector3 } from 'three'
import { order } from '../../lab/commands'
import type { Pose } from '../../protocol/geometry_msgs'
import {
  attachType,
  detachType,
  moveObjectType,
  type SceneObject,
} from '../../protocol/mrlab_msgs'
import type { LabScene } from '../../scene/lab/lab_scene'
import { carried, type Grab, grab } from '../grab/object'
import { newTrace, trace, velocityOf } from '../grab/throw'
import type { Hit, Pointer, Signal, Target } from '../input/pointer'
import type { Surroundings } from '../panels/panel'
import type { Obstacle } from '../place/supports'
import type { Frames, Lab, Speech } from '../ports'
import { Carry } from './carry'

/** m */
const REACH = 0.06
/** s between two poses that are sent to physics. */
const PERIOD = 1 / 30
/** s for which a moved object counts as held by that hand: a hand is never quite still. */
const IN_HAND = 0.5

const STILL: Vec = { x: 0, y: 0, z: 0 }

const centre = new Vector3()
const at = new Vector3()
const inverse = new Matrix4()

type Vec = Pose['position']

/** The ports of an object's handle. */
export type ObjectPorts = Speech & Lab & Frames & Surroundings

/** An object that a hand or a ray picks up, carries, and throws on release. */
export class ObjectHandle implements Target {
  private holder: Pointer | null = null
  private grab: Grab | null = null
  private readonly position = new Vector3()
  private readonly trace = newTrace()
  private readonly carry: Carry
  private object: SceneObject
  /** True while a gripper is releasing it. */
  private detaching = false
  private now = 0
  private releasedAt = Number.NEGATIVE_INFINITY
  /** Time at which the hand of another client last moved it, s. */
  private movedAt = Number.NEGATIVE_INFINITY

  constructor(
    object: SceneObject,
    private readonly scene: LabScene,
    private readonly ports: ObjectPorts,
    private readonly robotAt: (place: Vector3) => string,
  ) {
    this.object = object
    this.carry = new Carry(ports, { object: object.name }, PERIOD, (pose, hand) =>
      this.tell(pose, STILL, hand),
    )
  }

  get free(): boolean {
    return this.object.held_by === ''
  }

  /** An upright cylinder around it, in the lab's frame; null: it is in a hand or a gripper. */
  get obstacle(): Obstacle | null {
    if (this.holder !== null || !this.free) return null
    const { pose, size } = this.object
    const { x, y, z } = pose.position
    return {
      kind: 'thing',
      x,
      y,
      radius: Math.hypot(size.x, size.y) / 2,
      low: z - size.z / 2,
      high: z + size.z / 2,
    }
  }

  /** Return the approximate distance of its surface from a place of the scene, m. */
  distanceTo(place: Vector3): number {
    const { x, y, z } = this.object.size
    return Math.max(this.centre(centre).distanceTo(place) - Math.min(x, y, z) / 2, 0)
  }

  /** Take over its state. */
  show(object: SceneObject): void {
    const { x, y, z } = this.object.pose.position
    const to = object.pose.position
    const moved = to.x !== x || to.y !== y || to.z !== z
    const released = this.now - this.releasedAt < IN_HAND
    if (moved && object.held_by === 'hand' && this.holder === null && !released) {
      this.movedAt = this.now
    }
    // The gateway lets go for whom it has lost; a gripper that took it keeps it.
    if (this.holder !== null && this.carry.held && object.held_by === '') this.carry.again()
    this.object = object
  }

  cast(ray: Ray, hit: Hit): boolean {
    this.centre(centre)
    const along = at.subVectors(centre, ray.origin).dot(ray.direction)
    if (along < 0) return false
    ray.at(along, hit.point)
    if (hit.point.distanceTo(centre) > this.radius) return false
    hit.distance = along - this.radius / 2
    return true
  }

  reaches(point: Vector3): boolean {
    return point.distanceTo(this.centre(centre)) < this.radius + REACH
  }

  on(signal: Signal): void {
    const { pointer } = signal
    if (signal.kind === 'enter') this.ports.feedback('hover', signal)
    else if (signal.kind === 'down' && this.holder === null) {
      if (this.isCarriedByOthers) {
        this.ports.say(this.ports.words.room.inAnotherHand(this.object.name))
        return
      }
      this.ports.feedback('press', signal)
      this.grab = grab(pointer, this.centre(centre), this.reaches(pointer.place))
      this.holder = pointer
      this.trace.count = 0
      this.takeFromGripper()
    } else if ((signal.kind === 'up' || signal.kind === 'cancel') && this.holder === pointer) {
      const hand = this.robotAt(this.centre(centre))
      this.holder = null
      this.releasedAt = this.now
      if (hand === '') this.release(signal.kind === 'up')
      else this.giveTo(hand)
    }
  }

  /** Before each picture: follow the hand. now: s. */
  update(now: number): void {
    this.now = now
    if (this.holder === null || this.grab === null) return
    carried(this.grab, this.holder, at)
    inverse.copy(this.ports.world.matrixWorld).invert()
    this.position.copy(at).applyMatrix4(inverse)
    trace(this.trace, now, this.position)
    this.scene.moveObject(this.object.name, this.pose(), '')
    if (!this.detaching) this.carry.move(this.pose(), now)
  }

  /** True while another client moves it; an object that a closed page still holds can be taken. */
  private get isCarriedByOthers(): boolean {
    return this.object.held_by === 'hand' && this.now - this.movedAt < IN_HAND
  }

  /** Take it from the gripper that holds it. */
  private takeFromGripper(): void {
    const { held_by: robot } = this.object
    if (robot === '' || robot === 'hand') return
    this.detaching = true
    order(this.ports, 'physics/detach', detachType, { robot }).then(() => {
      this.detaching = false
    })
  }

  /** Attach it to a gripper at its present pose; if that is refused, it falls. */
  private giveTo(robot: string): void {
    const request = { robot, object: this.object.name }
    this.carry.end(async () => {
      const answer = await order(this.ports, 'physics/attach', attachType, request)
      if (answer === null) this.release(false)
    })
  }

  private get radius(): number {
    const { x, y, z } = this.object.size
    return Math.max(Math.hypot(x, y, z) / 2, 0.03)
  }

  /** Write its place in the scene. */
  private centre(into: Vector3): Vector3 {
    const { x, y, z } = this.holder === null ? this.object.pose.position : this.position
    return this.ports.world.localToWorld(into.set(x, y, z))
  }

  private pose(): Pose {
    const { x, y, z } = this.position
    return { position: { x, y, z }, orientation: this.object.pose.orientation }
  }

  /** Return it to physics at its present pose; thrown: with the velocity of the hand. */
  private release(thrown: boolean): void {
    const velocity = thrown ? velocityOf(this.trace, at) : STILL
    const { x, y, z } = velocity
    const pose = this.pose()
    this.carry.end(() => this.tell(pose, { x, y, z }, ''))
  }

  /** hand: the one that holds it; empty: it is let go. */
  private tell(pose: Pose, velocity: Vec, hand: string): Promise<unknown> {
    return order(this.ports, 'physics/move_object', moveObjectType, {
      name: this.object.name,
      pose,
      twist: { linear: velocity, angular: STILL },
      held: hand !== '',
      hand,
    })
  }
}
