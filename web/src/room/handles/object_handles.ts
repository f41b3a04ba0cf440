import type { Vector3 } from 'three'
import type { SceneObject } from '../../protocol/mrlab_msgs'
import type { ShownObject } from '../../scene/lab/lab_objects'
import type { LabScene } from '../../scene/lab/lab_scene'
import type { Targets } from '../input/targets'
import type { Obstacle } from '../place/supports'
import { ObjectHandle, type ObjectPorts } from './object_handle'

/** m */
const NEAR = 0.15

/** A handle for each object of the scene. */
export class ObjectHandles {
  private readonly handles = new Map<string, ObjectHandle>()

  /** robotAt: the robot whose fingers are at a place; empty: none. counted: their number
   * changed. */
  constructor(
    private readonly scene: LabScene,
    private readonly ports: ObjectPorts,
    private readonly targets: Targets,
    private readonly robotAt: (place: Vector3) => string,
    private readonly counted: () => void,
  ) {}

  get count(): number {
    return this.handles.size
  }

  set(objects: readonly ShownObject[]): void {
    const before = this.handles.size
    const here = new Set<string>()
    for (const object of objects as readonly SceneObject[]) {
      here.add(object.name)
      const handle = this.handles.get(object.name)
      if (handle !== undefined) handle.show(object)
      else this.add(object)
    }
    for (const [name, handle] of this.handles) {
      if (here.has(name)) continue
      this.handles.delete(name)
      this.targets.remove(handle)
    }
    if (this.handles.size !== before) this.counted()
  }

  /** Return the free object nearest to a place of the scene; empty: none is near. */
  nearest(place: Vector3): string {
    let found = ''
    let least = NEAR
    for (const [name, handle] of this.handles) {
      const distance = handle.free ? handle.distanceTo(place) : Number.POSITIVE_INFINITY
      if (distance >= least) continue
      least = distance
      found = name
    }
    return found
  }

  /** What lies or stands free. */
  *obstacles(): Iterable<Obstacle> {
    for (const { obstacle } of this.handles.values()) if (obstacle !== null) yield obstacle
  }

  /** Before each picture. now: s. */
  update(now: number): void {
    for (const handle of this.handles.values()) handle.update(now)
  }

  dispose(): void {
    for (const handle of this.handles.values()) {
      this.targets.remove(handle)
    }
    this.handles.clear()
  }

  private add(object: SceneObject): void {
    const handle = new ObjectHandle(object, this.scene, this.ports, this.robotAt)
    this.handles.set(object.name, handle)
    this.targets.add(handle)
  }
}
