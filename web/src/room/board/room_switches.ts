import type { Surface } from '../../protocol/mrlab_msgs'
import { sentence } from '../../words/diagnostic'
import { Asking, CONFIRM_S } from '../panels/asking'
import type { Alignment } from '../place/alignment'
import type { SceneAnchor } from '../place/anchor'
import type { CommonPlace } from '../place/common_place'
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
  readonly common: CommonPlace
}

/** Return the lines and switches of the room tab. surfaces: those that the lab knows. */
export function roomSwitches(
  ports: Speech & Lab & May & Viewer,
  { anchor, alignment, scan, touching, common }: Places,
  visit: Visit,
  stage: RoomStage,
  surfaces: () => readonly Surface[],
): RoomSwitches {
  const asking = new Asking(ports.say)
  let forgotten: readonly Surface[] = []
  let forgottenAt = Number.NEGATIVE_INFINITY
  const now = () => performance.now() / 1000
  return {
    lines: () => {
      const standing = {
        surfaces: surfaces().filter(({ vertices }) => vertices.length > 0).length,
        insideFor: visit.lasts(now()),
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
    align: () => (touching.awaited === 'nothing' ? common.join() : touching.cancel()),
    get canUndo() {
      return touching.canUndo
    },
    undoAlign: () => touching.undo(),
    get canPutBack() {
      return anchor.canPutBack
    },
    putBack: () => {
      common.moved()
      anchor.putBack()
    },
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
    bringHere: () => {
      common.moved()
      alignment.align(ports)
    },
    canForget: ports.scene,
    get canRemember() {
      return now() - forgottenAt < CONFIRM_S
    },
    forgetSurfaces: () =>
      asking.press('forget', ports.words.room.asksForget, () => {
        forgotten = surfaces()
        forgottenAt = now()
        orderSurfaces(ports, '', [])
        scan.tellAgain()
      }),
    rememberSurfaces: () => {
      forgottenAt = Number.NEGATIVE_INFINITY
      orderSurfaces(ports, '', [...forgotten])
      scan.tellAgain()
    },
    leave: () => visit.leave(),
  }
}
