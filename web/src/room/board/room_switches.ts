import { sentence } from '../../words/diagnostic'
import { Asking } from '../panels/asking'
import type { Alignment } from '../place/alignment'
import type { SceneAnchor } from '../place/anchor'
import { orderSurfaces, type RoomScan } from '../place/scan'
import type { TouchAlignment } from '../place/touch_alignment'
import type { Lab, May, Speech, Viewer } from '../ports'
import type { RoomStage } from '../scene/stage'
import type { Visit } from '../session/visit'
import { type RoomSwitches, roomLines } from './settings_tab'

/** The parts that hold the scene in its place in the real room. */
export interface Places {
  readonly anchor: SceneAnchor
  readonly alignment: Alignment
  readonly scan: RoomScan
  readonly touching: TouchAlignment
}

/** Return the lines and switches of the room tab. surfaces: how many the lab knows. */
export function roomSwitches(
  ports: Speech & Lab & May & Viewer,
  { anchor, alignment, scan, touching }: Places,
  visit: Visit,
  stage: RoomStage,
  surfaces: () => number,
): RoomSwitches {
  const asking = new Asking(ports.say)
  return {
    lines: () => {
      const standing = {
        surfaces: surfaces(),
        insideFor: visit.lasts(performance.now() / 1000),
        scanned: scan.count,
        hold: anchor.hold,
        missing: visit.missing,
      }
      return roomLines(standing, ports.words.room)
    },
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
    get canPutBack() {
      return anchor.canPutBack
    },
    putBack: () => anchor.putBack(),
    keepHere: () => anchor.keepHere(),
    get scan() {
      const { session } = visit
      if (session?.initiateRoomCapture === undefined) return null
      return () => {
        session.initiateRoomCapture?.().catch((error: unknown) => ports.say(sentence(error)))
      }
    },
    get measuring() {
      return scan.awaited
    },
    measure: () => {
      scan.awaited = !scan.awaited
      if (scan.awaited) ports.say(ports.words.room.touchTable, false)
    },
    bringHere: () => alignment.align(ports),
    canForget: ports.scene,
    forgetSurfaces: () =>
      asking.press('forget', ports.words.room.asksForget, () => {
        orderSurfaces(ports, '', [])
        scan.tellAgain()
      }),
    leave: () => visit.leave(),
  }
}
