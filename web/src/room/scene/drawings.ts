import type { LabFollower } from '../../lab/follower'
import type { LabScene } from '../../scene/lab/lab_scene'
import type { SceneRobot } from '../../scene/robot/robot'
import { sentence } from '../../words/diagnostic'
import { Envelope } from './envelope'
import { Reference } from './reference'
import { ToolRibbon } from './tool_ribbon'

export type Drawing = 'path' | 'reach'

interface Drawn {
  robot: SceneRobot | null
  readonly wanted: Set<Drawing>
  /** The motion that is compared with; empty: none. */
  compared: string
  ribbon: ToolRibbon | null
  envelope: Envelope | null
  reference: Reference | null
  /** The frames of which the ribbon is. */
  course: unknown
}

/** Drawings at robots on demand: the tool's path, the reach, and the ghost of another motion. */
export class Drawings {
  private readonly robots = new Map<string, Drawn>()

  /** say: reports a motion that could not be fetched. */
  constructor(
    private readonly scene: LabScene,
    private readonly follower: () => LabFollower,
    private readonly say: (text: string) => void,
  ) {}

  has(robot: string, what: Drawing): boolean {
    return this.robots.get(robot)?.wanted.has(what) ?? false
  }

  toggle(robot: string, what: Drawing): void {
    const { wanted } = this.of(robot)
    if (!wanted.delete(what)) wanted.add(what)
  }

  /** Return the motion that a robot is compared with; empty: none. */
  comparedWith(robot: string): string {
    return this.robots.get(robot)?.compared ?? ''
  }

  /** Show the ghost of a motion, such as quintic@2, beside a robot; empty: no ghost. */
  compare(robot: string, motion: string): void {
    const drawn = this.of(robot)
    drawn.compared = motion
    drawn.reference?.dispose()
    drawn.reference = null
    if (motion === '') return
    this.follower()
      .framesOf(motion)
      .then(
        (course) => {
          const found = this.scene.robot(robot)
          if (drawn.compared !== motion || found === undefined) return
          const names = this.follower().joints(robot)
          if (course.jointCount !== names.length) return
          const ghost = this.scene.ghost(robot)
          if (ghost === undefined) return
          drawn.reference = new Reference(motion, course, ghost, found.chain(), names)
        },
        (error: unknown) => {
          drawn.compared = ''
          this.say(sentence(error))
        },
      )
  }

  /** Return the fastest that a robot's tool is on its path, m/s; NaN: the path is not drawn. */
  fastest(robot: string): number {
    return this.robots.get(robot)?.ribbon?.fastest ?? Number.NaN
  }

  /** Return how a robot compares with its ghost; null: there is none. */
  reference(robot: string): Reference | null {
    return this.robots.get(robot)?.reference ?? null
  }

  /** Before each picture, once the robots are posed; return whether another one is due. */
  update(): boolean {
    let due = false
    for (const [name, drawn] of this.robots) due = this.draw(name, drawn) || due
    return due
  }

  forget(robot: string): void {
    const drawn = this.robots.get(robot)
    if (drawn === undefined) return
    this.clear(drawn)
    this.robots.delete(robot)
  }

  dispose(): void {
    for (const name of [...this.robots.keys()]) this.forget(name)
  }

  private of(robot: string): Drawn {
    let drawn = this.robots.get(robot)
    if (drawn === undefined) {
      drawn = {
        robot: null,
        wanted: new Set(),
        compared: '',
        ribbon: null,
        envelope: null,
        reference: null,
        course: null,
      }
      this.robots.set(robot, drawn)
    }
    return drawn
  }

  private draw(name: string, drawn: Drawn): boolean {
    const robot = this.scene.robot(name)
    const base = this.scene.base(name)
    if (robot === undefined || base === undefined) return false
    if (drawn.robot !== robot) {
      // Another end effector: the drawings are of another robot.
      this.clear(drawn)
      drawn.robot = robot
      if (drawn.compared !== '') this.compare(name, drawn.compared)
    }
    const course = this.follower().course(name)
    let due = false
    const path = drawn.wanted.has('path') && course !== null
    if (drawn.ribbon !== null && (!path || drawn.course !== course)) {
      drawn.ribbon.dispose()
      drawn.ribbon = null
      due = true
    }
    if (path && drawn.ribbon === null) {
      drawn.ribbon = new ToolRibbon(robot.chain(), course, base)
      drawn.course = course
      due = true
    }
    const reach = drawn.wanted.has('reach')
    if (!reach && drawn.envelope !== null) {
      drawn.envelope.dispose()
      drawn.envelope = null
      due = true
    }
    if (reach && drawn.envelope === null) {
      const joints = this.follower().joints(name).length
      drawn.envelope = new Envelope(robot.chain(), joints, base, -base.position.z)
    }
    due = drawn.envelope?.update() || due
    drawn.reference?.update(this.follower().positionOf(name), robot)
    return due
  }

  private clear(drawn: Drawn): void {
    drawn.ribbon?.dispose()
    drawn.envelope?.dispose()
    drawn.reference?.dispose()
    drawn.ribbon = drawn.envelope = drawn.reference = null
  }
}
