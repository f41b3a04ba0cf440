import { Object3D, Vector3 } from 'three'
import { describe, expect, it } from 'vitest'
import { footingOf, stand } from '../../../src/room/place/touch_alignment'
import { stand as standInRos } from '../../../src/room/scene/frames'

/** Return the place in the floor space of the lab's place `at`. */
function placed(first: Vector3, second: Vector3, at: Vector3, floor = 0): number[] {
  const footing = footingOf(first, second)
  if (footing === null) throw new Error('too near')
  const group = new Object3D()
  const world = new Object3D()
  standInRos(world)
  group.add(world)
  stand(footing, floor, group.position, group.quaternion)
  group.updateMatrixWorld(true)
  return world.localToWorld(at.clone()).toArray()
}

function close(found: number[], expected: number[]): void {
  found.forEach((value, i) => {
    expect(value).toBeCloseTo(expected[i] as number)
  })
}

describe('an alignment by two points', () => {
  it('puts the origin below the first point and x towards the second', () => {
    const [first, second] = [new Vector3(1, 0.8, -2), new Vector3(3, 1.1, -2)]
    close(placed(first, second, new Vector3()), [1, 0, -2])
    close(placed(first, second, new Vector3(2, 0, 0)), [3, 0, -2])
    close(placed(first, second, new Vector3(0, 0, 1.5), 0.05), [1, 1.55, -2])
  })

  it('is the same place of the room for headsets whose floor spaces differ', () => {
    const points = [new Vector3(0.3, 0.7, -1), new Vector3(-0.4, 0.7, -2.1)] as const
    const seen = (turn: number, shift: Vector3) =>
      points.map((p) =>
        p
          .clone()
          .applyAxisAngle(new Vector3(0, 1, 0), turn)
          .add(shift),
      )
    const robot = new Vector3(1.2, -0.4, 0.72)
    const here = new Vector3().fromArray(placed(points[0], points[1], robot))
    const shift = new Vector3(4, 0, -1)
    const [first, second] = seen(1.1, shift) as [Vector3, Vector3]
    const there = placed(first, second, robot)
    close(
      here
        .applyAxisAngle(new Vector3(0, 1, 0), 1.1)
        .add(shift)
        .toArray(),
      there,
    )
  })

  it('refuses points that are too near to each other, one above the other too', () => {
    expect(footingOf(new Vector3(0, 0, 0), new Vector3(0.3, 0, 0))).toBeNull()
    expect(footingOf(new Vector3(0, 0, 0), new Vector3(0, 2, 0))).toBeNull()
  })
})
