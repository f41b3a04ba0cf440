import { Ray, Vector3 } from 'three'
import { beforeEach, expect, test } from 'vitest'
import { begin, carry, hold, join, newBaseGrab } from '../../../src/room/grab/base'
import { type Place, supportsOf } from '../../../src/room/place/supports'

const supports = supportsOf([])
const still = { x: 0, y: 0 }
const grabbed = newBaseGrab()
const first = holdAt(0, 0)
let others: Place[]
const around = () => ({ supports, walls: [], bases: others, obstacles: [] })

function holdAt(x: number, y: number) {
  return { near: true, roll: 0, ray: new Ray(), place: new Vector3(x, y, 0.1) }
}

beforeEach(() => {
  others = []
  first.place.set(0.05, 0, 0.1)
  first.roll = 0.1
  begin(grabbed, new Vector3(0, 0, 0), 0)
  hold(grabbed, first, around())
})

test('a press that moves less than 3 cm carries nothing', () => {
  first.place.x += 0.02
  expect(carry(grabbed, first, null, still, 0.1, around())).toBeNull()
  expect(grabbed.moved).toBe(false)
})

test('the base follows the pointer that took hold of its side', () => {
  first.place.set(1.05, 0.5, 0.1)
  expect(carry(grabbed, first, null, still, 0.1, around())).toBe('')
  expect(grabbed.place).toMatchObject({ x: 1, y: 0.5, z: 0, support: 'floor' })
})

test('beside another base it stays at the last clear place', () => {
  others = [{ x: 1, y: 0, z: 0, support: 'kr6_1' }]
  first.place.x = 0.55
  carry(grabbed, first, null, still, 0.1, around())
  first.place.x = 0.95
  expect(carry(grabbed, first, null, still, 0.1, around())).toBe('robot')
  expect(grabbed.place.x).toBeCloseTo(0.5)
})

test('two pointers turn the base about their middle, where it stays', () => {
  const second = holdAt(-0.05, 0)
  join(grabbed, first, second, around())
  for (let step = 1; step <= 60; step++) {
    const angle = (step * Math.PI) / 180
    first.place.set(0.05 * Math.cos(angle), 0.05 * Math.sin(angle), 0.1)
    second.place.set(-0.05 * Math.cos(angle), -0.05 * Math.sin(angle), 0.1)
    carry(grabbed, first, second, still, 0.01, around())
  }
  expect(grabbed.heading).toBeCloseTo(Math.PI / 3)
  expect(Math.hypot(grabbed.place.x, grabbed.place.y)).toBeLessThan(0.005)
})

test('two pointers carry the base with them', () => {
  const second = holdAt(-0.05, 0)
  join(grabbed, first, second, around())
  first.place.x += 0.5
  second.place.x += 0.5
  expect(carry(grabbed, first, second, still, 0.1, around())).toBe('')
  expect(grabbed.place.x).toBeCloseTo(0.5)
  expect(grabbed.heading).toBeCloseTo(0)
})

test('one hand turns it like a key, and not where it only trembles', () => {
  first.roll = 0.4
  expect(carry(grabbed, first, null, still, 0.1, around())).toBeNull()
  expect([grabbed.heading, grabbed.moved]).toEqual([0, false])
  for (const roll of [0.6, 0.9]) {
    first.roll = roll
    carry(grabbed, first, null, still, 0.1, around())
  }
  expect(grabbed.heading).toBeCloseTo(2.5 * 0.4)
  // Taken anew, it goes on from there.
  hold(grabbed, first, around())
  carry(grabbed, first, null, still, 0.1, around())
  expect([grabbed.heading, grabbed.moved]).toEqual([expect.closeTo(1), true])
})

test('the stick turns it and pushes it along the ray', () => {
  first.ray.direction.set(1, 0, -1).normalize()
  carry(grabbed, first, null, { x: 1, y: -1 }, 0.1, around())
  expect(grabbed.heading).toBeCloseTo(-0.16)
  expect(grabbed.place.x).toBeCloseTo(0.08)
})
