import {
  BufferAttribute,
  type Material,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  SRGBColorSpace,
  type Texture,
} from 'three'
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js'
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js'

/** Of the atlas, seen at a slant. */
const ANISOTROPY = 4
/** Of texture coordinates, which have 16 bits. */
const STEP = 1 / 65535

/** Red, green, blue (linear), roughness and metalness, 0 to 1. */
export type Paint = readonly [number, number, number, number, number]

/** Left, top, right, bottom of a drawing in the atlas, and the paint that has its finish. */
export type Drawing = readonly [number, number, number, number, number]

/** The pictures of a packed file: its materials, and the drawings on its links. */
export interface Painted {
  readonly palette: readonly Paint[]
  /** The share of the atlas's height that is the palette; without one there are no drawings. */
  readonly band?: number
  readonly white?: readonly [number, number]
  readonly drawings?: readonly Drawing[]
}

/** Read a GLB; of a packed robot a node a link, each with the colour, light and finish of its
 * vertices, and with a picture of the drawings on it. */
export async function readGlb(bytes: ArrayBuffer): Promise<Object3D> {
  const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder)
  paletteInsteadOfTextures(loader)
  const { scene } = await loader.parseAsync(bytes, '')
  scene.traverse((node) => {
    if (!(node instanceof Mesh)) return
    const material = node.material as Material
    const { painted } = material.userData as { painted?: Painted }
    const { map } = material as MeshStandardMaterial
    if (painted !== undefined) paint(node, painted, map !== null)
  })
  return scene
}

/** Replace the textures of a file by its palette, which has the same colours; a picture is decoded
 * only for drawings on links. */
function paletteInsteadOfTextures(loader: GLTFLoader): void {
  loader.register((parser) => ({
    name: 'palette',
    loadMaterial(index: number) {
      const stated = (parser.json as Materials).materials?.[index]
      const painted = stated?.extras
      if (painted?.palette === undefined) return null
      const material = new MeshStandardMaterial({ roughness: 0.5, metalness: 0 })
      material.userData.painted = painted
      const picture = stated?.pbrMetallicRoughness?.baseColorTexture?.index
      if (painted.drawings === undefined || picture === undefined) return Promise.resolve(material)
      return parser.getDependency('texture', picture).then((atlas: Texture | null) => {
        // A picture that cannot be decoded: the links have no drawings.
        if (atlas === null) return material
        atlas.colorSpace = SRGBColorSpace
        atlas.anisotropy = ANISOTROPY
        atlas.userData.white = painted.white
        material.map = atlas
        return material
      })
    },
  }))
}

interface Materials {
  readonly materials?: readonly {
    readonly extras?: Painted
    readonly pbrMetallicRoughness?: { readonly baseColorTexture?: { readonly index: number } }
  }[]
}

/** Give the vertices of a mesh their colour with the baked light, and their finish; vertices of
 * drawings keep their place in the atlas, others point to its white. */
export function paint({ geometry }: Mesh, painted: Painted, hasAtlas: boolean): void {
  const { palette, band = 1, white = [0, 0], drawings = [] } = painted
  const light = geometry.getAttribute('color')
  const places = geometry.getAttribute('uv')
  const colour = new Float32Array(places.count * 3)
  const finish = new Uint8Array(places.count * 2)
  const drawn = new Uint16Array(places.count * 2)
  for (let i = 0; i < places.count; i++) {
    const u = places.getX(i)
    const v = places.getY(i)
    const drawing = v > band ? drawings.find((one) => holds(one, u, v)) : undefined
    const number = drawing?.[4] ?? Math.floor(u * palette.length)
    const row = palette[Math.min(number, palette.length - 1)] as Paint
    const bare = drawing === undefined || !hasAtlas
    const share = light.getX(i)
    for (let k = 0; k < 3; k++) colour[i * 3 + k] = share * (bare ? (row[k] as number) : 1)
    finish[i * 2] = 255 * row[3]
    finish[i * 2 + 1] = 255 * row[4]
    drawn[i * 2] = Math.round((bare ? white[0] : u) / STEP)
    drawn[i * 2 + 1] = Math.round((bare ? white[1] : v) / STEP)
  }
  geometry.setAttribute('color', new BufferAttribute(colour, 3))
  geometry.setAttribute('finish', new BufferAttribute(finish, 2, true))
  if (hasAtlas) geometry.setAttribute('uv', new BufferAttribute(drawn, 2, true))
  else geometry.deleteAttribute('uv')
}

function holds([left, top, right, bottom]: Drawing, u: number, v: number): boolean {
  const off = 2 * STEP
  return u > left - off && u < right + off && v > top - off && v < bottom + off
}
