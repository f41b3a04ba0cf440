import { signal } from '@preact/signals'
import type { StateName } from '../design/tokens'
import type { Link, LinkStatus, Sample } from '../link/link'
import type { PoseSource } from '../playback/clocked_arm'
import type { Course } from '../playback/course'
import type { Commands } from '../playback/player'
import { RemotePlayer } from '../playback/player'
import { diagnosticArrayReader } from '../protocol/diagnostic_msgs'
import type { MessageReader } from '../protocol/message_type'
import {
  collisionReader,
  contactsReader,
  Grasp,
  graspReader,
  graspTargetsReader,
  LabProcess,
  labProcessesReader,
  overlapsReader,
  type Place,
  placeReader,
  playbackStateReader,
  RecorderState,
  type Robot,
  type RobotSystem,
  recorderStateReader,
  robotSystemsReader,
  robotsReader,
  type Surface,
  sceneObjectsReader,
  surfacesReader,
} from '../protocol/mrlab_msgs'
import { jointStateReader } from '../protocol/sensor_msgs'
import { stringReader } from '../protocol/std_msgs'
import type { LabScene } from '../scene/lab/lab_scene'
import {
  type CourseOf,
  Courses,
  clockOf,
  type DrawnArm,
  FollowedRobot,
  type RobotView,
  seconds,
  setJoints,
} from './followed_robot'
import { backUntil, holds, type Outage, outagesOf } from './outages'
import { type SessionStop, stopsOf } from './stops'
import { Undoing } from './undoing'

/** s: contacts are published at 50 Hz, and not at all while there are none. */
const CONTACT_S = 0.3
const NO_CONTACTS: readonly never[] = []
/** Behind the state of a robot that stands in a surface. */
const NOT_CHECKED = '⚠'

export interface SystemView {
  readonly system: RobotSystem
  readonly player: RemotePlayer
}

/** Activity of a key: the number of messages, and the time of the newest one. */
interface KeyActivity {
  readonly type: string
  count: number
  /** s, of the lab's clock */
  newest: number
}

/** The part of a LabScene that a follower calls. */
export type FollowedScene = Pick<
  LabScene,
  | 'setRobots'
  | 'setState'
  | 'setTargets'
  | 'setCollision'
  | 'setObjects'
  | 'setSurfaces'
  | 'setContacts'
  | 'frame'
> & { robot(name: string): DrawnArm | undefined }

/** The functions that a follower takes from its page. */
interface FollowerOptions {
  /** Return the commands of a robot or a system, by name; of the recorder's replay, by
   * 'recorder'. */
  commands(name: string): Commands
  word(state: StateName): string
  colour(state: StateName): string
  /** A picture is due. */
  stir(): void
  courseOf: CourseOf
}

/** Follows a lab over its link: moves the scene, and sets the signals that panels show. */
export class LabFollower {
  readonly status = signal<LinkStatus>({ phase: 'connecting', reason: '', roundTrip: Number.NaN })
  readonly robots = signal<readonly RobotView[]>([])
  readonly systems = signal<readonly SystemView[]>([])
  readonly recorder = signal<RecorderState | null>(null)
  /** Processes of the lab that do not run, or run again since a short while. */
  readonly outages = signal<readonly Outage[]>([])
  readonly replay: RemotePlayer
  /** What happened in the session that is replayed; none until the recorder has read it. */
  readonly stops = signal<readonly SessionStop[]>([])
  /** The place in which the robots stand; null: the lab has not said. */
  readonly place = signal<Place | null>(null)
  readonly undoing: Undoing
  /** True once the lab has published its robots. */
  readonly known = signal(false)
  readonly activity = new Map<string, KeyActivity>()
  scene: FollowedScene | null = null
  private readonly kept = new Map<string, FollowedRobot>()
  private readonly courses: Courses
  private readonly systemPlayers = new Map<string, RemotePlayer>()
  /** As the lab has them. */
  surfaces: readonly Surface[] = []
  private processes: readonly LabProcess[] = []
  /** Ends the naming of a process that runs again. */
  private outageTimer: ReturnType<typeof setTimeout> | undefined
  /** Names in the lab's order. */
  private order: readonly string[] = []
  /** Lab time at which the link was lost, s. */
  private heldAt: number | null = null
  /** Lab time of the newest contacts that are shown, s. */
  private contactAt = Number.NaN
  private readonly undo: (() => void)[]

