import { COMMON } from '../../lab/people/parts'
import type { People } from '../../lab/people/people'
import type { Surface } from '../../protocol/mrlab_msgs'
import type { OwnPresence } from '../people/own_presence'
import type { Lab, May, Speech } from '../ports'
import type { SceneAnchor } from './anchor'
import { orderSurfaces, type RoomScan } from './scan'
import type { TouchAlignment } from './touch_alignment'

/** s after the entry in which the presence of others arrives. */
const LISTEN_S = 1

/** Decides in which place this headset is. The first one inside is in the lab's; each later one is
 * where an anchor that it has found holds a place, or was aligned by touch with others. Only those in
 * one place see each other, and only the surfaces of the lab's place count. */
export class CommonPlace {
  /** True if the surfaces of this display count: without a headset it is in the lab's place. */
  aligned = true
  private enteredAt = Number.NaN
  /** Id of the lab's place. */
  private lab = COMMON
  /** The place that this headset is in: an id as the lab's, or the frame of a display that it was
   * aligned with. Empty: not known. */
  private here = ''
  /** The same before the last alignment by touch, and the frame that this one joined. */
  private before = ''
  private joined: { readonly frame: string } | null = null
  private frame = ''
  /** True while the lab has surfaces of this headset. */
  private told = false

  /** device: the source of this headset's surfaces. */
  constructor(
    private readonly ports: Speech & Lab & May,
    private readonly device: string,
    private readonly people: Pick<People, 'id' | 'isFirst' | 'anyIn' | 'joinable'>,
    private readonly presence: Pick<OwnPresence, 'setFrame'>,
    private readonly scan: Pick<RoomScan, 'tellAgain'>,
    private readonly touching: Pick<TouchAlignment, 'joined' | 'end' | 'begin'>,
    private readonly anchor: Pick<SceneAnchor, 'waits' | 'goTo' | 'placeHere' | 'holdFor'>,
  ) {}

  /** A session begins; now: s. */
  begin(now: number): void {
    this.aligned = false
    this.enteredAt = now
    this.here = this.before = this.frame = ''
    this.joined = null
    this.presence.setFrame(this.people.id)
  }

  /** The session has ended: the surfaces of this headset leave with it. */
  end(): void {
    this.touching.end()
    this.tell([])
    this.aligned = true
    this.here = ''
    this.presence.setFrame(COMMON)
  }

  /** The lab stands in another place now. Headsets that find its anchor go there; those that were in
   * its place before come along, unless others are known to be in the new one. */
  goTo(place: string): void {
    if (place === '' || place === this.lab) return
    const from = this.lab
    this.lab = place
    const found = this.anchor.goTo(place)
    if (this.here === '') return
    if (found || (this.here === from && !this.people.anyIn(place))) this.here = place
  }

  /** The person has moved the scene: whoever is with others has to be aligned with them again. */
  moved(): void {
    if (this.people.anyIn(this.frame)) this.here = ''
  }

  /** Await the touches that align this headset with those of a frame; by default those whom a
   * newcomer joins. */
  join(frame = this.people.joinable): void {
    this.touching.begin(frame)
  }

  /** In each frame with a headset; now: s. */
  update(now: number): void {
    this.takeTouch()
    const heard = now - this.enteredAt > LISTEN_S && !this.anchor.waits
    if (this.here === '' && heard) {
      this.here = this.anchor.placeHere(this.lab) || (this.people.isFirst ? this.lab : '')
    }
    if (this.here === this.lab && this.lab !== COMMON) this.anchor.holdFor(this.lab)
    const known = this.here === '' ? this.people.id : this.here
    const frame = this.here === this.lab ? COMMON : known
    const aligned = frame === COMMON || (this.here !== '' && !this.people.anyIn(COMMON))
    if (aligned === this.aligned && (frame === this.frame || !heard)) return
    this.frame = frame
    this.aligned = aligned
    this.presence.setFrame(frame)
    if (aligned) this.scan.tellAgain()
    else {
      this.order([])
      this.ports.say(this.ports.words.room.alignToCount)
    }
  }

  private takeTouch(): void {
    const { joined } = this.touching
    if (joined === this.joined) return
    if (this.joined === null) this.before = this.here
    this.joined = joined
    if (joined === null) this.here = this.before
    else this.here = joined.frame === COMMON ? this.lab : joined.frame
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
