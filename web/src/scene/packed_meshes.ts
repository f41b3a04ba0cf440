import { BufferAttribute, type Material, Mesh, MeshStandardMaterial, type Object3D } from 'three'
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js'
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js'

/** Red, green, blue (linear), roughness and metalness, 0 to 1. */
type Paint = readonly [number, number, number, number, number]

/** Read a packed robot: a node a link, each with the colour, light and finish of its vertices. */
export async function readPacked(bytes: ArrayBuffer): Promise<Object3D> {
  const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder)
  paletteInsteadOfTextures(loader)
  const { scene } = await loader.parseAsync(bytes, '')
  scene.traverse((node) => {
    if (!(node instanceof Mesh)) return
    const { palette } = (node.material as Material).userData as { palette?: readonly Paint[] }
    if (palette !== undefined) paint(node, palette)
  })
  return scene
}

/** Let the palette of a file stand for its textures: they are the same, and no picture is decoded. */
function paletteInsteadOfTextures(loader: GLTFLoader): void {
  loader.register(({ json }) => ({
    name: 'palette',
    loadMaterial(index: number) {
      const found = (json as Materials).materials?.[index]?.extras?.palette
      if (found === undefined) return null
      const material = new MeshStandardMaterial({ roughness: 0.5, metalness: 0 })
      material.userData.palette = found
      return Promise.resolve(material)
    },
  }))
}

interface Materials {
  readonly materials?: readonly { readonly extras?: { readonly palette?: readonly Paint[] } }[]
}

/** Give the vertices of a mesh their colour with the baked light, and their finish. */
function paint({ geometry }: Mesh, palette: readonly Paint[]): void {
  const light = geometry.getAttribute('color')
  const places = geometry.getAttribute('uv')
  const colour = new Float32Array(places.count * 3)
  const finish = new Uint8Array(places.count * 2)
  for (let i = 0; i < places.count; i++) {
    const number = Math.min(Math.floor(places.getX(i) * palette.length), palette.length - 1)
    const [red, green, blue, roughness, metalness] = palette[number] as Paint
    const share = light.getX(i)
    colour[i * 3] = red * share
    colour[i * 3 + 1] = green * share
    colour[i * 3 + 2] = blue * share
    finish[i * 2] = 255 * roughness
    finish[i * 2 + 1] = 255 * metalness
  }
  geometry.setAttribute('color', new BufferAttribute(colour, 3))
  geometry.setAttribute('finish', new BufferAttribute(finish, 2, true))
  geometry.deleteAttribute('uv')
}
