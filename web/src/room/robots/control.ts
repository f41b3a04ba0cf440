import { fits } from '../../lab/catalogue'
import { order } from '../../lab/commands'
import type { RobotView } from '../../lab/followed_robot'
import { rateAfter } from '../../playback/player'
import {
  attachType,
  detachType,
  loadTrajectoryType,
  removeType,
  setEndEffectorType,
  triggerType,
} from '../../protocol/mrlab_msgs'
import { fixed } from '../../words/words'
import { Notice } from '../panels/notice'
import { type Choice, PagedList } from '../panels/paged_list'
import type { Surroundings } from '../panels/panel'
import { Panel } from '../panels/panel'
import { CLOSE, HIT, PANEL_THEME, type Pen, TEXT } from '../panels/pen'
import { type Mark, Timeline, type Track } from '../panels/timeline'
import type { Catalogue, Lab, Speech } from '../ports'
import type { Drawings } from '../scene/drawings'
import { CHECK_WIDTH, type Checks, PanelCheck } from './check'
import { type ControlActions, drawButtons, drawStatus } from './control_view'
import { comparable, drawShow } from './show_view'

const WIDTH = 640
const HEIGHT = 480
const EDGE = 26
const TRACK: Track = { x: EDGE, y: 164, width: WIDTH - 2 * EDGE, height: HIT }
/** s between two paintings of a robot's deviation from its ghost. */
const COMPARE_PERIOD = 0.5

/** The ports of a robot's panel. */
type ControlPorts = Speech & Lab & Catalogue & Surroundings & Checks

type View = 'control' | 'motions' | 'end_effectors' | 'show' | 'compare' | 'check'

/** The panel at a robot: its motions, play, timeline, rate, end effector, and the reason for a
 * halt. */
export class ControlPanel {
  readonly panel: Panel
  telemetry = false
  /** Places on the timeline, s, at which it collided. */
  readonly collisions: number[] = []
  private page: View = 'control'
  private readonly notice = new Notice(() => this.panel.repaint())
  private readonly lab: Lab
  private paintedAt = 0
  private robot: RobotView
  private readonly list = new PagedList()
  private readonly timeline: Timeline
  private readonly check: PanelCheck
  private readonly actions: ControlActions = {
    trigger: (verb) => this.trigger(verb),
    changeRate: (step) => this.changeRate(step),
    open: (view) => this.open(view),
    toggleTelemetry: () => {
      this.telemetry = !this.telemetry
    },
    useHand: () => this.useHand(),
    remove: () => this.remove(),
  }

  /** objectAt: the object nearest to a robot's fingers; empty: none is near. close: make a chip of
   * the panel. */
  constructor(
    private readonly ports: ControlPorts,
    robot: RobotView,
    private readonly drawings: Drawings,
    private readonly objectAt: (robot: string) => string,
    private readonly close: () => void,
  ) {
    this.robot = robot
    this.panel = new Panel(WIDTH, HEIGHT, (pen) => this.draw(pen), ports)
    this.lab = { link: ports.link, say: this.notice.say }
    const rowAt = (position: number) => this.rowAt(position)
    const stir = () => ports.stir()
    this.timeline = new Timeline(this.panel.group, WIDTH, HEIGHT, TRACK, rowAt, stir)
    this.check = new PanelCheck(ports, this.name, () => this.panel.repaint(), this.notice.say)
    this.check.follow(robot)
  }

  get name(): string {
    return this.robot.robot.name
  }

  get view(): RobotView {
    return this.robot
  }

  /** Play, or pause. */
  play(): void {
    const { state } = this.robot
    this.trigger(state === 'PLAYING' || state === 'ADJUSTING' ? 'pause' : 'play')
  }

  get scrubs(): number {
    return this.timeline.scrubs
  }

  get joints(): readonly string[] {
    return this.robot.robot.joint_names
  }

  /** Take over the state of the robot. */
  show(robot: RobotView): void {
    const before = this.robot
    this.robot = robot
    const halted = robot.state === 'COLLISION_HALT' && before.state !== 'COLLISION_HALT'
    if (halted) {
      this.page = 'control'
      this.collisions.push(robot.player.position())
    }
    if (robot.playback?.trajectory_id !== before.playback?.trajectory_id) {
      this.collisions.length = 0
    }
    this.check.follow(robot)
    if (halted || !looksAlike(robot, before)) this.panel.repaint()
  }

  /** Before each picture. now: s. */
  update(now: number): void {
    this.notice.update(now)
    const { player } = this.robot
    const shown = this.page === 'control' && this.loaded
    this.timeline.update(shown ? player : null, now)
    if (this.compares && now - this.paintedAt > COMPARE_PERIOD) {
      this.paintedAt = now
      this.panel.repaint()
    }
    this.panel.update()
  }

  dispose(): void {
    this.check.dispose()
    this.panel.dispose()
    this.timeline.dispose()
  }

  /** True while it shows the deviation of the robot from its ghost. */
  private get compares(): boolean {
    return this.page === 'show' && this.drawings.reference(this.name) !== null
  }

  private get loaded(): boolean {
    return (this.robot.playback?.frame_count ?? 0) > 0
  }

  private trigger(verb: string): void {
    order(this.lab, `${this.name}/${verb}`, triggerType, {})
  }

  private remove(): void {
    order(this.lab, 'lab/remove_robot', removeType, { name: this.name })
  }

