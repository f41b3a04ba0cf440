import type { CourseOf } from '../lab/followed_robot'
import type { LabFollower } from '../lab/follower'
import type { People } from '../lab/people/people'
import type { Link } from '../link/link'
import type { TrajectoryInfo } from '../protocol/mrlab_msgs'
import type { MeshSource } from '../scene/robot/meshes'
import type { Words } from '../words/en'
import type { Board, MakeTab, Tab, TabPorts } from './board/board'
import { objectsTab, robotsTab } from './board/catalogue_tabs'
import { labTab } from './board/lab_tab'
import { type Person, peopleTab } from './board/people_tab'
import { type Places, roomSwitches } from './board/room_switches'
import { roomTab, settingsTab } from './board/settings_tab'
import { systemsTab } from './board/systems_tab'
import type { ObjectHandles } from './handles/object_handles'
import { objectToPlace, robotToPlace } from './handles/placeables'
import type { Placing } from './handles/placing'
import type { Pointing } from './handles/pointing'
import type { Stats } from './latency'
import type { Caption } from './panels/caption'
import type { Feedback, Surroundings } from './panels/panel'
import type { Spawning } from './place/spawning'
import type { Ground, Obstacle, Support, Wall } from './place/supports'
import type { Catalogue, Entry, Frames, Lab, May, Preferences, Speech, Viewer } from './ports'
import type { Checks } from './robots/check'
import type { RoomRobots } from './robots/robots'
import type { Drawings } from './scene/drawings'
import type { RoomStage } from './scene/stage'
import type { Settings } from './session/settings'
import type { Visit } from './session/visit'
import type { Creation } from './systems/creation'
import type { Guide } from './tour/guide'

/** m: distance at which text is read. */
const READ_AT = 0.9
/** Size of panels of who wants large text. */
const LARGE_TEXT = 1.35

/** Everything that a room is made from. */
export interface RoomParts extends Checks, May {
  readonly container: HTMLElement
  readonly link: Link
  readonly words: Words
  readonly robots: readonly Entry[]
  readonly endEffectors: readonly Entry[]
  /** The person who is signed in. */
  readonly person: Person
  readonly courseOf: CourseOf
  /** Tabs that other parts of the pages add to the board. */
  readonly tabs: readonly MakeTab[]
}

/** All ports; each part takes those that it uses. */
export type Ports = TabPorts &
  Speech &
  Lab &
  Frames &
  Catalogue &
  Preferences &
  Ground &
  Checks &
  May &
  Surroundings

/** The parts of a room whose present values the ports return. */
interface Wired extends Viewer {
  readonly stage: RoomStage
  readonly board: Board
  readonly caption: Pick<Caption, 'say'>
  readonly robots: RoomRobots
  readonly settings: Settings
  readonly visit: Pick<Visit, 'inside'>
  readonly trajectories: readonly TrajectoryInfo[]
  readonly supports: readonly Support[]
  readonly walls: readonly Wall[]
  readonly objects: ObjectHandles
  readonly people: People
}

/** Return the ports of the room's parts. Values that change are read from the room, and nothing
 * is read before a part asks for it. */
export function portsOf(
  { link, words, robots, endEffectors, checks, commands, scene }: RoomParts,
  room: Wired,
  feedback: Feedback,
): Ports {
  return {
    link,
    words,
    robots,
    endEffectors,
    checks,
    commands,
    scene,
    feedback,
    stir: () => room.stage.invalidate(),
    world: room.stage.world,
    head: room.head,
    look: room.look,
    readAt: READ_AT,
    get textScale() {
      return room.settings.largeText.value ? LARGE_TEXT : 1
    },
    get trajectories() {
      return room.trajectories
    },
    get supports() {
      return room.supports
    },
    get bases() {
      return room.robots.bases()
    },
    get walls() {
      return room.walls
    },
    get obstacles() {
      return obstaclesOf(room)
    },
    get leftHanded() {
      return room.settings.leftHanded.value
    },
    get seated() {
      return room.settings.seated.value
    },
    get still() {
      return room.settings.still.value
    },
    get screen() {
      return room.visit.inside.value ? null : room.stage.camera
    },
    repaintBoard: () => room.board.panel.repaint(),
    say: (text, warns) => {
      room.board.say(text, warns)
      room.caption.say(text)
    },
  }
}

function* obstaclesOf({ objects, people, head }: Wired): Iterable<Obstacle> {
  yield* objects.obstacles()
  yield* people.obstacles(head)
}

/** The parts of a room that the tabs of its board show and change. */
interface Tabbed extends Places {
  readonly spawning: Spawning
  readonly placing: Placing
  readonly meshes: MeshSource
  readonly objects: ObjectHandles
  readonly creation: Creation
  readonly follower: LabFollower
  readonly people: People
  readonly pointing: Pointing
  readonly stats: Stats
  readonly drawings: Drawings
  readonly settings: Settings
  readonly guide: Guide
  readonly visit: Visit
  readonly stage: RoomStage
}

/** Return the tabs of the board, in their order. */
export function tabsOf(ports: Ports, { person, tabs }: RoomParts, room: Tabbed): Tab[] {
  const { spawning, placing, objects, follower, settings, visit, stage, drawings } = room
  const switches = roomSwitches(ports, room, visit, stage, () => follower.surfaces)
  const chosen = () => placing.id
  return [
    robotsTab(ports, chosen, (entry) => {
      placing.begin(robotToPlace(entry, spawning, room.meshes, () => stage.invalidate()))
    }),
    objectsTab(
      ports,
      () => spawning.types,
      chosen,
      (type) => placing.begin(objectToPlace(type, spawning)),
      () => ({ here: objects.count, most: spawning.most }),
    ),
    systemsTab(ports, room.creation, follower),
    peopleTab(ports, room.people, follower, person, room.pointing, {
      get inside() {
        return visit.inside.value
      },
      join: (frame) => room.common.join(frame),
    }),
    labTab(ports, follower, room.stats),
    ...tabs.map((make) => make(ports, follower, drawings)),
    roomTab(ports, switches),
    settingsTab(ports, settings, () => room.guide.begin()),
  ]
}
