import { CircleGeometry, Mesh, MeshBasicMaterial, PlaneGeometry } from 'three'
import { fits } from '../../pages/lab/catalogue'
import type { RobotView } from '../../pages/lab/followed_robot'
import { RATES } from '../../playback/player'
import { loadTrajectoryType, removeType, setEndEffectorType } from '../../protocol/mrlab_msgs'
import { triggerType } from '../../protocol/std_srvs'
import { order, type RoomContext } from '../context'
import { Panel } from './panel'
import { GAP, HIT, PANEL_THEME, type Pen, TEXT } from './pen'

const WIDTH = 640
const HEIGHT = 500
const EDGE = 26
/** mm, of the timeline in the panel. */
const TRACK = { x: EDGE, y: 208, width: WIDTH - 2 * EDGE, height: HIT } as const
const MM = 0.001
const PAGE = 4
/** s between two seeks of one drag. */
const SEEK_PERIOD = 0.05
/** s between two paintings of the time that goes on. */
const TIME_PERIOD = 0.25
const NOTICE_S = 8

type View = 'control' | 'motions' | 'end_effectors'

/** The panel at a robot: its motions, play, timeline, rate, end effector, and why it halted. */
export class ControlPanel {
  readonly panel: Panel
  telemetry = false
  /** Places on the timeline, s, at which it collided. */
  readonly collisions: number[] = []
  private view: View = 'control'
  private page = 0
  private notice = ''
  private noticedAt = 0
  private soughtAt = 0
  private paintedAt = 0
  private now = 0
  private scrub: number | null = null
  private robot: RobotView
  private readonly flat = new MeshBasicMaterial({ toneMapped: false })
  private readonly bar = new Mesh(new PlaneGeometry(1, 1), this.flat)
  private readonly knob = new Mesh(new CircleGeometry(0.5, 24), this.flat)

  constructor(
    private readonly context: RoomContext,
    robot: RobotView,
  ) {
    this.robot = robot
    this.panel = new Panel(WIDTH, HEIGHT, (pen) => this.draw(pen), context)
    this.flat.color.set(PANEL_THEME.colours.accent)
    this.panel.group.add(this.bar, this.knob)
    this.bar.position.z = this.knob.position.z = 1.5 * MM
    this.knob.scale.setScalar(30 * MM)
  }

  get name(): string {
    return this.robot.robot.name
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
    this.bar.visible = this.knob.visible = shown
    if (shown) {
      const position = this.scrub ?? player.position()
      const share = player.duration > 0 ? position / player.duration : 0
      const length = Math.max(share * TRACK.width, 0.1)
      const left = TRACK.x - WIDTH / 2
      const y = (HEIGHT / 2 - TRACK.y - TRACK.height / 2) * MM
      this.bar.scale.set(length * MM, 8 * MM, 1)
      this.bar.position.set((left + length / 2) * MM, y, this.bar.position.z)
      this.knob.position.set((left + length) * MM, y, this.knob.position.z)
      if (player.playing && now - this.paintedAt > TIME_PERIOD) this.panel.repaint()
    }
    this.panel.update()
  }

  dispose(): void {
    this.panel.dispose()
    this.bar.geometry.dispose()
    this.knob.geometry.dispose()
    this.flat.dispose()
  }

  private get loaded(): boolean {
    return (this.robot.playback?.frame_count ?? 0) > 0
  }

  /** Who is told to play, pause and so on: the system where the robot is in one. */
  private get driver(): string {
    return this.robot.playback?.system || this.name
  }

  private readonly say = (text: string): void => {
    this.notice = text
    this.noticedAt = this.now
    this.panel.repaint()
  }

  private trigger(verb: string): void {
    order({ link: this.context.link, say: this.say }, `${this.driver}/${verb}`, triggerType, {})
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
    else this.drawControl(pen)
  }

