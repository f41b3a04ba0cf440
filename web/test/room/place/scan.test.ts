import { Group, Matrix4, Quaternion, Vector3 } from 'three'
import { beforeEach, describe, expect, it } from 'vitest'
import type { Surface } from '../../../src/protocol/mrlab_msgs'
import { RoomScan, simplifyMesh, simplifyOutline } from '../../../src/room/place/scan'
import { stand } from '../../../src/room/scene/frames'

interface MadeUpPlane {
  lastChangedTime: number
  semanticLabel: string
  polygon: { x: number; y: number; z: number }[]
  planeSpace: { matrix: Matrix4 }
}

function plane(label: string, x: number, y: number, z: number, half = 0.5): MadeUpPlane {
  const corners = [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ]
  return {
    lastChangedTime: 1,
    semanticLabel: label,
    polygon: corners.map(([a = 0, b = 0]) => ({ x: a * half, y: 0, z: b * half })),
    planeSpace: {
      matrix: new Matrix4().compose(new Vector3(x, y, z), new Quaternion(), new Vector3(1, 1, 1)),
    },
  }
}

describe('the room', () => {
  let planes: Set<MadeUpPlane>
  let told: Surface[][]
  let scan: RoomScan
  let now: number

  beforeEach(() => {
    const world = new Group()
    stand(world)
    world.updateMatrixWorld(true)
    planes = new Set()
    told = []
    now = 0
    scan = new RoomScan(world, (surfaces) => told.push(surfaces))
  })

  /** Let seconds go by, as frames of an XRFrame that marks everything as changed, as devices do. */
  function wait(seconds: number, touch = true): void {
    for (const end = now + seconds; now < end; now += 0.1) {
      if (touch) for (const each of planes) each.lastChangedTime = now
      const frame = {
        detectedPlanes: planes,
        getPose: (space: { matrix: Matrix4 }) => ({
          transform: { matrix: new Float32Array(space.matrix.elements) },
        }),
      }
      scan.update(frame as unknown as XRFrame, {} as XRReferenceSpace, now)
    }
  }

  it('takes a surface that is touched where the headset knows none', () => {
    wait(2)
    expect(scan.touch(new Vector3(1, 0.72, -2))).toBe(false)
    scan.awaited = true
    expect(scan.touch(new Vector3(1, 0.72, -2))).toBe(true)
    expect([scan.awaited, scan.count]).toEqual([false, 1])
    const { name, label, pose, vertices } = (told.at(-1) ?? []).at(-1) as Surface
    expect([name, label, vertices.length]).toEqual(['touched_1', 'table', 4])
    expect(pose.position.x).toBeCloseTo(2)
    expect([pose.position.y, pose.position.z]).toEqual([-1, 0.72])
    // It stays as the headset finds its own, and is told again with them.
    planes.add(plane('table', 0, 0.7, 0))
    wait(3)
    expect(told.at(-1)?.map((each) => each.label)).toEqual(['floor', 'table', 'table'])
  })

  it('is told once it stands still, although the device marks it as changed for ever', () => {
    planes.add(plane('floor', 0, 0.02, 0, 3))
    planes.add(plane('table', 0.2, 0.72, -1.1))
    wait(5)
    expect(told).toHaveLength(1)
    const [floor, table] = told[0] as [Surface, Surface]
    // the lab's own floor has no end; the headset's says where that is
    expect(floor).toMatchObject({ name: 'floor', vertices: [] })
    expect(scan.floor).toBeCloseTo(0.02, 6)
    expect(table).toMatchObject({ name: 'table_1', label: 'table' })
    expect(table.pose.position.x).toBeCloseTo(1.1, 6)
    expect(table.pose.position.y).toBeCloseTo(-0.2, 6)
    expect(table.pose.position.z).toBeCloseTo(0.72, 6)
    expect(table.vertices).toHaveLength(4)
    for (const { z } of table.vertices) expect(z).toBeCloseTo(0, 12)
  })

  it('is told again when a table is moved, comes or goes, and not when it trembles', () => {
    const table = plane('table', 0, 0.7, -1)
    planes.add(table)
    wait(3)
    table.planeSpace.matrix.setPosition(0.005, 0.7, -1)
    wait(3)
    expect(told).toHaveLength(1)
    table.planeSpace.matrix.setPosition(0.3, 0.7, -1)
    wait(3)
    expect(told).toHaveLength(2)
    planes.add(plane('table', 2, 0.7, -1))
    wait(3)
    expect(told[2]?.map(({ name }) => name)).toEqual(['floor', 'table_1', 'table_2'])
    planes.delete(table)
    wait(3)
    expect(told[3]?.map(({ name }) => name)).toEqual(['floor', 'table_2'])
  })

  it('is told again when an outline grows', () => {
    const table = plane('table', 0, 0.7, -1)
    planes.add(table)
    wait(3)
    for (const corner of table.polygon) corner.x *= 1.5
    wait(3)
    expect(told).toHaveLength(2)
  })

  it('is bounded', () => {
    for (let i = 0; i < 100; i++) planes.add(plane('other', i, 0.5, 0))
    wait(3)
    expect(told[0]?.length).toBe(65)
  })
})

describe('what is sent of it', () => {
  it('has no corners on straight lines, and 32 at most', () => {
    const square = [
      { x: 0, y: 0 },
      { x: 0.5, y: 0.001 },
      { x: 1, y: 0 },
      { x: 1, y: 1 },
      { x: 0, y: 1 },
    ]
    expect(simplifyOutline(square)).toHaveLength(4)
    const round = Array.from({ length: 500 }, (_, i) => ({
      x: 3 * Math.cos(i / 79.6),
      y: 3 * Math.sin(i / 79.6),
    }))
    const simple = simplifyOutline(round)
    expect(simple.length).toBeLessThanOrEqual(32)
    expect(simple.length).toBeGreaterThan(6)
  })

  it('is a mesh of few triangles that keeps its size', () => {
    const side = 60
    const vertices = new Float32Array(side * side * 3)
    const indices: number[] = []
    for (let i = 0; i < side * side; i++) {
      vertices.set([(i % side) / side, Math.floor(i / side) / side, 0], 3 * i)
      if (i % side < side - 1 && i < side * (side - 1)) {
        indices.push(i, i + 1, i + side, i + 1, i + side + 1, i + side)
      }
    }
    const simple = simplifyMesh(vertices, Uint32Array.from(indices), 500)
    expect(simple.triangles.length / 3).toBeLessThanOrEqual(500)
    expect(Math.max(...simple.triangles)).toBeLessThan(simple.vertices.length / 3)
    expect(Math.max(...simple.vertices)).toBeGreaterThan(0.85)
  })
})
