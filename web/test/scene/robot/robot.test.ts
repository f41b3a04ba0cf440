// @vitest-environment jsdom
import { BoxGeometry, Matrix4, Mesh, MeshStandardMaterial, Object3D, Vector3 } from 'three'
import { describe, expect, it, test } from 'vitest'
import { Course } from '../../../src/playback/course'
import { trackOf } from '../../../src/scene/preview/tool_path'
import { pushCorners } from '../../../src/scene/robot/corners'
import { Looks } from '../../../src/scene/robot/looks'
import type { MeshSource } from '../../../src/scene/robot/meshes'
import { SceneRobot } from '../../../src/scene/robot/robot'
import { RobotBody } from '../../../src/scene/robot/robot_body'

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

test('a joint turns about its axis, from where the next joint is', () => {
  const turn = robot().turnOf('turn')
  expect(turn?.length).toBeCloseTo(1)
  const at = new Vector3(Math.cos(0.5), Math.sin(0.5), 0).applyMatrix4(
    turn?.frame ?? new Matrix4(),
  )
  expect(at.toArray()).toEqual([Math.cos(0.5), Math.sin(0.5), 1].map((v) => expect.closeTo(v)))
  expect(robot().turnOf('slide')).toBeNull()
})

test('fingers open and close, and what mimics them follows', () => {
  const arm = robot()
  arm.setGripper(true)
  expect(arm.root.joints.finger?.position.y).toBeCloseTo(0.04)
  expect(arm.root.joints.follower?.position.y).toBeCloseTo(-0.04)
  arm.setGripper(false)
  expect(arm.root.joints.finger?.position.y).toBeCloseTo(0)
})

test('a missing mesh leaves a placeholder and is named', async () => {
  const arm = robot({ load: () => Promise.reject(new Error('404 Not Found')) })
  await arm.ready
  expect(arm.troubles).toEqual(['arm.glb'])
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

test('its links are one mesh that moves with them', async () => {
  const steel = new MeshStandardMaterial({ color: 0xff0000, roughness: 0.2, metalness: 1 })
  const load = () => {
    const mesh = new Mesh(new BoxGeometry(0.2, 0.2, 0.2), steel)
    // mirrored, as some descriptions do
    mesh.scale.y = -1
    return Promise.resolve(mesh)
  }
  const arm = robot({ load })
  await arm.ready
  const meshes: Mesh[] = []
  arm.root.traverse((node) => {
    if (node instanceof Mesh) meshes.push(node)
  })
  const [body] = meshes as [RobotBody]
  expect(meshes).toHaveLength(1)
  expect(body).toBeInstanceOf(RobotBody)
  expect(body.geometry.getAttribute('position').count).toBe(48)
  expect([...body.geometry.getAttribute('finish').array.slice(0, 2)]).toEqual([51, 255])
  arm.setPositions([Math.PI / 2, 0.05])
  arm.root.updateMatrixWorld(true)
  body.skeleton.update()
  // the box of tool0 is 1 m wide, 1.05 m along y, 1 m up
  const at = new Vector3()
  const low = new Vector3(9, 9, 9)
  for (let i = 24; i < 48; i++) low.min(body.getVertexPosition(i, at))
  expect(low.toArray()).toEqual([
    expect.closeTo(-0.55, 5),
    expect.closeTo(0.5, 5),
    expect.closeTo(0.5, 5),
  ])
  // its faces still look outwards
  const index = body.geometry.getIndex()
  const [a, b, c] = [0, 1, 2].map((i) =>
    new Vector3().fromBufferAttribute(body.geometry.getAttribute('position'), index?.getX(i) ?? 0),
  ) as [Vector3, Vector3, Vector3]
  const outward = b.clone().sub(a).cross(c.clone().sub(a))
  const normal = new Vector3().fromBufferAttribute(body.geometry.getAttribute('normal'), 0)
  expect(outward.dot(normal)).toBeGreaterThan(0)
  const corners: Vector3[] = []
  pushCorners(arm.root, arm.root, corners)
  expect(corners).toHaveLength(16)
  arm.setLook('own', 'tool0')
  expect(body.geometry.groups).toEqual([
    { start: 0, count: 36, materialIndex: 0 },
    { start: 36, count: 36, materialIndex: 1 },
  ])
})

test('a robot that stands is left as it was, until a joint or its base moves', async () => {
  const arm = robot()
  await arm.ready
  const base = new Object3D()
  base.add(arm.root)
  const { tool0 } = arm.root.links
  const x = () => {
    base.updateMatrixWorld(true)
    return tool0?.matrixWorld.elements[12]
  }
  expect(x()).toBeCloseTo(1)
  tool0?.matrixWorld.setPosition(7, 0, 0) // to see whether it is computed anew
  expect(x()).toBe(7)
  arm.setPositions([0, 0])
  expect(x()).toBeCloseTo(1)
  tool0?.matrixWorld.setPosition(7, 0, 0)
  arm.setPositions([0, 0])
  expect(x()).toBe(7)
  arm.setPositions([0, 0.5])
  expect(x()).toBeCloseTo(1)
  base.position.x = 2
  expect(x()).toBeCloseTo(3)
})

describe('the chain from base to tool', () => {
  it('says where the tool is without moving the robot', () => {
    const arm = robot()
    arm.setPositions([0.3, 0.05])
    const chain = arm.chain()
    const at = new Vector3()
    for (const positions of [
      [0, 0],
      [1.1, 0.04],
      [-0.7, 0.1],
    ]) {
      chain.tool(positions, at)
      arm.setPositions(positions)
      expect(at.distanceTo(placeOf(arm.root.links.tool0))).toBeLessThan(1e-9)
    }
  })

  it('finds the farthest place within the limits', () => {
    const chain = robot().chain()
    const at = new Vector3()
    const scratch = new Float64Array(2)
    // straight ahead at 0; the slide goes to its end across it
    chain.farthest(new Vector3(1, 0, 0), scratch, at)
    expect(at.x).toBeCloseTo(Math.hypot(1, 0.1), 6)
    // behind it the joint's limits of 1 rad hold
    chain.farthest(new Vector3(-1, 0, 0), scratch, at)
    expect(at.x).toBeCloseTo(Math.cos(1) - 0.1 * Math.sin(1), 6)
    expect(Math.abs(scratch[0] ?? 0)).toBeLessThanOrEqual(1)
  })
})
