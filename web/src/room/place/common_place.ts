import type { People } from '../../lab/people/people'
import type { Surface } from '../../protocol/mrlab_msgs'
import type { OwnPresence } from '../people/own_presence'
import type { Lab, May, Speech } from '../ports'
import { orderSurfaces, type RoomScan } from './scan'
import type { TouchAlignment } from './touch_alignment'

/** s after the entry in which the presence of others arrives. */
const LISTEN_S = 1

/** Decides if this headset stands in the same place as the others. The first one inside does; each
 * later one has to be aligned by touch. Only then do its surfaces and its avatar count. */
export class CommonPlace {
  /** True if the frame of this display is the lab's: without a headset it always is. */
  aligned = true
  private enteredAt = Number.NaN
  private first = false
  private known = false
  /** True while the lab has surfaces of this headset. */
  private told = false

  /** device: the source of this headset's surfaces. */
  constructor(
    private readonly ports: Speech & Lab & May,
    private readonly device: string,
    private readonly people: Pick<People, 'isFirst'>,
    private readonly presence: Pick<OwnPresence, 'setAligned'>,
    private readonly scan: Pick<RoomScan, 'tellAgain'>,
    private readonly touching: Pick<TouchAlignment, 'canUndo' | 'end'>,
  ) {}

  /** A session begins; now: s. */
  begin(now: number): void {
    this.aligned = false
    this.enteredAt = now
    this.first = false
    this.known = false
    this.presence.setAligned(false)
  }

  /** The session has ended: the surfaces of this headset leave with it. */
  end(): void {
    this.touching.end()
    this.tell([])
    this.aligned = true
    this.presence.setAligned(true)
  }

  /** In each frame with a headset; now: s. */
  update(now: number): void {
    const heard = now - this.enteredAt > LISTEN_S
    if (!this.aligned && heard) this.first ||= this.people.isFirst
    const aligned = this.first || this.touching.canUndo
    if (aligned === this.aligned && (this.known || !heard)) return
    this.aligned = aligned
    this.known = true
    this.presence.setAligned(aligned)
    if (aligned) this.scan.tellAgain()
    else {
      this.order([])
      this.ports.say(this.ports.words.room.alignToCount)
    }
  }

  /** Take over the surfaces of the lab: give it those of this headset again if it lost them, as
   * after a long break of the link. */
  keep(surfaces: readonly { readonly source?: string }[]): void {
    const here = surfaces.some(({ source }) => source === this.device)
    if (this.told && this.aligned && !here) this.scan.tellAgain()
  }

  /** Give the lab the surfaces of this headset once it is aligned. */
  tell(surfaces: Surface[]): void {
    if (!this.aligned) return
    this.told = surfaces.length > 0
    this.order(surfaces)
  }

  private order(surfaces: Surface[]): void {
    if (this.ports.scene) orderSurfaces(this.ports, this.device, surfaces)
  }
}
