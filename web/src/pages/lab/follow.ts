import { signal } from '@preact/signals'
import { STATE_NAMES, type StateName } from '../../design/tokens'
import type { Link, LinkStatus, MessageType, Sample } from '../../link/link'
import type { Commands } from '../../playback/player'
import { RemotePlayer } from '../../playback/player'
import type { Time } from '../../protocol/builtin_interfaces'
import {
  type Collision,
  collisionType,
  contactsType,
  Grasp,
  graspType,
  type PlaybackState,
  playbackStateType,
  type RecorderState,
  type Robot,
  type RobotSystem,
  recorderStateType,
  robotSystemsType,
  robotsType,
  sceneObjectsType,
} from '../../protocol/mrlab_msgs'
import { jointStateType } from '../../protocol/sensor_msgs'
import { stringType } from '../../protocol/std_msgs'
import type { LabScene } from '../../scene/lab_scene'

/** How one robot stands, for the panel beside the picture. */
export interface RobotView {
  readonly robot: Robot
  readonly state: StateName
  readonly playback: PlaybackState | null
  /** What it holds; empty: nothing. */
  readonly holding: string
  /** What its arm touches; empty: nothing. */
  readonly touching: string
  readonly player: RemotePlayer
}

export interface SystemView {
  readonly system: RobotSystem
  readonly player: RemotePlayer
}

/** What came on a key: how many messages, and when the newest one did. */
export interface KeyActivity {
  readonly type: string
  count: number
  /** s, of the lab's clock */
  newest: number
}

interface Kept {
  robot: Robot | null
  urdf: string
  playback: PlaybackState | null
  holding: string
  collision: Collision | null
  /** Whether it stands in a pose of the lab, rather than in that of its URDF. */
  posed: boolean
  readonly player: RemotePlayer
}

const seconds = (time: Time): number => time.sec + time.nanosec * 1e-9

/** Follows a lab over its link: the scene gets what moves, the signals what a panel shows. */
export class LabFollower {
  readonly status = signal<LinkStatus>({ phase: 'connecting', reason: '', roundTrip: Number.NaN })
  readonly robots = signal<readonly RobotView[]>([])
  readonly systems = signal<readonly SystemView[]>([])
  readonly recorder = signal<RecorderState | null>(null)
  readonly replay: RemotePlayer
  /** Whether the lab has said which robots there are. */
  readonly known = signal(false)
  readonly activity = new Map<string, KeyActivity>()
  scene: LabScene | null = null
  private readonly kept = new Map<string, Kept>()
  private readonly systemPlayers = new Map<string, RemotePlayer>()
  private readonly undo: (() => void)[]

  /** commands: of a robot or a system, by name; of the recorder's replay, by 'recorder'. stir: a
   * picture is due. */
  constructor(
    readonly link: Link,
    private readonly commands: (name: string) => Commands,
    private readonly word: (state: StateName) => string,
    private readonly colour: (state: StateName) => string,
    private readonly stir: () => void,
  ) {
    const labTime = () => link.labTime()
    this.replay = new RemotePlayer('bag', labTime, commands('recorder'))
    this.status.value = link.status
    this.undo = [
      link.onStatus((status) => {
        this.status.value = status
      }),
      this.on('robots', robotsType, (message) => this.takeRobots(message.robots)),
      this.on('*/robot_description', stringType, (message, { key }) => {
        this.of(owner(key)).urdf = message.data
        this.show()
      }),
      this.on('*/joint_states', jointStateType, (message, { key }) => {
        const robot = this.scene?.robot(owner(key))
        if (robot === undefined) return
        let moved = false
        for (let i = 0; i < message.name.length; i++) {
          moved = robot.setJoint(message.name[i] as string, message.position[i] as number) || moved
        }
        const kept = this.of(owner(key))
        if (!kept.posed) {
          kept.posed = true
          this.scene?.frame()
        }
        if (moved) this.stir()
      }),
      this.on('*/playback_state', playbackStateType, (message, { key }) => {
        const kept = this.of(owner(key))
        kept.playback = message
        const { clock, duration, rate } = message
        const stamp = seconds(clock.stamp)
        kept.player.follow({ stamp, position: clock.position, rate: clock.rate }, duration, rate)
        this.show()
      }),
      this.on('*/grasp', graspType, (message, { key }) => {
        const name = owner(key)
        const robot = this.scene?.robot(name)
        for (let i = 0; i < message.fingers.length; i++) {
          robot?.setJoint(message.fingers[i] as string, message.finger_positions[i] as number)
        }
        this.of(name).holding = message.state === Grasp.HOLDING ? message.object : ''
        this.show()
      }),
      this.on('*/collision', collisionType, (message, { key }) => {
        this.of(owner(key)).collision = message
        this.show()
      }),
      this.on('objects', sceneObjectsType, (message) => this.scene?.setObjects(message.objects)),
      this.on('contacts', contactsType, (message) => this.scene?.setContacts(message.contacts)),
      this.on('systems', robotSystemsType, (message) => this.takeSystems(message.systems)),
      this.on('recorder/state', recorderStateType, (message) => this.takeRecorder(message)),
    ]
  }

