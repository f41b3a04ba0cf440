import { Group, Object3D, Vector3 } from 'three'
import { beforeEach, describe, expect, test, vi } from 'vitest'
import { Placing } from '../../../src/room/handles/placing'
import { RayPointer } from '../../../src/room/input/pointer'
import { Targets } from '../../../src/room/input/targets'
import type { Ground } from '../../../src/room/place/supports'
import { stand } from '../../../src/room/scene/frames'
import type { Pose } from '../../../src/scene/stage/pose'
import { en } from '../../../src/words/en'

const TABLE = {
  name: 'table_1',
  height: 0.72,
  outline: Float64Array.from([0.8, -0.6, 1.6, -0.6, 1.6, 0.6, 0.8, 0.6]),
}
const FLOOR = { name: 'floor', height: 0, outline: new Float64Array() }

// There is no canvas to paint it on.
vi.mock('../../../src/scene/stage/labels', () => ({
  Label: class {
    readonly sprite = new Object3D()
    constructor(readonly text: string) {}
    paint(): void {}
    dispose(): void {}
  },
}))

describe('a robot that is placed', () => {
  const pointer = new RayPointer('ray', 'right')
  const targets = new Targets((target) => pointer.forget(target))
  let placing: Placing
  let put: { readonly pose: Pose; readonly support: string }[]
  let said: string[]
  let stick: number
  let ground: Ground
  const world = new Object3D()
  stand(world)
  world.updateMatrixWorld(true)

  beforeEach(() => {
    put = []
    said = []
    stick = 0
    ground = { supports: [TABLE, FLOOR], walls: [], bases: [], obstacles: [] }
    const ports = {
      ...ground,
      words: en,
      say: (text: string) => said.push(text),
      feedback: () => undefined,
      stir: () => undefined,
      world,
      head: new Vector3(0, 1.6, 0),
      look: world.quaternion,
      get obstacles() {
        return ground.obstacles
      },
    }
    placing = new Placing(
      ports,
      targets,
      () => stick,
      () => undefined,
    )
    placing.begin({
      id: 'ur5e',
      foot: { radius: 0.12, tall: 0.5, apart: 0.35 },
      reach: 0.85,
      ghost: () => ({ root: new Group(), paint: () => undefined, dispose: () => undefined }),
      put: async (pose, support) => put.push({ pose, support }),
    })
  })

  /** Aim at a place of the lab. */
  function aim(x: number, y: number, z: number, step = 0.01): void {
    pointer.ray.origin.set(0.2, 1.3, -0.1)
    const to = world.localToWorld(new Vector3(x, y, z))
    pointer.ray.direction.subVectors(to, pointer.ray.origin).normalize()
    pointer.aim(1, true, targets.all)
    placing.update(step)
  }

  test('stands within 10 mm and 2 degrees of where it was aimed, on a table or the floor', () => {
    for (const [x, y, z] of [
      [1.2, 0.1, 0.72],
      [1.0, 1.4, 0],
    ] as const) {
      placing.begin({ ...chosen(), id: `at ${x}` })
      aim(x, y, z)
      const shown = placing.pose
      pointer.press('select')
      // A hand that trembles at the press changes nothing.
      aim(x + 0.01, y + 0.01, z)
      pointer.release('select')
      const { pose, support } = put.at(-1) ?? {}
      expect(pose).toEqual(shown)
      const { position } = pose as Pose
      expect(Math.hypot(position.x - x, position.y - y, position.z - z)).toBeLessThan(0.01)
      expect(support).toBe(z === 0 ? 'floor' : 'table_1')
      expect(placing.active).toBe(false)
    }
  })

  function chosen() {
    return {
      id: 'kr6',
      foot: { radius: 0.12, tall: 0.5, apart: 0.35 },
      reach: 0,
      ghost: () => ({ root: new Group(), paint: () => undefined, dispose: () => undefined }),
      put: async (pose: Pose, support: string) => put.push({ pose, support }),
    }
  }

  test('turns with the stick', () => {
    aim(1.0, 1.4, 0)
    const before = headingOf(placing.pose)
    stick = 1
    aim(1.0, 1.4, 0, 0.5)
    expect(headingOf(placing.pose)).toBeCloseTo(before - 0.8)
  })

  test('turns where it stands as a pressed ray goes sideways, for hands that have no stick', () => {
    aim(1.0, 1.4, 0)
    const before = placing.pose
    pointer.press('select')
    aim(1.3, 1.4, 0)
    const held = placing.pose
    expect(held?.position).toEqual(before?.position)
    expect(Math.abs(headingOf(held) - headingOf(before))).toBeGreaterThan(0.2)
    pointer.release('select')
    expect(put.at(-1)?.pose).toEqual(held)
  })

  test('is refused with the reason where it would stand in a person', () => {
    ground = {
      ...ground,
      obstacles: [{ kind: 'person', x: 1, y: 1.2, radius: 0.2, low: 0, high: 1.7 }],
    }
    aim(1.0, 1.4, 0)
    pointer.press('select')
    pointer.release('select')
    expect(put).toEqual([])
    expect(said.at(-1)).toBe(en.room.hindered.person)
    pointer.press('grip')
    expect(placing.active).toBe(false)
  })
})

function headingOf(pose: Pose | null): number {
  const { z = 0, w = 1 } = pose?.orientation ?? {}
  return 2 * Math.atan2(z, w)
}
