import { describe, expect, test } from 'vitest'
import { BASE, hindranceAt, squared } from '../../../src/room/grab/clearance'
import type { Ground, Place } from '../../../src/room/place/supports'

const TABLE = {
  name: 'table_1',
  height: 0.7,
  outline: Float64Array.from([-0.6, -0.4, 0.6, -0.4, 0.6, 0.4, -0.6, 0.4]),
}
const FLOOR = { name: 'floor', height: 0, outline: new Float64Array() }
const EMPTY: Ground = { supports: [TABLE, FLOOR], walls: [], bases: [], obstacles: [] }

function at(x: number, y: number, support = TABLE): Place {
  return { x, y, z: support.height, support: support.name }
}

describe('a robot', () => {
  test('stands on a table, but not over its edge', () => {
    expect(hindranceAt(at(0, 0), BASE, EMPTY)).toBeNull()
    expect(hindranceAt(at(0.55, 0), BASE, EMPTY)).toBe('edge')
  })

  test('stands beside a table, but not in it', () => {
    const tall = { ...BASE, tall: 1 }
    expect(hindranceAt(at(0.65, 0, FLOOR), tall, EMPTY)).toBe('thing')
    expect(hindranceAt(at(0.9, 0, FLOOR), tall, EMPTY)).toBeNull()
  })

  test('stands in no wall, robot, thing or person', () => {
    const wall = { ax: -2, ay: 1.5, bx: 2, by: 1.5, low: 0, high: 2.6 }
    const around: Ground = {
      ...EMPTY,
      walls: [wall],
      bases: [{ x: 2, y: 0, z: 0, support: 'kr6_1' }],
      obstacles: [
        { kind: 'thing', x: 0.3, y: 0, radius: 0.04, low: 0.7, high: 0.78 },
        { kind: 'person', x: -2, y: 0, radius: 0.2, low: 0, high: 1.7 },
      ],
    }
    expect(hindranceAt(at(1, 1.45, FLOOR), BASE, around)).toBe('thing')
    expect(hindranceAt(at(2.2, 0, FLOOR), BASE, around)).toBe('robot')
    expect(hindranceAt(at(0.2, 0), BASE, around)).toBe('thing')
    expect(hindranceAt(at(0.1, 0), BASE, around)).toBeNull()
    expect(hindranceAt(at(-1.8, 0, FLOOR), BASE, around)).toBe('person')
    // what lies on the table is above the floor beside it
    expect(hindranceAt(at(2, 1, FLOOR), BASE, around)).toBeNull()
  })
})

test('a heading nearly square to a near edge is square to it', () => {
  const { supports } = EMPTY
  expect(squared(0.05, at(0, 0.2), supports)).toBeCloseTo(0)
  expect(squared(Math.PI / 2 - 0.05, at(0, 0.2), supports)).toBeCloseTo(Math.PI / 2)
  expect(squared(0.4, at(0, 0.2), supports)).toBe(0.4)
  expect(squared(0.05, at(3, 3, FLOOR), supports)).toBe(0.05)
})
