import { expect, test } from 'vitest'
import { delayOf, largestDeviation } from '../../../src/pages/trajectories/deviation'
import { Course } from '../../../src/playback/course'

function course(...frames: readonly (readonly number[])[]): Course {
  return new Course(10, frames[0]?.length ?? 0, Float64Array.from(frames.flat()))
}

test('a motion does not deviate from itself', () => {
  const motion = course([0, 0], [1, 1])
  expect(largestDeviation(motion, motion)).toBeNull()
})

test('the joint, the time and the row of the largest difference are named', () => {
  const found = largestDeviation(
    course([0, 0], [1, 1], [2, 2]),
    course([0, 0.1], [1, 0.5], [2, 2]),
  )
  expect(found).toEqual({ joint: 1, amount: 0.5, time: 0.1, row: 2 })
})

test('behind its end a shorter motion stays at its last pose', () => {
  const found = largestDeviation(course([0], [1], [5]), course([0], [1]))
  expect(found).toMatchObject({ amount: 4, row: 3 })
})

/** 6 s at 50 Hz: two joints move for 3 s and stand. */
function late(delay: number, off = 0): Course {
  const frames = Array.from({ length: 301 }, (_, i) => {
    const s = Math.min(Math.max((i / 50 - delay) / 3, 0), 1)
    return [Math.sin(5 * s) * s * (1 - s), s * s * (3 - 2 * s) + off]
  })
  return new Course(50, 2, Float64Array.from(frames.flat()))
}

test.each([0, 0.12, 1.5, -0.4])('a delay of %f s is found, with a joint that is off', (delay) => {
  expect(delayOf(late(0), late(delay, 0.05))).toBeCloseTo(delay, 2)
  const left = largestDeviation(late(0), late(delay, 0.05), delay)
  expect(left?.joint).toBe(1)
  expect(left?.amount).toBeCloseTo(0.05, 2)
})

test('motions that stand have no delay', () => {
  expect(delayOf(course([1], [1], [1]), course([1], [1]))).toBe(0)
  expect(delayOf(course([1]), course([1]))).toBe(0)
})