  constructor(
    readonly link: Link,
    private readonly options: FollowerOptions,
  ) {
    const labTime = () => link.labTime()
    this.courses = new Courses(options.courseOf)
    this.replay = new RemotePlayer('bag', labTime, options.commands('recorder'))
    this.status.value = link.status
    this.undoing = new Undoing(link)
    this.undo = [
      () => this.undoing.dispose(),
      link.onStatus((status) => {
        this.status.value = status
        this.hold()
      }),
      this.on('robots', robotsReader, (message) => this.takeRobots(message.robots)),
      this.on('*/robot_description', stringReader, (message, { key }) => {
        const name = owner(key)
        // Links are named as their frames; the scene and the contacts know them by the plain name.
        this.of(name).urdf = message.data.replaceAll(`="${name}/`, '="')
        this.show()
      }),
      this.on('*/joint_states', jointStateReader, (message, { key }) => {
        const name = owner(key)
        const drawn = this.scene?.robot(name)
        if (this.of(name).takeJoints(message, drawn, link.labTime())) options.stir()
      }),
      this.on('*/finger_states', jointStateReader, (message, { key }) => {
        const drawn = this.scene?.robot(owner(key))
        if (drawn !== undefined && setJoints(drawn, message)) options.stir()
      }),
      this.on('*/playback_state', playbackStateReader, (message, { key }) => {
        this.of(owner(key)).takePlayback(message)
        options.stir()
        this.show()
      }),
      this.on('*/targets', graspTargetsReader, (message, { key }) => {
        this.of(owner(key)).targets = message.targets
        this.show()
      }),
      this.on('*/grasp', graspReader, (message, { key }) => {
        const name = owner(key)
        const drawn = this.scene?.robot(name)
        for (let i = 0; i < message.fingers.length; i++) {
          drawn?.setJoint(message.fingers[i] as string, message.finger_positions[i] as number)
        }
        this.of(name).holding = message.state === Grasp.HOLDING ? message.object : ''
        this.show()
      }),
      this.on('*/collision', collisionReader, (message, { key }) => {
        this.of(owner(key)).collision = message
        this.show()
      }),
      this.on('objects', sceneObjectsReader, (message) => this.scene?.setObjects(message.objects)),
      this.on('surfaces', surfacesReader, (message) => {
        this.surfaces = message.surfaces
        this.scene?.setSurfaces(message.surfaces)
      }),
      this.on('overlaps', overlapsReader, ({ overlaps }) => {
        for (const { robot } of overlaps) this.of(robot)
        for (const [name, followed] of this.kept) {
          const here = overlaps.filter(({ robot }) => robot === name)
          followed.overlaps = here.map(({ label, surface }) => label || surface)
        }
        this.show()
      }),
      this.on('place', placeReader, (message) => {
        this.place.value = message
      }),
      this.on('contacts', contactsReader, ({ contacts }) => {
        this.contactAt = link.labTime()
        this.scene?.setContacts(contacts)
      }),
      this.on('systems', robotSystemsReader, (message) => this.takeSystems(message.systems)),
      this.on('processes', labProcessesReader, (message) => this.takeProcesses(message.processes)),
      this.on('recorder/stops', diagnosticArrayReader, (message) => {
        this.stops.value = stopsOf(message)
      }),
      this.on('recorder/state', recorderStateReader, (message) => this.takeRecorder(message)),
    ]
  }

  /** True while a bag is replayed in place of the live lab. */
  get replays(): boolean {
    const state = this.recorder.value?.state
    return state === RecorderState.REPLAYING || state === RecorderState.PAUSED
  }

  /** Give the scene the known state; call it when the scene is made. */
  attach(scene: FollowedScene): void {
    this.scene = scene
    scene.setSurfaces(this.surfaces)
    this.show()
  }

  /** Before each picture: pose the robots for its display, `ahead`, s, from now; return whether
   * one continues to move. Without the link all keep their last pose. */
  pose(ahead = 0): boolean {
    const time = this.heldAt ?? this.link.labTime() + ahead
    let more = false
    if (time - this.contactAt > CONTACT_S) {
      this.contactAt = Number.NaN
      this.scene?.setContacts(NO_CONTACTS)
    }
    for (const [name, followed] of this.kept) {
      const moves = followed.draw(this.scene?.robot(name), time)
      if (moves === 'first') this.scene?.frame()
      if (moves !== false) more = true
    }
    return more
  }

  /** Return the source of a robot's shown pose. */
  source(name: string): PoseSource {
    return this.kept.get(name)?.source ?? 'none'
  }

  /** Return the frames of a robot's loaded motion; null: not fetched. */
  course(name: string): Course | null {
    return this.kept.get(name)?.course ?? null
  }

