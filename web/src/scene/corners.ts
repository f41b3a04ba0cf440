import { Mesh, type Object3D, Vector3 } from 'three'

/** Add the corners of the box about each mesh below `object`, in the frame of `world`, to `into`. */
export function pushCorners(object: Object3D, world: Object3D, into: Vector3[]): void {
  world.updateWorldMatrix(true, true)
  const inverse = world.matrixWorld.clone().invert()
  object.traverse((node) => {
    if (!(node instanceof Mesh) || !node.visible) return
    node.geometry.computeBoundingBox()
    const box = node.geometry.boundingBox
    if (box === null || box.isEmpty()) return
    for (let corner = 0; corner < 8; corner++) {
      const at = new Vector3(
        corner & 1 ? box.max.x : box.min.x,
        corner & 2 ? box.max.y : box.min.y,
        corner & 4 ? box.max.z : box.min.z,
      )
      into.push(at.applyMatrix4(node.matrixWorld).applyMatrix4(inverse))
    }
  })
}
