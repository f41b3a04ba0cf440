import { type Object3D, Quaternion, Vector3 } from 'three'
import type { Link } from '../../link/link'
import {
  createPresence,
  type Presence,
  presenceReader,
  presenceWriter,
} from '../../protocol/mrlab_msgs'
import type { Words } from '../../words/en'
import type { Viewer } from '../ports'
import { poseInWorld } from '../scene/frames'
import { Avatar, AvatarShapes, type Part, partOf } from './avatar'

/** s between two of our own messages: less than 20 a second. */
const PERIOD = 0.055
/** s without a message after which an avatar is removed. */
const GONE = 4
const LEVEL = new Quaternion()
/** m: radius of a standing person, and from the eyes to the top of the head. */
const WIDE = 0.2
const CROWN = 0.15

const eyes = new Vector3()

/** An upright cylinder around a person, m. */
export interface Standing {
  readonly kind: 'person'
  readonly x: number
  readonly y: number
  readonly radius: number
  readonly low: number
  readonly high: number
}

function standing({ x, y, z }: Vector3): Standing {
  return { kind: 'person', x, y, radius: WIDE, low: 0, high: z + CROWN }
}

interface Person {
  readonly avatar: Avatar
  aligned: boolean
  seenAt: number
}

/** Places of a person's hands; null: not tracked. */
interface Hands {
  hand(side: 'left' | 'right'): Vector3 | null
}

/** A person in the room. */
interface Present {
  readonly name: string
  readonly part: Part
  readonly aligned: boolean
}

/** The frame of displays that are in the same place; any other one is a display's own. */
const COMMON = 'world'

/** The other people in the room: receives their presence and publishes ours. */
export class People {
  private readonly people = new Map<string, Person>()
  private readonly shapes = new AvatarShapes()
  private readonly own = createPresence()
  private readonly undo: () => void
  private toldAt = Number.NEGATIVE_INFINITY
  private now = 0

  /** id: of this display, unique in the lab. changed: a person came or left. */
  constructor(
    private readonly link: Link,
    private readonly world: Object3D,
    readonly id: string,
    private readonly words: Words,
    private readonly changed: () => void,
  ) {
    this.own.id = id
    this.own.header.frame_id = COMMON
    this.undo = link.subscribe('presence', presenceReader, (message) => this.take(message))
  }

  /** The others. */
  get present(): Present[] {
    return [...this.people.values()].map(({ avatar: { name, part }, aligned }) => {
      return { name, part, aligned }
    })
  }

  /** Where people stand, in the lab's frame, this one first. head: in the scene. */
  *obstacles(head: Vector3): Iterable<Standing> {
    const own = this.world.worldToLocal(eyes.copy(head))
    yield standing(own)
    for (const { avatar } of this.people.values()) {
      if (avatar.group.visible) yield standing(avatar.place)
    }
  }

  /** The heads of the others that are drawn, in the scene. */
  *heads(): Iterable<Vector3> {
    for (const { avatar } of this.people.values()) {
      if (avatar.group.visible) yield this.world.localToWorld(eyes.copy(avatar.place))
    }
  }

  /** True if nobody else is in the common place, and nobody with a lower id waits for it. */
  get isFirst(): boolean {
    for (const [id, { aligned }] of this.people) if (aligned || id < this.id) return false
    return true
  }

  /** Set if this display is in the same place as the others: avatars are drawn between displays in
   * one place only. */
  setAligned(aligned: boolean): void {
    this.own.header.frame_id = aligned ? COMMON : this.id
  }

  /** Before each picture: update avatars, and remove silent people. Returns whether any is drawn.
   * now, step: s. */
  update(now: number, step: number): boolean {
    this.now = now
    const inPlace = this.own.header.frame_id === COMMON
    for (const [id, { avatar, aligned, seenAt }] of this.people) {
      avatar.group.visible = aligned && inPlace
      if (now - seenAt > GONE) this.remove(id)
      else avatar.update(step)
    }
    return this.people.size > 0
  }

  /** Publish our pose; call it in each frame with a headset. */
  tell({ head, look }: Viewer, hands: Hands): void {
    if (this.now - this.toldAt < PERIOD) return
    this.toldAt = this.now
    const { own, world } = this
    own.head = poseInWorld(world, head, look)
    const left = hands.hand('left')
    own.has_left = left !== null
    if (left !== null) own.left = poseInWorld(world, left, LEVEL)
    const right = hands.hand('right')
    own.has_right = right !== null
    if (right !== null) own.right = poseInWorld(world, right, LEVEL)
    this.send(false)
  }

  /** Publish that we leave; nothing if we never published our presence. */
  leave(): void {
    if (this.toldAt === Number.NEGATIVE_INFINITY) return
    this.toldAt = Number.NEGATIVE_INFINITY
    this.send(true)
  }

  dispose(): void {
    this.undo()
    this.leave()
    for (const id of [...this.people.keys()]) this.remove(id)
    this.shapes.dispose()
  }

  private send(away: boolean): void {
    const { own, link } = this
    const time = link.labTime()
    const { stamp } = own.header
    stamp.sec = Math.floor(time)
    stamp.nanosec = Math.floor((time - stamp.sec) * 1e9)
    own.away = away
    link.publish('presence', presenceWriter, own)
  }

  private take(message: Presence): void {
    if (message.id === this.id) return
    if (message.away) {
      this.remove(message.id)
      return
    }
    const part = partOf(message)
    // Without a name: a client of the lab's own network, which needs no sign-in.
    const name = message.name || message.id.slice(0, 8)
    let person = this.people.get(message.id)
    if (person !== undefined && (person.avatar.part !== part || person.avatar.name !== name)) {
      this.remove(message.id)
      person = undefined
    }
    if (person === undefined) {
      const avatar = new Avatar(this.shapes, name, part, this.words.room.parts[part])
      person = { avatar, aligned: true, seenAt: 0 }
      this.people.set(message.id, person)
      this.world.add(avatar.group)
      this.changed()
    }
    const aligned = message.header.frame_id === COMMON
    if (aligned !== person.aligned) {
      person.aligned = aligned
      this.changed()
    }
    // Not the time of the last frame: a software renderer may take seconds for one.
    person.seenAt = performance.now() / 1000
    person.avatar.take(message)
  }

  private remove(id: string): void {
    const person = this.people.get(id)
    if (person === undefined) return
    this.people.delete(id)
    person.avatar.dispose()
    this.changed()
  }
}
