/** A point of a way as it is seen: mm to the right and up, and when it is reached, as a share of the
 * time. */
export type WayPoint = readonly [right: number, up: number, share: number]
export type Way = readonly WayPoint[]

/** Return the whole numbers of an encoded polyline. */
function decoded(text: string): number[] {
  const numbers = []
  let value = 0
  let shift = 0
  for (const character of text) {
    const bits = character.charCodeAt(0) - 63
    value |= (bits & 31) << shift
    shift += 5
    if (bits & 32) continue
    numbers.push(value & 1 ? ~(value >> 1) : value >> 1)
    value = 0
    shift = 0
  }
  return numbers
}

/** Return the way that `mrlab_ros/classroom/marks/ways.py` wrote. step: mm. */
export function wayOf(text: string, step: number): Way {
  const numbers = decoded(text)
  const way: [number, number, number][] = []
  let [place, right, up] = [0, 0, 0]
  for (let i = 0; i + 2 < numbers.length; i += 3) {
    place += numbers[i] ?? 0
    right += step * (numbers[i + 1] ?? 0)
    up += step * (numbers[i + 2] ?? 0)
    way.push([right, up, place])
  }
  return way.map(([x, y, at]) => [x, y, place > 0 ? at / place : 0])
}

/** Return where a way with points is at a share of its time. */
export function alongWay(way: Way, share: number): WayPoint {
  const next = way.findIndex((point) => point[2] >= share)
  const after = way.at(next) ?? [0, 0, 0]
  const before = (next > 0 && way[next - 1]) || after
  const part = after[2] > before[2] ? Math.min((share - before[2]) / (after[2] - before[2]), 1) : 0
  const at = (axis: 0 | 1) => before[axis] + part * (after[axis] - before[axis])
  return [at(0), at(1), share]
}
