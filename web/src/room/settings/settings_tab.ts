import type { RoomContext } from '../context'
import { BOARD_WIDTH, EDGE, type Tab, TOP } from '../panels/board'
import { GAP, HIT, TEXT } from '../panels/pen'
import type { Settings, Switch } from './settings'

const SWITCH = 270
const ABOUT = EDGE + SWITCH + 20

/** What somebody chooses for their own eyes and hands. */
export function settingsTab(context: RoomContext, settings: Settings, tour: () => void): Tab {
  const w = context.words.room
  const rows: readonly (readonly [string, Switch, string, string])[] = [
    ['left_handed', settings.leftHanded, w.leftHanded, w.leftHandedAbout],
    ['seated', settings.seated, w.seated, w.seatedAbout],
    ['contrast', settings.contrast, w.contrast, w.contrastAbout],
    ['still', settings.still, w.still, w.stillAbout],
    ['occlusion', settings.occlusion, w.occlusion, w.occlusionAbout],
  ]
  return {
    id: 'settings',
    words: w.settings,
    draw: (pen) => {
      let y = TOP
      const about = (words: string) =>
        pen.lines(ABOUT, y + 18, words, TEXT.small, BOARD_WIDTH - ABOUT - EDGE, 'second', 2)
      for (const [id, each, words, why] of rows) {
        const look = { chosen: each.value, tick: each.value }
        pen.button(id, EDGE, y, SWITCH, words, () => each.toggle(), look)
        about(why)
        y += HIT + GAP
      }
      pen.button('tour', EDGE, y, SWITCH, w.tour.again, tour)
      about(w.tour.about)
    },
  }
}
