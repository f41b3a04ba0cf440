import type { Vector3 } from 'three'
import { STATE_NAMES, THEMES } from '../design/tokens'
import { MotionPlayer } from '../playback/player'
import type { SessionDocument, SessionObject } from '../playback/session'
import { changeAt, Track, within } from '../playback/track'
import type { ShownObject } from '../scene/lab/lab_objects'
import { LabScene } from '../scene/lab/lab_scene'
import { Controls, type TimeMark } from '../scene/preview/controls'
import { type MeshBytes, MeshLibrary } from '../scene/robot/meshes'
import { NoWebGL } from '../scene/stage/renderer'
import { Stage } from '../scene/stage/stage'
import { themeNow } from '../scene/stage/theme'
import type { SceneWords } from '../words/words'

const POSE = 7
const POSES = 9 // times at which the robots are taken into the picture
const LATE = 0.1 // s, by which a halt may be recorded before the collision that it is of

/** A session in 3D that plays. */
export interface SessionView {
  /** Seek to a time, s, and pause. */
  seek(time: number): void
  /** Return a data: URL of the scene at a time; empty without WebGL. */
  pictureAt(time: number): string
}

interface SessionViewOptions {
  readonly meshes: MeshBytes
  readonly words: SceneWords
  readonly marks: readonly TimeMark[]
  /** The word for a state, such as PLAYING; one of a check is none. */
  wordOf(state: string): string
  onTime(time: number): void
}

const MOVING = new Set(['PLAYING', 'ADJUSTING'])

/** Show a session in `container`. */
export function createSessionView(
  container: HTMLElement,
  session: SessionDocument,
  { meshes, words, marks, wordOf, onTime }: SessionViewOptions,
): SessionView {
  const player = new MotionPlayer(session.duration, () => performance.now() / 1000)
  const element = document.createElement('div')
  element.className = 'scene-preview'
  const picture = document.createElement('div')
  picture.className = 'scene-view'
  const note = document.createElement('p')
  note.className = 'scene-note'
  note.setAttribute('role', 'status')
  note.hidden = true
  element.append(picture, note)
  container.append(element)
  const say = (text: string) => {
    note.textContent = text
    note.hidden = text === ''
  }
  const controls = new Controls(player, words, 0.1, (time) => Math.floor(time * 100) + 1)
  element.append(controls.element)
  controls.setMarks(marks)

  let draw: (time: number) => void = () => undefined
  let stage: Stage | null = null
  try {
    stage = new Stage(picture, words.view)
    draw = drawing(
      stage,
      session,
      new MeshLibrary(meshes),
      () => player.position(),
      // nothing plays on a still
      (state) => (!player.playing && MOVING.has(state) ? '' : wordOf(state)),
      (troubles) => say(words.missing(troubles)),
    )
  } catch (error) {
    if (!(error instanceof NoWebGL)) throw error
    picture.hidden = true
    say(words.noWebGL)
  }
  let last = -1
  let played = false
  const step = (): boolean => {
    const time = player.position()
    if (time !== last || played !== player.playing) {
      last = time
      played = player.playing
      draw(time)
      controls.show(time)
      onTime(time)
      if (!player.playing) controls.showState()
    }
    return player.playing
  }
  if (stage === null) {
    player.onChange(function frame() {
      if (step()) requestAnimationFrame(frame)
    })
    step()
  } else {
    const shown = stage
    shown.onFrame(step)
    player.onChange(() => shown.invalidate())
  }
  return {
    seek: (time) => {
      player.pause()
      player.seek(time)
    },
    pictureAt: (time) => {
      if (stage === null) return ''
      draw(time)
      const taken = stage.picture()
      draw(player.position())
      return taken
    },
  }
}

/** Return a function that puts the whole scene to a time, s. */
function drawing(
  stage: Stage,
  session: SessionDocument,
  meshes: MeshLibrary,
  now: () => number,
  wordOf: (state: string) => string,
  say: (troubles: string) => void,
): (time: number) => void {
  const scene = new LabScene(stage, meshes, () => say([...scene.troubles].join('; ')))
  scene.setSurfaces(session.surfaces)
  const pose = new Float64Array(POSE)
  const bases = session.robots.map((robot) => new Track(robot.base))
  scene.setRobots(
    session.robots.map((robot, i) => {
      pose.fill(0)
      pose[POSE - 1] = 1
      bases[i]?.sample(0, pose)
      return { name: robot.name, urdf: robot.urdf, pose: poseOf(pose), joint_names: robot.joints }
    }),
  )
  const robots = session.robots.map((robot) => {
    const track = new Track(robot.track)
    return { robot, track, values: new Float64Array(track.columns) }
  })
  const objects = session.objects.map((object) => ({ object, track: new Track(object.track) }))
  let present = ''
  const draw = (time: number): void => {
    const { states } = THEMES[themeNow().name]
    for (const [i, { robot, track, values }] of robots.entries()) {
      track.sample(time, values)
      scene.robot(robot.name)?.setPositions(values)
      bases[i]?.sample(time, pose)
      scene.placeRobot(robot.name, poseOf(pose))
      scene.showRobot(robot.name, within(robot.there, time))
      const state = changeAt(robot.states, time)
      const name = STATE_NAMES.find((known) => known === state)
      const colour = name === undefined ? '' : states[name]
      const halted = state === 'COLLISION_HALT'
      scene.setState(robot.name, wordOf(state), colour, halted)
      scene.setCollision(robot.name, halted ? changeAt(robot.collisions, time + LATE) : '')
    }
    const there = objects.filter(({ object }) => object.first <= time && time <= object.last + 0.1)
    const names = there.map(({ object }) => object.name).join()
    const shown: ShownObject[] = []
    for (const { object, track } of there) {
      track.sample(time, pose)
      const holder = changeAt(object.holders, time)
      if (names === present) scene.moveObject(object.name, poseOf(pose), holder)
      else shown.push(objectAt(object, poseOf(pose), holder))
    }
    if (names !== present) scene.setObjects(shown)
    present = names
  }
  scene.ready.then(() => {
    // The picture contains all places that the robots reach in the session.
    const points: Vector3[] = []
    for (let i = 0; i < POSES; i++) {
      draw((i / (POSES - 1)) * session.duration)
      scene.reach(points)
    }
    draw(now())
    stage.frame(points, true)
    document.documentElement.dataset.ready = 'true'
  })
  stage.onFrame(() => {
    scene.update()
    return false
  })
  return draw
}

function objectAt(object: SessionObject, pose: ShownObject['pose'], holder: string): ShownObject {
  const { name, mesh, size, color, primitive } = object
  return { name, mesh, size, color, primitive, pose, held_by: holder }
}

function poseOf(values: Float64Array): ShownObject['pose'] {
  const [x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 1] = values
  const length = Math.hypot(qx, qy, qz, qw) || 1
  return {
    position: { x, y, z },
    orientation: { x: qx / length, y: qy / length, z: qz / length, w: qw / length },
  }
}
