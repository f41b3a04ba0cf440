import { Object3D } from 'three'
import { beforeEach, describe, expect, it } from 'vitest'
import { type HandlePorts, RobotHandle } from '../../../src/room/handles/robot_handle'
import { RayPointer } from '../../../src/room/input/pointer'
import { supportsOf } from '../../../src/room/place/supports'
import { upright } from '../../../src/room/scene/frames'
import type { LabScene } from '../../../src/scene/lab/lab_scene'
import { type Pose, place } from '../../../src/scene/stage/pose'

const settled = () => new Promise((resolve) => setTimeout(resolve))

describe('a robot that is carried', () => {
  let base: Object3D
  let handle: RobotHandle
  let answers: ((success: boolean) => void)[]
  let told: Pose[]
  const pointer = new RayPointer('ray', 'right')

  beforeEach(() => {
    base = new Object3D()
    answers = []
    told = []
    const scene = {
      robot: () => undefined,
      placeRobot: (_: string, pose: Pose) => place(base, pose),
    } as unknown as LabScene
    const ports = {
      world: new Object3D(),
      supports: supportsOf([]),
      walls: [],
      bases: [],
      obstacles: [],
      feedback: () => undefined,
      stir: () => undefined,
      say: () => undefined,
      link: {
        call: (_: string, _type: unknown, { pose }: { pose: Pose }) => {
          told.push(pose)
          return new Promise((resolve) => {
            answers.push((success) => resolve({ success, message: '' }))
          })
        },
      },
    } as unknown as HandlePorts
    const choosing = { on: false, touch: () => undefined }
    handle = new RobotHandle('ur5e_1', base, scene, ports, choosing, () => 0)
    handle.show(upright(0, 0, 0, 0))
    base.updateMatrixWorld(true)
    pointer.place.set(0, 0, 0.1)
    handle.on({ kind: 'down', pointer, button: 'select' })
    pointer.place.set(0.5, 0, 0.1)
    handle.update(1, 0.1)
    handle.on({ kind: 'up', pointer, button: 'select' })
    expect(base.position.x).toBeCloseTo(0.5)
  })

  async function answer(success: boolean): Promise<void> {
    while (answers.length > 0) {
      for (const each of answers.splice(0)) each(success)
      await settled()
    }
  }

  it('stays where it was let go until the lab answers, however late', async () => {
    handle.update(9, 0.1)
    expect(base.position.x).toBeCloseTo(0.5)
    expect(told.at(-1)?.position.x).toBeCloseTo(0.5)
    handle.show(upright(0.5, 0, 0, 0))
    await answer(true)
    handle.update(20, 0.1)
    expect(base.position.x).toBeCloseTo(0.5)
  })

  it('stands where somebody else put it afterwards', async () => {
    handle.show(upright(-2, 1, 0, 0))
    await answer(true)
    handle.update(1.2, 0.1)
    handle.update(9, 0.1)
    expect(base.position.toArray()).toEqual([-2, 1, 0])
  })

  it('goes back where the lab refuses its place', async () => {
    await answer(false)
    handle.update(1.2, 0.1)
    expect(base.position.toArray()).toEqual([0, 0, 0])
  })
})
