import { Group, Matrix4, type Object3D, Quaternion, Vector3 } from 'three'
import type { MeshSource } from '../robot/meshes'
import { bodyMaterial } from '../robot/robot_body'
import { type Pose, place } from '../stage/pose'
import type { SceneHost } from '../stage/renderer'
import { type Instance, Instances, partsOf } from './instances'
import { colourOf, kindOf, primitiveParts, type Shape, scaleOf } from './shapes'

/** An object of the scene: the fields of mrlab_msgs/msg/SceneObject that are drawn. */
export interface ShownObject extends Shape {
  readonly name: string
  readonly pose: Pose
  readonly held_by: string
  /** Its pose in the tool0 of the robot that holds it; a quaternion of zeros: not said. */
  readonly in_tool?: Pose
}

interface Entry {
  readonly root: Group
  heldBy: string
  /** Of the object in the tool0 that holds it. */
  readonly grip: Matrix4
  look: string
  /** Its drawing; null: none yet. */
  instance: Instance | null
  seen: boolean
}

/** The objects of the scene. One that is held moves with the hand between two messages. */
export class LabObjects {
  private readonly known = new Map<string, Entry>()
  private readonly instances: Instances
  /** Geometries and materials of primitives, disposed of at the end. */
  private readonly made: { dispose(): void }[] = []
  /** Of meshes that have their colours in their vertices. */
  private readonly own = bodyMaterial(null)
  private readonly scratch = new Matrix4()
  private readonly scale = new Vector3()
  private readonly unit = new Vector3(1, 1, 1)
  private readonly quaternion = new Quaternion()

  /** toolOf: the tool0 of a robot; undefined: there is none. */
  constructor(
    private readonly stage: SceneHost,
    private readonly meshes: MeshSource,
    private readonly toolOf: (robot: string) => Object3D | undefined,
    private readonly trouble: (mesh: string) => void,
  ) {
    this.instances = new Instances(stage.world)
  }

  /** Take over the present objects; all others disappear. */
  set(objects: readonly ShownObject[]): void {
    let changed = false
    for (const entry of this.known.values()) entry.seen = false
    for (const object of objects) {
      const entry = this.known.get(object.name) ?? this.add(object)
      entry.seen = true
      changed = this.dress(entry, object) || changed
      // A held object follows the hand.
      if (entry.heldBy === '' || entry.heldBy !== object.held_by) {
        changed = place(entry.root, object.pose) || changed
      }
      this.hold(entry, object.held_by)
      changed = this.fit(entry, object.in_tool) || changed
    }
    for (const [name, entry] of this.known) {
      if (entry.seen) continue
      changed = true
      this.known.delete(name)
      this.undress(entry)
      entry.root.removeFromParent()
    }
    if (changed) this.stage.invalidate()
  }

  /** Move one object; false: there is none of that name. */
  move(name: string, pose: Pose, heldBy: string): boolean {
    const entry = this.known.get(name)
    if (entry === undefined) return false
    place(entry.root, pose)
    this.hold(entry, heldBy)
    return true
  }

  /** Before each picture: put held objects into the hands. Matrices are current. */
  follow(): void {
    for (const entry of this.known.values()) {
      const tip = entry.heldBy === '' ? undefined : this.toolOf(entry.heldBy)
      if (tip === undefined) continue
      this.inWorld(tip).multiply(entry.grip)
      this.scratch.decompose(entry.root.position, this.quaternion, this.scale)
      entry.root.quaternion.copy(this.quaternion)
    }
    this.instances.update()
  }

  dispose(): void {
    for (const { root } of this.known.values()) root.removeFromParent()
    this.known.clear()
    this.instances.dispose()
    for (const each of this.made) each.dispose()
    this.own.dispose()
  }

