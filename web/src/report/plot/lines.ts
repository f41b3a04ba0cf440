/** Lines over time as points of SVG. */

type Numbers = ArrayLike<number>

const MOST_BLOCKS = 250 // about two units of width each

/** Return the places of all values, or of many the least and greatest of each block. */
export function envelope(values: Numbers): number[] {
  const count = values.length
  if (count <= 2 * MOST_BLOCKS) return Array.from({ length: count }, (_, i) => i)
  const kept = new Set([0, count - 1])
  for (let block = 0; block < MOST_BLOCKS; block++) {
    const begin = Math.floor((block * count) / MOST_BLOCKS)
    const end = Math.floor(((block + 1) * count) / MOST_BLOCKS)
    let low = begin
    let high = begin
    for (let i = begin; i < end; i++) {
      const value = values[i] as number
      // a block without a number keeps its first one: a gap
      if (value < (values[low] as number) || Number.isNaN(values[low])) low = i
      if (value > (values[high] as number) || Number.isNaN(values[high])) high = i
    }
    kept.add(low).add(high)
  }
  return [...kept].sort((a, b) => a - b)
}

/** Return the points of straight lines at places that are chosen; a new line after each gap. */
export function polylines(
  chosen: readonly number[],
  x: (index: number) => number,
  y: (index: number) => number,
): string[] {
  const lines: string[] = []
  let points: string[] = []
  const end = () => {
    if (points.length > 0) lines.push(points.join(' '))
    points = []
  }
  for (const index of chosen) {
    const [px, py] = [x(index), y(index)]
    if (Number.isFinite(px) && Number.isFinite(py))
      points.push(`${px.toFixed(1)},${py.toFixed(1)}`)
    else end()
  }
  end()
  return lines
}

/** Return the place of the last of rising times that is not after `time`; 0 before the first. */
export function indexAt(times: Numbers, time: number): number {
  let low = 0
  let high = times.length - 1
  while (low < high) {
    const middle = (low + high + 1) >> 1
    if ((times[middle] as number) <= time + 1e-9) low = middle
    else high = middle - 1
  }
  return low
}
