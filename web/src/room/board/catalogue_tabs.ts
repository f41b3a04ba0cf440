import { order } from '../../lab/commands'
import { type ObjectType, triggerType } from '../../protocol/mrlab_msgs'
import { named } from '../../words/words'
import { GAP, HIT, TEXT } from '../panels/pen'
import type { Catalogue, Entry, Lab, Speech } from '../ports'
import { BOTTOM, drawCards, EDGE, type Tab, TOP } from './board'

const CHIP = 44

/** The catalogue of robots: pictures, narrowed to a maker or size. */
export function robotsTab(
  ports: Speech & Catalogue,
  chosen: () => string,
  choose: (entry: Entry) => void,
): Tab {
  const page = { value: 0 }
  let group = ''
  return {
    id: 'robots',
    words: ports.words.room.robots,
    draw: (pen) => {
      const groups = [...new Set(ports.robots.map((each) => each.group))].sort()
      let x = EDGE
      for (const each of groups.length > 1 ? ['', ...groups] : []) {
        const words = each === '' ? ports.words.room.all : each
        const width = Math.max(72, 26 + words.length * 10)
        const narrow = () => {
          group = each
          page.value = 0
        }
        const look = { chosen: each === group, small: true }
        pen.button(`group ${each}`, x, TOP - 12, width, words, narrow, look, CHIP)
        x += width + GAP
      }
      const shown = ports.robots.filter((each) => group === '' || each.group === group)
      if (shown.length === 0)
        pen.text(EDGE, TOP + 90, ports.words.loading, TEXT.body, 600, 'second')
      drawCards(pen, TOP + CHIP, shown, page, (entry, left, top, width, height) => {
        const { id, name, note, picture } = entry
        const look = { chosen: chosen() === id }
        const act = () => choose(entry)
        pen.card(`robot ${id}`, left, top, width, height, name, note, picture, act, look)
      })
    },
  }
}

/** The catalogue of objects. */
export function objectsTab(
  ports: Speech & Lab,
  types: () => readonly ObjectType[],
  chosen: () => string,
  choose: (type: ObjectType) => void,
  count: () => { readonly here: number; readonly most: number },
): Tab {
  const page = { value: 0 }
  return {
    id: 'objects',
    words: ports.words.room.objects,
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
          named(type.id),
          `${cm.join('×')} cm`,
          null,
          () => choose(type),
          { chosen: chosen() === type.id },
        )
        const side = Math.min(height - 90, 84)
        const colour = `rgb(${r * 255} ${g * 255} ${b * 255})`
        pen.box(left + (width - side) / 2, top + 18, side, side, colour)
      })
      const { here, most } = count()
      const words = ports.words.room.objectCount(here, most)
      pen.lines(EDGE + 250 + GAP, BOTTOM - HIT / 2 - 12, words, TEXT.small, 250, 'second', 2)
      pen.button('clear_objects', EDGE, BOTTOM - HIT, 250, ports.words.room.clearObjects, () => {
        order(ports, 'physics/clear_objects', triggerType, {})
      })
    },
  }
}
