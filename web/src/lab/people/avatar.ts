import {
  Group,
  type Material,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  Quaternion,
  SphereGeometry,
  Vector3,
} from 'three'
import type { Presence } from '../../protocol/mrlab_msgs'
import { Label } from '../../scene/stage/labels'
import type { Pose } from '../../scene/stage/pose'
import { PART_ICONS, type Part } from './parts'

/** m */
const HEAD = 0.11
const HAND = 0.045
const ABOVE = 0.17
const NAME = 0.03 // of a name, as a part of the distance to it
/** Time constant, s, with which an avatar follows its messages, which arrive at 20 Hz at most. */
const EASE = 0.06
const JUMP = 0.6 // m

const place = new Vector3()
const turn = new Quaternion()

const PART_COLOURS = { 0: 0xa9b5c2, 1: 0x6cb6ff, 2: 0xffe08a } as const

/** The shapes that all avatars share. */
export class AvatarShapes {
  readonly ball = new SphereGeometry(1, 24, 16)
  readonly visor = new MeshStandardMaterial({ color: 0x16202b, roughness: 0.2 })
  private readonly looks = [0, 1, 2].map(
    (part) => new MeshStandardMaterial({ color: PART_COLOURS[part as Part], roughness: 0.55 }),
  )

  look(part: Part): Material {
    return this.looks[part] as Material
  }

  dispose(): void {
    this.ball.dispose()
    this.visor.dispose()
    for (const look of this.looks) look.dispose()
  }
}

/** A part of an avatar that moves towards its received pose. */
class Moved {
  readonly group = new Group()
  private readonly to = new Vector3()
  private readonly turn = new Quaternion()
  private here = false

  take({ position: p, orientation: q }: Pose): void {
    this.to.set(p.x, p.y, p.z)
    this.turn.set(q.x, q.y, q.z, q.w).normalize()
    const { position, quaternion } = this.group
    if (this.here && position.distanceTo(this.to) < JUMP) return
    this.here = true
    position.copy(this.to)
    quaternion.copy(this.turn)
  }

  show(on: boolean): void {
    this.here &&= on
    this.group.visible = on
  }

  update(share: number): void {
    place.copy(this.to)
    turn.copy(this.turn)
    this.group.position.lerp(place, share)
    this.group.quaternion.slerp(turn, share)
  }
}

/** Another person in the room: a head with its gaze, hands, and a name above. */
export class Avatar {
  readonly group = new Group()
  private readonly head = new Moved()
  private readonly left = new Moved()
  private readonly right = new Moved()
  private readonly label: Label

  constructor(
    shapes: AvatarShapes,
    readonly name: string,
    readonly part: Part,
    words: string,
  ) {
    const look = shapes.look(part)
    const ball = (radius: number, material: Material) => {
      const mesh = new Mesh(shapes.ball, material)
      mesh.scale.setScalar(radius)
      return mesh
    }
    const skull = ball(HEAD, look)
    skull.scale.z *= 1.15
    const visor = ball(HEAD, shapes.visor)
    // x points forwards
    visor.scale.set(HEAD * 0.5, HEAD * 0.82, HEAD * 0.36)
    visor.position.set(HEAD * 0.66, 0, HEAD * 0.12)
    this.head.group.add(skull, visor)
    this.left.group.add(ball(HAND, look))
    this.right.group.add(ball(HAND, look))
    this.label = new Label(`${PART_ICONS[part]} ${name} · ${words}`, NAME)
    this.label.paint('#1B2129', '#E8EDF2')
    this.label.sprite.position.z = ABOVE
    this.head.group.add(this.label.sprite)
    this.group.add(this.head.group, this.left.group, this.right.group)
  }

  /** Of the head, in the lab's frame. */
  get place(): Vector3 {
    return this.head.group.position
  }

  /** The head, whose x points forwards. */
  get eyes(): Object3D {
    return this.head.group
  }

  take(message: Presence): void {
    this.head.take(message.head)
    this.left.show(message.has_left)
    if (message.has_left) this.left.take(message.left)
    this.right.show(message.has_right)
    if (message.has_right) this.right.take(message.right)
  }

  /** Before each picture. step: s. */
  update(step: number): void {
    const share = 1 - Math.exp(-step / EASE)
    this.head.update(share)
    this.left.update(share)
    this.right.update(share)
  }

  dispose(): void {
    this.label.dispose()
    this.group.removeFromParent()
  }
}