  /** Return the frames of a trajectory, such as quintic@3. Rejects if they cannot be fetched. */
  framesOf(trajectory: string): Promise<Course> {
    return this.courses.of(trajectory)
  }

  /** Return the joints of a robot, base first. */
  joints(name: string): readonly string[] {
    return this.kept.get(name)?.robot?.joint_names ?? []
  }

  /** Return where a robot is on its trajectory now, s. */
  positionOf(name: string): number {
    return this.kept.get(name)?.player.position() ?? 0
  }

  dispose(): void {
    clearTimeout(this.outageTimer)
    for (const undo of this.undo) undo()
  }

  private on<T>(
    key: string,
    type: MessageReader<T>,
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

  private of(name: string): FollowedRobot {
    let followed = this.kept.get(name)
    if (followed === undefined) {
      const { commands } = this.options
      const player = new RemotePlayer('live', () => this.link.labTime(), commands(name))
      player.hold(this.lost)
      followed = new FollowedRobot(player, this.courses.of)
      this.kept.set(name, followed)
    }
    return followed
  }

  private get lost(): boolean {
    return this.status.value.phase !== 'open'
  }

  /** True without a link: everything keeps its last pose. */
  private hold(): void {
    const { lost } = this
    this.heldAt = lost ? (this.heldAt ?? this.link.labTime()) : null
    for (const { player } of this.kept.values()) player.hold(lost)
    for (const player of this.systemPlayers.values()) player.hold(lost)
    this.replay.hold(lost)
    this.options.stir()
  }

  private takeRobots(robots: readonly Robot[]): void {
    this.order = robots.map(({ name }) => name)
    const there = new Set(this.order)
    for (const [name, followed] of this.kept) {
      // One that was never in a list may be in the next: its other messages may come first.
      if (followed.robot !== null && !there.has(name)) this.forget(name)
    }
    for (const robot of robots) this.of(robot.name).enter(robot)
    this.known.value = true
    this.show()
  }

  private forget(name: string): void {
    this.kept.delete(name)
    for (const key of this.activity.keys()) if (owner(key) === name) this.activity.delete(key)
  }

  private takeSystems(systems: readonly RobotSystem[]): void {
    const there = new Set(systems.map(({ name }) => name))
    for (const name of this.systemPlayers.keys()) {
      if (!there.has(name)) this.systemPlayers.delete(name)
    }
    this.systems.value = systems.map((system) => {
      let player = this.systemPlayers.get(system.name)
      if (player === undefined) {
        player = new RemotePlayer(
          'live',
          () => this.link.labTime(),
          this.options.commands(system.name),
        )
        player.hold(this.lost)
        this.systemPlayers.set(system.name, player)
      }
      player.follow(clockOf(system), system.duration, system.rate)
      return { system, player }
    })
  }

  private takeProcesses(processes: readonly LabProcess[]): void {
    const known = new Map(this.processes.map((each) => [each.name, seconds(each.down)]))
    this.processes = processes
    for (const process of processes) {
      const down = seconds(process.down)
      if (process.state === LabProcess.RUNNING || down <= (known.get(process.name) ?? 0)) continue
      for (const followed of this.kept.values()) {
        if (holds(process, followed.host)) followed.stop(down)
      }
    }
    this.showOutages()
    this.options.stir()
    this.show()
  }

  /** Show the outages of now, and again when a process that runs need not be named any more. */
  private showOutages(): void {
    clearTimeout(this.outageTimer)
    const now = this.link.labTime()
    this.outages.value = outagesOf(this.processes, now)
    const next = Math.min(...this.processes.map(backUntil).filter((until) => until > now))
    if (Number.isFinite(next)) {
      this.outageTimer = setTimeout(() => this.showOutages(), (next - now) * 1000 + 100)
    }
  }

  private takeRecorder(state: RecorderState): void {
    this.recorder.value = state
    // Its state is published once a second; in between the clock runs at its rate.
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
    for (const name of this.order) {
      const view = this.kept.get(name)?.view ?? null
      if (view !== null) views.push(view)
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
    for (const { robot, state, targets, overlaps } of views) {
      const collision = this.kept.get(robot.name)?.collision
      const { word, colour } = this.options
      const mark = overlaps.length > 0 ? ` ${NOT_CHECKED}` : ''
      scene.setState(robot.name, word(state) + mark, colour(state), state === 'COLLISION_HALT')
      scene.setTargets(robot.name, targets)
      scene.setCollision(robot.name, collision?.colliding ? collision.contact.link : '')
    }
  }
}

/** Return the robot that a key belongs to. */
function owner(key: string): string {
  return key.slice(0, key.indexOf('/'))
}
