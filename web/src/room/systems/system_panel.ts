import { STATE_NAMES, type StateName } from '../../design/tokens'
import { order } from '../../lab/commands'
import type { SystemView } from '../../lab/follower'
import { rateAfter } from '../../playback/player'
import { RobotSystem, removeType, setModeType, triggerType } from '../../protocol/mrlab_msgs'
import { spoken } from '../../words/diagnostic'
import { Notice } from '../panels/notice'
import { PagedList } from '../panels/paged_list'
import type { Surroundings } from '../panels/panel'
import { Panel } from '../panels/panel'
import { CLOSE, GAP, HIT, PANEL_THEME, type Pen, TEXT } from '../panels/pen'
import { Timeline, type Track } from '../panels/timeline'
import type { Lab, Speech } from '../ports'
import { type Segment, segmentsOf } from './segments'

const WIDTH = 640
const HEIGHT = 490
const EDGE = 26
const WIDE = WIDTH - 2 * EDGE
const SEGMENTS = { top: 102, height: 72 } as const
/** mm: a segment's bar, and the least row that has room for its words. */
const BAR = 10
const LABELLED = 28
const TRACK: Track = { x: EDGE, y: 178, width: WIDE, height: HIT }
const ROW = 266
const MOVING: ReadonlySet<number> = new Set([RobotSystem.STAGING, RobotSystem.PLAYING])

/** The ports of a system's panel. */
export type SystemPorts = Speech & Lab & Surroundings

type View = 'control' | 'members' | 'confirm'

/** Return the state of a playback whose colour a system has. */
export function stateOf({ label }: RobotSystem): StateName {
  if (label === 'STAGING') return 'ADJUSTING'
  return STATE_NAMES.find((name) => name === label) ?? 'READY'
}

/** The one panel of a robot system: its timeline with a segment for each member. */
export class SystemPanel {
  readonly panel: Panel
  private view: View = 'control'
  /** The member to be taken out; empty: the system is to be dissolved. */
  private leaving = ''
  private readonly notice = new Notice(() => this.panel.repaint())
  private readonly lab: Lab
  private shown: SystemView
  private readonly list = new PagedList()
  private readonly timeline: Timeline

  constructor(
    private readonly ports: SystemPorts,
    shown: SystemView,
    private readonly close: () => void,
  ) {
    this.shown = shown
    this.panel = new Panel(WIDTH, HEIGHT, (pen) => this.draw(pen), ports)
    this.lab = { link: ports.link, say: this.notice.say }
    const { group } = this.panel
    const stir = () => ports.stir()
    this.timeline = new Timeline(group, WIDTH, HEIGHT, TRACK, () => '', stir)
  }

  get name(): string {
    return this.shown.system.name
  }

  get system(): RobotSystem {
    return this.shown.system
  }

  get members(): readonly { readonly robot: string }[] {
    return this.shown.system.members
  }

  /** Take over the state of the system. */
  show(view: SystemView): void {
    this.shown = view
    this.panel.repaint()
  }

  /** Before each picture. now: s. */
  update(now: number): void {
    this.notice.update(now)
    const { player } = this.shown
    const control = this.view === 'control'
    this.timeline.update(control ? player : null, now)
    this.panel.update()
  }

  dispose(): void {
    this.panel.dispose()
    this.timeline.dispose()
  }

  get moving(): boolean {
    return MOVING.has(this.shown.system.state)
  }

  /** Play, or pause. */
  play(): void {
    this.trigger(this.moving ? 'pause' : 'play')
  }

  private trigger(verb: string): void {
    order(this.lab, `${this.name}/${verb}`, triggerType, {})
  }

  private open(view: View): void {
    this.view = view
    this.panel.repaint()
  }

  private draw(pen: Pen): void {
    const { system } = this.shown
    const { states } = this.ports.words
    const state = stateOf(system)
    pen.text(EDGE, 36, system.name, TEXT.head, 330, 'ink', 700)
    const halted = state === 'COLLISION_HALT'
    pen.close(WIDTH - EDGE, this.close)
    pen.chip(WIDTH - EDGE - CLOSE - 12, 36, states[state], PANEL_THEME.states[state], halted)
    if (this.view === 'members') this.drawMembers(pen)
    else if (this.view === 'confirm') this.drawConfirm(pen)
    else this.drawControl(pen, system)
  }

