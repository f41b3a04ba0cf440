import { classTab } from '../../classroom/class_tab'
import type { Lesson } from '../../classroom/lesson'
import { sentence } from '../../words/diagnostic'
import type { RoomContext } from '../context'
import type { Fixtures } from '../fixtures'
import { orderSurfaces } from '../place/scan'
import type { Tab } from './board'
import { objectsTab, robotsTab } from './catalogue_tabs'
import { labTab } from './lab_tab'
import { type Person, peopleTab } from './people_tab'
import { roomLines, roomTab, settingsTab } from './settings_tab'
import { systemsTab } from './systems_tab'

const OBJECT_AWAY = 0.8 // m

/** Return the tabs of the board of a room. own: who is signed in. lesson: null: no class. */
export function boardTabs(
  context: RoomContext,
  room: Fixtures,
  own: Person,
  lesson: Lesson | null,
): readonly Tab[] {
  const { spawning, creation, follower, settings, stage, visit, touching } = room
  const lines = () => {
    const standing = {
      surfaces: room.surfaces.length,
      insideFor: visit.lasts(performance.now() / 1000),
      scanned: room.scan.count,
      hold: room.anchor.hold,
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
      () => ({ here: room.objects.count, most: spawning.most }),
    ),
    systemsTab(context, creation, follower),
    peopleTab(context, room.people, follower, own),
    labTab(context, follower, room.stats),
    ...(lesson === null ? [] : [classTab(context, follower, lesson)]),
    roomTab(context, {
      lines,
      get grid() {
        return stage.grid
      },
      toggleGrid: () => stage.setGrid(!stage.grid),
      get canAlign() {
        return visit.session !== null
      },
      get aligning() {
        return touching.awaited !== 'nothing'
      },
      align: () => (touching.awaited === 'nothing' ? touching.begin() : touching.cancel()),
      get canUndo() {
        return touching.canUndo
      },
      undoAlign: () => touching.undo(),
      get scan() {
        const { session } = visit
        if (session?.initiateRoomCapture === undefined) return null
        return () => {
          session.initiateRoomCapture?.().catch((error: unknown) => context.say(sentence(error)))
        }
      },
      bringHere: () => room.alignment.align(room),
      forgetSurfaces: () => {
        orderSurfaces(context, '', [])
        room.scan.tellAgain()
      },
      leave: () => visit.leave(),
    }),
    settingsTab(context, settings, () => room.guide.begin()),
  ]
}
