import { number, words } from '../../words/words'
import { roundStep } from './axis'
import { polylines } from './lines'
import { MarkDisc } from './strip_plot'

// Of a view, in its own units; the numbers of its axes are below it and to its left.
const WIDTH = 320
const LEFT = 40
const RIGHT = 6
const TOP = 8
const BOTTOM = 24
const LEAST = 120
const MOST = 320
const NAMES = 'xyz'
// Of each view the coordinates to the right and upwards.
const VIEWS = [
  ['above', 0, 1],
  ['side', 0, 2],
  ['front', 1, 2],
] as const
// A smaller path stands in the middle of a view of 5 cm.
const SMALLEST = 0.05
const MARGIN = 1.12

type Points = Float32Array
/** A numbered place on the way, m. */
interface Spot {
  readonly number: number
  readonly severity: 'info' | 'warning' | 'error'
  readonly place: readonly [number, number, number]
}

interface ToolPathProps {
  /** (N, 3) m in the world, NaN: unknown. */
  readonly path: Points
  readonly reference: Points | null
  readonly spots: readonly Spot[]
}

/** Return the least and greatest known coordinates of points; null: none is known. */
function extentOf(...all: readonly (ArrayLike<number> | null)[]) {
  const low = [Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY, Number.POSITIVE_INFINITY]
  const high = low.map((value) => -value)
  for (const points of all) {
    for (let i = 0; i < (points?.length ?? 0); i++) {
      const value = points?.[i] ?? Number.NaN
      const axis = i % 3
      if (value < (low[axis] as number)) low[axis] = value
      if (value > (high[axis] as number)) high[axis] = value
    }
  }
  return low.every(Number.isFinite) ? { low, high } : null
}

/** The way of a tool from above, from the side and from the front, in one scale. */
export function ToolPath({ path, reference, spots }: ToolPathProps) {
  const w = words.value.report
  const extent = extentOf(
    path,
    reference,
    spots.flatMap(({ place }) => place),
  )
  if (extent === null) return null
  const middle = extent.low.map((low, axis) => (low + (extent.high[axis] as number)) / 2)
  const [sx, sy, sz] = extent.low.map(
    (low, axis) => Math.max((extent.high[axis] as number) - low, SMALLEST) * MARGIN,
  ) as [number, number, number]
  const width = WIDTH - LEFT - RIGHT
  const room = MOST - TOP - BOTTOM
  const scale = Math.min(width / sx, width / sy, room / sy, room / sz)
  const height = Math.max(scale * Math.max(sy, sz), LEAST - TOP - BOTTOM)
  return (
    <section>
      <h3>{w.way}</h3>
      <p class="keys">
        <span>
          <i class="key first" /> {w.begins}
        </span>
        <span>
          <i class="key last" /> {w.ends}
        </span>
        {reference && (
          <span>
            <i class="key dashed" /> {w.reference}
          </span>
        )}
      </p>
      <div class="tool-way">
        {VIEWS.map(([name, across, up]) => (
          <View
            key={name}
            title={w.views[name]}
            {...{ width, height, scale, middle, across, up, path, reference, spots }}
          />
        ))}
      </div>
    </section>
  )
}

interface ViewProps extends ToolPathProps {
  readonly title: string
  readonly width: number
  readonly height: number
  readonly scale: number
  readonly middle: readonly number[]
  readonly across: number
  readonly up: number
}

function View(props: ViewProps) {
  const { title, width, height, scale, across, up, path, reference, spots } = props
  const [centreX = 0, centreY = 0] = [props.middle[across], props.middle[up]]
  const x = (value: number) => LEFT + width / 2 + (value - centreX) * scale
  const y = (value: number) => TOP + height / 2 - (value - centreY) * scale
  const [right, bottom] = [LEFT + width, TOP + height]
  const step = roundStep(Math.min(width, height) / scale / 3)
  const marksOf = (centre: number, extent: number) => {
    const half = extent / scale / 2
    const first = Math.ceil((centre - half) / step)
    const count = Math.floor((centre + half) / step) - first + 1
    return Array.from({ length: Math.max(count, 0) }, (_, k) => (first + k) * step)
  }
  const draw = (points: Points) =>
    polylines(
      Array.from({ length: points.length / 3 }, (_, i) => i),
      (i) => x(points[3 * i + across] as number),
      (i) => y(points[3 * i + up] as number),
    )
  const lines = draw(path)
  const ends = [lines[0]?.split(' ')[0], lines.at(-1)?.split(' ').at(-1)]
  return (
    <figure>
      <figcaption class="second small">{title}</figcaption>
      <svg
        class="path"
        role="img"
        viewBox={`0 0 ${WIDTH} ${(height + TOP + BOTTOM).toFixed(0)}`}
        aria-label={words.value.report.wayFrom(title)}
      >
        <rect class="frame" x={LEFT} y={TOP} width={width} height={height} rx="4" />
        {marksOf(centreX, width).map((value) => (
          <g key={`x ${value}`}>
            <line class="grid" x1={x(value)} x2={x(value)} y1={TOP} y2={bottom} />
            <text class="across" x={x(value)} y={bottom + 15}>
              {number(value, 3)}
            </text>
          </g>
        ))}
        {marksOf(centreY, height).map((value) => (
          <g key={`y ${value}`}>
            <line class="grid" x1={LEFT} x2={right} y1={y(value)} y2={y(value)} />
            <text class="tick" x={LEFT - 5} y={y(value) + 4}>
              {number(value, 3)}
            </text>
          </g>
        ))}
        <text class="tick" x={right - 4} y={bottom - 6}>{`${NAMES[across]}, m`}</text>
        <text x={LEFT + 6} y={TOP + 14}>{`${NAMES[up]}, m`}</text>
        {reference &&
          draw(reference).map((points) => (
            <polyline key={points} class="compared" points={points} />
          ))}
        {lines.map((points) => (
          <polyline key={points} class="curve way" points={points} />
        ))}
        {ends.map((point, i) => {
          const [cx, cy] = point?.split(',') ?? []
          const kind = i === 0 ? 'first' : 'last'
          return <circle key={kind} class={kind} cx={cx} cy={cy} r="4.5" />
        })}
        {spots.map(({ number: name, severity, place }) => (
          <MarkDisc
            key={name}
            mark={{ number: name, severity, from: 0, to: 0, strip: null }}
            x={x(place[across] as number)}
            y={y(place[up] as number)}
          />
        ))}
      </svg>
    </figure>
  )
}
