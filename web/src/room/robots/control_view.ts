import type { RobotView } from '../../lab/followed_robot'
import { spoken } from '../../words/diagnostic'
import { named } from '../../words/words'
import { GAP, HIT, PANEL_THEME, type Pen, TEXT } from '../panels/pen'
import type { Speech } from '../ports'

const TOP = 254

/** The actions of a robot's controls. */
export interface ControlActions {
  /** verb: a service of the playback. */
  trigger(verb: 'play' | 'pause' | 'stop'): void
  /** step: to the next rate, up or down. */
  changeRate(step: number): void
  open(view: 'motions' | 'end_effectors' | 'show'): void
  toggleTelemetry(): void
  useHand(): void
  remove(): void
}

/** State of the panel itself. */
interface ControlShown {
  /** The last sentence; empty: none. */
  readonly notice: string
  readonly loaded: boolean
  readonly telemetry: boolean
  /** mm that are taken to the right of the sentence. */
  readonly beside: number
}

/** Draw the status of a robot, between its name and its timeline: its motion, and the reason for a
 * halt. */
export function drawStatus(
  pen: Pen,
  edge: number,
  { words }: Speech,
  { robot, playback, state, touching, holding, overlaps, down }: RobotView,
  { notice, loaded, beside }: ControlShown,
): void {
  const w = words.room
  const motion = playback?.trajectory_id ?? ''
  const hand = robot.end_effector === '' ? '' : ` + ${named(robot.end_effector)}`
  const parts = [`${robot.model}${hand}`, motion || w.noMotion]
  pen.text(edge, 76, parts.join(' · '), TEXT.small, undefined, 'second')
  const width = pen.width - 2 * edge - beside
  if (state === 'COLLISION_HALT') {
    pen.box(edge, 92, pen.width - 2 * edge, 68, PANEL_THEME.states.COLLISION_HALT)
    const ink = PANEL_THEME.colours.on_halt
    pen.text(edge + 16, 112, touching || w.cleared, TEXT.read, 550, ink, 700)
    const next = touching ? w.moveClear : w.playOn
    pen.text(edge + 16, 143, next, TEXT.small, 550, ink, 600)
  } else if (down) {
    pen.lines(edge, 108, words.lab.outages.robot, TEXT.read, width, PANEL_THEME.states.PAUSED, 2)
  } else if (notice !== '') {
    pen.lines(edge, 108, notice, TEXT.read, width, PANEL_THEME.states.PAUSED, 2)
  } else if (overlaps.length > 0) {
    const stands = words.lab.standsIn(overlaps.map((each) => named(each)).join(', '))
    pen.lines(edge, 108, stands, TEXT.read, width, PANEL_THEME.states.PAUSED, 2)
  } else if (playback?.message) {
    pen.lines(edge, 108, spoken(playback), TEXT.read, width, 'second', 2)
  } else if (holding) {
    pen.text(edge, 112, words.lab.holds(holding), TEXT.read, width)
  }
  if (!loaded) pen.text(edge, 200, w.chooseMotion, TEXT.read)
}

/** Draw the buttons of a robot: play, rate, motions, end effector and drawings. */
export function drawButtons(
  pen: Pen,
  edge: number,
  { words }: Speech,
  { robot, state, player, holding }: RobotView,
  { loaded, telemetry }: ControlShown,
  actions: ControlActions,
): void {
  const w = words.room
  const moving = state === 'PLAYING' || state === 'ADJUSTING'
  const enabled = { enabled: loaded }
  const play = () => actions.trigger(moving ? 'pause' : 'play')
  const primary = { primary: true, enabled: loaded }
  pen.button('play', edge, TOP, 206, moving ? w.pause : w.play, play, primary)
  const stop = () => actions.trigger('stop')
  pen.button('stop', edge + 206 + GAP, TOP, 116, w.stop, stop, enabled)
  const rates = edge + 206 + 116 + 2 * GAP
  pen.button('slower', rates, TOP, HIT, '−', () => actions.changeRate(-1), enabled)
  const rate = `${player.rate} ×`
  pen.text(rates + HIT + 51, TOP + HIT / 2, rate, TEXT.body, 90, 'ink', 600, 'center')
  const right = pen.width - edge - HIT
  pen.button('faster', right, TOP, HIT, '+', () => actions.changeRate(1), enabled)

  const third = (pen.width - 2 * edge - 2 * GAP) / 3
  const [left, middle, last] = [0, 1, 2].map((i) => edge + i * (third + GAP)) as [
    number,
    number,
    number,
  ]
  const row = TOP + HIT + GAP
  const open = (view: Parameters<ControlActions['open']>[0]) => () => actions.open(view)
  pen.button('motions', left, row, third, w.motions, open('motions'), { primary: !loaded })
  pen.button('end_effector', middle, row, third, w.endEffector, open('end_effectors'))
  const toggle = () => actions.toggleTelemetry()
  pen.button('telemetry', last, row, third, w.telemetry, toggle, { chosen: telemetry })

  const bottom = row + HIT + GAP
  pen.button('show', left, bottom, third, w.show, open('show'))
  const grip = holding !== '' ? w.letGo : w.giveInHand
  const hand = { enabled: robot.end_effector !== '' }
  pen.button('hand', middle, bottom, third, grip, () => actions.useHand(), hand)
  pen.button('remove', last, bottom, third, w.remove, () => actions.remove())
}
