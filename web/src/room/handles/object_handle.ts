import { Matrix4, type Ray, Vector3 } from 'three'
import {
  attachType,
  detachType,
  moveObjectType,
  type SceneObject,
} from '../../protocol/mrlab_msgs'
import type { LabScene } from '../../scene/lab/lab_scene'
import { order, type RoomContext } from '../context'
import type { Hit, Pointer, Signal, Target } from '../input/pointer'

/** m */
const REACH = 0.06
/** s between two poses that physics is told of. */
const PERIOD = 1 / 30
/** Samples of a throw: the last 0.1 s or so. */
const SAMPLES = 8
/** m/s: nobody throws faster, but a lost hand jumps. */
const FASTEST = 6
/** s for which an object that went with a hand is in that hand: hands are never quite still. */
const IN_HAND = 0.5

const centre = new Vector3()
const at = new Vector3()
const inverse = new Matrix4()

/** An object that is picked up by a hand or a ray, carried, and thrown when it is let go. */
export class ObjectHandle implements Target {
  private holder: Pointer | null = null
  private near = false
  private distance = 0
  private readonly offset = new Vector3()
  private readonly position = new Vector3()
  private readonly times = new Float64Array(SAMPLES)
  private readonly places = new Float64Array(SAMPLES * 3)
  private samples = 0
  private toldAt = 0
  private object: SceneObject
  /** Whether a gripper is about to let go of it. */
  private detaching = false
  private now = 0
  private releasedAt = Number.NEGATIVE_INFINITY
  /** When somebody else's hand last moved it. */
  private movedAt = Number.NEGATIVE_INFINITY

  constructor(
    object: SceneObject,
    private readonly scene: LabScene,
    private readonly context: RoomContext,
  ) {
    this.object = object
  }

  get free(): boolean {
    return this.object.held_by === ''
  }

  /** Return how far its surface is from a place of the scene, about, m. */
  distanceTo(place: Vector3): number {
    const { x, y, z } = this.object.size
    return Math.max(this.centre(centre).distanceTo(place) - Math.min(x, y, z) / 2, 0)
  }

  /** Take over where it is. */
  show(object: SceneObject): void {
    const { x, y, z } = this.object.pose.position
    const to = object.pose.position
    const moved = to.x !== x || to.y !== y || to.z !== z
    const released = this.now - this.releasedAt < IN_HAND
    if (moved && object.held_by === 'hand' && this.holder === null && !released) {
      this.movedAt = this.now
    }
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
    if (signal.kind === 'enter') this.context.feedback('hover', signal)
    else if (signal.kind === 'down' && this.holder === null) {
      if (this.isCarriedByOthers) {
        this.context.say(this.context.words.room.inAnotherHand(this.object.name))
        return
      }
      this.context.feedback('press', signal)
      // where it is before it is held, and goes with the hand from
      this.near = this.reaches(pointer.place)
      this.centre(centre)
      this.holder = pointer
      this.distance = at.subVectors(centre, pointer.ray.origin).dot(pointer.ray.direction)
      this.offset.copy(centre).sub(this.hand(pointer, at))
      this.samples = 0
      this.takeFromGripper()
    } else if ((signal.kind === 'up' || signal.kind === 'cancel') && this.holder === pointer) {
      const hand = this.context.robotAt(this.centre(centre))
      this.holder = null
      this.releasedAt = this.now
      if (hand === '') this.tell(false, signal.kind === 'up')
      else this.giveTo(hand)
    }
  }

  /** Before each picture: it goes with the hand. now: s. */
  update(now: number): void {
    this.now = now
    if (this.holder === null) return
    this.hand(this.holder, at).add(this.offset)
    inverse.copy(this.context.world.matrixWorld).invert()
    this.position.copy(at).applyMatrix4(inverse)
    const sample = this.samples++ % SAMPLES
    this.times[sample] = now
    this.position.toArray(this.places, sample * 3)
    this.scene.moveObject(this.object.name, this.pose(), '')
    if (now - this.toldAt < PERIOD || this.detaching) return
    this.toldAt = now
    this.tell(true, false)
  }

  /** What a page that is gone has left in the air can be taken. */
  private get isCarriedByOthers(): boolean {
    return this.object.held_by === 'hand' && this.now - this.movedAt < IN_HAND
  }

  /** A hand takes what a gripper holds. */
  private takeFromGripper(): void {
    const { held_by: robot } = this.object
    if (robot === '' || robot === 'hand') return
    this.detaching = true
    order(this.context, 'physics/detach', detachType, { robot }).then(() => {
      this.detaching = false
    })
  }

  /** Have a gripper take it out of the hand, where it is; refused, it falls. */
  private giveTo(robot: string): void {
    const request = { robot, object: this.object.name }
    order(this.context, 'physics/attach', attachType, request).then((answer) => {
      if (answer === null) this.tell(false, false)
    })
  }

  private get radius(): number {
    const { x, y, z } = this.object.size
    return Math.max(Math.hypot(x, y, z) / 2, 0.03)
  }

  /** Write its place in the scene. */
  private centre(into: Vector3): Vector3 {
    const { x, y, z } = this.holder === null ? this.object.pose.position : this.position
    return this.context.world.localToWorld(into.set(x, y, z))
  }

  private hand({ ray, place }: Pointer, into: Vector3): Vector3 {
    return this.near ? into.copy(place) : ray.at(this.distance, into)
  }

  private pose() {
    const { x, y, z } = this.position
    return { position: { x, y, z }, orientation: this.object.pose.orientation }
  }

  private tell(held: boolean, thrown: boolean): void {
    const linear = { x: 0, y: 0, z: 0 }
    if (thrown && this.samples >= SAMPLES) {
      const newest = (this.samples - 1) % SAMPLES
      const oldest = this.samples % SAMPLES
      const time = (this.times[newest] as number) - (this.times[oldest] as number)
      const speed = (axis: number) =>
        ((this.places[newest * 3 + axis] as number) - (this.places[oldest * 3 + axis] as number)) /
        Math.max(time, 1e-3)
      at.set(speed(0), speed(1), speed(2)).clampLength(0, FASTEST)
      linear.x = at.x
      linear.y = at.y
      linear.z = at.z
    }
    order(this.context, 'physics/move_object', moveObjectType, {
      name: this.object.name,
      pose: this.pose(),
      twist: { linear, angular: { x: 0, y: 0, z: 0 } },
      held,
    })
  }
}
