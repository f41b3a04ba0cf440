import { effect, type ReadonlySignal } from '@preact/signals'
import type { LabFollower } from '../../lab/follower'
import type { Entry, RoomContext } from '../context'
import type { Board } from '../panels/board'
import type { RobotPanels } from '../panels/robot_panels'
import type { SystemPanels } from '../systems/system_panels'
import { hopsOf } from '../why/hops'

/** s between two looks at a lab that says nothing: silence is no message. */
const PERIOD_S = 1

/** What shows how the lab stands. */
export interface Listeners {
  readonly context: RoomContext
  readonly follower: LabFollower
  readonly board: Board
  readonly panels: RobotPanels
  readonly systems: SystemPanels
  /** The files of meshes that could not be read. */
  readonly troubles: ReadonlySignal<readonly string[]>
  /** A robot has begun to halt. */
  halt(): void
}

/** Keep the panels as the lab is; returns how to end it. */
export function listen({
  context,
  follower,
  board,
  panels,
  systems,
  troubles,
  halt,
}: Listeners): () => void {
  const { words, robots, endEffectors } = context
  const repaint = () => board.panel.repaint()
  /** s; NaN: the link is not open. */
  let openedAt = Number.NaN
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
      robots: follower.robots.value.length,
      troubles: troubles.value,
    }
    board.standing = hopsOf(way, words.room)[0]?.words ?? ''
  }
  const timer = setInterval(look, PERIOD_S * 1000)
  const undo = [
    () => clearInterval(timer),
    effect(look),
    effect(() => {
      if (panels.show(follower.robots.value)) halt()
    }),
    effect(() => {
      if (follower.recorder.value !== null) repaint()
    }),
    effect(() => {
      systems.show(follower.systems.value)
      repaint()
    }),
    // pictures of the catalogue come later than the panel
    ...[...robots, ...endEffectors].map(({ picture }: Entry) => {
      picture?.addEventListener('load', repaint)
      return () => picture?.removeEventListener('load', repaint)
    }),
  ]
  return () => {
    for (const each of undo) each()
  }
}
