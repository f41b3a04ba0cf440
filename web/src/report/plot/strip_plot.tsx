import { useContext, useEffect, useMemo, useRef } from 'preact/hooks'
import type { Mark, Strip } from '../../design/plot/strip'
import { number, words } from '../../words/words'
import { moments, ticks } from './axis'
import { envelope, indexAt, polylines } from './lines'
import { PlayheadContext } from './playhead'

/** A strip with its own times, as reports draw it: SVG, which prints and follows the theme. */
export interface Plotted {
  readonly strip: Strip
  /** s, rising, one a value. */
  readonly times: ArrayLike<number>
  readonly marks: readonly Mark[]
}

interface StripPlotProps extends Plotted {
  /** s, of the axis. */
  readonly begin: number
  readonly duration: number
}

// In the picture's own units: the numbers of the axis left, the limits right of the curve.
const WIDTH = 640
const HEIGHT = 96
const LEFT = 52
const RIGHT = 56
const TOP = 10
const BOTTOM = 6
const AXIS = 22
// A limit that is farther from the line than this share of its range would only flatten it.
const NEAR = 0.35
const LEAST_DEGREES = 10
const MOST_TICKS = 6

function extent(values: Float64Array | null): [number, number] {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY]
  for (const value of values ?? []) {
    if (value < low) low = value
    if (value > high) high = value
  }
  return [low, high]
}

/** Return the range of a strip's axis: the line, and limits that are near to it. */
export function spanOf(strip: Strip): [number, number] {
  const [a, b] = extent(strip.values)
  const [c, d] = extent(strip.compared)
  let [low, high] = [Math.min(a, c), Math.max(b, d)]
  if (!(high >= low)) return [0, 1]
  const near = NEAR * (high - low)
  if (strip.upper !== null && strip.upper <= high + near) high = Math.max(high, strip.upper)
  if (strip.lower !== null && strip.lower >= low - near) low = Math.min(low, strip.lower)
  // A value at rest stands in the middle, without jitter from rounding.
  const least = strip.unit === '°' ? LEAST_DEGREES : Math.max(Math.abs(high), 1e-3) * 0.02
  const missing = Math.max(least - (high - low), 0) / 2
  const margin = 0.08 * Math.max(high - low, least)
  return [low - missing - margin, high + missing + margin]
}

/** Return a value with its unit, as beside the playhead. */
export function amount(value: number, unit: string): string {
  if (!Number.isFinite(value)) return '–'
  const digits = unit === '°' || unit === 'mm' ? 1 : Math.abs(value) >= 100 ? 0 : 2
  return `${number(value, digits, digits)}${unit === '°' ? '' : ' '}${unit}`.trim()
}

function label(value: number, unit: string): string {
  return `${number(value, 4)}${unit === '°' ? '°' : ''}`
}