  private add(object: ShownObject): Entry {
    const root = new Group()
    root.name = object.name
    const entry = {
      root,
      heldBy: '',
      grip: new Matrix4(),
      look: '',
      instance: null,
      seen: true,
    }
    this.known.set(object.name, entry)
    this.stage.world.add(root)
    return entry
  }

  /** Return the pose of a frame in the world, in the scratch matrix. */
  private worldOf(frame: Object3D): Matrix4 {
    // updateWorldMatrix passes over frames that do not compute themselves.
    this.stage.world.updateMatrixWorld(true)
    return this.inWorld(frame)
  }

  private inWorld(frame: Object3D): Matrix4 {
    this.scratch.copy(this.stage.world.matrixWorld).invert()
    return this.scratch.multiply(frame.matrixWorld)
  }

  private hold(entry: Entry, by: string): void {
    const tip = by === '' ? undefined : this.toolOf(by)
    if (tip === undefined) {
      entry.heldBy = ''
    } else if (entry.heldBy !== by) {
      entry.heldBy = by
      entry.root.updateMatrix()
      entry.grip.copy(this.worldOf(tip).invert()).multiply(entry.root.matrix)
    }
  }

  /** Put a held object at its place in the hand; return whether that is new. */
  private fit(entry: Entry, inTool: Pose | undefined): boolean {
    if (entry.heldBy === '' || inTool === undefined) return false
    const { position: p, orientation: q } = inTool
    if (q.x === 0 && q.y === 0 && q.z === 0 && q.w === 0) return false
    this.quaternion.set(q.x, q.y, q.z, q.w)
    this.scratch.compose(this.scale.set(p.x, p.y, p.z), this.quaternion, this.unit)
    if (this.scratch.equals(entry.grip)) return false
    entry.grip.copy(this.scratch)
    return true
  }

  /** Give an object its look; return whether it is another one than before. */
  private dress(entry: Entry, object: ShownObject): boolean {
    const { size, color, mesh, primitive } = object
    const dimensions = Array.from(primitive.dimensions).join()
    const look = `${mesh} ${primitive.type} ${dimensions} ${size.x} ${size.y} ${size.z} ${color.r} ${color.g} ${color.b} ${color.a}`
    if (entry.look === look) return false
    entry.look = look
    this.undress(entry)
    if (mesh === '') {
      this.drawPrimitive(entry, object)
      return true
    }
    this.meshes
      .load(mesh)
      .then((loaded) => {
        if (entry.look === look) this.drawMesh(entry, mesh, loaded)
      })
      .catch((error: unknown) => {
        console.warn(`${mesh}:`, error)
        this.trouble(mesh.slice(mesh.lastIndexOf('/') + 1))
        if (entry.look === look) this.drawPrimitive(entry, object)
      })
      .then(() => this.stage.invalidate())
    return true
  }

  private drawPrimitive(entry: Entry, object: ShownObject): void {
    const kind = kindOf(object)
    if (!this.instances.has(kind)) {
      const parts = primitiveParts(object)
      for (const { geometry, material } of parts) this.made.push(geometry, material)
      this.instances.define(kind, parts)
    }
    entry.instance = { kind, frame: entry.root, scale: scaleOf(object), colour: colourOf(object) }
    this.instances.add(entry.instance)
  }

  private drawMesh(entry: Entry, uri: string, loaded: Object3D): void {
    if (!this.instances.has(uri)) {
      const parts = partsOf(loaded, this.own)
      if (parts === null) {
        // A mesh with several materials is drawn alone.
        entry.root.add(loaded)
        return
      }
      this.made.push(...parts.flatMap((part) => (part.material === this.own ? part.geometry : [])))
      this.instances.define(uri, parts)
    }
    entry.instance = { kind: uri, frame: entry.root, scale: this.unit, colour: null }
    this.instances.add(entry.instance)
  }

  private undress(entry: Entry): void {
    if (entry.instance !== null) this.instances.remove(entry.instance)
    entry.instance = null
    entry.root.clear()
  }
}
