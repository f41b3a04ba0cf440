import { Group, Quaternion, Ray, Vector3 } from 'three'
import { expect, test, vi } from 'vitest'
import {
  attachType,
  createSceneObject,
  detachType,
  moveObjectType,
} from '../../../src/protocol/mrlab_msgs'
import { ObjectHandle } from '../../../src/room/handles/object_handle'
import type { Pointer } from '../../../src/room/input/pointer'
import type { LabScene } from '../../../src/scene/lab/lab_scene'
import { en } from '../../../src/words/en'
import { FakeLink } from '../../fake_link'

const settled = () => new Promise((resolve) => setTimeout(resolve))

function carried(heldBy: string, robotAt: string) {
  const link = new FakeLink()
  const done = () => ({ success: true, message: '' })
  link.answer('physics/attach', attachType, done)
  link.answer('physics/detach', detachType, done)
  link.answer('physics/move_object', moveObjectType, done)
  const ports = {
    link,
    world: new Group(),
    feedback: () => undefined,
    say: vi.fn(),
    words: en,
    head: new Vector3(),
    look: new Quaternion(),
    stir: () => undefined,
  }
  const object = { ...createSceneObject(), name: 'cube_1', held_by: heldBy }
  object.pose.position.x = 2
  object.size.x = object.size.y = object.size.z = 0.05
  const moveObject = vi.fn()
  const handle = new ObjectHandle(
    object,
    { moveObject } as unknown as LabScene,
    ports,
    () => robotAt,
  )
  const ray = new Ray(new Vector3(1, 0, 0), new Vector3(1, 0, 0))
  const pointer = { ray, place: ray.origin } as unknown as Pointer
  handle.on({ kind: 'down', pointer, button: 'select' })
  handle.update(1)
  const services = () => link.calls.map(({ service }) => service)
  return { handle, pointer, link, services, moveObject, ports }
}

test('what is let go between the fingers of a gripper is fixed to it', async () => {
  const { handle, pointer, link, services } = carried('', 'ur5e_1')
  handle.on({ kind: 'up', pointer, button: 'select' })
  await vi.waitFor(() => expect(services()).toContain('physics/attach'))
  expect(link.calls.at(-1)?.request).toEqual({ robot: 'ur5e_1', object: 'cube_1' })
  // it is not let go first: until the gripper has it, it would fall
  const moved = link.calls.filter(({ service }) => service === 'physics/move_object')
  expect(moved.map(({ request }) => (request as { held: boolean }).held)).toEqual([true])
})

test('what is let go elsewhere is fixed to nothing', async () => {
  const { handle, pointer, services } = carried('', '')
  handle.on({ kind: 'up', pointer, button: 'select' })
  await vi.waitFor(() => expect(services()).toHaveLength(2))
  expect(services()).not.toContain('physics/attach')
})

test('a hand takes what a gripper holds, once that has let go', async () => {
  const { handle, services } = carried('ur5e_1', '')
  expect(services()).toEqual(['physics/detach'])
  await vi.waitFor(() => {
    handle.update(2)
    expect(services()).toContain('physics/move_object')
  })
})

test('it is taken where it is, and goes as far as the hand', () => {
  const { handle, pointer, moveObject } = carried('', '')
  expect(moveObject.mock.lastCall?.[1].position).toMatchObject({ x: 2, y: 0, z: 0 })
  pointer.ray.origin.set(1, 0.3, 0)
  handle.update(2)
  expect(moveObject.mock.lastCall?.[1].position).toMatchObject({ x: 2, y: 0.3, z: 0 })
})

test('what is in the hand of somebody else is left there, until that hand moves it no more', async () => {
  const { handle, pointer, services, ports } = carried('', '')
  handle.on({ kind: 'up', pointer, button: 'select' })
  await vi.waitFor(() => expect(services()).toHaveLength(2))
  await settled()
  handle.update(5)
  const moved = { ...createSceneObject(), name: 'cube_1', held_by: 'hand' }
  moved.pose.position.x = 2.1
  moved.size.x = moved.size.y = moved.size.z = 0.05
  handle.show(moved)
  const before = services().length
  handle.on({ kind: 'down', pointer, button: 'select' })
  handle.update(5.1)
  expect(services()).toHaveLength(before)
  expect(ports.say).toHaveBeenCalledWith(en.room.inAnotherHand('cube_1'))
  // a page that is gone has left it in the air
  handle.update(6)
  handle.on({ kind: 'down', pointer, button: 'select' })
  handle.update(6.1)
  await settled()
  expect(services()).toHaveLength(before + 1)
})

test('what was just let go is taken again, though the lab still has it in the hand', async () => {
  const { handle, pointer, services } = carried('', '')
  handle.on({ kind: 'up', pointer, button: 'select' })
  await vi.waitFor(() => expect(services()).toHaveLength(2))
  await settled()
  const late = { ...createSceneObject(), name: 'cube_1', held_by: 'hand' }
  late.size.x = late.size.y = late.size.z = 0.05
  handle.show(late)
  const before = services().length
  handle.on({ kind: 'down', pointer, button: 'select' })
  handle.update(1.1)
  await settled()
  expect(services()).toHaveLength(before + 1)
})
