import type { Object3D } from 'three'
import type { Link } from '../link/link'
import { LatencyHop, latencyWriter } from '../protocol/mrlab_msgs'
import { jointStateReader } from '../protocol/sensor_msgs'
import { fixed } from '../words/words'
import type { Surroundings } from './panels/panel'
import { Panel } from './panels/panel'
import { type Pen, TEXT } from './panels/pen'
import type { Lab, Speech } from './ports'

/** s of a window. */
const WINDOW = 1
const WIDTH = 560
const HEIGHT = 150
const EDGE = 24
const BELOW = 0.4 // m, of its middle below that of the board

/** Measures the duration of frames and the age of joint states; publishes both, and shows them on
 * demand. */
export class Stats {
  private readonly ages = new Ages()
  private readonly undo: () => void
  readonly panel: Panel
  private closedAt = 0
  private frames = 0
  private rate = 0
  /** Duration of the slowest frame of this window and of the one before, ms. */
  private slowest = 0
  private slowestBefore = 0

  /** board: the panel below which it is shown. */
  constructor(
    private readonly ports: Speech & Lab & Surroundings,
    board: Object3D,
  ) {
    this.panel = new Panel(WIDTH, HEIGHT, (pen) => this.draw(pen), ports)
    this.panel.group.position.y = -BELOW
    this.panel.group.visible = false
    board.add(this.panel.group)
    const { link } = ports
    // Latched messages are old without having been long on their way.
    let since = link.labTime()
    const opened = link.onStatus(({ phase }) => {
      if (phase === 'open') since = link.labTime()
    })
    const heard = link.subscribe('*/joint_states', jointStateReader, (_, { stamp }) => {
      if (stamp >= since) this.ages.add(link.labTime() - stamp)
    })
    this.undo = () => {
      opened()
      heard()
    }
  }

  get shown(): boolean {
    return this.panel.group.visible
  }

  toggle(): void {
    this.panel.group.visible = !this.shown
    this.panel.repaint()
  }

  /** After each frame. now: s; ms: of JavaScript that it took. */
  frame(now: number, ms: number): void {
    this.frames++
    this.slowest = Math.max(this.slowest, ms)
    if (now - this.closedAt >= WINDOW) {
      this.rate = this.frames / (now - this.closedAt)
      this.closedAt = now
      this.frames = 0
      this.slowestBefore = this.slowest
      this.slowest = 0
      this.ages.close()
      tell(this.ports.link, this.ages)
      this.panel.repaint()
    }
    this.panel.update()
  }

  dispose(): void {
    this.undo()
    this.panel.dispose()
  }

  private draw(pen: Pen): void {
    const w = this.ports.words.room
    const { p50, p95, count } = this.ages
    const trip = this.ports.link.status.roundTrip
    const ms = (seconds: number) => fixed(seconds * 1000, seconds < 0.01 ? 1 : 0)
    const frame = w.statsFrame(fixed(this.slowestBefore, 1), fixed(this.rate, 0))
    pen.text(EDGE, 36, frame, TEXT.small, undefined, 'ink', 600)
    const age = count > 0 ? w.statsAge(ms(p50), ms(p95)) : w.statsNone
    pen.text(EDGE, 76, age, TEXT.small)
    if (!Number.isNaN(trip))
      pen.text(EDGE, 116, w.statsTrip(ms(trip)), TEXT.small, undefined, 'second')
  }
}

/** Publish the figures of a window on `latency/clients`. */
export function tell(link: Link, { count, p50, p95, most }: Ages): void {
  const { roundTrip } = link.status
  if (count === 0 || Number.isNaN(roundTrip)) return
  const now = link.labTime()
  const sec = Math.floor(now)
  const hop = {
    hop: LatencyHop.PUBLISHED_TO_RECEIVED,
    topic: '',
    count,
    p50,
    p95,
    max: most,
  }
  link.publish('latency/clients', latencyWriter, {
    header: { stamp: { sec, nanosec: Math.floor((now - sec) * 1e9) }, frame_id: '' },
    observer: 'room',
    window: WINDOW,
    // the clocks' offset is wrong by half a round trip at most
    clock_error: roundTrip / 2,
    hops: [hop],
  })
}

/** Ages that are kept of one window: a lab of ten robots sends fewer in a second. */
const MOST = 1024

/** The ages of messages on arrival, over a window. */
export class Ages {
  private readonly ages = new Float64Array(MOST)
  private readonly sorted = new Float64Array(MOST)
  private taken = 0

  /** Of the window that ended last, s. */
  count = 0
  p50 = Number.NaN
  p95 = Number.NaN
  most = Number.NaN

  /** age: s; NaN is ignored. */
  add(age: number): void {
    if (Number.isNaN(age)) return
    this.ages[this.taken % MOST] = age
    this.taken++
  }

  /** End the window and begin the next one. */
  close(): void {
    this.count = this.taken
    const kept = Math.min(this.taken, MOST)
    const values = this.sorted.subarray(0, kept)
    values.set(this.ages.subarray(0, kept))
    values.sort()
    const at = (share: number) =>
      values[Math.min(Math.floor(share * kept), kept - 1)] ?? Number.NaN
    this.p50 = at(0.5)
    this.p95 = at(0.95)
    this.most = at(1)
    this.taken = 0
  }
}
