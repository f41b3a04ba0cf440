import { DirectionalLight, Vector3 } from 'three'
import { describe, expect, test } from 'vitest'
import { ShadowFit } from '../../../src/scene/stage/shadow_fit'

/** Return whether a caster at a place of the scene is in the picture of the shadow. */
function covers(sun: DirectionalLight, place: Vector3): boolean {
  const { camera } = sun.shadow
  camera.position.copy(sun.position)
  camera.lookAt(sun.target.position)
  camera.updateMatrixWorld()
  const at = place.clone().project(camera)
  return Math.max(Math.abs(at.x), Math.abs(at.y), Math.abs(at.z)) <= 1
}

describe('what a shadow covers', () => {
  const middle = new Vector3(1, 0.2, -2)

  function fitted(...balls: readonly (readonly [Vector3, number])[]) {
    const sun = new DirectionalLight()
    const fit = new ShadowFit(sun, new Vector3(1.2, 3.2, 1.4))
    const about = (place: Vector3) => {
      fit.about(place, 1.6)
      for (const [centre, radius] of balls) fit.take(centre, radius)
      fit.apply()
    }
    about(middle)
    return { sun, about }
  }

  test('is a square about a place, with the floor on which the shadow falls', () => {
    const { sun } = fitted()
    expect(covers(sun, middle)).toBe(true)
    expect(covers(sun, new Vector3(1, 1.5, -2))).toBe(true)
    expect(covers(sun, new Vector3(2.4, 0, -2))).toBe(true)
    expect(covers(sun, new Vector3(4, 0, -2))).toBe(false)
    expect(sun.shadow.camera.right - sun.shadow.camera.left).toBeCloseTo(3.2)
  })

  test.each([
    ['stretched out to the side', new Vector3(4, 0.8, -2)],
    ['towards the eyes', new Vector3(1, 0.6, 1.3)],
    ['above the sun', new Vector3(1.3, 4.5, -2)],
  ])('grows with an arm %s', (_, tool) => {
    const { sun } = fitted([tool, 0.2])
    expect(covers(sun, tool)).toBe(true)
    for (const axis of ['x', 'y', 'z'] as const) {
      for (const side of [-0.19, 0.19]) {
        const edge = tool.clone()
        edge[axis] += side
        expect(covers(sun, edge)).toBe(true)
      }
    }
    expect(covers(sun, middle)).toBe(true)
  })

  test('does not change with each motion, and fits anew about another place', () => {
    const tool = new Vector3(4, 0.8, -2)
    const { sun, about } = fitted([tool, 0.2])
    const { left, right, top, bottom } = sun.shadow.camera
    tool.x -= 0.3
    about(middle)
    expect(sun.shadow.camera).toMatchObject({ left, right, top, bottom })
    tool.copy(middle)
    about(middle.clone().setX(1.5))
    expect(sun.shadow.camera.right - sun.shadow.camera.left).toBeCloseTo(3.2)
  })

  test('keeps surfaces from shading themselves, however large it is', () => {
    const small = fitted().sun.shadow
    const large = fitted([new Vector3(6, 0.8, -2), 0.2]).sun.shadow
    const texels = ({ camera, mapSize, normalBias }: typeof small) =>
      normalBias / Math.max(camera.right - camera.left, camera.top - camera.bottom) / mapSize.x
    expect(texels(large)).toBeCloseTo(texels(small), 8)
    expect(large.normalBias).toBeGreaterThan(1.5 * small.normalBias)
  })
})
