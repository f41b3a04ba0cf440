import { type Object3D, Quaternion, Vector3 } from 'three'
import type { Pose } from '../../protocol/geometry_msgs'

/** ROS (REP 103): x forwards, y left, z up. WebXR: x right, y up, z backwards. Both right-handed,
 * m. This file is the only one that knows both; the lab's frame `world` is an Object3D that
 * `stand` turned, and three's matrices do the rest. */
export const ROS_TO_XR: Readonly<Quaternion> = new Quaternion(-0.5, 0.5, 0.5, 0.5)

const turn = new Quaternion()
const scale = new Vector3()
const place = new Vector3()

/** Turn an object so that its children are drawn in ROS axes. */
export function stand(world: Object3D): void {
  world.quaternion.copy(ROS_TO_XR)
}

/** Write a WebXR vector in ROS axes into `into`; it may be the same. */
export function vectorToRos(vector: Vector3, into: Vector3): Vector3 {
  return into.set(-vector.z, -vector.x, vector.y)
}

/** Return the pose in the lab's frame of a tracked pose: of a head or a hand, x then points
 * forwards; of a plane, z then is its normal. position, quaternion: in the scene. world: with a
 * current matrixWorld. */
export function poseInWorld(world: Object3D, position: Vector3, quaternion: Quaternion): Pose {
  world.matrixWorld.decompose(scale, turn, scale)
  place.copy(position)
  world.worldToLocal(place)
  turn.invert().multiply(quaternion).multiply(ROS_TO_XR)
  return {
    position: { x: place.x, y: place.y, z: place.z },
    orientation: { x: turn.x, y: turn.y, z: turn.z, w: turn.w },
  }
}

/** Return the upright pose with a heading about z, rad. */
export function upright(x: number, y: number, z: number, heading: number): Pose {
  return {
    position: { x, y, z },
    orientation: { x: 0, y: 0, z: Math.sin(heading / 2), w: Math.cos(heading / 2) },
  }
}
