import { Color, Group, InstancedMesh, Matrix4, type Object3D, Vector3 } from 'three'
import { expect, test, vi } from 'vitest'
import { LabObjects, type ShownObject } from '../../../src/scene/lab/lab_objects'
import type { MeshSource } from '../../../src/scene/robot/meshes'
import type { Stage } from '../../../src/scene/stage/stage'

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
  world.updateMatrixWorld()
  objects.follow()
  const shown = world.getObjectByName('cube')
  expect(shown?.position.x).toBeCloseTo(3)
  objects.set([cube(9)])
  hand.position.x = 6
  world.updateMatrixWorld()
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
  await vi.waitFor(() => expect(said).toHaveBeenCalledWith('cup.glb'))
  const drawn = () => world.children.find((each) => each instanceof InstancedMesh)
  await vi.waitFor(() => {
    objects.follow()
    expect(drawn()).toMatchObject({ count: 1, visible: true })
  })
  objects.set([])
  objects.follow()
  expect(drawn()?.visible).toBe(false)
})

test('objects of one shape are one mesh, each with its size, colour and place', () => {
  const { world, objects } = scene()
  const many = Array.from({ length: 40 }, (_, i) => ({
    ...cube(i),
    name: `cube_${i}`,
    color: { r: 0, g: i / 40, b: 0, a: 1 },
    primitive: { type: 1, dimensions: [i + 1, 1, 1] },
  }))
  objects.set(many)
  objects.follow()
  const meshes = world.children.filter((each) => each instanceof InstancedMesh)
  expect(meshes).toHaveLength(1)
  const [mesh] = meshes as [InstancedMesh]
  expect(mesh.count).toBe(40)
  const matrix = new Matrix4()
  const place = new Vector3()
  mesh.getMatrixAt(7, matrix)
  expect(place.setFromMatrixPosition(matrix).x).toBe(7)
  expect(place.setFromMatrixScale(matrix).x).toBeCloseTo(8)
  const before = mesh.instanceMatrix.version
  objects.follow()
  expect(mesh.instanceMatrix.version, 'what stands is not sent again').toBe(before)
  // One is removed: the others keep their geometry.
  objects.set(many.filter(({ name }) => name !== 'cube_3'))
  objects.follow()
  const colour = new Color()
  mesh.getMatrixAt(3, matrix)
  mesh.getColorAt(3, colour)
  expect(place.setFromMatrixPosition(matrix).x).toBe(4)
  expect(colour.getHex()).toBe(new Color().setRGB(0, 0.1, 0, 'srgb').getHex())
})

test('what is grasped sits in the hand though the frames of a robot do not compute themselves', () => {
  const { world, hand, objects } = scene()
  const joint = new Group()
  world.remove(hand)
  joint.add(hand)
  world.add(joint)
  for (const node of [joint, hand]) node.matrixAutoUpdate = false
  world.updateMatrixWorld()
  joint.position.x = 3
  joint.updateMatrix()
  objects.set([cube(1, 'arm')])
  joint.updateMatrixWorld(true)
  objects.follow()
  expect(world.getObjectByName('cube')?.position.x).toBeCloseTo(1)
})
