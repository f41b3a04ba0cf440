import type { Pose } from '../../protocol/geometry_msgs'
import {
  createSystemMember,
  createSystemType,
  type ObjectType,
  type RobotSystem,
  removeType,
  spawnObjectType,
} from '../../protocol/mrlab_msgs'
import { triggerType } from '../../protocol/std_srvs'
import { type Entry, order, type RoomContext } from '../context'
import { BOARD_WIDTH, BOTTOM, drawCards, EDGE, type Tab, TOP } from './board'
import { GAP, HIT, type Pen, TEXT } from './pen'

const CHIP = 44

/** The catalogue of robots: pictures, narrowed to a maker or size. */
export function robotsTab(context: RoomContext, choose: (entry: Entry) => void): Tab {
  const page = { value: 0 }
  let group = ''
  return {
    id: 'robots',
    words: context.words.room.robots,
    draw: (pen) => {
      const groups = [...new Set(context.robots.map((each) => each.group))].sort()
      let x = EDGE
      for (const each of groups.length > 1 ? ['', ...groups] : []) {
        const words = each === '' ? context.words.room.all : each
        const width = Math.max(72, 26 + words.length * 10)
        const narrow = () => {
          group = each
          page.value = 0
        }
        const look = { chosen: each === group, small: true }
        pen.button(`group ${each}`, x, TOP - 12, width, words, narrow, look, CHIP)
        x += width + GAP
      }
      const shown = context.robots.filter((each) => group === '' || each.group === group)
      if (shown.length === 0)
        pen.text(EDGE, TOP + 90, context.words.loading, TEXT.body, 600, 'second')
      drawCards(pen, TOP + CHIP, shown, page, (entry, left, top, width, height) => {
        const { id, name, note, picture } = entry
        pen.card(`robot ${id}`, left, top, width, height, name, note, picture, () => choose(entry))
      })
    },
  }
}

/** The catalogue of objects. */
export function objectsTab(
  context: RoomContext,
  types: () => readonly ObjectType[],
  poseFor: () => Pose,
): Tab {
  const page = { value: 0 }
  return {
    id: 'objects',
    words: context.words.room.objects,
    draw: (pen) => {
      drawCards(pen, TOP - 12, types(), page, (type, left, top, width, height) => {
        const { r, g, b } = type.color
        const cm = [type.size.x, type.size.y, type.size.z].map((m) => Math.round(m * 100))
        pen.card(
          `object ${type.id}`,
          left,
          top,
          width,
          height,
          type.id,
          `${cm.join('×')} cm`,
          null,
          () => {
            const request = {
              type: type.id,
              name: '',
              automatic: true,
              pose: poseFor(),
            }
            order(context, 'physics/spawn_object', spawnObjectType, request)
          },
        )
        const side = Math.min(height - 90, 84)
        const colour = `rgb(${r * 255} ${g * 255} ${b * 255})`
        pen.box(left + (width - side) / 2, top + 18, side, side, colour)
      })
      pen.button('clear_objects', EDGE, BOTTOM - HIT, 250, context.words.room.clearObjects, () => {
        order(context, 'physics/clear_objects', triggerType, {})
      })
    },
  }
}

/** Robots that are picked in order, to become a system. */
export interface Picking {
  on: boolean
  readonly picked: string[]
}

/** Making robot systems by touch, and what there is of them. */
export function systemsTab(
  context: RoomContext,
  picking: Picking,
  motionOf: (robot: string) => string,
  systems: () => readonly RobotSystem[],
): Tab {
  return {
    id: 'systems',
    words: context.words.room.systems,
    draw: (pen) => {
      const w = context.words.room
      let y = TOP + 6
      if (!picking.on) {
        y = pen.lines(EDGE, y, w.systemHint, TEXT.body)
        pen.button(
          'pick',
          EDGE,
          y + 4,
          300,
          w.pick,
          () => {
            picking.on = true
            picking.picked.length = 0
          },
          { primary: true },
        )
        y += HIT + 44
      } else {
        pen.lines(EDGE, y, w.touchInOrder, TEXT.body)
        const list = picking.picked.map((name, i) => `${i + 1} ${name}`).join('   ')
        pen.text(EDGE, y + 66, list || w.nonePicked, TEXT.body, undefined, 'accent', 600)
        const ready = picking.picked.length >= 2
        const make = (mode: number) => () => create(context, picking, motionOf, mode)
        const width = (BOARD_WIDTH - 2 * EDGE - 2 * GAP) / 3
        const look = { primary: true, enabled: ready, small: true }
        const { parallel, sequential } = context.words.lab
        pen.button('parallel', EDGE, y + 100, width, parallel, make(0), look)
        pen.button('sequential', EDGE + width + GAP, y + 100, width, sequential, make(1), look)
        pen.button('end_picking', EDGE + 2 * (width + GAP), y + 100, width, w.back, () => {
          picking.on = false
        })
        y += 200
      }
      for (const system of systems().slice(0, 2)) {
        drawSystem(pen, context, system, y)
        y += HIT + 44
      }
    },
  }
}

