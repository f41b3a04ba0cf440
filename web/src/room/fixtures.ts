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
import type { Alignment } from './anchor/alignment'
import type { SceneAnchor } from './anchor/anchor'
import type { TouchAlignment } from './anchor/touch_alignment'
import type { Entry } from './context'
import type { Drawings } from './drawings/drawings'
import type { RoomRobots } from './follow/robots'
import type { ObjectHandles } from './handles/object_handles'
import type { Stats } from './latency/stats'
import type { Mouse } from './mouse'
import type { Overlays } from './overlays'
import type { Board } from './panels/board'
import type { BoardPlace } from './panels/board_place'
import type { RobotPanels } from './panels/robot_panels'
import type { People } from './people/people'
import type { Person } from './people/people_tab'
import type { Spawning } from './placement/spawning'
import type { Support } from './placement/supports'
import type { RoomScan } from './room-scan/scan'
import type { Visit } from './session/visit'
import type { Settings } from './settings/settings'
import type { RoomStage } from './stage'
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
