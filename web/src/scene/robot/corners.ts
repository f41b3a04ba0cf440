import { type Box3, Mesh, type Object3D, Vector3 } from 'three'
import { RobotBody } from './robot_body'

/** Add the corners of the box about each mesh below `object`, in the frame of `world`, to
 * `into`. */
export function pushCorners(object: Object3D, world: Object3D, into: Vector3[]): void {
  world.updateWorldMatrix(true, true)
  const inverse = world.matrixWorld.clone().invert()
  object.traverse((node) => {
    if (!(node instanceof Mesh) || !node.visible) return
    if (node instanceof RobotBody) {
      node.boxes.forEach((box, i) => {
        push(box, node.skeleton.bones[i] ?? node)
      })
      return
    }
    node.geometry.computeBoundingBox()
    if (node.geometry.boundingBox !== null) push(node.geometry.boundingBox, node)
  })

  function push(box: Box3, frame: Object3D): void {
    if (box.isEmpty()) return
    for (let corner = 0; corner < 8; corner++) {
      const at = new Vector3(
        corner & 1 ? box.max.x : box.min.x,
        corner & 2 ? box.max.y : box.min.y,
        corner & 4 ? box.max.z : box.min.z,
      )
      into.push(at.applyMatrix4(frame.matrixWorld).applyMatrix4(inverse))
    }
  }
}
