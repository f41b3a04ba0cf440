import { THEMES } from '../../design/tokens'
import { commandsOf } from '../../lab/commands'
import type { CourseOf } from '../../lab/followed_robot'
import { LabFollower } from '../../lab/follower'
import type { Link } from '../../link/link'
import { themeNow } from '../../scene/stage/theme'
import { sentence } from '../../words/diagnostic'
import type { RoomContext } from '../context'

/** Return what follows the lab for a room; says which motion could not be fetched. */
export function roomFollower(
  link: Link,
  { words, say }: Pick<RoomContext, 'words' | 'say'>,
  courseOf: CourseOf,
): LabFollower {
  return new LabFollower(link, {
    commands: (name) => commandsOf(link, name),
    word: (state) => words.states[state],
    // names stand in the picture, whose theme is the page's
    colour: (state) => THEMES[themeNow().name].states[state],
    stir: () => undefined,
    courseOf: (id) =>
      courseOf(id).catch((error: unknown) => {
        say(sentence(error))
        throw error
      }),
  })
}
