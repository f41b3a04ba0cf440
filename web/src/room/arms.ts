import type { Link } from '../link/link'
import { ClockedArm } from '../playback/clocked_arm'
import { Course } from '../playback/course'
import type { Time } from '../protocol/builtin_interfaces'
import {
  getTrajectoryType,
  PlaybackState,
  playbackStateType,
  type Trajectory,
} from '../protocol/mrlab_msgs'
import { jointStateType } from '../protocol/sensor_msgs'
import type { LabScene } from '../scene/lab_scene'

/** s: a motion of minutes comes in one answer. */
const FETCH_TIMEOUT_S = 30
/** s: what a change of the clock moves has come to rest by then. */
const SETTLE_S = 0.4
const MOVING: ReadonlySet<number> = new Set([PlaybackState.ADJUSTING, PlaybackState.PLAYING])
const ON_COURSE: ReadonlySet<number> = new Set([
  PlaybackState.PLAYING,
  PlaybackState.PAUSED,
  PlaybackState.COLLISION_HALT,
  PlaybackState.COMPLETE,
])

const seconds = ({ sec, nanosec }: Time): number => sec + nanosec * 1e-9

interface Arm {
  joints: readonly string[]
  arm: ClockedArm
  state: PlaybackState | null
  /** id@version of the course that the arm has, or that is on its way. */
  wanted: string
}

/** Moves the robots of the room: each trajectory is fetched once, and its pose taken at the instant
 * at which a picture is shown. */
export class Arms {
  private readonly arms = new Map<string, Arm>()
  private readonly courses = new Map<string, Promise<Trajectory | null>>()
  private readonly undo: (() => void)[]
  private movesUntil = 0

  /** say: is told what could not be fetched. */
  constructor(
    private readonly link: Link,
    private readonly scene: LabScene,
    private readonly say: (text: string) => void,
  ) {
    this.undo = [
      link.subscribe('*/joint_states', jointStateType, (message, { key }) => {
        const arm = this.arms.get(key.slice(0, key.indexOf('/')))
        if (arm === undefined) return
        const stamp = seconds(message.header.stamp)
        arm.arm.take(message.name, message.position, stamp, link.labTime())
      }),
      link.subscribe('*/playback_state', playbackStateType, (message, { key }) => {
        const name = key.slice(0, key.indexOf('/'))
        this.takeState(this.of(name), message)
      }),
    ]
  }

  /** Say which joints a robot has, base first. */
  setJoints(name: string, joints: readonly string[]): void {
    const arm = this.of(name)
    if (arm.joints.join() === joints.join()) return
    arm.joints = [...joints]
    arm.arm = new ClockedArm(joints)
    arm.wanted = ''
    if (arm.state !== null) this.takeState(arm, arm.state)
  }

  forget(name: string): void {
    this.arms.delete(name)
  }

  /** Move every robot to where it is at a lab time, s; return whether one moves. */
  update(time: number): boolean {
    for (const [name, { arm, state }] of this.arms) {
      const robot = this.scene.robot(name)
      if (robot === undefined || !arm.sample(time)) continue
      robot.setPositions(arm.positions)
      if (MOVING.has(state?.state ?? 0)) this.movesUntil = time + SETTLE_S
    }
    return time < this.movesUntil
  }

  /** Return the source of a robot's pose, for who wants to know why it moves as it does. */
  source(name: string): string {
    return this.arms.get(name)?.arm.source ?? 'none'
  }

  dispose(): void {
    for (const undo of this.undo) undo()
  }

  private of(name: string): Arm {
    let arm = this.arms.get(name)
    if (arm === undefined) {
      arm = {
        joints: [],
        arm: new ClockedArm([]),
        state: null,
        wanted: '',
      }
      this.arms.set(name, arm)
    }
    return arm
  }

  private takeState(arm: Arm, state: PlaybackState): void {
    arm.state = state
    this.movesUntil = this.link.labTime() + SETTLE_S
    const { clock, trajectory_id: id, trajectory_version: version } = state
    arm.arm.setClock(
      { stamp: seconds(clock.stamp), position: clock.position, rate: clock.rate },
      ON_COURSE.has(state.state),
    )
    if (arm.joints.length === 0) return
    const wanted = id === '' ? '' : version > 0 ? `${id}@${version}` : id
    if (wanted === arm.wanted) return
    arm.wanted = wanted
    arm.arm.setCourse(null)
    if (wanted === '') return
    this.fetch(wanted).then((trajectory) => {
      if (arm.wanted === wanted && trajectory !== null) {
        arm.arm.setCourse(courseFor(arm.joints, trajectory))
      }
    })
  }

  private fetch(id: string): Promise<Trajectory | null> {
    let fetching = this.courses.get(id)
    if (fetching === undefined) {
      const request = { id, file_only: false, begin: 0, count: 0 }
      fetching = this.link
        .call('converter/get', getTrajectoryType, request, FETCH_TIMEOUT_S)
        .then((answer) => {
          if (!answer.success) throw new Error(answer.message)
          return answer.trajectory
        })
        .catch((error: Error) => {
          // without it the arm follows its joint states
          this.courses.delete(id)
          this.say(error.message)
          return null
        })
      this.courses.set(id, fetching)
    }
    return fetching
  }
}

/** Return the course of a trajectory with its columns in the order of `joints`; null where it has
 * other joints or no frames. */
export function courseFor(joints: readonly string[], trajectory: Trajectory): Course | null {
  const columns = joints.map((joint) => trajectory.joint_names.indexOf(joint))
  const count = joints.length
  const frames = trajectory.positions.length / count
  if (columns.includes(-1) || !Number.isInteger(frames) || frames < 1) return null
  const positions = new Float64Array(trajectory.positions.length)
  for (let frame = 0; frame < frames; frame++) {
    for (let joint = 0; joint < count; joint++) {
      const column = columns[joint] as number
      positions[frame * count + joint] = trajectory.positions[frame * count + column] as number
    }
  }
  return new Course(trajectory.info.frame_rate, count, positions)
}
