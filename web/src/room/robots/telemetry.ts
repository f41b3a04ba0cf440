import type { Telemetry } from '../../protocol/mrlab_msgs'
import { fixed } from '../../words/words'
import { LiveInk } from '../panels/live_ink'
import type { Surroundings } from '../panels/panel'
import { Panel } from '../panels/panel'
import { PANEL_THEME, type Pen, TEXT } from '../panels/pen'
import type { Speech } from '../ports'

const WIDTH = 640
const ROW = 48
const TOP = 90
const EDGE = 26
/** Height of the lines of the gripper's load. */
const GRASP = 58
/** mm, of a curve; and its middle below the top of its row. */
const CURVE = 18
const CURVE_AT = 36
/** Right edges of the columns. */
const COLUMNS = [330, 470, 614] as const
/** Samples of a graph: 12 s. */
const SAMPLES = 120
/** s between two samples and two readings. */
const PERIOD = 0.1
/** Letters of all values of a joint. */
const LETTERS = 26
const DEG = 180 / Math.PI

/** Angles, velocities and torque proxies of a robot's joints, live. */
export class TelemetryPanel {
  readonly panel: Panel
  private readonly graph: Float64Array
  private readonly live: LiveInk
  private written = 0
  private takenAt = Number.NEGATIVE_INFINITY
  private newest: Telemetry | null = null
  /** The lines of the gripper's load when they were painted. */
  private load = ''
  private theme: typeof PANEL_THEME | null = null

  constructor(
    private readonly ports: Speech & Surroundings,
    private readonly joints: readonly string[],
  ) {
    this.graph = new Float64Array(joints.length * SAMPLES).fill(Number.NaN)
    const height = TOP + joints.length * ROW + 40 + GRASP
    this.panel = new Panel(WIDTH, height, (pen) => this.draw(pen), ports)
    const parts = { letters: joints.length * LETTERS, curves: joints.length, samples: SAMPLES }
    this.live = new LiveInk(this.panel.group, parts, WIDTH, height)
  }

  take(message: Telemetry): void {
    this.newest = message
  }

  /** Before each picture; angleOf: of the drawn robot, rad. now: s. */
  update(now: number, angleOf: (joint: string) => number): void {
    if (now - this.takenAt > PERIOD && this.panel.group.visible) {
      // not in the same picture as other panels
      const first = this.takenAt === Number.NEGATIVE_INFINITY
      this.takenAt = first ? now - PERIOD * Math.random() : now
      this.read(angleOf)
      this.ports.stir()
    }
    this.panel.update()
  }

  dispose(): void {
    this.live.dispose()
    this.panel.dispose()
  }

  /** Take a sample, and show it. */
  private read(angleOf: (joint: string) => number): void {
    const place = this.written++ % SAMPLES
    const { live, newest, joints } = this
    const { ink } = PANEL_THEME.colours
    if (this.theme !== PANEL_THEME) {
      this.theme = PANEL_THEME
      live.paint(PANEL_THEME.joints)
    }
    live.begin()
    for (let i = 0; i < joints.length; i++) {
      const joint = joints[i] as string
      const angle = angleOf(joint)
      this.graph[i * SAMPLES + place] = angle
      const index = newest?.joint_names.indexOf(joint) ?? -1
      const speed = index < 0 ? 0 : (newest?.velocities[index] ?? 0) * DEG
      const proxy = index < 0 ? 0 : (newest?.effort_proxy[index] ?? 0)
      const y = TOP + i * ROW + 14
      live.put(`${tenths(angle * DEG)}°`, COLUMNS[0], y, ink, 'right')
      live.put(`${tenths(speed)}°/s`, COLUMNS[1], y, ink, 'right')
      live.put(tenths(proxy), COLUMNS[2], y, ink, 'right')
      this.drawGraph(i)
    }
    live.end()
    live.drawn()
    const load = newest === null ? '' : loadOf(newest)
    if (load !== this.load) this.panel.repaint()
    this.load = load
  }

  private draw(pen: Pen): void {
    const w = this.ports.words
    pen.text(EDGE, 36, w.room.telemetry, TEXT.head, 300, 'ink', 700)
    const { angles, velocities, proxies } = w.plots.channels
    const heads = [angles, velocities, proxies]
    heads.forEach((head, i) => {
      pen.text(COLUMNS[i] as number, 74, head, TEXT.small, 128, 'second', 400, 'right')
    })
    this.joints.forEach((joint, i) => {
      const colour = PANEL_THEME.joints[i % PANEL_THEME.joints.length] as string
      pen.text(EDGE, TOP + i * ROW + 14, joint, TEXT.small, 200, colour, 600)
    })
    const y = TOP + this.joints.length * ROW + 20
    pen.text(EDGE, y, `${proxies}: ${w.room.proxyNote}`, TEXT.small, undefined, 'second')
    if (this.newest !== null) this.drawGrasp(pen, this.newest, y + 30)
  }

  /** Draw the load of the gripper; nothing if it holds nothing. */
  private drawGrasp(pen: Pen, grasp: Telemetry, y: number): void {
    if (grasp.held_object === '') return
    const w = this.ports.words.room
    const payload = grasp.payload > 0 ? fixed(grasp.payload, 1) : ''
    const heavy = grasp.payload > 0 && grasp.held_mass > grasp.payload
    const holds = w.holdsNow(grasp.held_object, fixed(grasp.held_mass, 2), payload)
    const warning = PANEL_THEME.states.PAUSED
    pen.text(EDGE, y, holds, TEXT.small, undefined, heavy ? warning : 'ink', 600)
    const moment = fixed(grasp.wrist_moment, 1)
    const slips = grasp.slip_margin < 0
    const bears = slips ? w.slips(moment) : w.bears(fixed(grasp.slip_margin, 1), moment)
    pen.text(EDGE, y + 26, bears, TEXT.small, undefined, slips ? warning : 'second')
  }

  private drawGraph(joint: number): void {
    const begin = joint * SAMPLES
    let low = Number.POSITIVE_INFINITY
    let high = Number.NEGATIVE_INFINITY
    for (let i = 0; i < SAMPLES; i++) {
      const value = this.graph[begin + i] as number
      if (Number.isNaN(value)) continue
      low = Math.min(low, value)
      high = Math.max(high, value)
    }
    const span = Math.max(high - low, 0.02)
    const width = WIDTH - 2 * EDGE
    const middle = TOP + joint * ROW + CURVE_AT
    for (let i = 0; i < SAMPLES; i++) {
      const value = this.graph[begin + ((this.written + i) % SAMPLES)] as number
      // before the first sample there is none: the curve begins at the right edge
      const at = Number.isNaN(value) ? SAMPLES - 1 : i
      const up = Number.isNaN(value) ? 0 : ((value - (low + high) / 2) / span) * CURVE
      this.live.point(joint, i, EDGE + (at / (SAMPLES - 1)) * width, middle - up)
    }
  }
}

/** Return a text that differs where the load of a gripper is another one as it is shown. */
function loadOf({
  held_object,
  held_mass,
  payload,
  slip_margin,
  wrist_moment,
}: Telemetry): string {
  if (held_object === '') return ''
  const numbers = [fixed(held_mass, 2), fixed(payload, 1), fixed(slip_margin, 1)]
  return [held_object, ...numbers, fixed(wrist_moment, 1)].join(' ')
}

/** Return a value with one decimal; 0 has no sign. */
function tenths(value: number): string {
  return fixed(Math.round(value * 10) / 10 || 0, 1)
}
