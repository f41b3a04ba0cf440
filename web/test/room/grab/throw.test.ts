import { Vector3 } from 'three'
import { expect, test } from 'vitest'
import { newTrace, trace, velocityOf } from '../../../src/room/grab/throw'

const FRAME = 1 / 72
const into = new Vector3()

function moved(speed: number, frames: number) {
  const places = newTrace()
  for (let i = 0; i < frames; i++) {
    trace(places, i * FRAME, new Vector3(i * FRAME * speed, 0, 0))
  }
  return places
}

test('a throw has the velocity of the last frames', () => {
  const places = moved(1.5, 30)
  expect(velocityOf(places, into).x).toBeCloseTo(1.5)
  for (let i = 30; i < 38; i++) trace(places, i * FRAME, new Vector3(1, 0, 0))
  expect(velocityOf(places, into).toArray()).toEqual([0, 0, 0])
})

test('an object that was held for a few frames is not thrown', () => {
  expect(velocityOf(moved(2, 7), into).toArray()).toEqual([0, 0, 0])
})

test('a jump of the tracking throws no faster than a person', () => {
  expect(velocityOf(moved(200, 8), into).length()).toBeCloseTo(6)
})
