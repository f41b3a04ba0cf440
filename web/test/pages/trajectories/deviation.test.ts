import { expect, test } from 'vitest'
import { largestDeviation } from '../../../src/pages/trajectories/deviation'
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
