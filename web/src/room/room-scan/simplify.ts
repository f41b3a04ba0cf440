/** m: a corner that is nearer to the line between its neighbours is left out. */
const STRAIGHT = 0.01
const MOST_CORNERS = 32
/** m: the first size of the cells in which a mesh's vertices become one. */
const CELL = 0.04

interface Point {
  readonly x: number
  readonly y: number
}

/** Return the corners of an outline without those that say nothing, 32 at most. */
export function simplifyOutline<P extends Point>(outline: readonly P[]): P[] {
  const kept = [...outline]
  for (let tolerance = STRAIGHT; ; tolerance *= 2) {
    for (let i = kept.length - 1; i >= 0 && kept.length > 3; i--) {
      const before = kept[(i + kept.length - 1) % kept.length] as P
      const after = kept[(i + 1) % kept.length] as P
      if (fromLine(kept[i] as P, before, after) < tolerance) kept.splice(i, 1)
    }
    if (kept.length <= MOST_CORNERS) return kept
  }
}

function fromLine(point: Point, a: Point, b: Point): number {
  const dx = b.x - a.x
  const dy = b.y - a.y
  const length = Math.hypot(dx, dy)
  if (length < 1e-9) return Math.hypot(point.x - a.x, point.y - a.y)
  return Math.abs((point.x - a.x) * dy - (point.y - a.y) * dx) / length
}

export interface SimpleMesh {
  readonly vertices: Float32Array
  readonly triangles: Uint32Array
}

/** Return a mesh with `most` triangles at most: vertices of one cell become one, and the cells grow
 * until it is small enough. */
export function simplifyMesh(
  vertices: Float32Array,
  indices: Uint32Array,
  most: number,
): SimpleMesh {
  if (indices.length / 3 <= most) return { vertices, triangles: indices }
  for (let cell = CELL; ; cell *= 1.5) {
    const found = clustered(vertices, indices, cell)
    if (found.triangles.length / 3 <= most) return found
  }
}

function clustered(vertices: Float32Array, indices: Uint32Array, cell: number): SimpleMesh {
  const cells = new Map<string, number>()
  const sums: number[] = []
  const counts: number[] = []
  const cellOf = new Uint32Array(vertices.length / 3)
  for (let i = 0; i < cellOf.length; i++) {
    const key = [0, 1, 2]
      .map((axis) => Math.round((vertices[3 * i + axis] as number) / cell))
      .join()
    let index = cells.get(key)
    if (index === undefined) {
      index = cells.size
      cells.set(key, index)
      counts.push(0)
      sums.push(0, 0, 0)
    }
    cellOf[i] = index
    counts[index] = (counts[index] as number) + 1
    for (let axis = 0; axis < 3; axis++) {
      sums[3 * index + axis] =
        (sums[3 * index + axis] as number) + (vertices[3 * i + axis] as number)
    }
  }
  const triangles: number[] = []
  const seen = new Set<string>()
  for (let i = 0; i < indices.length; i += 3) {
    const corners = [0, 1, 2].map((k) => cellOf[indices[i + k] as number] as number)
    const [a, b, c] = corners as [number, number, number]
    if (a === b || b === c || c === a) continue
    const key = [...corners].sort((p, q) => p - q).join()
    if (seen.has(key)) continue
    seen.add(key)
    triangles.push(a, b, c)
  }
  const means = Float32Array.from(sums, (sum, i) => sum / (counts[Math.floor(i / 3)] as number))
  return { vertices: means, triangles: Uint32Array.from(triangles) }
}
