import { fits } from '../../pages/lab/catalogue'
import type { RobotView } from '../../pages/lab/followed_robot'
import { RATES } from '../../playback/player'
import {
  attachType,
  detachType,
  loadTrajectoryType,
  removeType,
  setEndEffectorType,
} from '../../protocol/mrlab_msgs'
import { triggerType } from '../../protocol/std_srvs'
import { order, type RoomContext } from '../context'
import { type Choice, PagedList } from './paged_list'
import { Panel } from './panel'
import { GAP, HIT, PANEL_THEME, type Pen, TEXT } from './pen'
import { comparable, drawShow } from './show_view'
import { type Mark, Timeline, type Track } from './timeline'

const WIDTH = 640
const HEIGHT = 500
const EDGE = 26
const TRACK: Track = { x: EDGE, y: 208, width: WIDTH - 2 * EDGE, height: HIT }
/** s between two paintings of the time that goes on. */
const TIME_PERIOD = 0.5
const NOTICE_S = 8

type View = 'control' | 'motions' | 'end_effectors' | 'show' | 'compare'

/** The panel at a robot: its motions, play, timeline, rate, end effector, and why it halted. */
export class ControlPanel {
  readonly panel: Panel
  telemetry = false
  /** Places on the timeline, s, at which it collided. */
  readonly collisions: number[] = []
  private view: View = 'control'
  private notice = ''
  private noticedAt = 0
  private paintedAt = 0
  private now = 0
  private robot: RobotView
  private readonly list = new PagedList()
  private readonly timeline: Timeline

  constructor(
    private readonly context: RoomContext,
    robot: RobotView,
  ) {
    this.robot = robot
    this.panel = new Panel(WIDTH, HEIGHT, (pen) => this.draw(pen), context)
    const repaint = () => this.panel.repaint()
    this.timeline = new Timeline(this.panel.group, WIDTH, HEIGHT, TRACK, repaint)
  }

  get name(): string {
    return this.robot.robot.name
  }

  get scrubs(): number {
    return this.timeline.scrubs
  }

  get joints(): readonly string[] {
    return this.robot.robot.joint_names
  }

  /** Take over how the robot stands. */
  show(robot: RobotView): void {
    const before = this.robot
    this.robot = robot
    const halted = robot.state === 'COLLISION_HALT' && before.state !== 'COLLISION_HALT'
    if (halted) {
      this.view = 'control'
      this.collisions.push(robot.player.position())
    }
    if (robot.playback?.trajectory_id !== before.playback?.trajectory_id) {
      this.collisions.length = 0
    }
    this.panel.repaint()
  }

  /** Before each picture. now: s. */
  update(now: number): void {
    this.now = now
    if (this.notice !== '' && now - this.noticedAt > NOTICE_S) {
      this.notice = ''
      this.panel.repaint()
    }
    const { player } = this.robot
    const shown = this.view === 'control' && this.loaded
    this.timeline.update(shown ? player : null, now)
    const counts = (shown && player.playing) || this.compares
    if (counts && now - this.paintedAt > TIME_PERIOD) this.panel.repaint()
    this.panel.update()
  }

  dispose(): void {
    this.panel.dispose()
    this.timeline.dispose()
  }

  /** Whether it shows how far the robot is from its ghost. */
  private get compares(): boolean {
    return this.view === 'show' && this.context.drawings.reference(this.name) !== null
  }

  private get loaded(): boolean {
    return (this.robot.playback?.frame_count ?? 0) > 0
  }

  private readonly say = (text: string): void => {
    this.notice = text
    this.noticedAt = this.now
    this.panel.repaint()
  }

  private trigger(verb: string): void {
    order({ link: this.context.link, say: this.say }, `${this.name}/${verb}`, triggerType, {})
  }

