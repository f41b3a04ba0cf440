import { Mesh, MeshStandardMaterial, type Object3D } from 'three'
import { ColladaLoader } from 'three/addons/loaders/ColladaLoader.js'
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js'
import { STLLoader } from 'three/addons/loaders/STLLoader.js'

/** Read a mesh of an imported robot: STL, Collada or OBJ. Throws an Error that names the URI. */
export function readOther(suffix: string, bytes: ArrayBuffer, uri: string): Object3D {
  if (suffix === 'stl') {
    const grey = new MeshStandardMaterial({ color: 0xb9bfc7, roughness: 0.55, metalness: 0.1 })
    return new Mesh(new STLLoader().parse(bytes), grey)
  }
  const text = new TextDecoder().decode(bytes)
  if (suffix === 'obj') return new OBJLoader().parse(text)
  if (suffix === 'dae') {
    const read = new ColladaLoader().parse(text, '')
    if (read !== null) return read.scene
  }
  throw new Error(`${uri} cannot be read; expected GLB, STL, Collada or OBJ`)
}
