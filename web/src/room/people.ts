import { Group, Mesh, MeshStandardMaterial, type Object3D, SphereGeometry } from 'three'
import type { Link } from '../link/link'
import type { Pose } from '../protocol/geometry_msgs'
import { Presence, presenceType } from '../protocol/mrlab_msgs'
import { place } from '../scene/lab_objects'
import { Label } from '../scene/labels'

/** s between two of our own messages; an avatar without news for so long is gone. */
const PERIOD = 0.1
const GONE = 4
const HEAD = 0.11 // m

interface Person {
  readonly group: Group
  readonly parts: readonly Mesh[]
  readonly label: Label
  seenAt: number
}

export interface Tracked {
  readonly head: Pose
  readonly left: Pose | null
  readonly right: Pose | null
}

/** Who else is in the room: a head with a name, and the hands. */
export class People {
  private readonly people = new Map<string, Person>()
  private readonly shape = new SphereGeometry(1, 20, 14)
  private readonly material = new MeshStandardMaterial({ color: 0x6cb6ff, roughness: 0.5 })
  private readonly id = crypto.randomUUID()
  private toldAt = Number.NEGATIVE_INFINITY
  private now = 0
  private readonly undo: () => void

  constructor(
    private readonly link: Link,
    private readonly world: Object3D,
    private readonly part: number,
  ) {
    this.undo = link.subscribe('presence', presenceType, (message) => this.take(message))
  }

  /** Tell the others where we are, and let go of who is silent. now: s. */
  update(now: number, tracked: () => Tracked | null): void {
    this.now = now
    for (const [id, person] of this.people) if (now - person.seenAt > GONE) this.remove(id)
    if (now - this.toldAt < PERIOD) return
    const found = tracked()
    if (found === null) return
    this.toldAt = now
    this.tell(found, false)
  }

  /** Tell the others that we leave. */
  leave(): void {
    if (this.toldAt === Number.NEGATIVE_INFINITY) return
    this.tell({ head: presenceType.create().head, left: null, right: null }, true)
    this.toldAt = Number.NEGATIVE_INFINITY
  }

  dispose(): void {
    this.undo()
    this.leave()
    for (const id of [...this.people.keys()]) this.remove(id)
    this.shape.dispose()
    this.material.dispose()
  }

  private tell({ head, left, right }: Tracked, away: boolean): void {
    const time = this.link.labTime()
    const sec = Math.floor(time)
    const message = presenceType.create({ id: this.id, part: this.part, head, away })
    message.header.stamp = { sec, nanosec: Math.floor((time - sec) * 1e9) }
    message.header.frame_id = 'world'
    message.has_left = left !== null
    if (left !== null) message.left = left
    message.has_right = right !== null
    if (right !== null) message.right = right
    this.link.publish('presence', presenceType, message)
  }

  private take(message: Presence): void {
    if (message.id === this.id) return
    if (message.away) {
      this.remove(message.id)
      return
    }
    let person = this.people.get(message.id)
    if (person === undefined) {
      person = this.make(message.name || message.id.slice(0, 4), message.part)
      this.people.set(message.id, person)
    }
    person.seenAt = this.now
    const [head, left, right] = person.parts as [Mesh, Mesh, Mesh]
    place(head, message.head)
    left.visible = message.has_left
    if (message.has_left) place(left, message.left)
    right.visible = message.has_right
    if (message.has_right) place(right, message.right)
  }

  private make(name: string, part: number): Person {
    const group = new Group()
    const parts = [HEAD, 0.04, 0.04].map((radius) => {
      const mesh = new Mesh(this.shape, this.material)
      mesh.scale.setScalar(radius)
      group.add(mesh)
      return mesh
    })
    const label = new Label(part === Presence.TEACHES ? `★ ${name}` : name, 0.024)
    label.paint('#1B2129', '#E8EDF2')
    const head = parts[0] as Mesh
    label.sprite.position.z = 1.5
    // the head is scaled; its label keeps its size
    label.sprite.scale.divideScalar(HEAD)
    head.add(label.sprite)
    this.world.add(group)
    return { group, parts, label, seenAt: this.now }
  }

  private remove(id: string): void {
    const person = this.people.get(id)
    this.people.delete(id)
    person?.label.dispose()
    person?.group.removeFromParent()
  }
}
