import { STATE_NAMES, type StateName } from '../design/tokens'
import { type PlaybackClock, positionAt } from '../playback/clock'
import { ClockedArm, type PoseSource } from '../playback/clocked_arm'
import type { Course } from '../playback/course'
import type { RemotePlayer } from '../playback/player'
import type { Time } from '../protocol/builtin_interfaces'
import {
  type Collision,
  type GraspTarget,
  PlaybackState,
  type Robot,
} from '../protocol/mrlab_msgs'
import type { JointState } from '../protocol/sensor_msgs'
import type { SceneRobot } from '../scene/robot/robot'

/** State of a robot, for the panel beside the picture. */
export interface RobotView {
  readonly robot: Robot
  readonly state: StateName
  readonly playback: PlaybackState | null
  /** The object that it holds; empty: none. */
  readonly holding: string
  /** The thing that its arm touches; empty: none. */
  readonly touching: string
  /** The places at which the loaded motion grasps and releases. */
  readonly targets: readonly GraspTarget[]
  /** The surfaces that it stands in, where contacts are not checked, as their labels. */
  readonly overlaps: readonly string[]
  /** The process that plays it does not run. */
  readonly down: boolean
  readonly player: RemotePlayer
}

/** The part of a drawn robot that is posed here. */
export type DrawnArm = Pick<SceneRobot, 'setJoint' | 'setPositions'>

/** Returns the frames of a trajectory, such as quintic@3. Rejects if they cannot be fetched. */
export type CourseOf = (trajectory: string) => Promise<Course>

/** States in which an arm is on its course, where its clock says. */
const ON_COURSE: ReadonlySet<number> = new Set([
  PlaybackState.PLAYING,
  PlaybackState.PAUSED,
  PlaybackState.COLLISION_HALT,
  PlaybackState.COMPLETE,
])
/** Larger ones are posed by their joint states alone: their frames would take tens of megabytes. */
const MOST_FRAMES = 100_000

/** Return a ROS time, s. */
export const seconds = (time: Time): number => time.sec + time.nanosec * 1e-9

/** Return the clock of a robot or a system for a timeline. In READY it shows the begin of the next
 * run: the end of the motion if the rate is negative. */
export function clockOf({ clock }: Pick<PlaybackState, 'clock'>): PlaybackClock {
  return { stamp: seconds(clock.stamp), position: clock.position, rate: clock.rate }
}

/** One robot as the messages of its lab say it is. */
export class FollowedRobot {
  urdf = ''
  holding = ''
  targets: readonly GraspTarget[] = []
  collision: Collision | null = null
  overlaps: readonly string[] = []
  /** null: it is not in the lab, or not yet. */
  robot: Robot | null = null
  private playback: PlaybackState | null = null
  private down = false
  private arm: ClockedArm | null = null
  /** The trajectory whose frames are loaded or requested. */
  private wanted = ''
  private frames: Course | null = null
  /** The drawn arm that has a pose of the lab, and not that of its URDF. */
  private posed: DrawnArm | undefined

  constructor(
    readonly player: RemotePlayer,
    private readonly courseOf: CourseOf,
  ) {}

  /** The frames of the loaded motion; null: not fetched. */
  get course(): Course | null {
    return this.frames
  }

  /** The source of its pose. */
  get source(): PoseSource {
    return this.arm?.source ?? 'none'
  }

  /** Take over that it is in the lab. */
  enter(robot: Robot): void {
    this.robot = robot
    if (this.arm?.jointNames.join() === robot.joint_names.join()) return
    this.arm = new ClockedArm(robot.joint_names)
    this.posed = undefined
    this.setClock()
    this.arm.setCourse(this.frames)
  }

  /** The node that plays it; empty: unknown. */
  get host(): string {
    return this.playback?.host ?? ''
  }

  takePlayback(message: PlaybackState): void {
    this.down = false
    this.setPlayback(message)
  }

