import type { LabFollower } from '../../pages/lab/follow'
import type { Alignment, Viewer } from '../anchor/alignment'
import type { SceneAnchor } from '../anchor/anchor'
import type { RoomContext } from '../context'
import type { ObjectHandles } from '../handles/object_handles'
import type { Stats } from '../latency/stats'
import type { Spawning } from '../placement/spawning'
import type { RoomScan } from '../room-scan/scan'
import type { Visit } from '../session/visit'
import { roomLines, roomTab } from '../settings/room_tab'
import type { Settings } from '../settings/settings'
import type { RoomStage } from '../stage'
import type { Creation } from '../systems/creation'
import { systemsTab } from '../systems/systems_tab'
import type { Tab } from './board'
import { objectsTab, robotsTab } from './catalogue_tabs'
import { labTab } from './lab_tab'

const OBJECT_AWAY = 0.8 // m

/** What the tabs of the board show and switch. */
export interface BoardParts {
  readonly context: RoomContext
  readonly spawning: Spawning
  readonly creation: Creation
  readonly follower: LabFollower
  readonly settings: Settings
  readonly stage: RoomStage
  readonly visit: Visit
  readonly alignment: Alignment
  readonly anchor: SceneAnchor
  readonly scan: RoomScan
  readonly viewer: Viewer
  readonly objects: ObjectHandles
  readonly stats: Stats
  /** Surfaces that the lab knows. */
  surfaces(): number
}

/** Return the tabs of the board. */
export function boardTabs(parts: BoardParts): readonly Tab[] {
  const { context, spawning, creation, follower, settings, stage, visit } = parts
  const lines = () => {
    const standing = {
      surfaces: parts.surfaces(),
      insideFor: visit.lasts(performance.now() / 1000),
      scanned: parts.scan.count,
      hold: parts.anchor.hold,
      missing: visit.missing,
    }
    return roomLines(standing, context.words.room)
  }
  return [
    robotsTab(context, (entry) => spawning.spawn(entry)),
    objectsTab(
      context,
      () => spawning.types,
      () => spawning.before(OBJECT_AWAY),
      () => ({ here: parts.objects.count, most: spawning.most }),
    ),
    systemsTab(context, creation, follower),
    labTab(context, follower, parts.stats),
    roomTab(context, {
      lines,
      get grid() {
        return stage.grid
      },
      toggleGrid: () => stage.setGrid(!stage.grid),
      get leftHanded() {
        return settings.leftHanded.value
      },
      toggleHand: () => settings.leftHanded.toggle(),
      get scan() {
        const { session } = visit
        if (session?.initiateRoomCapture === undefined) return null
        return () => {
          session.initiateRoomCapture?.().catch((error: Error) => context.say(error.message))
        }
      },
      bringHere: () => parts.alignment.align(parts.viewer),
      leave: () => visit.leave(),
    }),
  ]
}