  private draw(pen: Pen): void {
    this.paintedAt = this.now
    const { robot, state } = this.robot
    const w = this.context.words
    pen.text(EDGE, 42, robot.name, TEXT.head, 330, 'ink', 700)
    const halted = state === 'COLLISION_HALT'
    pen.chip(WIDTH - EDGE, 42, w.states[state], PANEL_THEME.states[state], halted)
    if (this.view === 'motions') this.drawMotions(pen)
    else if (this.view === 'end_effectors') this.drawEndEffectors(pen)
    else if (this.view === 'show') this.drawShow(pen)
    else if (this.view === 'compare') this.drawCompare(pen)
    else this.drawControl(pen)
  }

  private drawControl(pen: Pen): void {
    const { robot, playback, state, player, touching, holding } = this.robot
    const w = this.context.words.room
    const motion = playback?.trajectory_id ?? ''
    const hand = robot.end_effector === '' ? '' : ` + ${robot.end_effector}`
    const parts = [`${robot.model}${hand}`, motion || w.noMotion]
    pen.text(EDGE, 82, parts.join(' · '), TEXT.small, undefined, 'second')
    if (state === 'COLLISION_HALT') {
      pen.box(EDGE, 104, WIDTH - 2 * EDGE, 92, PANEL_THEME.states.COLLISION_HALT)
      const ink = PANEL_THEME.colours.on_halt
      pen.text(EDGE + 16, 132, touching || w.cleared, TEXT.body, 550, ink, 700)
      const next = touching ? w.moveClear : w.playOn
      pen.text(EDGE + 16, 168, next, TEXT.small, 550, ink, 600)
    } else if (this.notice !== '') {
      pen.lines(EDGE, 122, this.notice, TEXT.small, undefined, PANEL_THEME.states.PAUSED, 3)
    } else if (playback?.message) {
      pen.lines(EDGE, 122, playback.message, TEXT.small, undefined, 'second', 3)
    } else if (holding) {
      pen.text(EDGE, 122, this.context.words.lab.holds(holding), TEXT.small)
    }
    if (this.loaded) this.drawTimeline(pen)
    else pen.text(EDGE, 238, w.chooseMotion, TEXT.body)
    const moving = state === 'PLAYING' || state === 'ADJUSTING'
    const top = 290
    pen.button(
      'play',
      EDGE,
      top,
      206,
      moving ? w.pause : w.play,
      () => this.trigger(moving ? 'pause' : 'play'),
      { primary: true, enabled: this.loaded },
    )
    pen.button('stop', EDGE + 206 + GAP, top, 116, w.stop, () => this.trigger('stop'), {
      enabled: this.loaded,
    })
    const rates = EDGE + 206 + 116 + 2 * GAP
    pen.button('slower', rates, top, HIT, '−', () => this.changeRate(-1), { enabled: this.loaded })
    const rate = `${player.rate} ×`
    pen.text(rates + HIT + 51, top + HIT / 2, rate, TEXT.body, 90, 'ink', 600, 'center')
    pen.button('faster', WIDTH - EDGE - HIT, top, HIT, '+', () => this.changeRate(1), {
      enabled: this.loaded,
    })
    const third = (WIDTH - 2 * EDGE - 2 * GAP) / 3
    const row = top + HIT + GAP
    const open = (view: View) => () => {
      this.view = view
      this.list.page = 0
    }
    pen.button('motions', EDGE, row, third, w.motions, open('motions'), { primary: !this.loaded })
    pen.button(
      'end_effector',
      EDGE + third + GAP,
      row,
      third,
      w.endEffector,
      open('end_effectors'),
    )
    pen.button(
      'telemetry',
      EDGE + 2 * (third + GAP),
      row,
      third,
      w.telemetry,
      () => {
        this.telemetry = !this.telemetry
      },
      { chosen: this.telemetry },
    )
    const last = row + HIT + GAP
    pen.button('show', EDGE, last, third, w.show, open('show'))
    const grip = holding !== '' ? w.letGo : w.giveInHand
    pen.button('hand', EDGE + third + GAP, last, third, grip, () => this.useHand(), {
      enabled: robot.end_effector !== '',
    })
    pen.button('remove', EDGE + 2 * (third + GAP), last, third, w.remove, () => {
      const { link } = this.context
      order({ link, say: this.say }, 'lab/remove_robot', removeType, { name: robot.name })
    })
  }

