import { Object3D, Ray, Vector3 } from 'three'
import { describe, expect, it } from 'vitest'
import { ArmShape } from '../../../src/room/handles/arm_shape'
import { newHit } from '../../../src/room/input/pointer'

/** An arm of two links of 1 m, straight up from (2, 0, 0), with joints between. */
function arm(): ArmShape {
  const names = ['base', 'upper', 'lower']
  const links: Record<string, Object3D> = {}
  let parent = new Object3D()
  parent.position.set(2, 0, 0)
  const root = parent
  names.forEach((name, i) => {
    const joint = new Object3D()
    if (i > 0) joint.position.set(0, 1, 0)
    const link = new Object3D()
    parent.add(joint)
    joint.add(link)
    links[name] = link
    parent = link
  })
  root.updateMatrixWorld(true)
  return new ArmShape(links)
}

describe('the shape of an arm', () => {
  it('is met by a finger anywhere along it', () => {
    const shape = arm()
    for (const height of [0, 0.5, 1.3, 2]) {
      expect(shape.distance(new Vector3(2.27, height, 0))).toBeCloseTo(0.2)
    }
    expect(shape.distance(new Vector3(2, 1, 0))).toBeCloseTo(-0.07)
    expect(shape.distance(new Vector3(2, 3, 0))).toBeCloseTo(0.93)
  })

  it('is met by a ray that passes near its axis, at its near side', () => {
    const hit = newHit()
    const from = new Vector3(2.03, 1.5, 3)
    expect(arm().cast(new Ray(from, new Vector3(0, 0, -1)), hit)).toBe(true)
    expect(hit.distance).toBeCloseTo(2.93)
    expect(arm().cast(new Ray(from, new Vector3(0, 0, 1)), hit)).toBe(false)
    from.x = 2.2
    expect(arm().cast(new Ray(from, new Vector3(0, 0, -1)), hit)).toBe(false)
  })
})
