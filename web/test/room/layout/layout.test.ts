import { describe, expect, test } from 'vitest'
import {
  type Box,
  type Crowd,
  covered,
  MOST_COVERED,
  overlaps,
  type Silhouette,
  settle,
  stays,
} from '../../../src/room/layout/layout'

const deg = Math.PI / 180
const OPEN = { width: 24 * deg, height: 18 * deg }
const CHIP = { width: 11 * deg, height: 3 * deg }

/** Return numbers from 0 to 1, the same for the same seed. */
function numbers(seed: number): () => number {
  let state = seed
  return () => {
    state = (state * 1664525 + 1013904223) % 2 ** 32
    return state / 2 ** 32
  }
}

interface Room {
  readonly robots: Silhouette[]
  readonly middles: { readonly az: number; readonly el: number }[]
  readonly fixed: Box[]
}

/** Return a room as it is seen from eyes at 1.6 m: arms of some joints, a person, the board. */
function roomOf(seed: number): Room {
  const next = numbers(seed)
  const robots: number[][] = []
  const middles = []
  const count = 1 + Math.floor(next() * 4)
  for (let i = 0; i < count; i++) {
    const az = (-50 + (100 * (i + next())) / count) * deg
    const away = 1 + 2 * next()
    const points: number[] = []
    let [x, up] = [0, 0]
    for (let joint = 0; joint < 7; joint++) {
      const el = Math.atan2(up - 1.6 + (next() > 0.5 ? 0.72 : 0), away)
      for (const side of [-1, 1]) points.push(az + x / away + (side * 0.06) / away, el)
      x += (next() - 0.5) * 0.35
      up += next() * 0.25
    }
    robots.push(points)
    middles.push({ az, el: Math.atan2(up / 2 - 1.6, away) })
  }
  const person = { az: (next() - 0.5) * 2, el: 0, width: 14 * deg, height: 14 * deg }
  const board = { az: 36 * deg, el: -13 * deg, width: 43 * deg, height: 35 * deg }
  return { robots, middles, fixed: [person, board] }
}

describe.each(Array.from({ length: 50 }, (_, seed) => seed))('in the made-up room %i', (seed) => {
  test('panels cover no robot, nobody, no board, and not each other', () => {
    const { robots, middles, fixed } = roomOf(seed)
    const boxes = [...fixed]
    const crowd: Crowd = { robots, boxes }
    middles.forEach((middle, i) => {
      const wish = { ...middle, ...(i === 0 ? OPEN : CHIP), side: 1 } as const
      const found = settle(wish, crowd)
      for (const robot of robots) expect(covered(found, robot)).toBeLessThanOrEqual(MOST_COVERED)
      for (const box of boxes) expect(overlaps(found, box)).toBe(false)
      expect(stays(found, wish, crowd)).toBe(true)
      boxes.push(found)
    })
  })
})

test('a panel stands on the wanted side of an arm', () => {
  const robot = Array.from({ length: 20 }, (_, i) => [
    -0.05 + 0.1 * (i % 2),
    -0.6 + 0.04 * i,
  ]).flat()
  const crowd = { robots: [robot], boxes: [] }
  const wish = { az: 0, el: -0.2, ...OPEN }
  expect(settle({ ...wish, side: 1 }, crowd).az).toBeGreaterThan(0)
  expect(settle({ ...wish, side: -1 }, crowd).az).toBeLessThan(0)
})

test('a panel that an arm comes before goes elsewhere', () => {
  const wish = { az: 0, el: -0.2, ...CHIP, side: 1 } as const
  const box = settle(wish, { robots: [], boxes: [] })
  const robot = [box.az, box.el, box.az + 0.01, box.el]
  expect(stays(box, wish, { robots: [], boxes: [] })).toBe(true)
  expect(stays(box, wish, { robots: [robot], boxes: [] })).toBe(false)
})
