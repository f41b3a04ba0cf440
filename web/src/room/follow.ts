import { effect, type ReadonlySignal } from '@preact/signals'
import { THEMES } from '../design/tokens'
import { commandsOf } from '../lab/commands'
import type { CourseOf, RobotView } from '../lab/followed_robot'
import { type FollowedScene, LabFollower } from '../lab/follower'
import { outageWords } from '../lab/outages'
import type { LabScene } from '../scene/lab/lab_scene'
import type { ShownSurface } from '../scene/lab/surfaces'
import { themeNow } from '../scene/stage/theme'
import { sentence, spoken } from '../words/diagnostic'
import type { Words } from '../words/en'
import type { Board } from './board/board'
import type { ObjectHandles } from './handles/object_handles'
import type { Catalogue, Entry, Lab, May, Speech } from './ports'
import type { RobotPanels } from './robots/robot_panels'
import type { RoomRobots } from './robots/robots'
import { hopsOf } from './session/hops'
import type { SystemPanels } from './systems/system_panels'

/** Return the follower of a room; it reports a motion that could not be fetched. */
export function roomFollower({ link, words, say }: Speech & Lab, courseOf: CourseOf): LabFollower {
  return new LabFollower(link, {
    commands: (name) => commandsOf({ link, say }, name),
    word: (state) => words.states[state],
    // Names are part of the picture, whose theme is the page's.
    colour: (state) => THEMES[themeNow().name].states[state],
    stir: () => undefined,
    courseOf: (id) =>
      courseOf(id).catch((error: unknown) => {
        say(sentence(error))
        throw error
      }),
  })
}

/** The receivers of the lab's messages. */
interface FollowedParts {
  readonly scene: LabScene
  readonly robots: RoomRobots
  readonly objects: ObjectHandles
  /** The set of robots has changed. */
  came(): void
  setSurfaces(surfaces: readonly ShownSurface[]): void
}

/** Return the scene as the follower moves it. */
export function followedScene(parts: FollowedParts): FollowedScene {
  const { scene, robots, objects } = parts
  return {
    setRobots: (shown) => {
      robots.set(shown)
      parts.came()
    },
    setState: (name, word, colour, filled) => scene.setState(name, word, colour, filled),
    setCollision: (name, link) => scene.setCollision(name, link),
    setObjects: (shown) => {
      scene.setObjects(shown)
      objects.set(shown)
    },
    setContacts: (contacts) => scene.setContacts(contacts),
    setSurfaces: (surfaces) => parts.setSurfaces(surfaces),
    // In the room, cubes between the fingers mark them.
    setTargets: () => undefined,
    frame: () => undefined,
    robot: (name) => scene.robot(name),
  }
}

/** Return which robots are halted, and by what. */
export function haltWords(robots: readonly RobotView[], words: Words): string {
  const halted = robots.filter(({ state }) => state === 'COLLISION_HALT')
  return halted
    .map(({ robot, touching }) =>
      [robot.name, words.states.COLLISION_HALT, touching].filter(Boolean).join(' · '),
    )
    .join('; ')
}

/** s between two checks of the link: a silent lab sends no message. */
const PERIOD_S = 1

/** The parts that show the state of the lab. */
export interface Listeners {
  readonly ports: Speech & Lab & Catalogue & May
  readonly follower: LabFollower
  readonly board: Board
  readonly panels: RobotPanels
  readonly systems: SystemPanels
  /** The files of meshes that could not be read. */
  readonly troubles: ReadonlySignal<readonly string[]>
  /** A robot has begun to halt. */
  halt(): void
}

/** Keep the panels up to date with the lab; returns a function that ends it. */
export function listen({
  ports,
  follower,
  board,
  panels,
  systems,
  troubles,
  halt,
}: Listeners): () => void {
  const { words, robots, endEffectors } = ports
  const repaint = () => board.panel.repaint()
  /** s; NaN: the link is not open. */
  let openedAt = Number.NaN
  const outages = () => follower.outages.value.map((each) => outageWords(each, words.lab.outages))
  let told: readonly string[] = []
  const tell = () => {
    const now = outages()
    follower.outages.value.forEach(({ kind }, i) => {
      const text = now[i] as string
      if (!told.includes(text)) ports.say(text, kind !== 'back')
    })
    told = now
  }
  const look = () => {
    const link = follower.status.value
    const now = performance.now() / 1000
    if (link.phase !== 'open') openedAt = Number.NaN
    else if (Number.isNaN(openedAt)) openedAt = now
    const way = {
      ability: null,
      link,
      openFor: now - openedAt,
      known: follower.known.value,
      outages: outages(),
      robots: follower.robots.value.length,
      troubles: troubles.value,
    }
    board.standing = hopsOf(way, words.room)[0]?.words ?? ''
  }
  const timer = setInterval(look, PERIOD_S * 1000)
  const undo = [
    () => clearInterval(timer),
    effect(look),
    effect(tell),
    effect(() => {
      if (panels.show(follower.robots.value)) halt()
    }),
    effect(() => {
      const act = follower.undoing.act.value
      const undo = ports.scene ? () => void follower.undoing.undo(ports) : null
      const label = words.room.undo
      board.offer(act === null ? null : { words: spoken(act), label, undo })
    }),
    effect(() => {
      if (follower.recorder.value !== null) repaint()
    }),
    effect(() => {
      systems.show(follower.systems.value)
      repaint()
    }),
    // Pictures of the catalogue are loaded later than the panel.
    ...[...robots, ...endEffectors].map(({ picture }: Entry) => {
      picture?.addEventListener('load', repaint)
      return () => picture?.removeEventListener('load', repaint)
    }),
  ]
  return () => {
    for (const each of undo) each()
  }
}
