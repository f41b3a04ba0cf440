import { describe, expect, it } from 'vitest'
import {
  isOn,
  landing,
  type SurfaceShape,
  supportsOf,
  wallsOf,
} from '../../../src/room/place/supports'

const UP = { x: 0, y: 0, z: 0, w: 1 }
const DOWN = { x: 1, y: 0, z: 0, w: 0 }
const WALL = { x: Math.SQRT1_2, y: 0, z: 0, w: Math.SQRT1_2 }
const square = (half: number) => [
  { x: -half, y: -half, z: 0 },
  { x: half, y: -half, z: 0 },
  { x: half, y: half, z: 0 },
  { x: -half, y: half, z: 0 },
]

function plane(name: string, height: number, change: Partial<SurfaceShape> = {}): SurfaceShape {
  const pose = { position: { x: 1, y: 0, z: height }, orientation: UP }
  return { name, label: 'table', pose, vertices: square(0.5), triangles: [], ...change }
}

const table = plane('table_1', 0.75)
const eyes = { x: 0, y: 0, z: 1.6 }
const place = () => ({ x: 0, y: 0, z: 0, support: '' })

describe('supports', () => {
  it('are the floor and level planes, however their normals point', () => {
    const flipped = plane('shelf', 1.2, {
      pose: { position: { x: 1, y: 0, z: 1.2 }, orientation: DOWN },
    })
    const wall = plane('wall', 1, { pose: { position: { x: 2, y: 0, z: 1 }, orientation: WALL } })
    const ceiling = plane('ceiling', 2.5, { label: 'ceiling' })
    const mesh = plane('mesh', 0.4, { triangles: [0, 1, 2] })
    const names = supportsOf([table, wall, ceiling, mesh, flipped]).map(({ name }) => name)
    expect(names).toEqual(['shelf', 'table_1', 'floor'])
  })

  it('end at their outline, turned as they are', () => {
    const turned = plane('t', 0.7, {
      pose: {
        position: { x: 0, y: 0, z: 0.7 },
        orientation: { x: 0, y: 0, z: Math.sin(Math.PI / 8), w: Math.cos(Math.PI / 8) },
      },
    })
    const [support] = supportsOf([turned])
    if (support === undefined) throw new Error('there is no support')
    expect(isOn(support, 0.6, 0)).toBe(true)
    expect(isOn(support, 0.45, 0.45)).toBe(false)
    expect(support.height).toBeCloseTo(0.7, 12)
  })
})

describe('landing', () => {
  it('is on the table where the ray meets it, else on the floor', () => {
    const found = place()
    expect(
      landing(
        { supports: supportsOf([table]), walls: [] },
        eyes,
        { x: 1, y: 0, z: -0.85 },
        5,
        found,
      ),
    ).toBe(true)
    expect(found).toMatchObject({ z: 0.75, support: 'table_1' })
    expect(
      landing({ supports: supportsOf([table]), walls: [] }, eyes, { x: 1, y: 1, z: -1 }, 5, found),
    ).toBe(true)
    expect(found).toMatchObject({ z: 0, support: 'floor' })
  })

  it('is nowhere for a ray into the air or too far away', () => {
    expect(
      landing({ supports: supportsOf([]), walls: [] }, eyes, { x: 1, y: 0, z: 0.1 }, 5, place()),
    ).toBe(false)
    expect(
      landing({ supports: supportsOf([]), walls: [] }, eyes, { x: 1, y: 0, z: -0.1 }, 5, place()),
    ).toBe(false)
  })
})

it('a landing is before a wall, not behind it', () => {
  const wall = plane('wall', 1, {
    label: 'wall',
    pose: { position: { x: 1, y: 0, z: 1 }, orientation: WALL },
  })
  const walls = wallsOf([wall, table])
  expect(walls.length).toBe(1)
  const around = { supports: supportsOf([]), walls }
  const before = { x: 1, y: -1, z: 1.6 }
  expect(landing(around, before, { x: 0, y: 1, z: -0.5 }, 5, place())).toBe(false)
  expect(landing(around, before, { x: 0, y: 1, z: -2 }, 5, place())).toBe(true)
  expect(landing(around, before, { x: 1, y: 1, z: -0.5 }, 5, place())).toBe(true)
})
