import type { Preview } from '../../api/types'
import './plot.css'

const MOST_LINES = 7
const WIDTH = 100
const HEIGHT = 30

/** Return the lines of a matrix's columns as paths of an SVG of 100 x 30. */
export function sparkPaths({ rows, columns, values }: Preview): string[] {
  let low = Number.POSITIVE_INFINITY
  let high = Number.NEGATIVE_INFINITY
  for (const value of values) {
    if (value === null) continue
    low = Math.min(low, value)
    high = Math.max(high, value)
  }
  const first = rows[0] ?? 0
  const length = Math.max((rows.at(-1) ?? 0) - first, 1)
  const span = high > low ? high - low : 1
  return Array.from({ length: Math.min(columns, MOST_LINES) }, (_, column) => {
    let path = ''
    let gap = true
    rows.forEach((row, index) => {
      const value = values[index * columns + column]
      if (value === null || value === undefined) {
        gap = true
        return
      }
      const x = (((row - first) / length) * WIDTH).toFixed(1)
      const y = (HEIGHT - 1 - ((value - low) / span) * (HEIGHT - 2)).toFixed(1)
      path += `${gap ? 'M' : 'L'}${x} ${y}`
      gap = false
    })
    return path
  })
}

/** A small picture of a matrix: one line a column. */
export function Sparkline({ preview, label }: { preview: Preview; label: string }) {
  return (
    <svg
      class="sparkline"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      preserveAspectRatio="none"
      role="img"
      aria-label={label}
    >
      {sparkPaths(preview).map((path, index) => (
        <path key={path} class={`line-${index + 1}`} d={path} />
      ))}
    </svg>
  )
}
