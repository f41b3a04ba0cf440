import type { Check } from '../../api/types'
import { counted, kindOf } from '../../lab/robot_check'
import type { Words } from '../../words/en'
import { number } from '../../words/words'
import type { Choice } from './paged_list'
import { PANEL_THEME } from './pen'

/** mm */
export const CHECK_WIDTH = 240
const MOST_LISTED = 40

/** Return what the button of a check says. */
export function checkLabel(check: Check | null, { check: w }: Pick<Words, 'check'>): string {
  if (check === null) return w.check
  const { state, verdict, stale } = check
  if (state === 'failed') return w.again
  if (state !== 'done') return w.verdicts.running
  const { refusing, warning } = counted(check)
  const count = refusing + warning
  const said = `${w.verdicts[verdict === 'ready' ? 'ready' : 'not_ready']}${stale !== null ? '?' : ''}`
  return count > 0 ? `${said} · ${count}` : said
}

/** Return the colour of a verdict, which stands below its words. */
export function checkColour({ state, verdict, stale }: Check): string {
  const { states } = PANEL_THEME
  if (state !== 'done' || stale !== null) return states.PAUSED
  return verdict === 'ready' ? states.READY : states.COLLISION_HALT
}

/** Return the findings of a check as a list, by their place in it; first, to check again. */
export function findingChoices(
  check: Check | null,
  again: boolean,
  words: Pick<Words, 'check' | 'severities'>,
): Choice[] {
  const choices: Choice[] = again ? [{ id: 'again', words: words.check.again, note: '' }] : []
  check?.findings.slice(0, MOST_LISTED).forEach(({ severity, code, time, link }, i) => {
    const at = time === null ? '' : ` ${words.check.at(number(time, 2))}`
    const text = `${words.severities[severity]}: ${kindOf(code, words)}${at}`
    choices.push({ id: String(i), words: text, note: link })
  })
  return choices
}
