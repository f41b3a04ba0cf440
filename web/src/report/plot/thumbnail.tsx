/** Small pictures of the ways of tools, all of a class in one scale, beside the reference's. */

const WIDTH = 104
const HEIGHT = 72
const MARGIN = 7
// The view is from the front right and above, like that of the other pictures.
const RIGHT = [-0.6, 0.8, 0] as const
const UP = [-0.36, -0.27, 0.89] as const
// Of the points at each end that may lie outside of the picture.
const OUTSIDE = 0.02
const LEAST = 50 // mm
const MOST = 1000 // ways that the scale is taken from

/** Points in the world, mm. */
export type Way = readonly (readonly number[])[]
type Flat = readonly [number, number]

function flat([x = 0, y = 0, z = 0]: readonly number[]): Flat {
  const along = ([a, b, c]: readonly [number, number, number]) => a * x + b * y + c * z
  return [along(RIGHT), along(UP)]
}

/** Scale of the paths of a class in a picture. */
export interface Scale {
  readonly factor: number
  readonly middle: Flat
}

function within(values: number[]): readonly [number, number] {
  values.sort((a, b) => a - b)
  const at = (share: number) => values[Math.round(share * (values.length - 1))] ?? 0
  return [at(OUTSIDE), at(1 - OUTSIDE)]
}

/** Return the scale in which the ways of a class can be compared by eye. */
export function scaleOf(ways: readonly Way[]): Scale {
  const step = Math.max(1, Math.floor(ways.length / MOST))
  const points = ways.filter((_, i) => i % step === 0).flatMap((way) => way.map(flat))
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
  const place = (point: readonly number[]): Flat => {
    const [x, y] = flat(point)
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
  const last = way.length - 1
  const spots = new Set(lost.map((share) => Math.min(Math.max(Math.round(share * last), 0), last)))
  const circle = (index: number, kind: string, r: number) => {
    const [cx, cy] = place(way[index] ?? [])
    return <circle key={`${kind} ${index}`} class={kind} cx={cx} cy={cy} r={r} />
  }
  return (
    <svg class="way-picture" viewBox={`0 0 ${WIDTH} ${HEIGHT}`} aria-hidden="true">
      {reference.length > 0 && <polyline class="compared" points={line(reference)} />}
      <polyline class="curve way" points={line(way)} />
      {circle(last, 'end', 4)}
      {circle(0, 'begin', 3)}
      {[...spots].map((index) => circle(index, 'spot', 4))}
    </svg>
  )
}
