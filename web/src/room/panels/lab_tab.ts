import type { LabFollower } from '../../pages/lab/follow'
import {
  listScenesType,
  RecorderState,
  replayType,
  sceneFileType,
  startRecordingType,
} from '../../protocol/mrlab_msgs'
import { triggerType } from '../../protocol/std_srvs'
import { order, type RoomContext } from '../context'
import type { Stats } from '../latency/stats'
import { BOARD_WIDTH, BOTTOM, EDGE, type Tab, TOP } from './board'
import { GAP, HIT, PANEL_THEME, type Pen, TEXT } from './pen'

const ROWS = 3
const KEY = 'mrlab.room.bags'
const MOST_BAGS = 6
const COLUMN = (BOARD_WIDTH - 2 * EDGE - GAP) / 2
const RIGHT = EDGE + COLUMN + GAP

/** Bags that were recorded while this browser looked on, newest first: the lab lists none. */
function knownBags(): string[] {
  const kept: unknown = JSON.parse(localStorage.getItem(KEY) ?? '[]')
  return Array.isArray(kept) ? kept.filter((each) => typeof each === 'string') : []
}

/** Remember a bag that is being recorded. */
export function keepBag({ state, bag }: RecorderState): void {
  if (state !== RecorderState.RECORDING || bag === '') return
  const bags = [bag, ...knownBags().filter((each) => each !== bag)]
  localStorage.setItem(KEY, JSON.stringify(bags.slice(0, MOST_BAGS)))
}

/** Return a name for a scene that is saved now. */
export function sceneName(date: Date): string {
  const two = (value: number) => String(value).padStart(2, '0')
  const day = `${date.getFullYear()}${two(date.getMonth() + 1)}${two(date.getDate())}`
  return `room_${day}_${two(date.getHours())}${two(date.getMinutes())}${two(date.getSeconds())}`
}

/** Scenes to save and load, sessions to record and replay, and how well the link does. */
export function labTab(context: RoomContext, follower: LabFollower, stats: Stats): Tab {
  const { link } = context
  const w = context.words.room
  let scenes: readonly string[] = []
  let listed = false
  let first = 0
  const list = () => {
    listed = true
    link
      .call('lab/list_scenes', listScenesType, {})
      .then((answer) => {
        scenes = answer.scenes
        context.repaintBoard()
      })
      .catch((error: Error) => context.say(error.message))
  }
  function drawScenes(pen: Pen): void {
    pen.text(EDGE, TOP + 4, w.scenes, TEXT.body, COLUMN, 'ink', 700)
    pen.button('save_scene', EDGE, TOP + 26, COLUMN, w.saveScene, async () => {
      const name = sceneName(new Date())
      if ((await order(context, 'lab/save_scene', sceneFileType, { name })) === null) return
      context.say(w.savedScene(name), false)
      list()
    })
    if (listed && scenes.length === 0) {
      pen.lines(EDGE, TOP + 116, w.noScenes, TEXT.small, COLUMN, 'second')
    }
    first = Math.min(first, Math.max(scenes.length - ROWS, 0))
    scenes.slice(first, first + ROWS).forEach((name, i) => {
      const y = TOP + 26 + (i + 1) * (HIT + GAP)
      const load = () => {
        order(context, 'lab/load_scene', sceneFileType, { name })
      }
      pen.button(`load ${name}`, EDGE, y, COLUMN, w.loadScene(name), load, { small: true })
    })
    if (scenes.length <= ROWS) return
    const y = TOP + 26 + (ROWS + 1) * (HIT + GAP)
    const turn = (by: number) => () => {
      first = Math.max(first + by, 0)
    }
    pen.button('scenes back', EDGE, y, 80, '‹', turn(-ROWS), { enabled: first > 0 })
    const more = { enabled: first + ROWS < scenes.length }
    pen.button('scenes on', EDGE + 80 + GAP, y, 80, '›', turn(ROWS), more)
  }

  function drawRecordings(pen: Pen): void {
    const state = follower.recorder.value
    const doing = state?.state ?? RecorderState.STOPPED
    const lab = context.words.lab
    pen.text(RIGHT, TOP + 4, lab.recordings, TEXT.body, COLUMN, 'ink', 700)
    const y = TOP + 26
    const stop = () => {
      order(context, 'recorder/stop', triggerType, {})
    }
    if (doing === RecorderState.RECORDING) {
      const look = { primary: true }
      pen.button('end_recording', RIGHT, y, COLUMN, w.endRecording, stop, look)
      pen.lines(RIGHT, y + 90, lab.recording(state?.bag ?? ''), TEXT.small, COLUMN, 'second')
    } else if (doing === RecorderState.STOPPED) {
      pen.button('record', RIGHT, y, COLUMN, w.record, () => {
        const request = { bag: '', topics: [], split_duration: 0 }
        order(context, 'recorder/start', startRecordingType, request)
      })
      const bags = knownBags()
      if (bags.length === 0) pen.lines(RIGHT, y + 90, w.noBags, TEXT.small, COLUMN, 'second')
      bags.slice(0, ROWS).forEach((bag, i) => {
        const short = bag.slice(bag.lastIndexOf('/') + 1)
        const words = `${w.replayed} ${short}`
        pen.button(
          `replay ${i}`,
          RIGHT,
          y + (i + 1) * (HIT + GAP),
          COLUMN,
          words,
          () => {
            order(context, 'recorder/replay', replayType, { bag, rate: 1, start: 0, loop: false })
          },
          { small: true },
        )
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
        order(context, `recorder/${verb}`, triggerType, {})
      },
      { primary: true },
    )
    pen.button('end_replay', RIGHT + half + GAP, y, half, w.endReplay, stop, { small: true })
    const track = y + HIT + 40
    const share = replay.duration > 0 ? replay.position() / replay.duration : 0
    pen.box(RIGHT, track - 4, COLUMN, 8, PANEL_THEME.colours.hairline)
    pen.box(RIGHT, track - 4, Math.max(share * COLUMN, 8), 8, PANEL_THEME.colours.accent)
    const time = `${replay.position().toFixed(1)} / ${replay.duration.toFixed(1)} s`
    pen.text(RIGHT, track + 36, time, TEXT.small, COLUMN, 'ink', 600)
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
