// @vitest-environment jsdom
import {
  BoxGeometry,
  BufferAttribute,
  Group,
  LOD,
  type Material,
  type Matrix4,
  Mesh,
  MeshStandardMaterial,
  Object3D,
  PerspectiveCamera,
  ShaderLib,
  SphereGeometry,
  Texture,
  type Vector2,
  Vector3,
} from 'three'
import { describe, expect, test, vi } from 'vitest'
import { Dissolve, originOf } from '../../../src/scene/robot/cross_fade'
import { Hose } from '../../../src/scene/robot/hose'
import { hosesOf, levelsOf } from '../../../src/scene/robot/levels'
import { Looks } from '../../../src/scene/robot/looks'
import { SceneRobot } from '../../../src/scene/robot/robot'
import { bodyMaterial, RobotBody } from '../../../src/scene/robot/robot_body'

const HOSE = `<hose radius="0.02" length="0.9">
  <end link="base" xyz="0.1 0 0.2" direction="0 0 2"/>
  <end link="arm" xyz="0 0 0.3" direction="1 0 0"/>
</hose>`

function urdf(beside: string): string {
  const visual = (name: string) =>
    `<visual><geometry><mesh filename="package://p/r/meshes/${name}.glb"/></geometry></visual>`
  return `<robot name="r">
    <link name="base">${visual('base')}</link><link name="arm">${visual('arm')}</link>
    <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 0.5"/>
      <axis xyz="0 1 0"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
    ${beside}
  </robot>`
}

const LEVEL = `<level_of_detail near="package://p/r/lod/near.glb"
  far="package://p/r/lod/far.glb"/>`

/** A packed file: a node a link, each with the colour and the finish of its vertices. */
function packed(corners: number): Group {
  const whole = new Group()
  for (const name of ['base', 'arm']) {
    const geometry = new SphereGeometry(0.2, corners, corners)
    const { count } = geometry.getAttribute('position')
    geometry.setAttribute('color', new BufferAttribute(new Float32Array(count * 3).fill(0.25), 3))
    geometry.setAttribute(
      'finish',
      new BufferAttribute(new Uint8Array(count * 2).fill(51), 2, true),
    )
    const link = new Group()
    link.name = name
    link.add(new Mesh(geometry, new MeshStandardMaterial({ vertexColors: true })))
    whole.add(link)
  }
  return whole
}

async function robot(
  beside: string,
  files: Record<string, () => Object3D>,
  still = true,
  before: (arm: SceneRobot) => void = () => undefined,
) {
  const asked: string[] = []
  const load = (uri: string) => {
    asked.push(uri.slice('package://p/r/'.length))
    const made = files[uri.slice('package://p/r/'.length)]
    return made === undefined ? Promise.reject(new Error('404')) : Promise.resolve(made())
  }
  const source = { load, dispose: () => undefined }
  const looks = new Looks()
  looks.still = () => still
  let pictures = 0
  const changed = () => {
    pictures++
  }
  const arm = new SceneRobot(urdf(beside), ['turn'], source, looks, changed)
  before(arm)
  await arm.ready
  // The far level is loaded after the near one.
  await new Promise((resolve) => setTimeout(resolve))
  const bodies: RobotBody[] = []
  arm.root.traverse((node) => {
    if (node instanceof RobotBody) bodies.push(node)
  })
  return { arm, asked, bodies, looks, pictures: () => pictures }
}

const box = () => new Mesh(new BoxGeometry(), new MeshStandardMaterial())