  private draw(pen: Pen): void {
    const { state } = this.robot
    const w = this.ports.words
    pen.text(EDGE, 36, this.name, TEXT.head, 330, 'ink', 700)
    const halted = state === 'COLLISION_HALT'
    pen.close(WIDTH - EDGE, this.close)
    pen.chip(WIDTH - EDGE - CLOSE - 12, 36, w.states[state], PANEL_THEME.states[state], halted)
    if (this.page === 'motions') this.drawMotions(pen)
    else if (this.page === 'end_effectors') this.drawEndEffectors(pen)
    else if (this.page === 'show') this.drawShow(pen)
    else if (this.page === 'compare') this.drawCompare(pen)
    else if (this.page === 'check') {
      this.check.drawFindings(pen, EDGE, this.list, this.robot.player, () => this.open('control'))
    } else this.drawControl(pen)
  }

  private drawControl(pen: Pen): void {
    const { ports, robot, notice, loaded, telemetry } = this
    const checked = loaded && robot.state !== 'COLLISION_HALT'
    const shown = {
      notice: notice.text,
      loaded,
      telemetry,
      beside: checked ? CHECK_WIDTH + 16 : 0,
    }
    if (checked) this.check.drawVerdict(pen, WIDTH - EDGE, () => this.open('check'))
    drawStatus(pen, EDGE, ports, robot, shown)
    if (loaded) this.timeline.draw(pen, robot.player, this.marks())
    drawButtons(pen, EDGE, ports, robot, shown, this.actions)
  }

  /** Detach the object that the gripper holds, or attach the one nearest to its fingers. */
  private useHand(): void {
    const { holding } = this.robot
    const robot = this.name
    if (holding !== '') {
      order(this.lab, 'physics/detach', detachType, { robot })
      return
    }
    const object = this.objectAt(robot)
    if (object === '') this.notice.say(this.ports.words.room.nothingNear)
    else order(this.lab, 'physics/attach', attachType, { robot, object })
  }

  private drawShow(pen: Pen): void {
    drawShow(pen, EDGE, this.ports, this.drawings, this.robot, {
      compare: () => this.open('compare'),
      back: () => this.open('control'),
    })
  }

  private drawCompare(pen: Pen): void {
    const back = () => this.open('show')
    this.list.draw(pen, EDGE, comparable(this.ports, this.robot), this.ports.words.room.back, {
      back,
      choose: (id) => {
        back()
        this.drawings.compare(this.name, id)
      },
    })
  }

  /** Return the marks of the timeline: grasps, releases and collisions. */
  private marks(): Mark[] {
    const w = this.ports.words.room
    const { colours, states } = PANEL_THEME
    return [
      ...this.robot.targets.map(({ time, close }) => ({
        time,
        colour: colours.second,
        words: close ? w.grasps : w.releases,
      })),
      ...this.collisions.map((time) => ({ time, colour: states.COLLISION_HALT, words: '' })),
      ...this.check.marks(this.robot.playback?.duration ?? 0),
    ]
  }

  /** Return the text of the row of the motion at a position, s. */
  private rowAt(position: number): string {
    const { playback } = this.robot
    const row = Math.round(position * (playback?.frame_rate ?? 0)) + 1
    return this.ports.words.room.frame(row, playback?.frame_count ?? 0)
  }

  private open(view: View): void {
    this.page = view
    this.list.page = 0
    this.panel.repaint()
  }

  private changeRate(step: number): void {
    const { player } = this.robot
    player.setRate(rateAfter(player.rate, step))
  }

  private drawMotions(pen: Pen): void {
    const { robot } = this.robot
    const w = this.ports.words.room
    const fit = this.ports.trajectories.filter((each) => fits(each, robot))
    if (fit.length === 0) pen.lines(EDGE, 120, w.noneFits(robot.model), TEXT.body)
    this.drawList(
      pen,
      fit.map(({ id, duration }) => ({ id, words: id, note: `${fixed(duration, 1)} s` })),
      (id) => {
        order(this.lab, `${this.name}/load`, loadTrajectoryType, { id })
      },
    )
  }

  private drawEndEffectors(pen: Pen): void {
    const w = this.ports.words.room
    const none = { id: '', words: w.bareFlange, note: '' }
    const all = this.ports.endEffectors.map(({ id, name }) => ({ id, words: name, note: id }))
    this.drawList(pen, [none, ...all], (id) => {
      const request = { robot: this.name, end_effector: id }
      order(this.lab, 'lab/set_end_effector', setEndEffectorType, request)
    })
  }

  /** A page of a list; choosing one returns to the controls. */
  private drawList(pen: Pen, entries: readonly Choice[], choose: (id: string) => void): void {
    const back = () => this.open('control')
    this.list.draw(pen, EDGE, entries, this.ports.words.room.back, {
      back,
      choose: (id) => {
        back()
        choose(id)
      },
    })
  }
}

/** Return whether a panel looks the same for two states: the lab publishes the state once a
 * second, and a painted panel costs a frame. */
function looksAlike(one: RobotView, other: RobotView): boolean {
  const a = one.playback
  const b = other.playback
  return (
    one.state === other.state &&
    one.holding === other.holding &&
    one.down === other.down &&
    one.touching === other.touching &&
    one.targets === other.targets &&
    one.robot.model === other.robot.model &&
    one.robot.end_effector === other.robot.end_effector &&
    a?.trajectory_id === b?.trajectory_id &&
    a?.trajectory_version === b?.trajectory_version &&
    a?.frame_count === b?.frame_count &&
    a?.frame_rate === b?.frame_rate &&
    a?.duration === b?.duration &&
    a?.rate === b?.rate &&
    a?.message === b?.message
  )
}
