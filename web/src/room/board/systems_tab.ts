import { order } from '../../lab/commands'
import type { LabFollower } from '../../lab/follower'
import {
  createCreateSystemRequest,
  createSystemMember,
  createSystemType,
} from '../../protocol/mrlab_msgs'
import { GAP, HIT, TEXT } from '../panels/pen'
import type { Lab, Speech } from '../ports'
import type { Creation } from '../systems/creation'
import { BOARD_WIDTH, EDGE, type Tab, TOP } from './board'

const MOST_LISTED = 6

/** The tab that creates robot systems by touch, and lists them. */
export function systemsTab(ports: Speech & Lab, creation: Creation, follower: LabFollower): Tab {
  return {
    id: 'systems',
    words: ports.words.room.systems,
    draw: (pen) => {
      const w = ports.words.room
      let y = TOP + 6
      if (!creation.on) {
        y = pen.lines(EDGE, y, w.systemHint, TEXT.body)
        pen.button('pick', EDGE, y + 4, 300, w.pick, () => creation.begin(), { primary: true })
        y += HIT + 44
      } else {
        pen.lines(EDGE, y, w.touchInOrder, TEXT.body)
        const list = creation.picked.map((name, i) => `${i + 1} ${name}`).join('   ')
        pen.text(EDGE, y + 66, list || w.nonePicked, TEXT.body, undefined, 'accent', 600)
        const ready = creation.picked.length >= 2
        const make = (mode: number) => () => create(ports, creation, follower, mode)
        const width = (BOARD_WIDTH - 2 * EDGE - 2 * GAP) / 3
        const look = { primary: true, enabled: ready, small: true }
        const { parallel, sequential } = ports.words.lab
        pen.button('parallel', EDGE, y + 100, width, parallel, make(0), look)
        pen.button('sequential', EDGE + width + GAP, y + 100, width, sequential, make(1), look)
        pen.button('end_creation', EDGE + 2 * (width + GAP), y + 100, width, w.back, () => {
          creation.end()
        })
        y += 200
      }
      for (const { system } of follower.systems.value.slice(0, MOST_LISTED)) {
        const robots = system.members.map(({ robot }) => robot).join(', ')
        pen.text(EDGE, y, `${system.name} · ${robots}`, TEXT.small, undefined, 'second')
        y += 34
      }
    },
  }
}

async function create(
  ports: Speech & Lab,
  creation: Creation,
  follower: LabFollower,
  mode: number,
): Promise<void> {
  const motionOf = (name: string) =>
    follower.robots.value.find(({ robot }) => robot.name === name)?.playback?.trajectory_id ?? ''
  const members = creation.picked.map((robot) => ({
    ...createSystemMember(),
    robot,
    trajectory_id: motionOf(robot),
  }))
  const answer = await order(ports, 'coordinator/create_system', createSystemType, {
    ...createCreateSystemRequest(),
    members,
    mode,
  })
  if (answer !== null) creation.end()
}
