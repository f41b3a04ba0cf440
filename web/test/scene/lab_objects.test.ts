import { Group, type Object3D } from 'three'
import { expect, test, vi } from 'vitest'
import { LabObjects, type ShownObject } from '../../src/scene/lab_objects'
import type { MeshSource } from '../../src/scene/meshes'
import type { Stage } from '../../src/scene/stage'

const upright = { x: 0, y: 0, z: 0, w: 1 }

function cube(x: number, heldBy = ''): ShownObject {
  return {
    name: 'cube',
    mesh: '',
    size: { x: 1, y: 1, z: 1 },
    color: { r: 1, g: 0, b: 0, a: 1 },
    primitive: { type: 1, dimensions: [1, 1, 1] },
    pose: { position: { x, y: 0, z: 0 }, orientation: upright },
    held_by: heldBy,
  }
}

function scene() {
  const world = new Group()
  const hand = new Group()
  world.add(hand)
  const invalidate = vi.fn()
  const meshes: MeshSource = {
    load: () => Promise.reject(new Error('404')),
    dispose: () => undefined,
  }
  const said = vi.fn()
  const stage = { world, invalidate } as unknown as Stage
  const objects = new LabObjects(
    stage,
    meshes,
    (name): Object3D | undefined => (name === 'arm' ? hand : undefined),
    said,
  )
  return { world, hand, objects, invalidate, said }
}

test('a scene that stands asks for no picture', () => {
  const { objects, invalidate } = scene()
  objects.set([cube(1)])
  objects.set([cube(1)])
  expect(invalidate).toHaveBeenCalledTimes(1)
  objects.set([cube(2)])
  expect(invalidate).toHaveBeenCalledTimes(2)
  objects.set([])
  expect(invalidate).toHaveBeenCalledTimes(3)
})

test('what is held goes with the hand between two messages', () => {
  const { world, hand, objects } = scene()
  hand.position.x = 3
  objects.set([cube(1)])
  objects.set([cube(1, 'arm')])
  hand.position.x = 5
  objects.follow()
  const shown = world.getObjectByName('cube')
  expect(shown?.position.x).toBeCloseTo(3)
  objects.set([cube(9)])
  hand.position.x = 6
  objects.follow()
  expect(shown?.position.x).toBeCloseTo(9)
})

test('what a robot holds sits in its hand where the lab says', () => {
  const { world, hand, objects } = scene()
  hand.position.x = 3
  const inTool = { position: { x: 0, y: 0, z: 0.1 }, orientation: upright }
  const unsaid = { position: { x: 7, y: 7, z: 7 }, orientation: { x: 0, y: 0, z: 0, w: 0 } }
  // the lab's pose is an old one of a hand that moved on
  objects.set([{ ...cube(1, 'arm'), in_tool: inTool }])
  objects.follow()
  const shown = world.getObjectByName('cube')
  expect(shown?.position.toArray()).toEqual([3, 0, 0.1])
  objects.set([{ ...cube(1, 'arm'), in_tool: unsaid }])
  objects.follow()
  expect(shown?.position.toArray()).toEqual([3, 0, 0.1])
})

test('a mesh that is missing is said, and its primitive drawn', async () => {
  const { world, objects, said } = scene()
  objects.set([{ ...cube(1), mesh: 'package://p/cup.glb' }])
  await vi.waitFor(() => expect(said).toHaveBeenCalledWith('package://p/cup.glb: 404'))
  await vi.waitFor(() => expect(world.getObjectByName('cube')?.children).toHaveLength(1))
})
