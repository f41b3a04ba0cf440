import { effect } from '@preact/signals'
import type { LabFollower } from '../../pages/lab/follow'
import type { Entry, RoomContext } from '../context'
import type { Board } from '../panels/board'
import type { RobotPanels } from '../panels/robot_panels'
import type { SystemPanels } from '../systems/system_panels'

/** What shows how the lab stands. */
export interface Listeners {
  readonly context: RoomContext
  readonly follower: LabFollower
  readonly board: Board
  readonly panels: RobotPanels
  readonly systems: SystemPanels
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
  halt,
}: Listeners): () => void {
  const { words, robots, endEffectors } = context
  const repaint = () => board.panel.repaint()
  const undo = [
    effect(() => {
      if (panels.show(follower.robots.value)) halt()
    }),
    effect(() => {
      const { phase, reason } = follower.status.value
      const { hops } = words.room
      board.standing =
        phase === 'open' ? '' : phase === 'connecting' ? hops.connecting : hops[phase](reason)
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
