import { type BufferGeometry, type Material, Mesh, type Object3D, Texture } from 'three'

/** Delivers the meshes that a URDF or an object names by URI. */
export interface MeshSource {
  /** Return a copy of the mesh that shares geometry and materials with other copies. Rejects with
   * an Error that names the URI. */
  load(uri: string): Promise<Object3D>
  dispose(): void
}

/** Returns the bytes of a mesh's file. */
export type MeshBytes = (uri: string) => Promise<ArrayBuffer>

/** Return where the gateway serves a package:// URI. */
function assetUrl(uri: string): string {
  const place = /^package:\/\/(.+)$/.exec(uri)?.[1]
  if (place === undefined) throw new Error(`the mesh '${uri}' has no package:// address`)
  return `/assets/${place.split('/').map(encodeURIComponent).join('/')}`
}

/** Fetch meshes from the gateway. */
async function fetchMesh(uri: string): Promise<ArrayBuffer> {
  const answer = await fetch(assetUrl(uri))
  if (!answer.ok) throw new Error(`${uri}: ${answer.status} ${answer.statusText}`)
  return answer.arrayBuffer()
}

/** Reads each file once. What reads it is fetched when needed: beside a GLB, after others. */
export class MeshLibrary implements MeshSource {
  private readonly known = new Map<string, Promise<Object3D>>()

  constructor(private readonly bytes: MeshBytes = fetchMesh) {}

  async load(uri: string): Promise<Object3D> {
    let loading = this.known.get(uri)
    if (loading === undefined) {
      loading = this.read(uri)
      this.known.set(uri, loading)
    }
    return (await loading).clone(true)
  }

  dispose(): void {
    for (const loading of this.known.values()) loading.then(release, () => undefined)
    this.known.clear()
  }

  private async read(uri: string): Promise<Object3D> {
    const suffix = uri.slice(uri.lastIndexOf('.') + 1).toLowerCase()
    const glb = () => import('./glb_meshes')
    const beside = suffix === 'glb' || suffix === 'gltf' ? glb() : null
    beside?.catch(() => undefined) // told below, where the file itself has come
    const bytes = await this.bytes(uri)
    if (beside !== null || isGlb(bytes)) return (await (beside ?? glb())).readGlb(bytes)
    const { readOther } = await import('./other_meshes')
    return readOther(suffix, bytes, uri)
  }
}

function isGlb(bytes: ArrayBuffer): boolean {
  return bytes.byteLength > 4 && new DataView(bytes).getUint32(0, true) === 0x46546c67
}

/** Free the geometries, materials and textures below an object. */
export function release(object: Object3D): void {
  object.traverse((node) => {
    if (!(node instanceof Mesh)) return
    ;(node.geometry as BufferGeometry).dispose()
    const materials: Material[] = Array.isArray(node.material) ? node.material : [node.material]
    for (const material of materials) {
      for (const value of Object.values(material)) if (value instanceof Texture) value.dispose()
      material.dispose()
    }
  })
}
