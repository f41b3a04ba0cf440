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

const MOST_LISTED = 8
const ROW = 36

/** The people in the room, and the button with which instructors pause everything. */
export function peopleTab(
  ports: Speech & Lab,
  people: People,
  follower: LabFollower,
  own: Person,
  pointing: Pointing,
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
      const line = (part: Part, name: string, ink: string, aligned = true) => {
        const place = aligned ? '' : ` · ${w.notAligned}`
        const words = `${PART_ICONS[part]}  ${name} · ${w.parts[part]}${place}`
        pen.text(EDGE, y, words, TEXT.body, undefined, ink, 600)
        y += ROW
      }
      line(own.part, `${named(own.name)} (${w.you})`, 'ink')
      const { present } = people
      for (const { name, part, aligned } of present.slice(0, MOST_LISTED))
        line(part, named(name), 'ink', aligned)
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
