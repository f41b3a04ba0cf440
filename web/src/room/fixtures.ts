import type { Signal } from '@preact/signals'
import type { Quaternion, Vector3 } from 'three'
import type { Lesson } from '../classroom/lesson'
import type { CourseOf } from '../lab/followed_robot'
import type { LabFollower } from '../lab/follower'
import type { CheckApi } from '../lab/robot_check'
import type { Link } from '../link/link'
import type { TrajectoryInfo } from '../protocol/mrlab_msgs'
import type { LabScene } from '../scene/lab/lab_scene'
import type { ShownSurface } from '../scene/lab/surfaces'
import type { Words } from '../words/en'
import type { Board } from './board/board'
import type { BoardPlace } from './board/board_place'
import type { Person } from './board/people_tab'
import type { Entry } from './context'
import type { ObjectHandles } from './handles/object_handles'
import type { Mouse } from './input/mouse'
import type { Stats } from './latency'
import type { People } from './people/people'
import type { Alignment } from './place/alignment'
import type { SceneAnchor } from './place/anchor'
import type { RoomScan } from './place/scan'
import type { Spawning } from './place/spawning'
import type { Support } from './place/supports'
import type { TouchAlignment } from './place/touch_alignment'
import type { RobotPanels } from './robots/robot_panels'
import type { RoomRobots } from './robots/robots'
import type { Drawings } from './scene/drawings'
import type { Overlays } from './scene/overlays'
import type { RoomStage } from './scene/stage'
import type { Settings } from './session/settings'
import type { Visit } from './session/visit'
import type { Creation } from './systems/creation'
import type { SystemPanels } from './systems/system_panels'
import type { Guide } from './tour/guide'

/** What the room is made from. */
export interface RoomParts {
  readonly container: HTMLElement
  readonly link: Link
  readonly words: Words
  readonly robots: readonly Entry[]
  readonly endEffectors: readonly Entry[]
  /** Who is signed in here. */
  readonly person: Person
  readonly courseOf: CourseOf
  readonly checks: CheckApi
  /** Whether the person plays robots. */
  readonly commands: boolean
  /** The class that a teacher steps through; null: there is none, or the person is no teacher. */
  readonly lesson: Lesson | null
}

/** The parts of a room, for what works across several of them. */
export interface Fixtures {
  /** Of the eyes, in the scene, m. */
  readonly head: Vector3
  readonly look: Quaternion
  readonly inside: Signal<boolean>
  /** Of the room, those that have an end. */
  readonly surfaces: readonly ShownSurface[]
  readonly supports: readonly Support[]
  readonly trajectories: readonly TrajectoryInfo[]
  readonly stage: RoomStage
  readonly scene: LabScene
  readonly follower: LabFollower
  readonly robots: RoomRobots
  readonly objects: ObjectHandles
  readonly overlays: Overlays
  readonly drawings: Drawings
  readonly board: Board
  readonly boardPlace: BoardPlace
  readonly panels: RobotPanels
  readonly systems: SystemPanels
  readonly stats: Stats
  readonly mouse: Mouse
  readonly visit: Visit
  readonly scan: RoomScan
  readonly anchor: SceneAnchor
  readonly alignment: Alignment
  readonly touching: TouchAlignment
  readonly spawning: Spawning
  readonly creation: Creation
  readonly guide: Guide
  readonly people: People
  readonly settings: Settings
  /** Frames drawn, and ms of JavaScript of the newest one. */
  frames: number
  frameMs: number
}
