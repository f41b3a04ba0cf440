import { ConeGeometry, Matrix4, Mesh, MeshBasicMaterial, Quaternion, Ray, Vector3 } from 'three'
import type { LookHere } from '../../lab/people/look_here'
import type { Hit, Signal, Target } from '../input/pointer'
import type { Targets } from '../input/targets'
import { Panel, type Surroundings } from '../panels/panel'
import { type Ground, landing, type Place } from '../place/supports'
import type { Frames, Speech, Viewer } from '../ports'

/** m along a ray that meets nothing. */
const AIR = 2
const FARTHEST = 8
/** Cosine of the angle from the middle of the view up to which a mark needs no arrow. */
const SEEN = Math.cos((22 * Math.PI) / 180)
/** m, of the arrow from the eyes; and how far it is from the middle of the view. */
const BEFORE = 0.8
const ASIDE = 0.22
const UP = new Vector3(0, 1, 0)

const inverse = new Matrix4()
const local = new Ray()
const towards = new Vector3()
const forwards = new Vector3()
const turn = new Quaternion()

/** Shows a teacher's ray, whose next press asks everybody to look at the point that it meets; and
 * to all an arrow at the edge of the view while the mark is out of sight. */
export class Pointing implements Target {
  active = false
  private readonly land: Place = { x: 0, y: 0, z: 0, support: '' }
  private readonly arrow = new Mesh(
    new ConeGeometry(0.018, 0.06, 20),
    new MeshBasicMaterial({ color: 0xffc94d, depthTest: false, transparent: true }),
  )

  /** changed: it began or ended. */
  constructor(
    private readonly ports: Speech & Frames & Ground & Surroundings,
    private readonly targets: Targets,
    private readonly lookHere: LookHere,
    private readonly changed: () => void,
  ) {
    this.arrow.visible = false
    this.arrow.renderOrder = 20
  }

  /** Let the next press point, or put this away. */
  toggle(): void {
    if (this.active) {
      this.end()
      return
    }
    this.active = true
    this.targets.narrow((target) => target === this || target instanceof Panel)
    this.targets.add(this)
    this.ports.say(this.ports.words.room.pointing, false)
    this.changed()
  }

  end(): void {
    if (!this.active) return
    this.active = false
    this.targets.remove(this)
    this.targets.widen()
    this.changed()
  }

  cast(ray: Ray, hit: Hit): boolean {
    inverse.copy(this.ports.world.matrixWorld).invert()
    local.copy(ray).applyMatrix4(inverse)
    if (landing(this.ports, local.origin, local.direction, FARTHEST, this.land)) {
      this.ports.world.localToWorld(hit.point.set(this.land.x, this.land.y, this.land.z))
    } else ray.at(AIR, hit.point)
    hit.distance = hit.point.distanceTo(ray.origin)
    return true
  }

  on(signal: Signal): void {
    if (signal.kind !== 'down') return
    this.ports.feedback('press', signal)
    if (signal.button === 'select') {
      this.lookHere.ask(this.ports.world.worldToLocal(towards.copy(signal.pointer.hit.point)))
    }
    this.end()
  }

  /** Before each picture: the arrow. */
  update({ head, look }: Viewer): void {
    const { arrow, lookHere, ports } = this
    const { point } = lookHere
    arrow.visible = false
    if (point === null) return
    ports.world.localToWorld(towards.copy(point)).sub(head).normalize()
    forwards.set(0, 0, -1).applyQuaternion(look)
    const ahead = towards.dot(forwards)
    if (ahead > SEEN) return
    if (arrow.parent === null) ports.world.parent?.parent?.add(arrow)
    // The part of the way that is across the view.
    towards.addScaledVector(forwards, -ahead)
    if (towards.lengthSq() < 1e-6) towards.set(1, 0, 0).applyQuaternion(look)
    towards.normalize()
    arrow.quaternion.copy(turn.setFromUnitVectors(UP, towards))
    arrow.position.copy(head).addScaledVector(forwards, BEFORE).addScaledVector(towards, ASIDE)
    arrow.visible = true
  }

  dispose(): void {
    this.end()
    this.arrow.removeFromParent()
    this.arrow.geometry.dispose()
    this.arrow.material.dispose()
  }
}
