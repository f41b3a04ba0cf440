/** Small pictures of the ways of tools, all of a class in one scale, beside the reference's. */

import { alongWay, type Way } from './way'

const WIDTH = 104
const HEIGHT = 72
const MARGIN = 7
// Of the points at each end that may lie outside of the picture.
const OUTSIDE = 0.02
const LEAST = 50 // mm
const MOST = 1000 // ways that the scale is taken from

/** Scale of the paths of a class in a picture. */
export interface Scale {
  readonly factor: number
  readonly middle: readonly [number, number]
}

function within(values: number[]): readonly [number, number] {
  values.sort((a, b) => a - b)
  const at = (share: number) => values[Math.round(share * (values.length - 1))] ?? 0
  return [at(OUTSIDE), at(1 - OUTSIDE)]
}

/** Return the scale in which the ways of a class can be compared by eye. */
export function scaleOf(ways: readonly Way[]): Scale {
  const step = Math.max(1, Math.floor(ways.length / MOST))
  const points = ways.filter((_, i) => i % step === 0).flat()
  const [left, right] = within(points.map(([x]) => x))
  const [low, high] = within(points.map(([, y]) => y))
  const factor = Math.min(
    (WIDTH - 2 * MARGIN) / Math.max(right - left, LEAST),
    (HEIGHT - 2 * MARGIN) / Math.max(high - low, LEAST),
  )
  return { factor, middle: [(left + right) / 2, (low + high) / 2] }
}

interface ThumbnailProps {
  readonly way: Way
  readonly reference: Way
  readonly scale: Scale
  /** Shares of the time, 0 to 1, at which points were lost; each gets a spot. */
  readonly lost?: readonly number[]
}

/** A path with a dot at its begin and a ring at its end. */
export function Thumbnail({ way, reference, scale, lost = [] }: ThumbnailProps) {
  const place = ([x = 0, y = 0]: readonly number[]): readonly [number, number] => {
    const [middleX, middleY] = scale.middle
    return [WIDTH / 2 + (x - middleX) * scale.factor, HEIGHT / 2 - (y - middleY) * scale.factor]
  }
  const line = (points: Way) =>
    points
      .map((point) =>
        place(point)
          .map((value) => value.toFixed(1))
          .join(),
      )
      .join(' ')
  const circle = (point: readonly number[], kind: string, r: number) => {
    const [cx, cy] = place(point)
    return <circle key={`${kind} ${cx} ${cy}`} class={kind} cx={cx} cy={cy} r={r} />
  }
  return (
    <svg class="way-picture" viewBox={`0 0 ${WIDTH} ${HEIGHT}`} aria-hidden="true">
      {reference.length > 0 && <polyline class="compared" points={line(reference)} />}
      <polyline class="curve way" points={line(way)} />
      {circle(way.at(-1) ?? [], 'end', 4)}
      {circle(way[0] ?? [], 'begin', 3)}
      {[...new Set(lost)].map((share) => circle(alongWay(way, share), 'spot', 4))}
    </svg>
  )
}
