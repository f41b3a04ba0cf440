import { type Object3D, Quaternion, type Vector3 } from 'three'
import { COMMON } from '../../lab/people/parts'
import type { People } from '../../lab/people/people'
import type { Link } from '../../link/link'
import { createPresence, presenceWriter } from '../../protocol/mrlab_msgs'
import type { Viewer } from '../ports'
import { poseInWorld } from '../scene/frames'

/** s between two messages: less than 20 a second. */
const PERIOD = 0.055
const LEVEL = new Quaternion()

/** Places of a person's hands; null: not tracked. */
interface Hands {
  hand(side: 'left' | 'right'): Vector3 | null
}

/** Publishes where the wearer of this headset is. */
export class OwnPresence {
  private readonly own = createPresence()
  private toldAt = Number.NEGATIVE_INFINITY

  constructor(
    private readonly link: Pick<Link, 'publish' | 'labTime'>,
    private readonly world: Object3D,
    private readonly people: Pick<People, 'id' | 'frame'>,
  ) {
    this.own.id = people.id
    this.own.header.frame_id = COMMON
  }

  /** Set the frame of our poses, which says in whose place we are. */
  setFrame(frame: string): void {
    this.own.header.frame_id = frame
    this.people.frame = frame
  }

  /** Publish our pose; call it in each frame with a headset. now: s. */
  tell({ head, look }: Viewer, hands: Hands, now: number): void {
    if (now - this.toldAt < PERIOD) return
    this.toldAt = now
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

  private send(away: boolean): void {
    const { own, link } = this
    const time = link.labTime()
    const { stamp } = own.header
    stamp.sec = Math.floor(time)
    stamp.nanosec = Math.floor((time - stamp.sec) * 1e9)
    own.away = away
    link.publish('presence', presenceWriter, own)
  }
}
