import type { Words } from '../../words/en'
import { GAP, HIT, TEXT } from '../panels/pen'
import type { Hold } from '../place/anchor'
import type { Speech } from '../ports'
import type { Settings, Switch } from '../session/settings'
import { BOARD_WIDTH, BOTTOM, EDGE, type Tab, TOP } from './board'

const SWITCH = 270
/** Height of a row, and the gap between two. */
const ROW = 45
const BETWEEN = 5
const ABOUT = EDGE + SWITCH + 20

/** The tab of a person's own settings. */
export function settingsTab(ports: Speech, settings: Settings, tour: () => void): Tab {
  const w = ports.words.room
  const rows: readonly (readonly [string, Switch, string, string])[] = [
    ['left_handed', settings.leftHanded, w.leftHanded, w.leftHandedAbout],
    ['seated', settings.seated, w.seated, w.seatedAbout],
    ['large_text', settings.largeText, w.largeText, w.largeTextAbout],
    ['contrast', settings.contrast, w.contrast, w.contrastAbout],
    ['still', settings.still, w.still, w.stillAbout],
    ['captions', settings.captions, w.captions, w.captionsAbout],
    ['occlusion', settings.occlusion, w.occlusion, w.occlusionAbout],
  ]
  return {
    id: 'settings',
    words: w.settings,
    draw: (pen) => {
      let y = TOP - 22
      const about = (words: string) =>
        pen.lines(ABOUT, y + 12, words, TEXT.small, BOARD_WIDTH - ABOUT - EDGE, 'second', 2)
      for (const [id, each, words, why] of rows) {
        const look = { chosen: each.value, tick: each.value }
        pen.button(id, EDGE, y, SWITCH, words, () => each.toggle(), look, ROW)
        about(why)
        y += ROW + BETWEEN
      }
      const half = (SWITCH - BETWEEN) / 2
      const { brightness, warmth } = settings
      const small = { small: true }
      const bright = w.brightness[brightness.value] ?? ''
      pen.button('brightness', EDGE, y, half, bright, () => brightness.next(), small, ROW)
      const warm = w.warmth[warmth.value] ?? ''
      const right = EDGE + half + BETWEEN
      pen.button('warmth', right, y, half, warm, () => warmth.next(), small, ROW)
      about(w.lightAbout)
      y += ROW + BETWEEN
      pen.button('tour', EDGE, y, SWITCH, w.tour.again, tour, {}, ROW)
      about(w.tour.about)
    },
  }
}

/** s within which a headset reports the surfaces that it knows. */
const SCAN_WAIT_S = 3

/** The state of the room, for a person in it. */
interface RoomStanding {
  /** Surfaces that the lab knows. */
  readonly surfaces: number
  /** s since a person entered; NaN: nobody is inside. */
  readonly insideFor: number
  /** Surfaces that the headset knows. */
  readonly scanned: number
  readonly hold: Hold
  /** Features that the session lacks. */
  readonly missing: readonly string[]
}

/** Return the lines about the state of the room. */
export function roomLines(room: RoomStanding, words: Words['room']): string[] {
  const lines = [words.surfaces(room.surfaces)]
  if (Number.isNaN(room.insideFor)) return lines
  if (room.insideFor > SCAN_WAIT_S && room.scanned === 0) lines.push(words.notSetUp)
  const holds = { kept: words.anchorKept, session: words.anchorSession, none: words.anchorNone }
  lines.push(holds[room.hold])
  if (room.missing.length > 0) lines.push(words.lacks(room.missing.join(', ')))
  return lines
}

/** The lines and switches of the room tab. */
export interface RoomSwitches {
  lines(): readonly string[]
  readonly grid: boolean
  toggleGrid(): void
  /** True if headsets can be aligned here by touch. */
  readonly canAlign: boolean
  /** True while a touch is awaited. */
  readonly aligning: boolean
  align(): void
  readonly canUndo: boolean
  undoAlign(): void
  /** True if an earlier place of this room is known, and the scene stands elsewhere. */
  readonly canPutBack: boolean
  putBack(): void
  /** Give up the earlier place. */
  keepHere(): void
  /** null: the device has no room scan of its own. */
  readonly scan: (() => void) | null
  /** True while the next touch makes a surface. */
  readonly measuring: boolean
  measure(): void
  /** Bring the scene's origin to the floor before the person. */
  bringHere(): void
  /** Have the lab forget the surfaces of all headsets, also of those that left. */
  readonly canForget: boolean
  forgetSurfaces(): void
  /** True for a while after that: it can be undone. */
  readonly canRemember: boolean
  rememberSurfaces(): void
  leave(): void
}

export function roomTab(ports: Speech, room: RoomSwitches): Tab {
  return {
    id: 'room',
    words: ports.words.room.room,
    says: () => [...room.lines(), room.canRemember].join(),
    draw: (pen) => {
      const w = ports.words.room
      let y = TOP + 6
      for (const line of room.lines())
        y = pen.lines(EDGE, y, line, TEXT.small, undefined, 'second') + 4
      const width = (BOARD_WIDTH - 2 * EDGE - GAP) / 2
      const top = BOTTOM - 4 * (HIT + GAP)
      const right = EDGE + width + GAP
      const second = top + HIT + GAP
      const third = second + HIT + GAP
      pen.button('grid', EDGE, top, width, w.grid, () => room.toggleGrid(), { chosen: room.grid })
      pen.button('scan', right, top, width, w.scan, () => room.scan?.(), {
        enabled: room.scan !== null,
      })
      pen.button('align', EDGE, second, width, w.align, () => room.align(), {
        chosen: room.aligning,
        enabled: room.canAlign,
      })
      pen.button('undo_align', right, second, width, w.undoAlign, () => room.undoAlign(), {
        enabled: room.canUndo,
      })
      pen.button('bring', EDGE, third, width, w.bringHere, () => room.bringHere())
      const [forget, press] = room.canRemember
        ? [w.undo, () => room.rememberSurfaces()]
        : [w.forgetSurfaces, () => room.forgetSurfaces()]
      pen.button('forget', right, third, width, forget, press, { enabled: room.canForget })
      const fourth = third + HIT + GAP
      pen.button('leave', EDGE, fourth, width, w.leave, () => room.leave(), {
        enabled: room.canAlign,
      })
      if (!room.canPutBack) {
        pen.button('measure', right, fourth, width, w.touchSurface, () => room.measure(), {
          chosen: room.measuring,
          enabled: room.canAlign,
        })
        return
      }
      const half = (width - GAP) / 2
      const small = { small: true }
      pen.button('put_back', right, fourth, half, w.putBack, () => room.putBack(), small)
      const last = right + half + GAP
      pen.button('keep_here', last, fourth, half, w.keepHere, () => room.keepHere(), small)
    },
  }
}