export function StripPlot({ strip, times, marks, begin, duration }: StripPlotProps) {
  const playhead = useContext(PlayheadContext)
  const line = useRef<SVGLineElement>(null)
  const shown = useRef<HTMLSpanElement>(null)
  const plot = useRef<SVGSVGElement>(null)
  const [low, high] = useMemo(() => spanOf(strip), [strip])
  const wide = WIDTH - LEFT - RIGHT
  const x = (time: number) => LEFT + (duration > 0 ? (time - begin) / duration : 0) * wide
  const y = (value: number) =>
    HEIGHT - BOTTOM - ((value - low) / (high - low)) * (HEIGHT - TOP - BOTTOM)
  const lines = useMemo(() => {
    const drawn = (values: Float64Array) =>
      polylines(
        envelope(values),
        (i) => x(times[i] as number),
        (i) => y(values[i] as number),
      )
    return { values: drawn(strip.values), compared: strip.compared ? drawn(strip.compared) : [] }
  }, [strip, times, begin, duration])

  useEffect(
    () =>
      playhead.time.subscribe((now) => {
        const share = duration > 0 ? (now - begin) / duration : 0
        const inside = share >= 0 && share <= 1
        line.current?.setAttribute('visibility', inside ? 'visible' : 'hidden')
        line.current?.setAttribute('x1', String(x(now)))
        line.current?.setAttribute('x2', String(x(now)))
        const value = inside ? strip.values[indexAt(times, now)] : undefined
        if (shown.current)
          shown.current.textContent = value === undefined ? '' : amount(value, strip.unit)
      }),
    [strip, times, begin, duration],
  )
  const seek = (event: PointerEvent) => {
    const box = plot.current?.getBoundingClientRect()
    if (box === undefined) return
    const at = (((event.clientX - box.left) / box.width) * WIDTH - LEFT) / wide
    playhead.seek(begin + Math.min(Math.max(at, 0), 1) * duration)
  }

  const [least, most] = extent(strip.values)
  const w = words.value.plots
  const summary = Number.isFinite(least)
    ? `${strip.label}: ${w.from(amount(least, ''), amount(most, ''), strip.unit)}`
    : strip.label
  const colour = (strip.colour % 7) + 1
  return (
    <figure class="report-strip">
      <figcaption>
        <span class={`strip-dot joint-${colour}`} />
        <span class="strip-name">{strip.label}</span>
        {strip.unit !== '°' && <span class="second">{strip.unit}</span>}
        <span class="strip-value" ref={shown} />
      </figcaption>
      <svg
        ref={plot}
        class="plot"
        viewBox={`0 0 ${WIDTH} ${HEIGHT + AXIS}`}
        role="img"
        aria-label={summary}
        onPointerDown={(event) => {
          plot.current?.setPointerCapture(event.pointerId)
          seek(event)
        }}
        onPointerMove={(event) => event.buttons > 0 && seek(event)}
      >
        {ticks(low, high).map((value) => (
          <g key={value}>
            <line class="grid" x1={LEFT} x2={WIDTH - RIGHT} y1={y(value)} y2={y(value)} />
            <text class="tick" x={LEFT - 8} y={y(value) + 4}>
              {label(value, strip.unit)}
            </text>
          </g>
        ))}
        <Forbidden value={strip.upper} unit={strip.unit} above y={y} low={low} high={high} />
        <Forbidden value={strip.lower} unit={strip.unit} y={y} low={low} high={high} />
        {marks.map((mark) => (
          <rect
            key={`range ${mark.number}`}
            class={`range tone-${mark.severity}`}
            x={x(mark.from) - 1}
            y={TOP}
            width={Math.max(x(mark.to) - x(mark.from), 0) + 2}
            height={HEIGHT - TOP - BOTTOM}
          />
        ))}
        {lines.compared.map((points) => (
          <polyline key={points} class="compared" points={points} />
        ))}
        {lines.values.map((points) => (
          <polyline key={points} class={`curve joint-line-${colour}`} points={points} />
        ))}
        <line ref={line} class="playhead" y1={0} y2={HEIGHT} visibility="hidden" />
        {marks.map((mark) => (
          <MarkDisc
            key={mark.number}
            mark={mark}
            x={Math.min(Math.max(x(mark.from), LEFT + 9), WIDTH - RIGHT - 9)}
            y={TOP}
          />
        ))}
        {moments(begin, begin + duration, MOST_TICKS).map(([time, text]) => (
          <text key={time} class="moment" x={x(time)} y={HEIGHT + AXIS - 7}>
            {text}
          </text>
        ))}
      </svg>
    </figure>
  )
}

/** The number of a finding or an event on a plot. */
export function MarkDisc({ mark, x, y }: { mark: Mark; x: number; y: number }) {
  const { selected } = useContext(PlayheadContext)
  return (
    <g
      class={`mark tone-${mark.severity}${selected.value === mark.number ? ' chosen' : ''}`}
      data-mark={mark.number}
    >
      <circle cx={x} cy={y} r={9} />
      <text x={x} y={y + 4}>
        {mark.number}
      </text>
    </g>
  )
}

interface ForbiddenProps {
  readonly value: number | null
  readonly unit: string
  readonly above?: boolean
  readonly low: number
  readonly high: number
  y(value: number): number
}

/** The range beyond a limit, hatched, with its value in the gutter; an arrow if it is far away. */
function Forbidden({ value, unit, above = false, low, high, y }: ForbiddenProps) {
  if (value === null || !Number.isFinite(value)) return null
  const far = value < low || value > high
  const edge = above ? TOP : HEIGHT - BOTTOM
  const at = far ? edge : y(value)
  const [from, to] = above ? [edge, at] : [at, edge]
  const text = label(Math.round(value * 10) / 10, unit)
  return (
    <g class="limit">
      {!far && (
        <>
          <rect x={LEFT} y={from} width={WIDTH - LEFT - RIGHT} height={Math.max(to - from, 0)} />
          <line x1={LEFT} x2={WIDTH - RIGHT} y1={at} y2={at} />
        </>
      )}
      <text class={far ? 'far' : ''} x={WIDTH - RIGHT + 6} y={at + 4}>
        {far ? `${above ? '↑' : '↓'} ${text}` : text}
      </text>
    </g>
  )
}

/** The pattern of the forbidden ranges of all plots: once a page. */
export function Hatch() {
  return (
    <svg class="hatch" aria-hidden="true" width="0" height="0">
      <defs>
        <pattern
          id="hatch"
          width="7"
          height="7"
          patternUnits="userSpaceOnUse"
          patternTransform="rotate(45)"
        >
          <rect width="2" height="7" />
        </pattern>
      </defs>
    </svg>
  )
}