  /** Give the scene what is known; call it when the scene is there. */
  attach(scene: LabScene): void {
    this.scene = scene
    this.show()
  }

  dispose(): void {
    for (const undo of this.undo) undo()
  }

  private on<T>(
    key: string,
    type: MessageType<T>,
    listener: (message: T, sample: Sample) => void,
  ): () => void {
    return this.link.subscribe(key, type, (message, sample) => {
      let activity = this.activity.get(sample.key)
      if (activity === undefined) {
        activity = { type: type.name, count: 0, newest: 0 }
        this.activity.set(sample.key, activity)
      }
      activity.count++
      activity.newest = Number.isNaN(sample.stamp) ? this.link.labTime() : sample.stamp
      listener(message, sample)
    })
  }

  private of(name: string): Kept {
    let kept = this.kept.get(name)
    if (kept === undefined) {
      const player = new RemotePlayer('live', () => this.link.labTime(), this.commands(name))
      kept = {
        robot: null,
        urdf: '',
        playback: null,
        holding: '',
        collision: null,
        posed: false,
        player,
      }
      this.kept.set(name, kept)
    }
    return kept
  }

  private takeRobots(robots: readonly Robot[]): void {
    for (const kept of this.kept.values()) kept.robot = null
    for (const robot of robots) this.of(robot.name).robot = robot
    this.known.value = true
    this.show()
  }

  private takeSystems(systems: readonly RobotSystem[]): void {
    this.systems.value = systems.map((system) => {
      let player = this.systemPlayers.get(system.name)
      if (player === undefined) {
        player = new RemotePlayer('live', () => this.link.labTime(), this.commands(system.name))
        this.systemPlayers.set(system.name, player)
      }
      const { clock, duration, rate } = system
      const stamp = seconds(clock.stamp)
      player.follow({ stamp, position: clock.position, rate: clock.rate }, duration, rate)
      return { system, player }
    })
  }

  private takeRecorder(state: RecorderState): void {
    this.recorder.value = state
    // its state comes once a second; in between the clock goes on at its rate
    const goes = state.state === 2
    this.replay.follow(
      {
        stamp: seconds(state.header.stamp),
        position: state.position,
        rate: goes ? state.rate : 0,
      },
      state.duration,
      state.rate,
    )
  }

  private show(): void {
    const views: RobotView[] = []
    for (const { robot, playback, holding, collision, player } of this.kept.values()) {
      if (robot === null) continue
      const state = STATE_NAMES[playback?.state ?? 0] ?? 'IDLE'
      const touching = collision?.colliding
        ? `${collision.contact.link} ↔ ${collision.contact.other}`
        : ''
      views.push({ robot, state, playback, holding, touching, player })
    }
    this.robots.value = views
    const { scene } = this
    if (scene === null) return
    scene.setRobots(
      views.map(({ robot }) => ({
        name: robot.name,
        urdf: this.kept.get(robot.name)?.urdf ?? '',
        pose: robot.pose,
        joint_names: robot.joint_names,
      })),
    )
    for (const { robot, state } of views) {
      const collision = this.kept.get(robot.name)?.collision
      scene.setState(robot.name, this.word(state), this.colour(state), state === 'COLLISION_HALT')
      scene.setCollision(robot.name, collision?.colliding ? collision.contact.link : '')
    }
  }
}

/** Return the robot that a key belongs to. */
function owner(key: string): string {
  return key.slice(0, key.indexOf('/'))
}
