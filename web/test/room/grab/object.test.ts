import { Ray, Vector3 } from 'three'
import { expect, test } from 'vitest'
import { carried, grab } from '../../../src/room/grab/object'

const grip = () => ({
  ray: new Ray(new Vector3(0, 1, 0), new Vector3(1, 0, 0)),
  place: new Vector3(0.1, 1, 0),
})
const into = new Vector3()

test('an object stays where it is until the pointer moves', () => {
  const centre = new Vector3(2, 1.1, 0.2)
  for (const inHand of [true, false]) {
    expect(carried(grab(grip(), centre, inHand), grip(), into).toArray()).toEqual([2, 1.1, 0.2])
  }
})

test('an object in the hand follows the hand', () => {
  const held = grab(grip(), new Vector3(0.2, 1, 0), true)
  const moved = grip()
  moved.place.set(0.1, 1.5, 0)
  expect(carried(held, moved, into).toArray()).toEqual([0.2, 1.5, 0])
})

test('an object on the ray keeps its distance', () => {
  const held = grab(grip(), new Vector3(2, 1, 0), false)
  const turned = grip()
  turned.ray.direction.set(0, 0, 1)
  expect(carried(held, turned, into).toArray()).toEqual([0, 1, 2])
})
