import { listBagsOf, order, trigger } from '../../lab/commands'
import type { LabFollower } from '../../lab/follower'
import {
  listScenesType,
  RecorderState,
  replayType,
  sceneFileType,
  startRecordingType,
  triggerType,
} from '../../protocol/mrlab_msgs'
import { sentence, spoken } from '../../words/diagnostic'
import { fixed, named } from '../../words/words'
import type { Stats } from '../latency'
import { GAP, HIT, PANEL_THEME, type Pen, TEXT } from '../panels/pen'
import { BOARD_WIDTH, BOTTOM, EDGE, type Tab, type TabPorts, TOP } from './board'

const ROWS = 3
const COLUMN = (BOARD_WIDTH - 2 * EDGE - GAP) / 2
const RIGHT = EDGE + COLUMN + GAP

/** Return a name for a scene that is saved now. */
function sceneName(date: Date): string {
  const two = (value: number) => String(value).padStart(2, '0')
  const day = `${date.getFullYear()}${two(date.getMonth() + 1)}${two(date.getDate())}`
  return `room_${day}_${two(date.getHours())}${two(date.getMinutes())}${two(date.getSeconds())}`
}

/** The tab with scenes to save and load, sessions to record and replay, and the figures of the
 * link. */
export function labTab(ports: TabPorts, follower: LabFollower, stats: Stats): Tab {
  const { link } = ports
  const w = ports.words.room
  let scenes: readonly string[] = []
  let bags: readonly string[] = []
  let listed = false
  /** State of the recorder when its bags were listed: each recording adds one. */
  let listedWhile = -1
  let firstScene = 0
  let firstBag = 0
  const listBags = () => {
    listBagsOf(link)
      .then((found) => {
        bags = found
        ports.repaintBoard()
      })
      .catch((error: unknown) => ports.say(sentence(error)))
  }
  const list = () => {
    listed = true
    link
      .call('lab/list_scenes', listScenesType, {})
      .then((answer) => {
        scenes = answer.scenes
        ports.repaintBoard()
      })
      .catch((error: unknown) => ports.say(sentence(error)))
  }
  function drawScenes(pen: Pen): void {
    pen.text(EDGE, TOP + 4, w.scenes, TEXT.body, COLUMN, 'ink', 700)
    pen.button('save_scene', EDGE, TOP + 26, COLUMN, w.saveScene, async () => {
      const name = sceneName(new Date())
      if ((await order(ports, 'lab/save_scene', sceneFileType, { name })) === null) return
      ports.say(w.savedScene(name), false)
      list()
    })
    if (listed && scenes.length === 0) {
      pen.lines(EDGE, TOP + 116, w.noScenes, TEXT.small, COLUMN, 'second')
    }
    firstScene = drawRows(pen, EDGE, scenes, firstScene, 'scenes', (name, y) => {
      const load = () => {
        order(ports, 'lab/load_scene', sceneFileType, { name })
      }
      pen.button(`load ${name}`, EDGE, y, COLUMN, w.loadScene(named(name)), load, { small: true })
    })
  }

  /** Draw a part of a list, with buttons to the parts before and after it; returns its first
   * index. */
  function drawRows(
    pen: Pen,
    x: number,
    entries: readonly string[],
    from: number,
    id: string,
    draw: (entry: string, y: number, index: number) => void,
  ): number {
    // The button of the latency is below the bags.
    const rows = id === 'bags' && entries.length > ROWS ? ROWS - 1 : ROWS
    const first = Math.min(from, Math.max(entries.length - 1, 0))
    entries.slice(first, first + rows).forEach((entry, i) => {
      draw(entry, TOP + 26 + (i + 1) * (HIT + GAP), first + i)
    })
    if (entries.length <= ROWS) return first
    const y = TOP + 26 + (rows + 1) * (HIT + GAP)
    const turn = (by: number) => () => {
      const next = Math.max(first + by, 0)
      if (id === 'scenes') firstScene = next
      else firstBag = next
    }
    pen.button(`${id} back`, x, y, 80, '‹', turn(-rows), { enabled: first > 0 })
    const more = { enabled: first + rows < entries.length }
    pen.button(`${id} on`, x + 80 + GAP, y, 80, '›', turn(rows), more)
    return first
  }

  function drawRecordings(pen: Pen): void {
    const state = follower.recorder.value
    const doing = state?.state ?? RecorderState.STOPPED
    const lab = ports.words.lab
    if (doing !== listedWhile) {
      listedWhile = doing
      listBags()
    }
    pen.text(RIGHT, TOP + 4, lab.recordings, TEXT.body, COLUMN, 'ink', 700)
    const y = TOP + 26
    const stop = () => {
      order(ports, 'recorder/stop', triggerType, {})
    }
    if (doing === RecorderState.RECORDING) {
      const look = { primary: true }
      pen.button('end_recording', RIGHT, y, COLUMN, w.endRecording, stop, look)
      pen.lines(RIGHT, y + 90, lab.recording(state?.bag ?? ''), TEXT.small, COLUMN, 'second')
    } else if (doing === RecorderState.STOPPED) {
      pen.button('record', RIGHT, y, COLUMN, w.record, () => {
        const request = { bag: '', topics: [], split_duration: 0 }
        order(ports, 'recorder/start', startRecordingType, request)
      })
      if (bags.length === 0) pen.lines(RIGHT, y + 90, w.noBags, TEXT.small, COLUMN, 'second')
      firstBag = drawRows(pen, RIGHT, bags, firstBag, 'bags', (bag, at, i) => {
        const replay = () => {
          order(ports, 'recorder/replay', replayType, { bag, rate: 1, start: 0, loop: false })
        }
        // those that have no name of their own differ by their time
        const label = `▶ ${bag.replace(/^session_/, '')}`
        pen.button(`replay ${i}`, RIGHT, at, COLUMN, label, replay, { small: true })
      })
    } else drawReplay(pen, y, doing === RecorderState.REPLAYING, stop)
  }

  function drawReplay(pen: Pen, y: number, goes: boolean, stop: () => void): void {
    const { replay } = follower
    const half = (COLUMN - GAP) / 2
    const verb = goes ? 'pause' : 'resume'
    pen.button(
      'replay_play',
      RIGHT,
      y,
      half,
      goes ? w.pause : w.play,
      () => {
        order(ports, `recorder/${verb}`, triggerType, {})
      },
      { primary: true },
    )
    pen.button('end_replay', RIGHT + half + GAP, y, half, w.endReplay, stop, { small: true })
    const track = y + HIT + 40
    const share = replay.duration > 0 ? replay.position() / replay.duration : 0
    pen.box(RIGHT, track - 4, COLUMN, 8, PANEL_THEME.colours.hairline)
    pen.box(RIGHT, track - 4, Math.max(share * COLUMN, 8), 8, PANEL_THEME.colours.accent)
    const { colours, states } = PANEL_THEME
    const inks = { info: colours.second, warning: states.PAUSED, error: states.COLLISION_HALT }
    for (const { time, severity } of replay.duration > 0 ? follower.stops.value : []) {
      const at = RIGHT + (time / replay.duration) * COLUMN
      pen.box(at - 2, track - 12, 4, 24, inks[severity])
    }
    const time = `${fixed(replay.position(), 1)} / ${fixed(replay.duration, 1)} s`
    pen.text(RIGHT, track + 36, time, TEXT.small, COLUMN, 'ink', 600)
    const stops = [
      ['previous_stop', `‹ ${w.tourStop}`, RIGHT],
      ['next_stop', `${w.tourStop} ›`, RIGHT + half + GAP],
    ] as const
    for (const [service, label, x] of stops) {
      pen.button(
        service,
        x,
        track + 56,
        half,
        label,
        () => void trigger(ports, `recorder/${service}`),
      )
    }
    const stands = follower.recorder.value
    if (stands?.message) {
      pen.lines(RIGHT, track + 56 + HIT + 22, spoken(stands), TEXT.small, COLUMN, 'ink', 3)
    }
    pen.zone({
      id: 'replay_timeline',
      x: RIGHT,
      y: track - HIT / 2,
      width: COLUMN,
      height: HIT,
      enabled: true,
      drags: true,
      press: (at, final) => {
        if (final) replay.seek(at * replay.duration)
      },
    })
  }

  return {
    id: 'lab',
    words: w.lab,
    draw: (pen) => {
      if (!listed) list()
      drawScenes(pen)
      drawRecordings(pen)
      const top = BOTTOM - HIT
      pen.button('stats', RIGHT, top, COLUMN, w.stats, () => stats.toggle(), {
        chosen: stats.shown,
        small: true,
      })
    },
  }
}
