import type { Telemetry } from '../../protocol/mrlab_msgs'
import { fixed } from '../../words/words'
import type { Surroundings } from '../panels/panel'
import { Panel } from '../panels/panel'
import { PANEL_THEME, type Pen, TEXT } from '../panels/pen'
import type { Speech } from '../ports'

const WIDTH = 640
const ROW = 62
const TOP = 96
const EDGE = 26
/** Height of the lines of the gripper's load. */
const GRASP = 62
/** Samples of a graph: 12 s. */
const SAMPLES = 120
/** s between two samples and two paintings. */
const PERIOD = 0.1
const DEG = 180 / Math.PI

/** Angles, velocities and torque proxies of a robot's joints, live. */
export class TelemetryPanel {
  readonly panel: Panel
  private readonly angles: Float64Array
  private readonly graph: Float64Array
  private written = 0
  private takenAt = Number.NEGATIVE_INFINITY
  private newest: Telemetry | null = null

  constructor(
    private readonly ports: Speech & Surroundings,
    private readonly joints: readonly string[],
  ) {
    this.angles = new Float64Array(joints.length)
    this.graph = new Float64Array(joints.length * SAMPLES).fill(Number.NaN)
    const height = TOP + joints.length * ROW + 46 + GRASP
    this.panel = new Panel(WIDTH, height, (pen) => this.draw(pen), ports)
  }

  take(message: Telemetry): void {
    this.newest = message
  }

  /** Before each picture; angleOf: of the drawn robot, rad. now: s. */
  update(now: number, angleOf: (joint: string) => number): void {
    if (now - this.takenAt > PERIOD) {
      this.takenAt = now
      const place = this.written++ % SAMPLES
      this.joints.forEach((joint, i) => {
        this.angles[i] = angleOf(joint)
        this.graph[i * SAMPLES + place] = this.angles[i] as number
      })
      this.panel.repaint()
    }
    this.panel.update()
  }

  dispose(): void {
    this.panel.dispose()
  }

  private draw(pen: Pen): void {
    const w = this.ports.words
    pen.text(EDGE, 40, w.room.telemetry, TEXT.head, 300, 'ink', 700)
    const { angles, velocities, proxies } = w.plots.channels
    const heads = [angles, velocities, proxies]
    heads.forEach((head, i) => {
      const x = [300, 430, 614][i] as number
      pen.text(x, 82, head, TEXT.small, 170, 'second', 400, 'right')
    })
    this.joints.forEach((joint, i) => {
      const y = TOP + i * ROW + ROW / 2
      const colour = PANEL_THEME.joints[i % PANEL_THEME.joints.length] as string
      pen.text(EDGE, y - 14, joint, TEXT.small, 170, colour, 600)
      this.drawGraph(pen, i, y, colour)
      const index = this.newest?.joint_names.indexOf(joint) ?? -1
      const speed = index < 0 ? 0 : (this.newest?.velocities[index] ?? 0) * DEG
      const proxy = index < 0 ? 0 : (this.newest?.effort_proxy[index] ?? 0)
      const values = [
        `${tenths((this.angles[i] ?? 0) * DEG)}°`,
        `${tenths(speed)}°/s`,
        tenths(proxy),
      ]
      values.forEach((value, column) => {
        const x = [300, 430, 614][column] as number
        pen.text(x, y - 12, value, TEXT.small, 160, 'ink', 600, 'right')
      })
    })
    const y = TOP + this.joints.length * ROW + 20
    pen.text(EDGE, y, `${proxies}: ${w.room.proxyNote}`, TEXT.small, undefined, 'second')
    if (this.newest !== null) this.drawGrasp(pen, this.newest, y + 34)
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
    pen.text(EDGE, y + 28, bears, TEXT.small, undefined, slips ? warning : 'second')
  }

  private drawGraph(pen: Pen, joint: number, y: number, colour: string): void {
    const { context } = pen
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
    const left = EDGE
    const width = WIDTH - 2 * EDGE
    context.beginPath()
    for (let i = 0; i < SAMPLES; i++) {
      const value = this.graph[begin + ((this.written + i) % SAMPLES)] as number
      if (Number.isNaN(value)) continue
      const at = y + 26 - ((value - (low + high - span) / 2) / span) * 22
      context.lineTo(left + (i / (SAMPLES - 1)) * width, at)
    }
    context.strokeStyle = colour
    context.lineWidth = 3
    context.stroke()
  }
}

/** Return a value with one decimal; 0 has no sign. */
function tenths(value: number): string {
  return fixed(Math.round(value * 10) / 10 || 0, 1)
}
