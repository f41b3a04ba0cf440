// @vitest-environment jsdom
import { Mesh, MeshStandardMaterial, Object3D, Vector3 } from 'three'
import { expect, test } from 'vitest'
import { Course } from '../../src/playback/course'
import { Looks } from '../../src/scene/looks'
import type { MeshSource } from '../../src/scene/meshes'
import { SceneRobot } from '../../src/scene/robot'
import { trackOf } from '../../src/scene/tool_path'

const URDF = `<robot name="r">
  <link name="base"/>
  <link name="arm"><visual><geometry><mesh filename="package://p/arm.glb"/></geometry></visual></link>
  <link name="tool0"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <link name="left"/><link name="right"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>
    <origin xyz="0 0 1"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="arm"/><child link="tool0"/>
    <origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.1" velocity="1" effort="1"/></joint>
  <joint name="finger" type="prismatic"><parent link="tool0"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" velocity="1" effort="1"/></joint>
  <joint name="follower" type="prismatic"><parent link="tool0"/><child link="right"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" velocity="1" effort="1"/><mimic joint="finger" multiplier="-1"/></joint>
</robot>`

function robot(meshes?: Partial<MeshSource>) {
  const source: MeshSource = {
    load: () => Promise.resolve(new Mesh(undefined, new MeshStandardMaterial())),
    dispose: () => undefined,
    ...meshes,
  }
  return new SceneRobot(URDF, ['turn', 'slide'], source, new Looks(), () => undefined)
}

function placeOf(object: Object3D | undefined): Vector3 {
  object?.updateWorldMatrix(true, false)
  return new Vector3().setFromMatrixPosition(object?.matrixWorld ?? new Object3D().matrix)
}

test('joints go past their limits: a refused pose looks refused', () => {
  const arm = robot()
  arm.setPositions([Math.PI, 0.5])
  const tool = placeOf(arm.root.links.tool0)
  expect(tool.x).toBeCloseTo(-1)
  expect(tool.y).toBeCloseTo(-0.5)
  expect(tool.z).toBeCloseTo(1)
})

test('fingers open and close, and what mimics them follows', () => {
  const arm = robot()
  arm.setGripper(true)
  expect(arm.root.joints.finger?.position.y).toBeCloseTo(0.04)
  expect(arm.root.joints.follower?.position.y).toBeCloseTo(-0.04)
  arm.setGripper(false)
  expect(arm.root.joints.finger?.position.y).toBeCloseTo(0)
})

test('a missing mesh leaves a placeholder and a sentence', async () => {
  const arm = robot({ load: () => Promise.reject(new Error('404 Not Found')) })
  await arm.ready
  expect(arm.troubles).toEqual(['package://p/arm.glb: 404 Not Found'])
  const link = arm.root.links.arm
  expect(link?.getObjectsByProperty('type', 'LineSegments')).toHaveLength(1)
})

test('the failing link is painted, the others turn grey, and all come back', async () => {
  const arm = robot()
  await arm.ready
  const looks = new Set<unknown>()
  const materials = () => {
    looks.clear()
    arm.root.traverse((node) => {
      if (node instanceof Mesh) looks.add(node.material)
    })
    return looks.size
  }
  expect(arm.linkOf('turn')).toBe('arm')
  expect(materials()).toBe(2)
  const [own] = [...looks]
  arm.setLook('grey', 'arm')
  expect(materials()).toBe(2)
  expect(looks.has(own)).toBe(false)
  arm.setLook('own')
  materials()
  expect(looks.has(own)).toBe(true)
})

test('the track of the tool is in the frame of the base', () => {
  const arm = robot()
  arm.root.position.set(5, 5, 5)
  const course = new Course(1, 2, Float64Array.from([0, 0, Math.PI / 2, 0]))
  const track = trackOf(arm, course)
  expect([...track.points].map((n) => Math.round(n * 1000) / 1000)).toEqual([1, 0, 1, 0, 1, 1])
})
