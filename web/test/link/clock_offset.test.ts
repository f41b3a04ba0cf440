import { describe, expect, test } from 'vitest'
import { ClockOffset, exchange } from '../../src/link/clock_offset'
import vectors from './clock_offset.json'

describe('the same as in Python', () => {
  test.each(vectors)('$name', ({ exchanges, reads }) => {
    const clock = new ClockOffset()
    let next = 0
    for (const [at, expected] of reads as [number, number][]) {
      while (next < exchanges.length && (exchanges[next]?.[3] as number) <= at) {
        clock.add(exchange(...(exchanges[next] as [number, number, number, number])))
        next++
      }
      expect(clock.offset(at)).toBeCloseTo(expected, 9)
    }
  })
})

test('nothing is known before the first exchange and after it was cleared', () => {
  const clock = new ClockOffset()
  expect(clock.offset(1)).toBeNaN()
  clock.add(exchange(0, 10, 10, 0))
  expect(clock.offset(1)).toBe(10)
  clock.clear()
  expect(clock.offset(1)).toBeNaN()
  expect(clock.roundTrip).toBeNaN()
})
