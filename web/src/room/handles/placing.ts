import {
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Ray,
  RingGeometry,
  type Vector3,
} from 'three'
import type { Pose } from '../../protocol/geometry_msgs'
import { Label } from '../../scene/stage/labels'
import { place } from '../../scene/stage/pose'
import { FARTHEST, TURN_SPEED } from '../grab/base'
import { type Foot, type Hindrance, hindranceAt, squared } from '../grab/clearance'
import type { Hit, Pointer, Signal, Target } from '../input/pointer'
import type { Targets } from '../input/targets'
import { Panel, type Surroundings } from '../panels/panel'
import { PANEL_THEME } from '../panels/pen'
import { type Ground, landing, type Place } from '../place/supports'
import type { Frames, Speech } from '../ports'
import { upright } from '../scene/frames'
import { BLOCKED, CLEAR } from './robot_handle'

/** m: width of the ring that shows a reach, and least distance above a surface. */
const RING = 0.012
const ABOVE = 0.004
/** Height of the sentence over what is placed, as a part of the distance to it; and m above its foot. */
const PROMPT = 0.032
const OVER = 0.8
/** rad that a thing turns for each that the pressed ray goes sideways, beyond what trembles. */
const GAIN = 4
const STEADY = 0.04
/** m along a ray that meets no surface: there what is placed is put away. */
const AIR = 4
/** rad: at a smaller bearing from the vertical the viewer is above, and says no direction. */
const BELOW = 0.05

const inverse = new Matrix4()
const local = new Ray()

/** Return the direction of a ray about the vertical, rad. */
function bearing({ direction: { x, z } }: Ray): number {
  return Math.atan2(x, z)
}

/** The look of a thing before it is placed: translucent, at real size, its origin on the ground. */
export interface Ghost {
  readonly root: Object3D
  paint(colour: number): void
  dispose(): void
}

/** A robot or an object that was chosen and has no place yet. */
export interface Placeable {
  /** Of the chosen card. */
  readonly id: string
  readonly foot: Foot
  /** m; 0: there is nothing to show. */
  readonly reach: number
  ghost(): Ghost
  /** Have the lab put it there. support: name of the surface. */
  put(pose: Pose, support: string): Promise<unknown>
}

/** Carries a chosen robot or object as a ghost on the surface that the ray meets, until the trigger
 * places it, or the grip, or a press into the air, puts it away. */
export class Placing implements Target {
  private chosen: Placeable | null = null
  private ghost: Ghost | null = null
  private readonly ring = new Mesh(
    new RingGeometry(1, 1 + RING, 96),
    new MeshBasicMaterial({ color: CLEAR, transparent: true, opacity: 0.8, depthWrite: false }),
  )
  private pointer: Pointer | null = null
  /** The pointer that is pressed: what is placed stands, and turns as the ray goes sideways. from,
   * turned: of the ray and of the thing at the press, rad. */
  private held: { pointer: Pointer; from: number; turned: number } | null = null
  private readonly land: Place = { x: 0, y: 0, z: 0, support: '' }
  private landed = false
  /** rad, added to the heading towards the viewer. */
  private turned = 0
  private heading = 0
  private hindrance: Hindrance | null = null
  private prompt: Label | null = null

  /** stick: of a pointer's controller, -1 to 1. changed: something was chosen or placed. */
  constructor(
    private readonly ports: Speech & Frames & Ground & Surroundings,
    private readonly targets: Targets,
    private readonly stick: (pointer: Pointer, axis: 'x' | 'y') => number,
    private readonly changed: () => void,
  ) {
    this.ring.visible = false
    ports.world.add(this.ring)
  }

  get active(): boolean {
    return this.chosen !== null
  }

  /** The id of the chosen card; empty: none is. */
  get id(): string {
    return this.chosen?.id ?? ''
  }

  /** The pose at which the trigger would place it now; null: nowhere. */
  get pose(): Pose | null {
    if (!this.landed || this.hindrance !== null) return null
    return upright(this.land.x, this.land.y, this.land.z, this.heading)
  }

  /** Carry this from now on; the same card again puts it away. */
  begin(chosen: Placeable): void {
    const same = chosen.id === this.id
    this.end()
    if (same) return
    this.chosen = chosen
    this.turned = 0
    this.ghost = chosen.ghost()
    this.ghost.root.visible = false
    this.ports.world.add(this.ghost.root)
    this.ring.scale.setScalar(Math.max(chosen.reach, 1e-3))
    this.targets.narrow((target) => target === this || target instanceof Panel)
    this.targets.add(this)
    this.ports.say(this.ports.words.room.placing, false)
    this.changed()
  }

