import { effect } from '@preact/signals'
import type { RobotView } from '../../lab/followed_robot'
import { marksOf, RobotCheck } from '../../lab/robot_check'
import type { Player } from '../../playback/player'
import type { RoomContext } from '../context'
import { CHECK_WIDTH, checkColour, checkLabel, findingChoices } from './check_view'
import type { PagedList } from './paged_list'
import { HIT, PANEL_THEME, type Pen } from './pen'
import type { Mark } from './timeline'

const TOP = 108
/** mm, of the line below the verdict that has its colour. */
const LINE = 5

/** The check of what a robot has loaded, on the robot's panel. */
export class PanelCheck {
  private readonly check: RobotCheck
  private readonly stopListening: () => void
  /** What was loaded when the panel came is not checked by itself. */
  private followed = false

  constructor(
    private readonly context: RoomContext,
    robot: string,
    repaint: () => void,
    say: (text: string) => void,
  ) {
    this.check = new RobotCheck(context.checks, robot)
    const { check, problem } = this.check
    this.stopListening = effect(() => {
      // read first: both are followed
      const known = check.value
      if (problem.value !== '' && known === null) say(problem.value)
      else repaint()
    })
  }

  /** Have what is loaded checked, where it has been loaded since the panel came. */
  follow({ playback, state }: RobotView): void {
    if (playback === null) return
    const { trajectory_id: id, trajectory_version: version } = playback
    const begins = this.followed && this.context.commands && state === 'READY'
    this.followed = true
    void this.check.follow(id && `${id}@${version}`, begins)
  }

  /** Return what is marked on the timeline of a motion of `duration` s. */
  marks(duration: number): Mark[] {
    const { states } = PANEL_THEME
    return marksOf(this.check.check.value, duration).map(({ time, finding: { severity } }) => ({
      time,
      colour: severity === 'error' ? states.COLLISION_HALT : states.PAUSED,
      words: '',
    }))
  }

  /** Draw a button that says the verdict and opens its findings; without one, it has the motion
   * checked. right: mm, where it ends. */
  drawVerdict(pen: Pen, right: number, open: () => void): void {
    const { words, commands } = this.context
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
    pen.box(x + 12, TOP + HIT + 4, CHECK_WIDTH - 24, LINE, checkColour(check))
  }

  /** Draw what the check found; a finding leads to its instant. */
  drawFindings(pen: Pen, edge: number, list: PagedList, player: Player, back: () => void): void {
    const { words, commands } = this.context
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
