import { STATE_NAMES, type StateName } from '../../design/tokens'
import type { PlaybackClock } from '../../playback/clock'
import type { Course } from '../../playback/course'
import { LivePose } from '../../playback/live_pose'
import type { RemotePlayer } from '../../playback/player'
import type { Time } from '../../protocol/builtin_interfaces'
import type { Collision, GraspTarget, PlaybackState, Robot } from '../../protocol/mrlab_msgs'
import type { JointState } from '../../protocol/sensor_msgs'
import type { SceneRobot } from '../../scene/robot'

/** How one robot stands, for the panel beside the picture. */
export interface RobotView {
  readonly robot: Robot
  readonly state: StateName
  readonly playback: PlaybackState | null
  /** What it holds; empty: nothing. */
  readonly holding: string
  /** What its arm touches; empty: nothing. */
  readonly touching: string
  /** Where what is loaded grasps and releases. */
  readonly targets: readonly GraspTarget[]
  readonly player: RemotePlayer
}

/** A drawn robot as far as it is posed here. */
export type DrawnArm = Pick<SceneRobot, 'setJoint' | 'setPositions'>

/** Returns the frames of a trajectory, such as quintic@3. Rejects where they cannot be had. */
export type CourseOf = (trajectory: string) => Promise<Course>

/** Larger ones are posed by their joint states alone: their frames would take tens of megabytes. */
const MOST_FRAMES = 100_000

/** Return a ROS time, s. */
export const seconds = (time: Time): number => time.sec + time.nanosec * 1e-9

/** Return the clock of a robot or a system as a timeline takes it; where it stands in READY, the next
 * run begins: at the end where it goes backwards. */
export function clockOf({ clock }: Pick<PlaybackState, 'clock'>): PlaybackClock {
  return { stamp: seconds(clock.stamp), position: clock.position, rate: clock.rate }
}

/** One robot as the messages of its lab say it is. */
export class FollowedRobot {
  urdf = ''
  holding = ''
  targets: readonly GraspTarget[] = []
  collision: Collision | null = null
  /** null: it is not in the lab, or not yet. */
  robot: Robot | null = null
  private playback: PlaybackState | null = null
  private pose: LivePose | null = null
  /** The trajectory whose frames are here or on their way. */
  private course = ''
  /** Whether it was drawn by the clock. */
  private byClock = false
  /** Whether joint states came. */
  private heard = false
  /** What stands in a pose of the lab, rather than in that of its URDF. */
  private posed: DrawnArm | undefined

  constructor(
    readonly player: RemotePlayer,
    private readonly courseOf: CourseOf,
  ) {}

  /** Take over that it is in the lab. */
  enter(robot: Robot): void {
    this.robot = robot
    if (this.pose?.jointNames.join() === robot.joint_names.join()) return
    this.pose = new LivePose(robot.joint_names, this.player)
    this.course = ''
    this.fetchCourse()
  }

  takePlayback(message: PlaybackState): void {
    this.playback = message
    this.player.follow(clockOf(message), message.duration, message.rate)
    this.fetchCourse()
  }

  /** Take over joint states. Return 'first' where they are the first that are drawn, whether they
   * move the drawn robot otherwise. */
  takeJoints(message: JointState, drawn: DrawnArm | undefined): 'first' | boolean {
    this.pose?.take(message.name, message.position, seconds(message.header.stamp))
    this.heard = true
    if (drawn === undefined) return false
    if (this.posed !== drawn) {
      this.posed = drawn
      setJoints(drawn, message)
      return 'first'
    }
    // while the clock poses it, only the first of its pictures is asked for here
    return this.pose?.moves ? !this.byClock : setJoints(drawn, message)
  }

  /** Before a picture: pose it by its clock; return whether it moves on by itself. */
  draw(drawn: DrawnArm | undefined): boolean {
    if (this.pose === null) return false
    const { moves } = this.pose
    const fresh = this.heard && this.posed !== drawn
    // where the clock stops, the joint states say where
    if (moves || this.byClock || fresh) drawn?.setPositions(this.pose.now())
    if (fresh) this.posed = drawn
    this.byClock = moves
    return moves
  }

  /** Return it for the panel; null: it is not in the lab. */
  get view(): RobotView | null {
    const { robot, playback, holding, targets, player, collision } = this
    if (robot === null) return null
    const touching = collision?.colliding
      ? `${collision.contact.link} ↔ ${collision.contact.other}`
      : ''
    const state = STATE_NAMES[playback?.state ?? 0] ?? 'IDLE'
    return { robot, state, playback, holding, touching, targets, player }
  }

  /** Have the frames of the loaded trajectory here; without them the joint states pose the robot. */
  private fetchCourse(): void {
    const { playback, pose } = this
    if (playback === null || pose === null) return
    const { trajectory_id: id, trajectory_version: version } = playback
    const wanted = id === '' ? '' : `${id}@${version}`
    if (wanted === this.course) return
    this.course = wanted
    pose.setCourse(null)
    if (wanted === '' || playback.frame_count > MOST_FRAMES) return
    this.courseOf(wanted).then(
      (course) => {
        if (this.course === wanted && this.pose === pose) pose.setCourse(course)
      },
      () => undefined,
    )
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