function drawSystem(pen: Pen, context: RoomContext, system: RobotSystem, y: number): void {
  const { name, members, label } = system
  const w = context.words.room
  const robots = members.map(({ robot }) => robot).join(', ')
  pen.text(
    EDGE,
    y,
    `${name} · ${label.toLowerCase()} · ${robots}`,
    TEXT.small,
    undefined,
    'second',
  )
  const moving = system.state === 2 || system.state === 3
  const verb = moving ? 'pause' : 'play'
  const width = (BOARD_WIDTH - 2 * EDGE - 2 * GAP) / 3
  const call = (service: string) => () => {
    order(context, `${name}/${service}`, triggerType, {})
  }
  pen.button(`${name} play`, EDGE, y + 18, width, moving ? w.pause : w.play, call(verb), {
    primary: true,
  })
  pen.button(`${name} stop`, EDGE + width + GAP, y + 18, width, w.stop, call('stop'))
  pen.button(`${name} dissolve`, EDGE + 2 * (width + GAP), y + 18, width, w.dissolve, () => {
    order(context, 'coordinator/dissolve_system', removeType, { name })
  })
}

async function create(
  context: RoomContext,
  picking: Picking,
  motionOf: (robot: string) => string,
  mode: number,
): Promise<void> {
  const base = createSystemType.request.create()
  const members = picking.picked.map((robot) => ({
    ...createSystemMember(),
    robot,
    trajectory_id: motionOf(robot),
  }))
  const answer = await order(context, 'coordinator/create_system', createSystemType, {
    ...base,
    members,
    mode,
  })
  if (answer === null) return
  picking.on = false
  picking.picked.length = 0
}

/** What the room tab shows and switches. */
export interface RoomSwitches {
  /** Lines that say how the room stands: surfaces, anchor, what the session lacks. */
  lines(): readonly string[]
  readonly grid: boolean
  toggleGrid(): void
  readonly leftHanded: boolean
  toggleHand(): void
  /** null: the device has no room scan of its own. */
  readonly scan: (() => void) | null
  /** Bring the scene's origin to the floor before the person. */
  bringHere(): void
  leave(): void
}

export function roomTab(context: RoomContext, room: RoomSwitches): Tab {
  return {
    id: 'room',
    words: context.words.room.room,
    draw: (pen) => {
      const w = context.words.room
      let y = TOP + 6
      for (const line of room.lines())
        y = pen.lines(EDGE, y, line, TEXT.small, undefined, 'second') + 4
      const width = (BOARD_WIDTH - 2 * EDGE - GAP) / 2
      const top = BOTTOM - 3 * (HIT + GAP)
      const right = EDGE + width + GAP
      pen.button('grid', EDGE, top, width, w.grid, () => room.toggleGrid(), { chosen: room.grid })
      pen.button('left_handed', right, top, width, w.leftHanded, () => room.toggleHand(), {
        chosen: room.leftHanded,
      })
      pen.button('scan', EDGE, top + HIT + GAP, width, w.scan, () => room.scan?.(), {
        enabled: room.scan !== null,
      })
      pen.button('bring', right, top + HIT + GAP, width, w.bringHere, () => room.bringHere())
      pen.button('leave', EDGE, top + 2 * (HIT + GAP), width, w.leave, () => room.leave())
    },
  }
}