  /** Let the gripper lose what it holds, or fix to it what is nearest to its fingers. */
  private useHand(): void {
    const { link, objectAt } = this.context
    const { holding } = this.robot
    const robot = this.name
    const teller = { link, say: this.say }
    if (holding !== '') {
      order(teller, 'physics/detach', detachType, { robot })
      return
    }
    const object = objectAt(robot)
    if (object === '') this.say(this.context.words.room.nothingNear)
    else order(teller, 'physics/attach', attachType, { robot, object })
  }

  private drawShow(pen: Pen): void {
    drawShow(pen, EDGE, this.context, this.robot, {
      compare: () => {
        this.view = 'compare'
        this.list.page = 0
      },
      back: () => {
        this.view = 'control'
      },
    })
  }

  private drawCompare(pen: Pen): void {
    const back = () => {
      this.view = 'show'
    }
    this.list.draw(pen, EDGE, comparable(this.context, this.robot), this.context.words.room.back, {
      back,
      choose: (id) => {
        back()
        this.context.drawings.compare(this.name, id)
      },
    })
  }

  private drawTimeline(pen: Pen): void {
    const { player, playback, targets } = this.robot
    const w = this.context.words.room
    const { colours, states } = PANEL_THEME
    const marks: Mark[] = [
      ...targets.map(({ time, close }) => ({
        time,
        colour: colours.second,
        words: close ? w.grasps : w.releases,
      })),
      ...this.collisions.map((time) => ({ time, colour: states.COLLISION_HALT, words: '' })),
    ]
    const rate = playback?.frame_rate ?? 0
    const frame = Math.round(this.timeline.position(player) * rate)
    this.timeline.draw(pen, player, marks, w.frame(frame + 1, playback?.frame_count ?? 0))
  }

  private changeRate(step: number): void {
    const { player } = this.robot
    const index = RATES.findIndex((rate) => rate >= player.rate - 1e-9)
    const next = RATES[Math.min(Math.max(index + step, 0), RATES.length - 1)]
    if (next !== undefined) player.setRate(next)
  }

  private drawMotions(pen: Pen): void {
    const { robot } = this.robot
    const w = this.context.words.room
    const fit = this.context.trajectories.filter((each) => fits(each, robot))
    if (fit.length === 0) pen.lines(EDGE, 120, w.noneFits(robot.model), TEXT.body)
    this.drawList(
      pen,
      fit.map(({ id, duration }) => ({ id, words: id, note: `${duration.toFixed(1)} s` })),
      (id) => {
        const { link } = this.context
        order({ link, say: this.say }, `${this.name}/load`, loadTrajectoryType, { id })
      },
    )
  }

  private drawEndEffectors(pen: Pen): void {
    const w = this.context.words.room
    const none = { id: '', words: w.bareFlange, note: '' }
    const all = this.context.endEffectors.map(({ id, name }) => ({ id, words: name, note: id }))
    this.drawList(pen, [none, ...all], (id) => {
      const request = { robot: this.name, end_effector: id }
      const { link } = this.context
      order({ link, say: this.say }, 'lab/set_end_effector', setEndEffectorType, request)
    })
  }

  /** A page of a list; choosing one returns to the controls. */
  private drawList(pen: Pen, entries: readonly Choice[], choose: (id: string) => void): void {
    const back = () => {
      this.view = 'control'
    }
    this.list.draw(pen, EDGE, entries, this.context.words.room.back, {
      back,
      choose: (id) => {
        back()
        choose(id)
      },
    })
  }
}
