import { courseOf } from '../../playback/course'
import type { MotionDocument } from '../../playback/motion'
import { MotionPlayer } from '../../playback/player'
import { say as worded } from '../../words/diagnostic'
import type { SceneWords } from '../../words/words'
import { MeshLibrary, type MeshSource } from '../robot/meshes'
import { NoWebGL } from '../stage/renderer'
import { Stage } from '../stage/stage'
import { Controls } from './controls'
import { PreviewScene } from './preview_scene'

/** Findings that are marked on the timeline. */
const MOST_MARKS = 60

interface PreviewOptions {
  /** The source of meshes; by default the gateway's /assets/. */
  readonly meshes?: MeshSource
  readonly words: SceneWords
  /** A picture for browsers without WebGL. */
  readonly poster?: string
}

/** A motion in 3D that plays. Times are s from the first frame. */
export interface MotionPreview {
  play(): void
  /** Show a second motion of a robot with the same joints as a ghost; null: the first and the last
   * pose instead. */
  compare(motion: MotionDocument | null): void
  seek(time: number): void
  /** Choose a finding by its number, from 1, and seek to its row; 0: none. */
  select(finding: number): void
  /** Receive the time whenever it changes, once a picture at most. */
  onTime(listener: (time: number) => void): () => void
  /** Receive the number of a finding, from 1, whose mark is clicked. */
  onSelect(listener: (number: number) => void): () => void
  /** Resolves when every mesh, or its placeholder, is loaded. */
  readonly ready: Promise<void>
  dispose(): void
}

/** Show a motion in `container`. Throws an Error if the document cannot be read. */
export function createMotionPreview(
  container: HTMLElement,
  motion: MotionDocument,
  options: PreviewOptions,
): MotionPreview {
  const { words } = options
  const course = courseOf(motion)
  const player = new MotionPlayer(course.duration, () => performance.now() / 1000)
  const meshes = options.meshes ?? new MeshLibrary()
  const timed = new Set<(time: number) => void>()
  const selected = new Set<(number: number) => void>()
  const undo: (() => void)[] = []
  let lastTime = -1

  const element = document.createElement('div')
  element.className = 'scene-preview'
  const view = document.createElement('div')
  view.className = 'scene-view'
  const note = document.createElement('p')
  note.className = 'scene-note'
  note.setAttribute('role', 'status')
  note.hidden = true
  element.append(view, note)
  container.append(element)
  const say = (text: string) => {
    note.textContent = text
    note.hidden = text === ''
  }

  let stage: Stage | null = null
  let scene: PreviewScene | null = null
  try {
    stage = new Stage(view, words.view)
    scene = new PreviewScene(stage, motion, course, meshes, words)
  } catch (error) {
    stage?.dispose()
    stage = null
    if (!(error instanceof NoWebGL)) {
      element.remove()
      throw error
    }
    say(words.noWebGL)
    if (options.poster !== undefined) {
      const poster = document.createElement('img')
      poster.src = options.poster
      poster.alt = motion.robot.model
      view.append(poster)
    } else {
      view.hidden = true
    }
  }

  if (scene !== null) {
    const ghosts = document.createElement('span')
    ghosts.textContent = words.ghosts
    const show = document.createElement('details')
    show.className = 'scene-show'
    const summary = document.createElement('summary')
    summary.textContent = words.show
    const path = document.createElement('span')
    path.textContent = words.path
    show.append(
      summary,
      switchFor(ghosts, scene.showsGhosts, scene.setGhosts.bind(scene)),
      switchFor(path, true, scene.setPath.bind(scene)),
    )
    view.append(show)
  }
  const rowAt = (time: number) => course.rowOf(course.frameAt(time))
  const controls = new Controls(player, words, 1 / motion.frame_rate, rowAt)
  controls.setMarks(
    motion.findings
      .filter(({ first_row }) => first_row > 0)
      .slice(0, MOST_MARKS)
      .map((finding) => ({
        time: course.timeOfRow(finding.first_row),
        severity: finding.severity,
        words: worded(finding).message,
      })),
  )
  element.append(controls.element)

  const step = (): boolean => {
    const time = player.position()
    if (time !== lastTime) {
      lastTime = time
      scene?.show(time)
      controls.show(time)
      for (const listener of timed) listener(time)
      if (!player.playing) controls.showState()
    }
    return player.playing
  }
  if (stage === null) undo.push(withoutStage(player, step))
  else {
    const invalidate = stage.invalidate.bind(stage)
    undo.push(stage.onFrame(step), player.onChange(invalidate))
  }

  const choose = (number: number): void => {
    const time = scene?.choose(number) ?? timeOf(number)
    if (time === null) return
    player.pause()
    player.seek(time)
    scene?.show(time)
  }
  const timeOf = (number: number): number | null => {
    const row = motion.findings[number - 1]?.first_row ?? 0
    return row === 0 ? null : course.timeOfRow(row)
  }
  const canvas = stage?.canvas
  if (scene !== null && canvas !== undefined) {
    const shown = scene
    const clicked = (event: MouseEvent) => {
      const number = shown.markAt(event.offsetX, event.offsetY)
      if (number === 0) return
      choose(number)
      for (const listener of selected) listener(number)
    }
    canvas.addEventListener('click', clicked)
  }
  const key = (event: KeyboardEvent) => {
    if (event.key !== ' ' || event.target !== canvas) return
    event.preventDefault()
    if (player.playing) player.pause()
    else player.play()
  }
  element.addEventListener('keydown', key)

  let disposed = false
  const waiting = setTimeout(() => {
    const robot = scene?.robot
    if (robot !== undefined && robot.meshesHere < robot.meshCount) {
      say(words.loading(robot.meshesHere, robot.meshCount))
    }
  }, 300)
  const ready = (scene?.ready ?? Promise.resolve()).then(() => {
    clearTimeout(waiting)
    const troubles = scene?.robot.troubles ?? []
    if (!disposed && scene !== null)
      say(troubles.length > 0 ? words.missing(troubles.join(', ')) : '')
  })

  return {
    play: () => player.play(),
    compare: (other) => {
      scene?.setCompared(other && courseOf(other))
    },
    seek: (time) => player.seek(time),
    select: choose,
    onTime: (listener) => {
      timed.add(listener)
      return () => timed.delete(listener)
    },
    onSelect: (listener) => {
      selected.add(listener)
      return () => selected.delete(listener)
    },
    ready,
    dispose: () => {
      disposed = true
      clearTimeout(waiting)
      for (const one of undo) one()
      controls.dispose()
      scene?.dispose()
      stage?.dispose()
      if (options.meshes === undefined) meshes.dispose()
      element.remove()
    },
  }
}

/** Return a switch with its text. */
function switchFor(text: HTMLElement, on: boolean, set: (on: boolean) => void): HTMLElement {
  const label = document.createElement('label')
  label.className = 'scene-toggle'
  const box = document.createElement('input')
  box.type = 'checkbox'
  box.checked = on
  box.addEventListener('change', () => set(box.checked))
  label.append(box, text)
  return label
}

/** Advance the clock without a picture. */
function withoutStage(player: MotionPlayer, step: () => boolean): () => void {
  let request = 0
  const frame = () => {
    request = step() ? requestAnimationFrame(frame) : 0
  }
  const stop = player.onChange(() => {
    if (request === 0) request = requestAnimationFrame(frame)
  })
  return () => {
    stop()
    cancelAnimationFrame(request)
  }
}
