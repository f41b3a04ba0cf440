import { type Object3D, Vector3 } from 'three'
import type { LabScene, ShownRobot } from '../../scene/lab/lab_scene'
import { type HandlePorts, RobotHandle } from '../handles/robot_handle'
import type { Pointer } from '../input/pointer'
import type { Targets } from '../input/targets'
import type { Place } from '../place/supports'
import type { Choosing } from '../ports'
import type { Drawings } from '../scene/drawings'
import type { Overlays } from '../scene/overlays'

/** m from a robot's tip */
const AT_FINGERS = 0.08

const tip = new Vector3()

/** The robots of the room: each is drawn, and carried by its base. */
export class RoomRobots {
  readonly handles = new Map<string, RobotHandle>()

  /** stick: the stick of a pointer's controller. */
  constructor(
    private readonly scene: LabScene,
    private readonly overlays: Pick<Overlays, 'forget'>,
    private readonly drawings: Pick<Drawings, 'forget'>,
    private readonly ports: HandlePorts,
    private readonly targets: Targets,
    private readonly choosing: Choosing,
    private readonly stick: (pointer: Pointer, axis: 'x' | 'y') => number,
  ) {}

  /** Return the places of the robots' bases, each with the robot's name as `support`. */
  *bases(): Iterable<Place> {
    for (const name of this.handles.keys()) {
      const base = this.scene.base(name)
      if (base === undefined) continue
      const { x, y, z } = base.position
      yield { x, y, z, support: name }
    }
  }

  /** The frames of each robot's links, from its base to its tip. */
  *links(): Iterable<readonly Object3D[]> {
    for (const name of this.handles.keys()) {
      const robot = this.scene.robot(name)
      if (robot !== undefined) yield Object.values(robot.root.links)
    }
  }

  /** Return the robot whose fingers are at a place of the scene; empty: none is. */
  fingersAt(place: Vector3): string {
    for (const name of this.handles.keys()) {
      const robot = this.scene.robot(name)
      if (robot === undefined || robot.tip === robot.tool) continue
      if (tip.setFromMatrixPosition(robot.tip.matrixWorld).distanceTo(place) < AT_FINGERS) {
        return name
      }
    }
    return ''
  }

  /** Take over the robots that there are. */
  set(robots: readonly ShownRobot[]): void {
    this.scene.setRobots(robots)
    for (const { name, urdf, pose } of robots) {
      const base = this.scene.base(name)
      if (urdf === '' || base === undefined) continue
      const before = this.handles.get(name)
      before?.show(pose)
      if (before?.base === base) continue
      if (before !== undefined) this.drop(name, before)
      const handle = new RobotHandle(name, base, this.scene, this.ports, this.choosing, this.stick)
      handle.show(pose)
      this.handles.set(name, handle)
      this.targets.add(handle)
    }
    for (const [name, handle] of this.handles) {
      if (robots.some((robot) => robot.name === name)) continue
      this.drop(name, handle)
      this.overlays.forget(name)
      this.drawings.forget(name)
    }
  }

  /** Before each picture. now, step: s. */
  update(now: number, step: number): void {
    for (const handle of this.handles.values()) handle.update(now, step)
  }

  dispose(): void {
    for (const [name, handle] of this.handles) this.drop(name, handle)
  }

  private drop(name: string, handle: RobotHandle): void {
    this.handles.delete(name)
    this.targets.remove(handle)
    handle.dispose()
  }
}