  private drawControl(pen: Pen, system: RobotSystem): void {
    const { player } = this.shown
    const w = this.ports.words.room
    const { parallel, sequential } = this.ports.words.lab
    const sequence = system.mode === RobotSystem.SEQUENTIAL
    const about = this.notice.text || spoken(system) || w.members(system.members.length)
    const ink = this.notice.text ? PANEL_THEME.states.PAUSED : 'second'
    pen.text(EDGE, 78, about, TEXT.read, undefined, ink)
    for (const segment of segmentsOf(system.members, system.duration))
      this.drawSegment(pen, segment)
    this.timeline.draw(pen, player, [])
    pen.button('play', EDGE, ROW, 206, this.moving ? w.pause : w.play, () => this.play(), {
      primary: true,
    })
    pen.button('stop', EDGE + 206 + GAP, ROW, 116, w.stop, () => this.trigger('stop'))
    const rates = EDGE + 206 + 116 + 2 * GAP
    pen.button('slower', rates, ROW, HIT, '−', () => this.changeRate(-1))
    const rate = `${player.rate} ×`
    pen.text(rates + HIT + 51, ROW + HIT / 2, rate, TEXT.body, 90, 'ink', 600, 'center')
    pen.button('faster', WIDTH - EDGE - HIT, ROW, HIT, '+', () => this.changeRate(1))
    const half = (WIDE - GAP) / 2
    const second = ROW + HIT + GAP
    const set = (mode: number) => () => {
      order(this.lab, `${this.name}/set_mode`, setModeType, { mode })
    }
    pen.button('parallel', EDGE, second, half, parallel, set(RobotSystem.PARALLEL), {
      chosen: !sequence,
    })
    const right = EDGE + half + GAP
    pen.button('sequential', right, second, half, sequential, set(RobotSystem.SEQUENTIAL), {
      chosen: sequence,
    })
    const third = second + HIT + GAP
    pen.button('members', EDGE, third, half, w.takeOut, () => this.open('members'))
    pen.button('dissolve', right, third, half, w.dissolve, () => {
      this.leaving = ''
      this.open('confirm')
    })
  }

  private drawSegment(pen: Pen, { row, rows, from, to, label, waits }: Segment): void {
    const height = Math.min(SEGMENTS.height / rows, 44)
    const y = SEGMENTS.top + row * height
    const x = EDGE + from * WIDE
    const width = Math.max((to - from) * WIDE, 6)
    const { joints } = PANEL_THEME
    pen.box(x, y + height - BAR, width, BAR - 2, joints[row % joints.length] as string)
    if (height < LABELLED) return
    const words = waits === '' ? label : `${label} · ${waits}`
    const middle = y + height - BAR - 11
    // The label begins with the segment, or ends with it if it would leave the panel.
    if (from < 0.6) pen.text(x, middle, words, TEXT.small, undefined, 'ink', 600)
    else pen.text(x + width, middle, words, TEXT.small, x + width - EDGE, 'ink', 600, 'right')
  }

  private drawMembers(pen: Pen): void {
    const entries = this.shown.system.members.map(({ robot, trajectory_id }, i) => ({
      id: robot,
      words: `${i + 1}  ${robot}`,
      note: trajectory_id,
    }))
    this.list.draw(pen, EDGE, entries, this.ports.words.room.back, {
      back: () => this.open('control'),
      choose: (robot) => {
        this.leaving = robot
        this.open('confirm')
      },
    })
  }

  private drawConfirm(pen: Pen): void {
    const w = this.ports.words.room
    const asks = this.leaving === '' ? w.asksDissolve : w.asksTakeOut(this.leaving)
    pen.lines(EDGE, 120, asks, TEXT.body, undefined, 'ink', 6)
    const half = (WIDE - GAP) / 2
    const y = HEIGHT - EDGE - HIT
    pen.button(
      'confirm',
      EDGE,
      y,
      half,
      w.dissolve,
      () => {
        const request = { name: this.name }
        order(this.lab, 'coordinator/dissolve_system', removeType, request)
        this.open('control')
      },
      { primary: true },
    )
    pen.button('back', EDGE + half + GAP, y, half, w.back, () => this.open('control'))
  }

  private changeRate(step: number): void {
    const { player } = this.shown
    player.setRate(rateAfter(player.rate, step))
  }
}
