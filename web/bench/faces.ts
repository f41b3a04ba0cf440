/** A stage of the pages or of the room with robots and things: for pictures of the docs
 * (scripts/pictures/faces.py) and for what they cost (bench/measures/faces.py). */

import { Mesh, type Object3D, Texture, Vector3 } from 'three'
import { RoomStage } from '../src/room/scene/stage'
import type { ShownObject } from '../src/scene/lab/lab_objects'
import { LabScene, type ShownRobot } from '../src/scene/lab/lab_scene'
import { MeshLibrary } from '../src/scene/robot/meshes'
import { Stage } from '../src/scene/stage/stage'

interface Shown {
  readonly stage: 'page' | 'room'
  readonly robots: readonly (ShownRobot & { readonly positions: readonly number[] })[]
  readonly objects: readonly ShownObject[]
}

/** Places of the lab's frame, m, and an angle of view, degrees. */
interface View {
  readonly eyes: readonly [number, number, number]
  readonly at: readonly [number, number, number]
  readonly angle: number
}

interface Cost {
  readonly calls: number
  readonly triangles: number
  readonly textures: number
}

/** A stage gives a picture fewer pixels where it draws slowly. */
interface Sharp {
  setPixels(share: number): void
}

declare global {
  interface Window {
    show(shown: Shown): Promise<number>
    look(view: View): Promise<string>
    cost(): Cost
  }
}

let stage: Stage | RoomStage
let scene: LabScene
let bases: { readonly base: Object3D }[] = []

/** Show robots and things; return s until the last is whole. */
window.show = async ({ stage: kind, robots, objects }) => {
  const begun = performance.now()
  stage = kind === 'page' ? new Stage(document.body, '') : new RoomStage(document.body, '')
  const meshes = new MeshLibrary()
  scene = new LabScene(stage, meshes)
  scene.setRobots(robots)
  scene.setObjects(objects)
  scene.setNames(0)
  const things = objects.map(({ mesh }) => (mesh === '' ? null : meshes.load(mesh)))
  await Promise.all([scene.ready, ...things])
  bases = robots.flatMap(({ name }) => {
    const base = scene.base(name)
    return base === undefined ? [] : [{ base }]
  })
  const took = (performance.now() - begun) / 1000
  for (const { name, positions } of robots) scene.robot(name)?.setPositions(positions)
  return took
}

/** Look from one place at another; return what is seen, a data: URL. */
window.look = async ({ eyes, at, angle }) => {
  const { camera, world, controls } = stage as RoomStage
  world.updateWorldMatrix(true, false)
  controls.enableDamping = false
  controls.minDistance = 0.01
  camera.fov = angle
  camera.updateProjectionMatrix()
  camera.position.copy(world.localToWorld(new Vector3(...eyes)))
  controls.target.copy(world.localToWorld(new Vector3(...at)))
  controls.update()
  await new Promise(requestAnimationFrame)
  if (stage instanceof Stage) (stage as unknown as Sharp).setPixels(1)
  world.updateMatrixWorld(true)
  scene.update()
  if (stage instanceof Stage) return stage.picture()
  stage.lightAbout(bases)
  stage.invalidate()
  stage.draw(performance.now() / 1000 + 10)
  return stage.canvas.toDataURL()
}

/** Return what the last picture cost. textures: bytes on the GPU, with their smaller copies. */
window.cost = () => {
  const { renderer, scene: all } = stage as RoomStage
  const found = new Set<Texture>()
  all.traverse((node) => {
    if (!(node instanceof Mesh)) return
    for (const material of [node.material].flat())
      for (const value of Object.values(material)) if (value instanceof Texture) found.add(value)
  })
  let textures = 0
  for (const { image, generateMipmaps } of found) {
    const { width = 0, height = 0 } = (image ?? {}) as { width?: number; height?: number }
    textures += width * height * 4 * (generateMipmaps ? 4 / 3 : 1)
  }
  const { calls, triangles } = renderer.info.render
  return { calls, triangles, textures }
}
