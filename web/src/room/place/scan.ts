import { Matrix4, type Object3D, Quaternion, Vector3 } from 'three'
import { order } from '../../lab/commands'
import type { Pose } from '../../protocol/geometry_msgs'
import { type Surface, setSurfacesType } from '../../protocol/mrlab_msgs'
import type { Lab } from '../ports'
import { poseInWorld, upright, vectorToRos } from '../scene/frames'

/** s between two looks, and for which the room must be still before it is published. */
const PERIOD = 0.5
const STILL = 0.8
/** m, and of a quaternion's numbers: smaller changes are noise of the tracking. */
const MOVED = 0.015
const TURNED = 0.012
const MOST_SURFACES = 64
const MOST_TRIANGLES = 1500
/** Label of the mesh of the whole room: too large for physics, which has the planes. */
const WHOLE = 'global mesh'
const FLOOR = 'floor'

interface Known {
  readonly name: string
  readonly label: string
  changed: number
  pose: Pose
  surface: Surface
}

/** m: half the width of a surface that is made by a touch. */
const HALF = 0.4

const matrix = new Matrix4()
const position = new Vector3()
const quaternion = new Quaternion()
const scale = new Vector3()
const corner = new Vector3()

/** Follows the surfaces that the headset knows, and reports them when they have changed: only new
 * ones are built again. */
export class RoomScan {
  /** Height of the headset's own floor in the floor space, m; NaN: it knows none. */
  floor = Number.NaN
  private readonly known = new Map<XRPlane | XRMesh, Known>()
  private readonly numbers = new Map<string, number>()
  /** Surfaces that a person touched: what the headset's scan lacks. */
  private readonly touched: Surface[] = []
  /** True while the next touch makes a surface. */
  awaited = false
  private lookedAt = Number.NEGATIVE_INFINITY
  private changedAt = Number.NaN

  /** tell: gets all surfaces, the endless floor first. */
  constructor(
    private readonly world: Object3D,
    private readonly tell: (surfaces: Surface[]) => void,
  ) {}

  /** Number of surfaces that the headset knows, without the floor. */
  get count(): number {
    return this.known.size + this.touched.length
  }

  /** Make a level surface about a touched point of the floor space; returns whether it was awaited. */
  touch(point: Vector3): boolean {
    if (!this.awaited) return false
    this.awaited = false
    const { x, y, z } = this.world.worldToLocal(position.copy(point))
    const corners = [-HALF, HALF, HALF, -HALF].map((across, i) => {
      return { x: across, y: i < 2 ? -HALF : HALF, z: 0 }
    })
    this.touched.push({
      name: `touched_${this.touched.length + 1}`,
      label: 'table',
      source: '',
      pose: upright(x, y, z, 0),
      vertices: corners,
      triangles: new Uint32Array(),
    })
    this.tell(this.surfaces())
    return true
  }

  /** Report all surfaces again: the lab has forgotten them. */
  tellAgain(): void {
    if (this.count > 0) this.changedAt = this.lookedAt
  }

  /** Look at a frame; now: s. */
  update(frame: XRFrame, space: XRReferenceSpace, now: number): void {
    if (now - this.lookedAt < PERIOD) return
    this.lookedAt = now
    const { detectedPlanes, detectedMeshes } = frame
    if (detectedPlanes === undefined && detectedMeshes === undefined) return
    const seen = new Set<XRPlane | XRMesh>()
    let changed = false
    for (const plane of detectedPlanes ?? []) {
      changed = this.look(frame, space, plane, plane.planeSpace, seen) || changed
    }
    for (const mesh of detectedMeshes ?? []) {
      if (mesh.semanticLabel === WHOLE && (detectedPlanes?.size ?? 0) > 0) continue
      changed = this.look(frame, space, mesh, mesh.meshSpace, seen) || changed
    }
    for (const each of [...this.known.keys()]) {
      if (seen.has(each)) continue
      this.known.delete(each)
      changed = true
    }
    if (changed) this.changedAt = now
    else if (now - this.changedAt > STILL) {
      this.changedAt = Number.NaN
      this.tell(this.surfaces())
    }
  }

