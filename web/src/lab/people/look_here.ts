import {
  AdditiveBlending,
  CylinderGeometry,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  RingGeometry,
  type Vector3,
} from 'three'
import type { Link } from '../../link/link'
import {
  createLookHere,
  lookHereReader,
  lookHereWriter,
  type RecorderState,
} from '../../protocol/mrlab_msgs'
import { Label } from '../../scene/stage/labels'
import { spoken } from '../../words/diagnostic'
import type { Words } from '../../words/en'
import { typed } from '../../words/phrase'
import { named } from '../../words/words'

const KEY = 'look_here'
/** s for which a mark is shown, and in which it fades. */
const SHOWN = 10
const FADES = 1.5
/** m */
const HIGH = 0.6
const RADIUS = 0.05
/** Height of its words, as a part of the distance to them. */
const WORDS = 0.034
const COLOUR = 0xffc94d
/** The code of a replay that stands where something happened. */
const STOP = 'tour_stop'
/** Letters of a mark's words. */
const MOST_LETTERS = 60

/** The mark at the point that somebody asked everybody to look at, or that a guided replay shows. */
export class LookHere {
  private readonly group = new Group()
  private readonly beam = new MeshBasicMaterial({
    color: COLOUR,
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
    blending: AdditiveBlending,
  })
  private readonly light = new Mesh(
    new CylinderGeometry(RADIUS * 0.5, RADIUS, HIGH, 24, 1, true)
      .rotateX(Math.PI / 2)
      .translate(0, 0, HIGH / 2),
    this.beam,
  )
  private readonly ring = new Mesh(
    new RingGeometry(RADIUS * 1.3, RADIUS * 1.7, 48),
    new MeshBasicMaterial({
      color: COLOUR,
      transparent: true,
      depthTest: false,
      side: DoubleSide,
    }),
  )
  private label: Label | null = null
  /** s, of performance.now(); NaN: nothing is shown. */
  private since = Number.NaN
  /** Where the replay stands, s of the session; NaN: at no stop. */
  private stop = Number.NaN
  /** True while that is shown: it does not fade. */
  private stands = false
  private readonly undo: () => void

  /** told: called with the words of a new mark. */
  constructor(
    private readonly link: Pick<Link, 'subscribe' | 'publish'>,
    world: Object3D,
    words: Words,
    private readonly told: (text: string) => void,
  ) {
    this.group.add(this.light, this.ring)
    this.group.visible = false
    world.add(this.group)
    this.undo = link.subscribe(KEY, lookHereReader, ({ name, point }) => {
      this.show(words.room.looksHere(named(name)), point)
    })
  }

  /** The point in the lab's frame, m; null: none is shown. */
  get point(): Vector3 | null {
    return this.group.visible ? this.group.position : null
  }

  /** Ask everybody to look at a point of the lab's frame, m. */
  ask({ x, y, z }: Vector3): void {
    this.link.publish(KEY, lookHereWriter, { ...createLookHere(), point: { x, y, z } })
  }

  /** Mark where a replay stands, until it goes on. */
  stand(state: RecorderState | null): void {
    const stop = state?.code === STOP ? state.position : Number.NaN
    if (Object.is(stop, this.stop)) return
    if (this.stands) this.hide()
    this.stop = stop
    const place = typed(state?.values.find(({ key }) => key === 'place')?.value)
    if (state === null || Number.isNaN(stop) || !Array.isArray(place)) return
    const [x, y, z] = place.map(Number)
    this.show(spoken(state), { x: x ?? 0, y: y ?? 0, z: z ?? 0 })
    this.stands = true
  }

  /** Before each picture; now: s. Returns whether it is drawn. */
  update(now: number): boolean {
    const { stands } = this
    const left = stands ? SHOWN : this.since + SHOWN - now
    if (!(left > 0)) {
      this.hide()
      return false
    }
    const share = Math.min(left / FADES, 1)
    this.beam.opacity = 0.45 * share
    this.ring.material.opacity = share
    this.ring.scale.setScalar(stands ? 1 : 1 + 0.25 * Math.sin((now - this.since) * 4))
    return !stands
  }

  dispose(): void {
    this.undo()
    this.hide()
    this.group.removeFromParent()
    for (const mesh of [this.light, this.ring]) mesh.geometry.dispose()
    this.beam.dispose()
    this.ring.material.dispose()
  }

  private show(text: string, point: { x: number; y: number; z: number }): void {
    this.hide()
    this.since = performance.now() / 1000
    this.group.position.set(point.x, point.y, point.z)
    this.group.visible = true
    const short = text.length > MOST_LETTERS ? `${text.slice(0, MOST_LETTERS)}…` : text
    this.label = new Label(short, WORDS)
    this.label.paint('#1B2129', '#FFE08A')
    this.label.sprite.position.z = HIGH
    this.group.add(this.label.sprite)
    this.told(text)
  }

  private hide(): void {
    this.since = Number.NaN
    this.stands = false
    this.group.visible = false
    this.label?.dispose()
    this.label = null
  }
}
