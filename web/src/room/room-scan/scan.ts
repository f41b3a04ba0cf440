import { Matrix4, type Object3D, Quaternion, Vector3 } from 'three'
import type { Pose } from '../../protocol/geometry_msgs'
import { type Surface, setSurfacesType } from '../../protocol/mrlab_msgs'
import { order, type RoomContext } from '../context'
import { poseInWorld, vectorToRos } from '../frames'
import { simplifyMesh, simplifyOutline } from './simplify'

/** s between two looks, and for which the room must be still before it is told. */
const PERIOD = 0.5
const STILL = 0.8
/** m, and of a quaternion's numbers: smaller changes are the tracking's. */
const MOVED = 0.015
const TURNED = 0.012
const MOST_SURFACES = 64
const MOST_TRIANGLES = 1500
/** Of the whole room: too much for physics, and the planes say the same. */
const WHOLE = 'global mesh'
const FLOOR = 'floor'

interface Known {
  readonly name: string
  readonly label: string
  changed: number
  pose: Pose
  surface: Surface
}

const matrix = new Matrix4()
const position = new Vector3()
const quaternion = new Quaternion()
const scale = new Vector3()
const corner = new Vector3()

/** Follows what the headset knows of the room, and tells it when it has changed: only what is new
 * is built again. */
export class RoomScan {
  /** Height of the headset's own floor in the floor space, m; NaN: it knows none. */
  floor = Number.NaN
  private readonly known = new Map<XRPlane | XRMesh, Known>()
  private readonly numbers = new Map<string, number>()
  private lookedAt = Number.NEGATIVE_INFINITY
  private changedAt = Number.NaN

  /** tell: gets all surfaces, the endless floor first. */
  constructor(
    private readonly world: Object3D,
    private readonly tell: (surfaces: Surface[]) => void,
  ) {}

  /** How many surfaces the headset knows, the floor left out. */
  get count(): number {
    return this.known.size
  }

  /** Tell all once more: the lab has forgotten them. */
  tellAgain(): void {
    if (this.known.size > 0) this.changedAt = this.lookedAt
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
    return [floor, ...[...this.known.values()].map(({ surface }) => surface)]
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
      // lost for a moment: what was known of it stays
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
    // devices mark planes as changed that are as they were, some in every frame
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

/** Give physics the surfaces that a headset measured: those of others stay. */
export function orderSurfaces(context: RoomContext, source: string, surfaces: Surface[]): void {
  order(context, 'physics/set_surfaces', setSurfacesType, { source, surfaces })
}