  /** Take over that its playback ended or froze at `time`, s of lab time: it stands where it was
   * then until its playback says otherwise. */
  stop(time: number): void {
    const { playback } = this
    if (playback === null) return
    this.down = true
    const { duration } = playback
    const position = Math.min(Math.max(positionAt(clockOf(playback), time), 0), duration)
    this.setPlayback({ ...playback, clock: { ...playback.clock, position, rate: 0 } })
  }

  private setPlayback(message: PlaybackState): void {
    this.playback = message
    this.player.follow(clockOf(message), message.duration, message.rate)
    this.setClock()
    this.fetchCourse()
  }

  /** Take over joint states; now: s of lab time. Return whether a picture is due. */
  takeJoints(
    { name, position, header }: JointState,
    drawn: DrawnArm | undefined,
    now: number,
  ): boolean {
    this.arm?.take(name, position, seconds(header.stamp), now)
    if (drawn === undefined) return false
    let moved = this.arm?.moves(now) ?? false
    for (let i = 0; i < name.length; i++) {
      const joint = name[i] as string
      // the arm's joints are posed before each picture
      if (this.arm?.has(joint)) continue
      moved = drawn.setJoint(joint, position[i] as number) || moved
    }
    return moved
  }

  /** Pose it for a picture that is displayed at `time`, s of lab time. Return 'first' the first
   * time, later whether it continues to move. */
  draw(drawn: DrawnArm | undefined, time: number): 'first' | boolean {
    const { arm } = this
    if (arm === null || !arm.sample(time)) return false
    const moves = arm.moves(time)
    drawn?.setPositions(arm.positions)
    if (drawn === undefined || this.posed === drawn) return moves
    this.posed = drawn
    return 'first'
  }

  /** Return it for the panel; null: it is not in the lab. */
  get view(): RobotView | null {
    const { robot, playback, holding, targets, overlaps, down, player, collision } = this
    if (robot === null) return null
    const touching = collision?.colliding
      ? `${collision.contact.link} ↔ ${collision.contact.other}`
      : ''
    const state = STATE_NAMES[playback?.state ?? 0] ?? 'IDLE'
    return { robot, state, playback, holding, touching, targets, overlaps, down, player }
  }

  private setClock(): void {
    if (this.playback === null) return
    this.arm?.setClock(clockOf(this.playback), ON_COURSE.has(this.playback.state))
  }

  /** Have the frames of the loaded trajectory here; without them the joint states pose the
   * robot. */
  private fetchCourse(): void {
    const { playback } = this
    if (playback === null) return
    const { trajectory_id: id, trajectory_version: version } = playback
    const wanted = id === '' ? '' : `${id}@${version}`
    if (wanted === this.wanted) return
    this.wanted = wanted
    this.setCourse(null)
    if (wanted === '' || playback.frame_count > MOST_FRAMES) return
    this.courseOf(wanted).then(
      (course) => {
        if (this.wanted === wanted) this.setCourse(course)
      },
      // Not fetched: the joint states pose it.
      () => undefined,
    )
  }

  private setCourse(course: Course | null): void {
    this.frames = course
    this.arm?.setCourse(course)
  }
}

/** Pose a drawn robot by the names of its joints; return whether that moves it. */
export function setJoints(drawn: DrawnArm, { name, position }: JointState): boolean {
  let moved = false
  for (let i = 0; i < name.length; i++) {
    moved = drawn.setJoint(name[i] as string, position[i] as number) || moved
  }
  return moved
}

/** Of how many trajectories the frames are kept. */
const MOST = 24

/** The frames of trajectories, each fetched once for all robots that play it. */
export class Courses {
  private readonly known = new Map<string, Promise<Course>>()

  constructor(private readonly fetch: CourseOf) {}

  /** Return the frames of a trajectory, such as quintic@3; a failed request is repeated. */
  readonly of: CourseOf = (id) => {
    let fetching = this.known.get(id)
    if (fetching === undefined) {
      fetching = this.fetch(id)
      this.known.set(id, fetching)
      fetching.catch(() => this.known.delete(id))
      const [oldest] = this.known.keys()
      if (this.known.size > MOST && oldest !== undefined) this.known.delete(oldest)
    }
    return fetching
  }
}
