import type { LabFollower } from '../../lab/follower'
import { PART_ICONS, type Part } from '../../lab/people/parts'
import type { People } from '../../lab/people/people'
import { named } from '../../words/words'
import { GAP, HIT, TEXT } from '../panels/pen'
import { pauseAll } from '../people/pausing'
import type { Lab, Speech } from '../ports'
import { BOARD_WIDTH, BOTTOM, EDGE, type Tab, TOP } from './board'

/** The person who is signed in. */
export interface Person {
  readonly name: string
  readonly part: Part
}

/** Lets the next press show everybody a point. */
interface Pointing {
  readonly active: boolean
  toggle(): void
}

/** Aligns this headset by touch with those of a frame. */
interface Joining {
  readonly inside: boolean
  join(frame: string): void
}

const MOST_LISTED = 6
const ROW = 46
const ALIGN = 230
const SMALL = { small: true }

/** The people in the room, and the button with which instructors pause everything. */
export function peopleTab(
  ports: Speech & Lab,
  people: People,
  follower: LabFollower,
  own: Person,
  pointing: Pointing,
  joining: Joining,
): Tab {
  const w = ports.words.room
  const pause = async () => {
    const { paused, failed } = await pauseAll(ports.link, follower)
    if (failed.length > 0) ports.say(failed.join('; '))
    else ports.say(paused.length === 0 ? w.nothingMoves : w.pausedAll(paused.length), false)
  }
  return {
    id: 'people',
    words: w.people,
    draw: (pen) => {
      let y = TOP + 12
      const line = (part: Part, name: string, where = '') => {
        const words = `${PART_ICONS[part]}  ${name} · ${w.parts[part]}${where}`
        pen.text(EDGE, y, words, TEXT.body, BOARD_WIDTH - 2 * EDGE - ALIGN - GAP, 'ink', 600)
        y += ROW
      }
      line(own.part, `${named(own.name)} (${w.you})`)
      const { present } = people
      for (const { id, name, part, frame, aligned } of present.slice(0, MOST_LISTED)) {
        if (joining.inside && !aligned) {
          const x = BOARD_WIDTH - EDGE - ALIGN
          const join = () => joining.join(frame)
          pen.button(`align ${id}`, x, y - ROW / 2 + 1, ALIGN, w.alignWith, join, SMALL, ROW - 4)
        }
        line(part, named(name), aligned ? '' : ` · ${w.notAligned}`)
      }
      const more = present.length - MOST_LISTED
      if (more > 0) pen.text(EDGE, y, w.andMore(more), TEXT.small, undefined, 'second')
      if (present.length === 0) pen.lines(EDGE, y, w.alone, TEXT.small, undefined, 'second')
      const width = (BOARD_WIDTH - 2 * EDGE - GAP) / 2
      if (own.part !== 2) return
      pen.button('pause_all', EDGE, BOTTOM - HIT - GAP, width, w.pauseAll, () => void pause(), {
        primary: true,
      })
      const right = EDGE + width + GAP
      const look = { chosen: pointing.active }
      pen.button(
        'look_here',
        right,
        BOTTOM - HIT - GAP,
        width,
        w.lookHere,
        () => pointing.toggle(),
        look,
      )
    },
  }
}
