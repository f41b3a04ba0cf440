import type { ReadonlySignal } from '@preact/signals'
import { useEffect, useRef, useState } from 'preact/hooks'
import { fixed, words } from '../../words/words'
import { theme } from '../theme'
import { createStrip, type Mark, rangeOf, type Strip, type StripPlot } from './strip'
import './plot.css'

interface StripsProps {
  /** s */
  readonly times: Float64Array
  readonly strips: readonly Strip[]
  readonly marks: readonly Mark[]
  /** Row of the workspace's matrix of a sample, from 1. */
  readonly rowOf: (index: number) => number
  /** Position in the motion, s. */
  readonly time: ReadonlySignal<number>
  readonly onSeek: (time: number) => void
}

const HEIGHT = 92
const FLAT_HEIGHT = 76
const NARROW = 480

function summary(strip: Strip): string {
  let low = Number.POSITIVE_INFINITY
  let high = Number.NEGATIVE_INFINITY
  for (const value of strip.values) {
    if (value < low) low = value
    if (value > high) high = value
  }
  const w = words.value.plots
  if (low > high) return strip.label
  const limits =
    strip.lower === null || strip.upper === null
      ? ''
      : w.between(fixed(strip.lower, 0), fixed(strip.upper, 0))
  return `${strip.label}: ${w.from(fixed(low, 1), fixed(high, 1), strip.unit)}${limits}`
}

/** Return the limits that the axis does not reach, such as `↓ -360° ↑ 360°`. */
function farLimits(strip: Strip): string {
  const [low, high] = rangeOf(strip)
  const { lower, upper } = strip
  const unit = strip.unit === '°' ? '°' : ''
  const far = [
    lower !== null && lower < low ? `↓ ${fixed(lower, 0)}${unit}` : '',
    upper !== null && upper > high ? `↑ ${fixed(upper, 0)}${unit}` : '',
  ]
  return far.filter(Boolean).join('  ')
}

/** Return a number of a strip with its unit; nothing at a gap. */
function valueAt(strip: Strip, index: number): string {
  const value = strip.values[index] ?? Number.NaN
  return Number.isNaN(value) ? '' : `${fixed(value, 1)} ${strip.unit}`
}

let nextSync = 1

/** One strip a joint, below each other, with one cursor. A click seeks. */
export function Strips({ times, strips, marks, rowOf, time, onSeek }: StripsProps) {
  const list = useRef<HTMLDivElement>(null)
  const seek = useRef(onSeek)
  seek.current = onSeek
  const [under, setUnder] = useState<number | null>(null)
  const w = words.value.plots

  useEffect(() => {
    const element = list.current
    if (element === null) return
    const hosts = [...element.querySelectorAll<HTMLElement>('.strip-plot')]
    const width = () => Math.max(hosts[0]?.clientWidth ?? 0, 120)
    const sync = `strips-${nextSync++}`
    const plots: StripPlot[] = strips.map((strip, index) =>
      createStrip(hosts[index] as HTMLElement, width(), {
        times,
        strip,
        marks: marks.filter((mark) => mark.strip === null || mark.strip === index),
        theme: theme.value,
        words: words.value.plots,
        height: width() < NARROW ? FLAT_HEIGHT : HEIGHT,
        axis: index === strips.length - 1,
        sync,
        onCursor: (at) => {
          if (index === 0) setUnder(at)
        },
        onSeek: (at) => seek.current(at),
      }),
    )
    let last = width()
    const resized = new ResizeObserver(() => {
      if (width() === last) return
      last = width()
      for (const plot of plots) plot.resize(last)
      show(time.value)
    })
    resized.observe(element)
    const show = (at: number) => {
      for (const plot of plots) plot.setTime(at)
    }
    const stop = time.subscribe(show)
    return () => {
      stop()
      resized.disconnect()
      for (const plot of plots) plot.dispose()
    }
  }, [times, strips, marks, time, theme.value, words.value])

  return (
    <div class="strips" ref={list}>
      <p class="strips-cursor tiny second" aria-hidden="true">
        {under === null ? w.hint : w.at(fixed(times[under] ?? 0, 2), String(rowOf(under)))}
      </p>
      {strips.map((strip, index) => (
        <figure class="strip" key={strip.label}>
          <figcaption>
            <span class={`strip-dot joint-${(strip.colour % 7) + 1}`} />
            <span class="strip-name">{strip.label}</span>
            <span class="strip-value">
              {under === null ? farLimits(strip) : valueAt(strip, under)}
            </span>
          </figcaption>
          <div class="strip-plot" role="img" aria-label={summary(strip)} data-strip={index} />
        </figure>
      ))}
    </div>
  )
}