  /** Put away what is carried. */
  end(): void {
    if (this.chosen === null) return
    this.chosen = null
    this.ghost?.dispose()
    this.ghost?.root.removeFromParent()
    this.ghost = null
    this.pointer = this.held = null
    this.landed = this.ring.visible = false
    this.say(false)
    this.targets.remove(this)
    this.targets.widen()
    this.ports.stir()
    this.changed()
  }

  cast(ray: Ray, hit: Hit): boolean {
    if (this.held === null ? this.lands(ray) : this.landed) {
      const { x, y, z } = this.land
      this.ports.world.localToWorld(hit.point.set(x, y, z))
    } else ray.at(AIR, hit.point)
    hit.distance = hit.point.distanceTo(ray.origin)
    return true
  }

  on(signal: Signal): void {
    const { pointer } = signal
    const { held } = this
    if (held !== null && held.pointer !== pointer) return
    if (signal.kind !== 'leave') this.pointer = pointer
    else if (this.pointer === pointer) this.pointer = null
    if (signal.kind === 'down') {
      this.ports.feedback('press', signal)
      if (signal.button === 'grip') this.end()
      else this.held = { pointer, from: bearing(pointer.ray), turned: this.turned }
    } else if (signal.kind === 'cancel') this.held = null
    else if (held !== null && signal.kind === 'move') {
      const way = Math.asin(Math.sin(bearing(pointer.ray) - held.from))
      this.turned = held.turned + GAIN * Math.sign(way) * Math.max(Math.abs(way) - STEADY, 0)
    } else if (held !== null && signal.kind === 'up') this.put()
  }

  /** Before each picture. step: s. */
  update(step: number): void {
    const { chosen, ghost, pointer } = this
    if (chosen === null || ghost === null) return
    if (pointer !== null && this.held === null)
      this.turned -= this.stick(pointer, 'x') * TURN_SPEED * step
    this.aim()
    ghost.root.visible = this.landed
    this.ring.visible = this.landed && chosen.reach > 0
    this.say(this.landed)
    if (!this.landed) return
    const { x, y, z } = this.land
    place(ghost.root, upright(x, y, z, this.heading))
    this.ring.position.set(x, y, z + ABOVE)
    const colour = this.hindrance === null ? CLEAR : BLOCKED
    this.ring.material.color.set(colour)
    ghost.paint(colour)
    this.ports.stir()
  }

  dispose(): void {
    this.end()
    this.ring.removeFromParent()
    this.ring.geometry.dispose()
    this.ring.material.dispose()
  }

  /** Show over the ghost why it cannot stand there, else what the buttons do. */
  private say(shown: boolean): void {
    const { room } = this.ports.words
    const { hindrance } = this
    const text = hindrance === null ? room.placingShort : room.hindered[hindrance]
    if (this.prompt !== null && (!shown || this.prompt.text !== text)) {
      this.prompt.dispose()
      this.prompt = null
    }
    if (!shown) return
    if (this.prompt === null) {
      const { colours, states } = PANEL_THEME
      this.prompt = new Label(text, PROMPT)
      this.prompt.paint(colours.card, hindrance === null ? colours.ink : states.COLLISION_HALT)
      this.ports.world.add(this.prompt.sprite)
    }
    const { x, y, z } = this.land
    this.prompt.sprite.position.set(x, y, z + OVER)
  }

  private lands(ray: Ray): boolean {
    inverse.copy(this.ports.world.matrixWorld).invert()
    local.copy(ray).applyMatrix4(inverse)
    return landing(this.ports, local.origin, local.direction, FARTHEST, this.land)
  }

  /** Find the place under the ray: it faces the viewer, turned by the stick. */
  private aim(): void {
    const { chosen, pointer, ports, land } = this
    if (this.held === null) {
      this.landed = chosen !== null && pointer !== null && this.lands(pointer.ray)
    }
    if (chosen === null || !this.landed) return
    const viewer: Vector3 = ports.world.worldToLocal(local.origin.copy(ports.head))
    const [dx, dy] = [viewer.x - land.x, viewer.y - land.y]
    const towards = Math.hypot(dx, dy) < BELOW ? 0 : Math.atan2(dy, dx)
    this.heading = squared(towards + this.turned, land, ports.supports)
    this.hindrance = hindranceAt(land, chosen.foot, ports)
  }

  private put(): void {
    const { chosen, ports } = this
    this.aim()
    if (chosen === null) return
    if (!this.landed) {
      this.end()
      return
    }
    this.held = null
    const { pose, hindrance, land } = this
    if (pose === null) {
      ports.say(ports.words.room.hindered[hindrance ?? 'thing'])
      return
    }
    this.end()
    void chosen.put(pose, land.support)
  }
}
