import type { MeshBytes } from '../scene/robot/meshes'

/** The data of a page: a document, and the meshes that it names. */
export interface ShownData {
  readonly document: { readonly schema: string }
  readonly meshes: MeshBytes
}

interface Head {
  readonly document: { readonly schema: string }
  /** Place of the file of each URI behind the head: offset, length, bytes. */
  readonly meshes: Readonly<Record<string, readonly [number, number]>>
}

/** Read the data of a page: 4 bytes with the length of the head, little-endian, the head as JSON,
 * the meshes. `mrlab_ros/app/show/page.py` writes it. */
export function unpackData(data: ArrayBuffer): ShownData {
  const length = new DataView(data).getUint32(0, true)
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length))) as Head
  const begin = 4 + length
  return {
    document: head.document,
    meshes: (uri) => {
      const place = head.meshes[uri]
      if (place === undefined) return Promise.reject(new Error(`${uri} is not in this page`))
      const [offset, size] = place
      return Promise.resolve(data.slice(begin + offset, begin + offset + size))
    },
  }
}