describe('levels of detail', () => {
  test('what is drawn on links is drawn with them; of two pictures the second stays apart', async () => {
    const [first, second] = [new Texture(), new Texture()]
    for (const atlas of [first, second]) atlas.userData.white = [0.5, 0.25]
    const near = packed(6)
    near.traverse((node) => {
      if (node instanceof Mesh) node.material.map = node.parent?.name === 'arm' ? first : second
    })
    const { arm, bodies } = await robot(LEVEL + HOSE, { 'lod/near.glb': () => near })
    const [body] = bodies as [RobotBody]
    expect(body.own.map).toBe(first)
    expect(body.material).toBe(body.own)
    const uv = body.geometry.getAttribute('uv')
    const places = Array.from({ length: uv.count }, (_, i) => [uv.getX(i), uv.getY(i)])
    // of the arm its own, of the hose the white one
    expect(places[0]?.[1]).toBeCloseTo(1)
    expect(places.at(-1)).toEqual([expect.closeTo(0.5, 4), expect.closeTo(0.25, 4)])
    const apart: Mesh[] = []
    arm.root.traverse((node) => {
      if (node instanceof Mesh && !(node instanceof RobotBody)) apart.push(node)
    })
    expect(apart.map(({ material }) => (material as MeshStandardMaterial).map)).toEqual([second])
  })

  test('one that collides while it is loaded keeps what is drawn on it, and its colours', async () => {
    const atlas = new Texture()
    atlas.userData.white = [0.5, 0.25]
    const near = packed(6)
    near.traverse((node) => {
      if (node instanceof Mesh) node.material.map = atlas
    })
    const plate = `<link name="plate"><visual><geometry>
      <mesh filename="package://p/r/plates/plate.glb"/></geometry></visual></link>
      <joint name="screws" type="fixed"><parent link="arm"/><child link="plate"/></joint>`
    const red = () => new Mesh(new BoxGeometry(), new MeshStandardMaterial({ color: 0xff0000 }))
    const files = { 'lod/near.glb': () => near, 'plates/plate.glb': red }
    const { arm, bodies } = await robot(LEVEL + plate, files, true, (arm) =>
      arm.setLook('grey', 'arm'),
    )
    const [body] = bodies as [RobotBody]
    expect(body.own.map).toBe(atlas)
    const colour = body.geometry.getAttribute('color')
    const colours = Array.from({ length: colour.count }, (_, i) =>
      [colour.getX(i), colour.getY(i), colour.getZ(i)].join(),
    )
    expect(new Set(colours)).toEqual(new Set(['0.25,0.25,0.25', '1,0,0']))
    expect(body.material).not.toBe(body.own)
    arm.setLook('own')
    expect(body.material).toBe(body.own)
  })

  test('packed files stand for the meshes of the links, near at hand and from afar', async () => {
    const files = { 'lod/near.glb': () => packed(12), 'lod/far.glb': () => packed(4) }
    const { arm, asked, bodies } = await robot(LEVEL, files)
    expect(asked).toEqual(['lod/near.glb', 'lod/far.glb'])
    expect([arm.meshCount, arm.meshesHere]).toEqual([2, 2])
    expect(arm.troubles).toEqual([])
    const [near, far] = bodies as [RobotBody, RobotBody]
    expect(near.geometry.getAttribute('color').getX(0)).toBe(0.25)
    expect(near.geometry.getAttribute('finish').getX(0)).toBeCloseTo(0.2)
    const corners = (body: RobotBody) => body.geometry.index?.count ?? 0
    expect(corners(far)).toBeLessThan(corners(near) / 4)
    expect([near.visible, far.visible]).toEqual([true, false])

    const camera = new PerspectiveCamera()
    const seenFrom = (distance: number) => {
      camera.position.set(distance, 0, 0)
      camera.updateMatrixWorld()
      arm.root.updateMatrixWorld(true)
      ;(near.parent as LOD).update(camera)
      return [near.visible, far.visible]
    }
    expect(near.parent).toBeInstanceOf(LOD)
    expect(seenFrom(1.5)).toEqual([true, false])
    expect(seenFrom(9)).toEqual([false, true])
    // at the border it stays as it was
    const border = (near.parent as LOD).levels[1]?.distance ?? 0
    expect(seenFrom(border * 0.97)).toEqual([false, true])
    expect(seenFrom(border * 0.9)).toEqual([true, false])
    expect(seenFrom(border * 0.97)).toEqual([true, false])
    arm.setLook('ghost')
    expect(far.material).toBe(near.material)
  })

  test('dissolve into each other where the eye goes away, and cast one shadow', async () => {
    const files = { 'lod/near.glb': () => packed(12), 'lod/far.glb': () => packed(4) }
    const { arm, bodies, looks, pictures } = await robot(LEVEL, files, false)
    const [near, far] = bodies as [RobotBody, RobotBody]
    const clock = vi.spyOn(performance, 'now')
    const camera = new PerspectiveCamera()
    const seenFrom = (distance: number, ms: number) => {
      clock.mockReturnValue(ms)
      camera.position.set(distance, 0, 0)
      camera.updateMatrixWorld()
      arm.root.updateMatrixWorld(true)
      ;(near.parent as LOD).update(camera)
      return [near.visible, far.visible]
    }
    // new ones are both drawn once, so that nothing is compiled when they dissolve
    expect(seenFrom(1.5, 1000)).toEqual([true, true])
    expect([originOf(near.material as Material), near.material === near.own]).toEqual([
      near.own,
      false,
    ])
    expect(seenFrom(1.5, 1016)).toEqual([true, false])
    expect(near.material).toBe(near.own)
    const before = pictures()
    expect(seenFrom(9, 2000)).toEqual([true, true])
    expect([near.castShadow, far.castShadow]).toEqual([true, false])
    expect(seenFrom(9, 2150)).toEqual([true, true])
    expect([near.castShadow, far.castShadow]).toEqual([false, true])
    expect(pictures()).toBe(before + 2)
    const [drawn] = [far.material as Material]
    expect(seenFrom(9, 2260)).toEqual([false, true])
    expect([far.material, far.castShadow]).toEqual([far.own, true])
    // A robot at rest requests no picture, and the next time nothing is made again.
    expect(pictures()).toBe(before + 2)
    seenFrom(1.5, 3000)
    expect(far.material).toBe(drawn)
    // a look that changes ends it
    arm.setLook('grey')
    expect(seenFrom(1.5, 3010)).toEqual([true, false])
    expect([near.material, near.castShadow]).toEqual([looks.grey, true])
    arm.setLook('ghost')
    expect(seenFrom(9, 4000)).toEqual([false, true])
    clock.mockRestore()
  })

  test('each pixel shows one of both: what dissolves draws a range of one noise', async () => {
    const mesh = new Mesh<BoxGeometry, Material | Material[]>(new BoxGeometry(), [
      bodyMaterial(null),
      new MeshStandardMaterial(),
    ])
    const own = mesh.material
    const dissolve = new Dissolve(mesh)
    dissolve.show(0.25, 1)
    const [first] = mesh.material as Material[]
    const shader = {
      uniforms: {} as Record<string, { value: Vector2 }>,
      vertexShader: ShaderLib.standard.vertexShader,
      fragmentShader: ShaderLib.standard.fragmentShader,
    }
    first?.onBeforeCompile(shader as never, null as never)
    expect(shader.uniforms.dissolve?.value.toArray()).toEqual([0.25, 1])
    expect(shader.fragmentShader).toMatch(
      /uniform vec2 dissolve;[\s\S]*void main\(\) \{[\s\S]*discard/,
    )
    expect(shader.fragmentShader).toContain('vFinish')
    dissolve.show(0.75, 1)
    expect(shader.uniforms.dissolve?.value.x).toBe(0.75)
    const keys = (mesh.material as Material[]).map((each) => each.customProgramCacheKey())
    expect(new Set(keys).size).toBe(2)
    dissolve.end()
    expect(mesh.material).toBe(own)
  })

  test('where they are missing the meshes of the links are drawn', async () => {
    const { arm, asked, bodies } = await robot(LEVEL, {
      'meshes/base.glb': box,
      'meshes/arm.glb': box,
    })
    expect(asked.slice(0, 3)).toEqual(['lod/near.glb', 'meshes/base.glb', 'meshes/arm.glb'])
    expect([arm.meshesHere, arm.troubles.length, bodies.length]).toEqual([2, 0, 1])
  })

  test('what is drawn besides, such as an adapter plate, is seen from afar too', async () => {
    const plate = `<link name="plate"><visual><geometry>
      <mesh filename="package://p/r/plates/plate.glb"/></geometry></visual></link>
      <joint name="screws" type="fixed"><parent link="arm"/><child link="plate"/></joint>`
    const files = {
      'lod/near.glb': () => packed(12),
      'lod/far.glb': () => packed(4),
      'plates/plate.glb': box,
    }
    const { bodies } = await robot(LEVEL + plate, files)
    const corners = 24
    const positions = (body?: RobotBody) => body?.geometry.getAttribute('position').count
    const spheres = 2 * new SphereGeometry(0.2, 4, 4).getAttribute('position').count
    expect(positions(bodies[1])).toBe(spheres + corners)
  })

  test('its height and its foot are those of what is drawn', async () => {
    const files = { 'lod/near.glb': () => packed(12), 'lod/far.glb': () => packed(4) }
    const { arm } = await robot(LEVEL, files)
    // as in a scene, whose y is up
    arm.root.rotation.x = -Math.PI / 2
    arm.root.position.y = 2
    arm.root.updateMatrix()
    arm.root.updateMatrixWorld(true)
    expect(arm.height()).toBeCloseTo(0.7)
    expect(arm.footprint()).toBeCloseTo(0.4, 1)
    const { arm: missing } = await robot('', {})
    expect(missing.footprint()).toBe(0)
  })

  test('a description without any names none', () => {
    const read = (text: string) => new DOMParser().parseFromString(urdf(text), 'text/xml')
    expect(levelsOf(read(''))).toEqual([])
    expect(levelsOf(read(LEVEL))).toHaveLength(1)
    expect(hosesOf(read(HOSE))).toHaveLength(1)
    expect(hosesOf(read(HOSE.replace('0.9', 'long')))).toEqual([])
  })
})

describe('hoses', () => {
  function hose(length: number) {
    const root = new Object3D()
    const first = new Object3D()
    const second = new Object3D()
    root.add(first, second)
    const up = new Vector3(0, 0, 1)
    const on = (link: Object3D) => ({ link, point: new Vector3(), direction: up })
    const made = new Hose([on(first), on(second)], length, 0.02)
    const places = () => {
      root.updateMatrixWorld(true)
      made.follow(root)
      return made.rings.map((ring) => new Vector3().setFromMatrixPosition(ring.matrixWorld))
    }
    return { root, second, made, places }
  }

  const lengthOf = (places: Vector3[]) =>
    places.slice(1).reduce((sum, at, i) => sum + at.distanceTo(places[i] as Vector3), 0)

  test.each([0.2, 0.4, 0.6])('keep their length, %d m between their ends', (apart) => {
    const { second, places } = hose(0.9)
    second.position.x = apart
    const at = places()
    expect(lengthOf(at)).toBeCloseTo(0.9, 1)
    expect(at[0]?.length()).toBeCloseTo(0, 6)
    expect(at[at.length - 1]?.x).toBeCloseTo(apart, 6)
  })

  test('leave their ends in the directions of these, and never twist', () => {
    const { root, second, made, places } = hose(0.9)
    second.position.x = 0.4
    second.rotation.y = -0.7
    root.position.set(3, 1, 2)
    places()
    const z = (i: number) =>
      new Vector3().setFromMatrixColumn(made.rings.at(i)?.matrixWorld as never, 2)
    expect(z(0).dot(new Vector3(0, 0, 1))).toBeCloseTo(1, 5)
    expect(z(-1).dot(new Vector3(0, 0, -1).applyEuler(second.rotation))).toBeCloseTo(1, 5)
    const column = (i: number, axis: number) =>
      new Vector3().setFromMatrixColumn(made.rings[i]?.matrixWorld as Matrix4, axis)
    for (let i = 1; i < made.rings.length; i++) {
      const bend = column(i, 2).angleTo(column(i - 1, 2))
      expect(column(i, 0).angleTo(column(i - 1, 0))).toBeLessThan(bend + 1e-6)
    }
  })

  test('that are pulled straight still join both ends', () => {
    const { second, places } = hose(0.5)
    second.position.x = 0.8
    const at = places()
    expect(at[at.length - 1]?.x).toBeCloseTo(0.8, 6)
    expect(at.every((place) => Number.isFinite(place.lengthSq()))).toBe(true)
  })

  test('are a part of the body, and move with its joints', async () => {
    const files = { 'meshes/base.glb': box, 'meshes/arm.glb': box }
    const { arm, bodies } = await robot(HOSE, files)
    const [body] = bodies as [RobotBody]
    const bones = body.skeleton.bones.length
    expect(bones).toBe(24)
    const end = () => {
      arm.root.updateMatrixWorld(true)
      return new Vector3().setFromMatrixPosition(
        body.skeleton.bones[bones - 1]?.matrixWorld as never,
      )
    }
    const before = end()
    expect(before.toArray().map((n) => Math.round(n * 1e4) / 1e4)).toEqual([0, 0, 0.8])
    arm.setPositions([Math.PI / 2])
    expect(
      end()
        .toArray()
        .map((n) => Math.round(n * 1e4) / 1e4),
    ).toEqual([0.3, 0, 0.5])
    // of no link: it is painted as the body is
    expect(body.geometry.groups).toEqual([])
    expect(body.skeleton.bones[bones - 1]?.name).toBe('hose')
    const weights = body.geometry.getAttribute('skinWeight')
    for (let i = 0; i < weights.count; i++) {
      let sum = 0
      for (let k = 0; k < 4; k++) sum += weights.getComponent(i, k)
      expect(sum).toBeCloseTo(1, 5)
    }
  })
})