  private drawControl(pen: Pen): void {
    const { robot, playback, state, player, touching, holding } = this.robot
    const w = this.context.words.room
    const motion = playback?.trajectory_id ?? ''
    const hand = robot.end_effector === '' ? '' : ` + ${robot.end_effector}`
    const parts = [`${robot.model}${hand}`, motion || w.noMotion]
    if (playback?.system) parts.push(this.context.words.lab.inSystem(playback.system))
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
      this.page = 0
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
    pen.button('remove', EDGE, row + HIT + GAP, third, w.remove, () => {
      const { link } = this.context
      order({ link, say: this.say }, 'lab/remove_robot', removeType, { name: robot.name })
    })
    pen.text(
      EDGE + third + GAP,
      row + HIT + GAP + HIT / 2,
      w.carryHint,
      TEXT.small,
      undefined,
      'second',
    )
  }

  private drawTimeline(pen: Pen): void {
    const { player, playback } = this.robot
    const { x, y, width, height } = TRACK
    const middle = y + height / 2
    const { duration } = player
    pen.box(x, middle - 4, width, 8, PANEL_THEME.colours.hairline)
    const at = (time: number) => x + (duration > 0 ? time / duration : 0) * width
    for (const { time, close } of this.robot.targets) {
      pen.box(at(time) - 2, middle - 20, 4, 40, PANEL_THEME.colours.second)
      const mark = close ? this.context.words.room.grasps : this.context.words.room.releases
      pen.text(at(time), middle - 30, mark, TEXT.small, 120, 'second', 400, 'center')
    }
    for (const time of this.collisions) {
      pen.box(at(time) - 3, middle - 16, 6, 32, PANEL_THEME.states.COLLISION_HALT)
    }
    const position = this.scrub ?? player.position()
    const frame = playback === null ? 0 : Math.round(position * playback.frame_rate)
    const time = `${position.toFixed(1)} / ${duration.toFixed(1)} s`
    pen.text(x, y + height + 10, time, TEXT.small, 300, 'ink', 600)
    const rows = this.context.words.room.frame(frame + 1, playback?.frame_count ?? 0)
    pen.text(x + width, y + height + 10, rows, TEXT.small, 300, 'second', 400, 'right')
    pen.zone({
      id: 'timeline',
      x,
      y,
      width,
      height,
      enabled: true,
      drags: true,
      press: (share, final) => this.seek(share * duration, final),
    })
  }

  private seek(position: number, final: boolean): void {
    this.scrub = final ? null : position
    this.panel.repaint()
    if (!final && this.now - this.soughtAt < SEEK_PERIOD) return
    this.soughtAt = this.now
    this.robot.player.seek(position)
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
  private drawList(
    pen: Pen,
    entries: readonly { id: string; words: string; note: string }[],
    choose: (id: string) => void,
  ): void {
    const w = this.context.words.room
    const pages = Math.max(Math.ceil(entries.length / PAGE), 1)
    this.page = Math.min(this.page, pages - 1)
    const wide = WIDTH - 2 * EDGE
    entries.slice(this.page * PAGE, (this.page + 1) * PAGE).forEach(({ id, words, note }, i) => {
      const y = 86 + i * (HIT + GAP)
      const label = note === '' || note === words ? words : `${words} · ${note}`
      pen.button(`choose ${id}`, EDGE, y, wide, label, () => {
        this.view = 'control'
        choose(id)
      })
    })
    const y = HEIGHT - HIT - EDGE
    const turn = (by: number) => () => {
      this.page += by
    }
    pen.button('back', EDGE, y, 190, w.back, () => {
      this.view = 'control'
    })
    if (pages === 1) return
    pen.button('previous', WIDTH - EDGE - 2 * 90 - GAP - 90, y, 90, '‹', turn(-1), {
      enabled: this.page > 0,
    })
    const place = `${this.page + 1} / ${pages}`
    pen.text(
      WIDTH - EDGE - 90 - GAP / 2 - 45,
      y + HIT / 2,
      place,
      TEXT.small,
      80,
      'second',
      400,
      'center',
    )
    pen.button('next', WIDTH - EDGE - 90, y, 90, '›', turn(1), { enabled: this.page < pages - 1 })
  }
}
