import { type Object3D, Vector3 } from 'three'
import type { Link } from '../../link/link'
import { type Presence, presenceReader } from '../../protocol/mrlab_msgs'
import type { Words } from '../../words/en'
import { Avatar, AvatarShapes } from './avatar'
import { COMMON, type Part, partOf } from './parts'

/** s without a message after which an avatar is removed. */
const GONE = 4
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
  frame: string
  seenAt: number
}

/** A person in the room. id: of the display. frame: of its poses. aligned: that is ours as well. */
export interface Present {
  readonly id: string
  readonly name: string
  readonly part: Part
  readonly frame: string
  readonly aligned: boolean
}

/** The other people in the room, from their presence. */
export class People {
  /** The frame of this display: avatars are drawn between displays of one frame only. */
  frame = COMMON
  /** The display whose eyes the picture is seen with: nothing of it is drawn. Empty: our own. */
  seenBy = ''
  private readonly people = new Map<string, Person>()
  private readonly shapes = new AvatarShapes()
  private readonly undo: () => void

  /** id: of this display, unique in the lab. changed: a person came or left. */
  constructor(
    link: Pick<Link, 'subscribe'>,
    private readonly world: Object3D,
    readonly id: string,
    private readonly words: Words,
    private readonly changed: () => void,
  ) {
    this.undo = link.subscribe('presence', presenceReader, (message) => this.take(message))
  }

  /** The others. */
  get present(): Present[] {
    return [...this.people].map(([id, { avatar, frame }]) => {
      const { name, part } = avatar
      return { id, name, part, frame, aligned: frame === this.frame }
    })
  }

  /** Return whether anybody else is in a frame. */
  anyIn(frame: string): boolean {
    for (const person of this.people.values()) if (person.frame === frame) return true
    return false
  }

  /** The frame of those whom a newcomer joins: that of the lab's place, unless all others who know
   * their place are elsewhere. */
  get joinable(): string {
    if (this.anyIn(COMMON)) return COMMON
    for (const [id, { frame }] of this.people) if (frame !== id) return frame
    return COMMON
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

  /** Return the head of a display, whose x points forwards; undefined: it is not here. */
  eyes(id: string): Object3D | undefined {
    return this.people.get(id)?.avatar.eyes
  }

  /** True if nobody else knows their place, and nobody with a lower id waits for it. */
  get isFirst(): boolean {
    for (const [id, { frame }] of this.people) if (frame !== id || id < this.id) return false
    return true
  }

  /** Before each picture: update avatars, and remove silent people. Returns whether any is drawn.
   * now, step: s. */
  update(now: number, step: number): boolean {
    for (const [id, { avatar, frame, seenAt }] of this.people) {
      avatar.group.visible = frame === this.frame && id !== this.seenBy
      if (now - seenAt > GONE) this.remove(id)
      else avatar.update(step)
    }
    return this.people.size > 0
  }

  dispose(): void {
    this.undo()
    for (const id of [...this.people.keys()]) this.remove(id)
    this.shapes.dispose()
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
      person = { avatar, frame: COMMON, seenAt: 0 }
      this.people.set(message.id, person)
      this.world.add(avatar.group)
      this.changed()
    }
    if (person.frame !== message.header.frame_id) {
      person.frame = message.header.frame_id
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