  /** All surfaces, the endless floor first. */
  surfaces(): Surface[] {
    const floor: Surface = {
      name: FLOOR,
      label: FLOOR,
      source: '',
      pose: { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
      vertices: [],
      triangles: new Uint32Array(),
    }
    return [floor, ...[...this.known.values()].map(({ surface }) => surface), ...this.touched]
  }

  private look(
    frame: XRFrame,
    space: XRReferenceSpace,
    found: XRPlane | XRMesh,
    at: XRSpace,
    seen: Set<XRPlane | XRMesh>,
  ): boolean {
    const pose = frame.getPose(at, space)
    if (pose === undefined) {
      // Lost for a moment: keep its last state.
      if (this.known.has(found)) seen.add(found)
      return false
    }
    matrix.fromArray(pose.transform.matrix).decompose(position, quaternion, scale)
    const label = found.semanticLabel ?? 'other'
    if (label === FLOOR) {
      this.floor = position.y
      return false
    }
    const before = this.known.get(found)
    if (before === undefined && this.known.size >= MOST_SURFACES) return false
    seen.add(found)
    const now = poseInWorld(this.world, position, quaternion)
    const stays = before !== undefined && near(before.pose, now)
    if (stays && before.changed === found.lastChangedTime) return false
    const name = before?.name ?? this.nameFor(label)
    const surface =
      before?.changed === found.lastChangedTime
        ? { ...before.surface, pose: now }
        : surfaceOf(found, name, label, now)
    // Devices mark unchanged planes as changed, some in every frame.
    const same = stays && sameShape(before.surface, surface)
    this.known.set(found, {
      name,
      label,
      changed: found.lastChangedTime,
      pose: same ? before.pose : now,
      surface: same ? before.surface : surface,
    })
    return !same
  }

  private nameFor(label: string): string {
    const word = label.replace(/[^a-z0-9]+/gi, '_').toLowerCase()
    const number = (this.numbers.get(word) ?? 0) + 1
    this.numbers.set(word, number)
    return `${word}_${number}`
  }
}

function near(a: Pose, b: Pose): boolean {
  const { position: p, orientation: q } = a
  const { position: r, orientation: s } = b
  const way = Math.hypot(p.x - r.x, p.y - r.y, p.z - r.z)
  const dot = Math.abs(q.x * s.x + q.y * s.y + q.z * s.z + q.w * s.w)
  return way < MOVED && 1 - dot < TURNED * TURNED
}

function sameShape(a: Surface, b: Surface): boolean {
  if (a.vertices.length !== b.vertices.length) return false
  if (a.triangles.length !== b.triangles.length) return false
  return a.vertices.every((p, i) => {
    const q = b.vertices[i] as typeof p
    return Math.hypot(p.x - q.x, p.y - q.y, p.z - q.z) < MOVED
  })
}

function surfaceOf(found: XRPlane | XRMesh, name: string, label: string, pose: Pose): Surface {
  if ('polygon' in found) {
    const outline = found.polygon.map(({ x, y, z }) => ros(x, y, z))
    const vertices = simplifyOutline(outline)
    return { name, label, source: '', pose, vertices, triangles: new Uint32Array() }
  }
  const simple = simplifyMesh(found.vertices, found.indices, MOST_TRIANGLES)
  const vertices = []
  for (let i = 0; i < simple.vertices.length; i += 3) {
    const [x, y, z] = simple.vertices.subarray(i, i + 3) as unknown as [number, number, number]
    vertices.push(ros(x, y, z))
  }
  return { name, label, source: '', pose, vertices, triangles: simple.triangles }
}

function ros(x: number, y: number, z: number): { x: number; y: number; z: number } {
  vectorToRos(corner.set(x, y, z), corner)
  return { x: corner.x, y: corner.y, z: corner.z }
}

/** Send physics the surfaces that a headset measured; those of others stay. */
export function orderSurfaces(lab: Lab, source: string, surfaces: Surface[]): void {
  order(lab, 'physics/set_surfaces', setSurfacesType, { source, surfaces })
}

/** m: a corner that is nearer to the line between its neighbours is left out. */
const STRAIGHT = 0.01
const MOST_CORNERS = 32
/** m: the first size of the cells in which a mesh's vertices become one. */
const CELL = 0.04

interface Point {
  readonly x: number
  readonly y: number
}

/** Return the corners of an outline without redundant ones, 32 at most. */
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

interface SimpleMesh {
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
