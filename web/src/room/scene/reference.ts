import { Vector3 } from 'three'
import type { Course } from '../../playback/course'
import type { Chain } from '../../scene/robot/chain'
import type { SceneRobot } from '../../scene/robot/robot'

const here = new Vector3()
const there = new Vector3()

/** Another motion beside that which a robot plays: a ghost of the robot at the same time of it, and
 * how far the two are apart. */
export class Reference {
  /** m at the tool, now and at most since it was chosen. */
  tool = 0
  most = 0
  /** rad or m, of each joint, now */
  readonly joints: Float64Array
  private readonly positions: Float64Array
  private readonly shown: Float64Array

  constructor(
    /** Such as quintic@2. */
    readonly motion: string,
    private readonly course: Course,
    private readonly ghost: SceneRobot,
    private readonly chain: Chain,
    readonly jointNames: readonly string[],
  ) {
    this.joints = new Float64Array(jointNames.length)
    this.positions = new Float64Array(course.jointCount)
    this.shown = new Float64Array(jointNames.length)
  }

  /** Take the pose of the motion at a time, s, and compare it with the drawn robot. */
  update(time: number, robot: SceneRobot): void {
    this.course.sample(time, this.positions)
    this.ghost.setPositions(this.positions)
    for (let i = 0; i < this.jointNames.length; i++) {
      const shown = robot.angle(this.jointNames[i] as string) ?? 0
      this.shown[i] = shown
      this.joints[i] = shown - (this.positions[i] as number)
    }
    this.chain.tool(this.shown, here)
    this.chain.tool(this.positions, there)
    this.tool = here.distanceTo(there)
    this.most = Math.max(this.most, this.tool)
  }

  /** Return the place of the joint that is farthest off. */
  worst(): number {
    let worst = 0
    for (let i = 1; i < this.joints.length; i++) {
      if (Math.abs(this.joints[i] as number) > Math.abs(this.joints[worst] as number)) worst = i
    }
    return worst
  }

  dispose(): void {
    this.ghost.dispose()
  }
}
