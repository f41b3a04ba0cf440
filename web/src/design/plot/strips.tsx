import { type ReadonlySignal, useComputed, useSignal } from '@preact/signals'
import { useEffect, useMemo, useRef, useState } from 'preact/hooks'
import { fixed, words } from '../../words/words'
import { Button } from '../button'
import { theme } from '../theme'
import { createStrip, type Mark, type Strip, type StripPlot } from './strip'
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
  /** Return the sample at a time, s. */
  readonly indexAt: (time: number) => number
  readonly onSeek: (time: number) => void
  /** Place of the joint that matters now: its strip is first, the others are folded; null: all. */
  readonly focus: number | null
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

/** Return a number of a strip with its unit; nothing at a gap. */
function valueAt(strip: Strip, index: number): string {
  const value = strip.values[index] ?? Number.NaN
  if (Number.isNaN(value)) return ''
  return `${fixed(value, 1)}${strip.unit.startsWith('°') ? '' : ' '}${strip.unit}`
}

/** The number under the cursor, else at the playhead. */
function Value({ strip, index }: { strip: Strip; index: ReadonlySignal<number> }) {
  return <span class="strip-value">{valueAt(strip, index.value)}</span>
}

interface PlaceProps extends Pick<StripsProps, 'times' | 'rowOf'> {
  readonly index: ReadonlySignal<number>
}

function Place({ times, index, rowOf }: PlaceProps) {
  const at = index.value
  return <>{words.value.plots.at(fixed(times[at] ?? 0, 2), String(rowOf(at)))}</>
}

let nextSync = 1

/** One strip a joint, below each other, with one cursor. A click seeks. */
export function Strips(props: StripsProps) {
  const { times, strips, marks, rowOf, indexAt, time, onSeek, focus } = props
  const list = useRef<HTMLDivElement>(null)
  const seek = useRef(onSeek)
  seek.current = onSeek
  const under = useSignal<number | null>(null)
  const index = useComputed(() => under.value ?? indexAt(time.value))
  const [all, setAll] = useState(false)
  const folds = focus !== null && strips.length > 1
  const shown = useMemo(() => {
    const first = strips.filter((strip) => strip.colour === focus)
    const others = strips.filter((strip) => strip.colour !== focus)
    return folds && !all ? first : [...first, ...others]
  }, [strips, focus, all, folds])
  const w = words.value.plots

  useEffect(() => {
    const element = list.current
    if (element === null) return
    const hosts = [...element.querySelectorAll<HTMLElement>('.strip-plot')]
    const width = () => Math.max(hosts[0]?.clientWidth ?? 0, 120)
    const sync = `strips-${nextSync++}`
    const plots: StripPlot[] = shown.map((strip, place) =>
      createStrip(hosts[place] as HTMLElement, width(), {
        times,
        strip,
        marks: marks.filter((mark) => mark.strip === null || mark.strip === strip.colour),
        theme: theme.value,
        height: width() < NARROW ? FLAT_HEIGHT : HEIGHT,
        axis: place === shown.length - 1,
        sync,
        onCursor: (at) => {
          if (place === 0) under.value = at
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
  }, [times, shown, marks, time, theme.value, words.value])

  return (
    <div class="strips" ref={list}>
      <p class="strips-cursor tiny second" aria-hidden="true">
        <Place times={times} index={index} rowOf={rowOf} />
      </p>
      {shown.map((strip) => (
        <figure class="strip" key={strip.label}>
          <figcaption>
            <span class={`strip-dot joint-${(strip.colour % 7) + 1}`} />
            <span class="strip-name">{strip.label}</span>
            <Value strip={strip} index={index} />
          </figcaption>
          <div
            class="strip-plot"
            role="img"
            aria-label={summary(strip)}
            data-strip={strip.colour}
          />
        </figure>
      ))}
      {folds && (
        <Button look="quiet" aria-expanded={all} onClick={() => setAll(!all)}>
          {all ? w.fold : w.unfold(strips.length)}
        </Button>
      )}
    </div>
  )
}
