import type { DrawnArm } from '../../pages/lab/followed_robot'
import type { LabScene, ShownRobot } from '../../scene/lab_scene'
import type { Arms } from '../arms'
import type { RoomContext } from '../context'
import { RobotHandle } from '../handles/robot_handle'
import type { Pointer } from '../input/pointer'
import type { Targets } from '../input/targets'
import type { Overlays } from '../overlays'
import type { Place } from '../placement/supports'

/** What is told of the robots by who takes hold of them. */
export interface RobotTouch {
  /** A base was pressed and let go in place. */
  touched(name: string): void
  /** Return the stick of a pointer's controller. */
  stick(pointer: Pointer, axis: 'x' | 'y'): number
}

/** The robots of the room: each is drawn, posed by the clock, and carried by its base. */
export class RoomRobots {
  readonly handles = new Map<string, RobotHandle>()
  /** What of a robot messages move: the fingers, for its arm goes by the clock. */
  private readonly fingers = new Map<string, DrawnArm>()

  constructor(
    private readonly scene: LabScene,
    private readonly arms: Arms,
    private readonly overlays: Overlays,
    private readonly context: RoomContext,
    private readonly targets: Targets,
    private readonly touch: RobotTouch,
  ) {}

  /** Return what messages move of a robot. */
  of(name: string): DrawnArm | undefined {
    return this.fingers.get(name)
  }

  /** Where robots stand, with their names for `support`. */
  *bases(): Iterable<Place> {
    for (const name of this.handles.keys()) {
      const base = this.scene.base(name)
      if (base === undefined) continue
      const { x, y, z } = base.position
      yield { x, y, z, support: name }
    }
  }

  /** Take over the robots that there are. */
  set(robots: readonly ShownRobot[]): void {
    this.scene.setRobots(robots)
    for (const { name, urdf, joint_names } of robots) {
      const base = this.scene.base(name)
      if (urdf === '' || base === undefined) continue
      this.arms.setJoints(name, joint_names)
      const before = this.handles.get(name)
      if (before?.base === base) continue
      if (before !== undefined) this.drop(name, before)
      const { touched, stick } = this.touch
      const handle = new RobotHandle(name, base, this.scene, this.context, touched, stick)
      this.handles.set(name, handle)
      this.targets.add(handle)
      this.fingers.set(name, {
        setPositions: () => undefined,
        setJoint: (joint, value) =>
          !joint_names.includes(joint) &&
          (this.scene.robot(name)?.setJoint(joint, value) ?? false),
      })
    }
    for (const [name, handle] of this.handles) {
      if (robots.some((robot) => robot.name === name)) continue
      this.drop(name, handle)
      this.arms.forget(name)
      this.fingers.delete(name)
      this.overlays.forget(name)
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
