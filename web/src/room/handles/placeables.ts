import { Group, Mesh, MeshStandardMaterial } from 'three'
import type { ObjectType } from '../../protocol/mrlab_msgs'
import { primitiveParts, scaleOf } from '../../scene/lab/shapes'
import { Looks } from '../../scene/robot/looks'
import type { MeshSource } from '../../scene/robot/meshes'
import { SceneRobot } from '../../scene/robot/robot'
import { themeNow } from '../../scene/stage/theme'
import { BASE } from '../grab/clearance'
import type { Spawning } from '../place/spawning'
import type { Entry } from '../ports'
import type { Ghost, Placeable } from './placing'

/** Of a ghost: it is seen before white walls and on dark desks. */
const OPACITY = 0.5

/** Return a robot of the catalogue, to be placed. changed: a picture is due. */
export function robotToPlace(
  { id, body }: Entry,
  spawning: Spawning,
  meshes: MeshSource,
  changed: () => void,
): Placeable {
  return {
    id,
    foot: BASE,
    reach: body?.reach ?? 0,
    ghost: () => robotGhost(body, meshes, changed),
    put: (pose, support) => spawning.spawnRobot(id, pose, support),
  }
}

/** Return a ghost that shows the robot once its description is here. */
function robotGhost(body: Entry['body'], meshes: MeshSource, changed: () => void): Ghost {
  const root = new Group()
  const looks = new Looks()
  looks.setTheme(themeNow())
  looks.ghost.opacity = OPACITY
  let robot: SceneRobot | null = null
  let gone = false
  body?.urdf().then(
    (urdf) => {
      if (gone) return
      robot = new SceneRobot(urdf, body.joints, meshes, looks, changed)
      robot.setLook('ghost')
      robot.setPositions(body.home)
      root.add(robot.root)
      changed()
    },
    // The ring alone shows where it will stand.
    () => undefined,
  )
  return {
    root,
    paint: (colour) => looks.ghost.color.set(colour),
    dispose: () => {
      gone = true
      robot?.dispose()
      looks.dispose()
    },
  }
}

/** Return an object of the catalogue, to be placed. */
export function objectToPlace(type: ObjectType, spawning: Spawning): Placeable {
  const { x, y, z } = type.size
  return {
    id: type.id,
    foot: { radius: Math.hypot(x, y) / 2, tall: z, apart: BASE.radius + Math.hypot(x, y) / 2 },
    reach: 0,
    ghost: () => objectGhost(type),
    put: ({ position, orientation }) => {
      const middle = { ...position, z: position.z + z / 2 }
      return spawning.spawnObject(type.id, { position: middle, orientation })
    },
  }
}

function objectGhost(type: ObjectType): Ghost {
  const shape = { size: type.size, color: type.color, mesh: '', primitive: type.primitive }
  const root = new Group()
  const look = new MeshStandardMaterial({ transparent: true, opacity: OPACITY, roughness: 0.9 })
  const parts = primitiveParts(shape)
  for (const { geometry } of parts) {
    const mesh = new Mesh(geometry, look)
    mesh.scale.copy(scaleOf(shape))
    mesh.position.z = type.size.z / 2
    root.add(mesh)
  }
  return {
    root,
    paint: (colour) => look.color.set(colour),
    dispose: () => {
      for (const { geometry, material } of parts) {
        geometry.dispose()
        material.dispose()
      }
      look.dispose()
    },
  }
}
