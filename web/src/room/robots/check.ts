import { effect } from '@preact/signals'
import type { Check } from '../../api/types'
import type { RobotView } from '../../lab/followed_robot'
import { type CheckApi, counted, kindOf, marksOf, RobotCheck } from '../../lab/robot_check'
import type { Player } from '../../playback/player'
import type { Words } from '../../words/en'
import { number } from '../../words/words'
import type { Choice, PagedList } from '../panels/paged_list'
import { HIT, PANEL_THEME, type Pen } from '../panels/pen'
import type { Mark } from '../panels/timeline'
import type { Speech } from '../ports'

/** mm */
export const CHECK_WIDTH = 240
const MOST_LISTED = 40

/** Return the label of the button of a check. */
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

const TOP = 92
/** mm, of the line below the verdict that has its colour. */
const LINE = 5

/** The checks of the lab. commands: the person may have motions checked. */
export interface Checks {
  readonly checks: CheckApi
  readonly commands: boolean
}

/** The check of a robot's loaded motion, on the robot's panel. */
export class PanelCheck {
  private readonly check: RobotCheck
  private readonly stopListening: () => void
  /** False until the panel has seen its first motion, which is not checked automatically. */
  private followed = false

  constructor(
    private readonly ports: Speech & Checks,
    robot: string,
    repaint: () => void,
    say: (text: string) => void,
  ) {
    this.check = new RobotCheck(ports.checks, robot)
    const { check, problem } = this.check
    this.stopListening = effect(() => {
      // read first: both are followed
      const known = check.value
      if (problem.value !== '' && known === null) say(problem.value)
      else repaint()
    })
  }

  /** Start a check of the loaded motion, if it was loaded after the panel was made. */
  follow({ playback, state }: RobotView): void {
    if (playback === null) return
    const { trajectory_id: id, trajectory_version: version } = playback
    const begins = this.followed && this.ports.commands && state === 'READY'
    this.followed = true
    void this.check.follow(id && `${id}@${version}`, begins)
  }

  /** Return the marks on the timeline of a motion of `duration` s. */
  marks(duration: number): Mark[] {
    const { states } = PANEL_THEME
    return marksOf(this.check.check.value, duration).map(({ time, finding: { severity } }) => ({
      time,
      colour: severity === 'error' ? states.COLLISION_HALT : states.PAUSED,
      words: '',
    }))
  }

  /** Draw a button with the verdict that opens its findings; without a verdict it starts a check.
   * right: its right edge, mm. */
  drawVerdict(pen: Pen, right: number, open: () => void): void {
    const { words, commands } = this.ports
    const check = this.check.check.value
    const unknown = check === null || check.state === 'failed'
    const press = () => {
      if (unknown) void this.check.start()
      else open()
    }
    const x = right - CHECK_WIDTH
    const look = { small: true, enabled: !unknown || commands }
    pen.button('check', x, TOP, CHECK_WIDTH, checkLabel(check, words), press, look)
    if (check === null) return
    pen.box(x + 12, TOP + HIT - LINE - 4, CHECK_WIDTH - 24, LINE, checkColour(check))
  }

  /** Draw the findings of the check; a finding leads to its instant. */
  drawFindings(pen: Pen, edge: number, list: PagedList, player: Player, back: () => void): void {
    const { words, commands } = this.ports
    const check = this.check.check.value
    list.draw(pen, edge, findingChoices(check, commands, words), words.room.back, {
      back,
      choose: (id) => {
        back()
        const time = check?.findings[Number(id)]?.time ?? null
        if (id === 'again') void this.check.start()
        else if (time !== null) player.seek(time)
      },
    })
  }

  dispose(): void {
    this.stopListening()
    this.check.dispose()
  }
}
