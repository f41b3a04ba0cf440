import uPlot from 'uplot'
import 'uplot/dist/uPlot.min.css'
import { number } from '../../words/words'
import type { Theme } from '../theme'
import { drawForbidden, FONT, type Limits } from './limits'

/** One line over time with its limits, in the unit that is shown. */
export interface Strip extends Limits {
  readonly label: string
  /** NaN: a gap */
  readonly values: Float64Array
  /** A second motion's values at the same times; null: none. */
  readonly compared: Float64Array | null
  /** Place in the theme's colours of joints. */
  readonly colour: number
}

/** A finding on the time axis, s. */
export interface Mark {
  readonly number: number
  readonly severity: 'info' | 'warning' | 'error'
  readonly from: number
  readonly to: number
  /** Place of its strip; null: it is about all. */
  readonly strip: number | null
}

export interface StripPlot {
  resize(width: number): void
  /** Show the playhead at a time, s. */
  setTime(time: number): void
  dispose(): void
}

interface StripOptions {
  readonly times: Float64Array
  readonly strip: Strip
  readonly marks: readonly Mark[]
  readonly theme: Theme
  readonly height: number
  /** The last strip has the axis of time. */
  readonly axis: boolean
  /** Strips with the same key share their cursor. */
  readonly sync: string
  onCursor(index: number | null): void
  onSeek(time: number): void
}

// Left of the plot, for the numbers of the axis; strips are stacked.
const AXIS_WIDTH = 52
const AXIS_HEIGHT = 30
// Right of it, for the limits.
const GUTTER = 62
// A joint that rests shows no noise: the least span of an axis, ° or mm.
const LEAST_SPAN = 10
// A limit that is farther from the line than this share of its range would only flatten it.
const NEAR = 0.35

function extent(values: Float64Array | null): [number, number] {
  let low = Number.POSITIVE_INFINITY
  let high = Number.NEGATIVE_INFINITY
  for (const value of values ?? []) {
    if (value < low) low = value
    if (value > high) high = value
  }
  return [low, high]
}

/** Return the range of a strip's axis: the line, and limits that are near to it. */
export function rangeOf(strip: Strip): [number, number] {
  const [a, b] = extent(strip.values)
  const [c, d] = extent(strip.compared)
  let low = Math.min(a, c)
  let high = Math.max(b, d)
  if (!(high >= low)) return [-1, 1]
  const middle = (low + high) / 2
  low = Math.min(low, middle - LEAST_SPAN / 2)
  high = Math.max(high, middle + LEAST_SPAN / 2)
  const span = high - low
  if (strip.upper !== null && strip.upper <= high + NEAR * span) high = Math.max(high, strip.upper)
  if (strip.lower !== null && strip.lower >= low - NEAR * span) low = Math.min(low, strip.lower)
  const margin = 0.14 * (high - low)
  return [low - margin, high + margin]
}

const SEVERITY_STATE = { error: 'COLLISION_HALT', warning: 'PAUSED', info: 'READY' } as const

function drawMarks(plot: uPlot, { marks, theme }: StripOptions): void {
  const { ctx, bbox } = plot
  const ratio = devicePixelRatio
  ctx.save()
  ctx.font = `600 ${FONT.replace('13', String(12 * ratio))}`
  ctx.textAlign = 'center'
  ctx.textBaseline = 'middle'
  for (const mark of marks) {
    const colour = theme.states[SEVERITY_STATE[mark.severity]]
    const from = plot.valToPos(mark.from, 'x', true)
    const to = Math.max(plot.valToPos(mark.to, 'x', true), from + 1.5 * ratio)
    ctx.globalAlpha = 0.16
    ctx.fillStyle = colour
    ctx.fillRect(from, bbox.top, to - from, bbox.height)
    ctx.globalAlpha = 1
    const x = Math.min(
      Math.max((from + to) / 2, bbox.left + 9 * ratio),
      bbox.left + bbox.width - 9 * ratio,
    )
    const y = bbox.top + 10 * ratio
    ctx.fillStyle = colour
    ctx.beginPath()
    ctx.arc(x, y, 9 * ratio, 0, 2 * Math.PI)
    ctx.fill()
    ctx.fillStyle = theme.colours.card
    ctx.fillText(String(mark.number), x, y + 0.5 * ratio)
  }
  ctx.restore()
}

/** Draw a strip into `parent`; straight lines between the samples. */
export function createStrip(parent: HTMLElement, width: number, options: StripOptions): StripPlot {
  const { strip, theme, axis } = options
  const colour = theme.joints[strip.colour % theme.joints.length] ?? theme.colours.ink
  const range = rangeOf(strip)
  const line = { stroke: colour, width: 1.75, points: { show: false } }
  const ticks = { show: false }
  const degrees = strip.unit === '°' ? '°' : ''
  const grid = { stroke: theme.colours.hairline, width: 1 }
  const series: uPlot.Series[] = [{}, line]
  const data: uPlot.AlignedData = [options.times, strip.values]
  if (strip.compared) {
    series.push({ ...line, stroke: theme.colours.second, dash: [5, 4], width: 1.5 })
    data.push(strip.compared)
  }
  const height = options.height + (axis ? AXIS_HEIGHT : 0)
  const playhead = document.createElement('div')
  playhead.className = 'strip-playhead'
  let now = 0
  const place = (drawn: uPlot) => {
    playhead.style.transform = `translateX(${drawn.valToPos(now, 'x')}px)`
  }
  const plot = new uPlot(
    {
      width,
      height,
      padding: [6, GUTTER, 6, 0],
      legend: { show: false },
      scales: { x: { time: false }, y: { range } },
      cursor: {
        sync: { key: options.sync, setSeries: false },
        y: false,
        drag: { x: false, y: false },
        points: { size: 7 },
      },
      axes: [
        {
          show: axis,
          size: AXIS_HEIGHT,
          stroke: theme.colours.second,
          font: FONT,
          grid,
          ticks,
          values: (_, splits) => splits.map((split) => `${number(split, 6)} s`),
        },
        {
          size: AXIS_WIDTH,
          stroke: theme.colours.second,
          font: FONT,
          grid,
          ticks,
          space: 26,
          values: (_, splits) => splits.map((split) => `${number(split, 6)}${degrees}`),
        },
      ],
      series,
      hooks: {
        drawClear: [(drawn) => drawForbidden(drawn, strip, theme)],
        // A new or resized plot has its scales when it is drawn, not before.
        draw: [(drawn) => drawMarks(drawn, options), place],
        setCursor: [(drawn) => options.onCursor(drawn.cursor.idx ?? null)],
      },
    },
    data,
    parent,
  )
  plot.over.append(playhead)
  const seek = (event: MouseEvent) => {
    const box = plot.over.getBoundingClientRect()
    options.onSeek(plot.posToVal(event.clientX - box.left, 'x'))
  }
  plot.over.addEventListener('click', seek)
  return {
    resize: (next) => plot.setSize({ width: next, height }),
    setTime: (time) => {
      now = time
      place(plot)
    },
    dispose: () => plot.destroy(),
  }
}
