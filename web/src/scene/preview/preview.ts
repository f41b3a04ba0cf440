import { type Course, courseOf } from '../../playback/course'
import type { MotionDocument } from '../../playback/motion'
import { MotionPlayer } from '../../playback/player'
import { said } from '../../words/diagnostic'
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
  /** Take another motion of the same robot in place of this one: camera and speed stay, and it goes
   * on playing where it played. */
  show(motion: MotionDocument): void
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
  const meshes = options.meshes ?? new MeshLibrary()
  const timed = new Set<(time: number) => void>()
  const selected = new Set<(number: number) => void>()

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
  try {
    stage = new Stage(view, words.view)
  } catch (error) {
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

  const load = (of: MotionDocument) =>
    new ShownMotion(of, stage, meshes, element, options, { timed, selected, say })
  let shown: ShownMotion
  try {
    shown = load(motion)
  } catch (error) {
    stage?.dispose()
    element.remove()
    throw error
  }
  const canvas = stage?.canvas
  canvas?.addEventListener('click', (event) => shown.click(event))
  const key = (event: KeyboardEvent) => {
    if (event.key !== ' ' || event.target !== canvas) return
    event.preventDefault()
    if (shown.player.playing) shown.player.pause()
    else shown.player.play()
  }
  element.addEventListener('keydown', key)

  return {
    play: () => shown.player.play(),
    compare: (other) => shown.compare(other),
    show: (next) => {
      if (next === shown.motion) return
      const before = shown.player
      const at = before.playing ? before.position() : null
      shown.dispose()
      shown = load(next)
      shown.player.setRate(before.rate)
      if (at === null) return
      shown.player.seek(at)
      shown.player.play()
    },
    seek: (time) => shown.player.seek(time),
    select: (number) => shown.choose(number),
    onTime: (listener) => {
      timed.add(listener)
      return () => timed.delete(listener)
    },
    onSelect: (listener) => {
      selected.add(listener)
      return () => selected.delete(listener)
    },
    get ready() {
      return shown.ready
    },
    dispose: () => {
      shown.dispose()
      stage?.dispose()
      if (options.meshes === undefined) meshes.dispose()
      element.remove()
    },
  }
}

/** The outside of a motion that is shown: listeners of its time and its marks, and the line of text. */
interface Surroundings {
  readonly timed: ReadonlySet<(time: number) => void>
  readonly selected: ReadonlySet<(number: number) => void>
  readonly say: (text: string) => void
}

/** One motion on the stage, with its player and controls. */
class ShownMotion {
  readonly player: MotionPlayer
  readonly ready: Promise<void>
  private readonly course: Course
  private readonly scene: PreviewScene | null
  private readonly controls: Controls
  private readonly undo: (() => void)[] = []
  private readonly waiting: ReturnType<typeof setTimeout>
  private lastTime = -1
  private disposed = false

  constructor(
    readonly motion: MotionDocument,
    stage: Stage | null,
    meshes: MeshSource,
    element: HTMLElement,
    options: PreviewOptions,
    private readonly around: Surroundings,
  ) {
    const { words } = options
    const course = courseOf(motion)
    this.course = course
    this.player = new MotionPlayer(course.duration, () => performance.now() / 1000)
    const scene = stage && new PreviewScene(stage, motion, course, meshes, words)
    this.scene = scene
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
      element.querySelector('.scene-view')?.append(show)
      this.undo.push(() => show.remove())
    }
    const rowAt = (time: number) => course.rowOf(course.frameAt(time))
    this.controls = new Controls(this.player, words, 1 / motion.frame_rate, rowAt)
    this.controls.setMarks(
      motion.findings
        .filter(({ first_row }) => first_row > 0)
        .slice(0, MOST_MARKS)
        .map((finding) => ({
          time: course.timeOfRow(finding.first_row),
          severity: finding.severity,
          words: said(finding, motion.robot.joints),
        })),
    )
    element.append(this.controls.element)
    const step = () => this.step()
    if (stage === null) this.undo.push(withoutStage(this.player, step))
    else {
      const invalidate = stage.invalidate.bind(stage)
      this.undo.push(stage.onFrame(step), this.player.onChange(invalidate))
    }
    this.waiting = setTimeout(() => {
      const robot = scene?.robot
      if (robot !== undefined && robot.meshesHere < robot.meshCount) {
        around.say(words.loading(robot.meshesHere, robot.meshCount))
      }
    }, 300)
    this.ready = (scene?.ready ?? Promise.resolve()).then(() => {
      clearTimeout(this.waiting)
      const troubles = scene?.robot.troubles ?? []
      if (!this.disposed && scene !== null)
        around.say(troubles.length > 0 ? words.missing(troubles.join(', ')) : '')
    })
  }

  private step(): boolean {
    const { player } = this
    const time = player.position()
    if (time !== this.lastTime) {
      this.lastTime = time
      this.scene?.show(time)
      this.controls.show(time)
      for (const listener of this.around.timed) listener(time)
      if (!player.playing) this.controls.showState()
    }
    return player.playing
  }

  choose(number: number): void {
    const time = this.scene?.choose(number) ?? this.timeOf(number)
    if (time === null) return
    this.player.pause()
    this.player.seek(time)
    this.scene?.show(time)
  }

  compare(other: MotionDocument | null): void {
    this.scene?.setCompared(other && courseOf(other))
  }

  private timeOf(number: number): number | null {
    const row = this.motion.findings[number - 1]?.first_row ?? 0
    return row === 0 ? null : this.course.timeOfRow(row)
  }

  click(event: MouseEvent): void {
    const number = this.scene?.markAt(event.offsetX, event.offsetY) ?? 0
    if (number === 0) return
    this.choose(number)
    for (const listener of this.around.selected) listener(number)
  }

  dispose(): void {
    this.disposed = true
    clearTimeout(this.waiting)
    for (const one of this.undo) one()
    this.controls.dispose()
    this.scene?.dispose()
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
