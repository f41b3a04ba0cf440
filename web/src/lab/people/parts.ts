import { Presence } from '../../protocol/mrlab_msgs'

/** An icon beside the word: a part is never shown by a colour alone. */
export const PART_ICONS = { 0: '○', 1: '▶', 2: '★' } as const

export type Part = keyof typeof PART_ICONS

/** Return a part as one of the three that there are. */
export function partOf({ part }: Pick<Presence, 'part'>): Part {
  return part === Presence.TEACHES || part === Presence.DRIVES ? (part as Part) : 0
}

/** The frame of the displays in the lab's place. That of others is the id of their place, or of a
 * display: its own, or that of another one that it was aligned with. */
export const COMMON = 'world'
