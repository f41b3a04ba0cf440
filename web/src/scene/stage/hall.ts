import {
  BackSide,
  BoxGeometry,
  Color,
  Mesh,
  MeshBasicMaterial,
  PMREMGenerator,
  Scene,
  type Texture,
  type WebGLRenderer,
} from 'three'

/** The light of what glows, in the units of a white wall; x and z along the floor, y up. */
interface Glow {
  readonly at: readonly [number, number, number]
  readonly size: readonly [number, number, number]
  readonly light: number
}

/** m: a hall, in the middle of which the robot stands, and what lights it: rows of lamps, windows
 * along one side, a gate at the other end. Long narrow lights show the form of painted castings,
 * which evenly lit ones leave flat. */
const HALL = { wide: 22, high: 9, grey: 0.36 }
const FLOOR = 0.42
const GLOWS: readonly Glow[] = [
  ...[-6.4, -2.2, 2.2, 6.4].map(
    (x): Glow => ({ at: [x, 8.6, -0.5], size: [0.32, 0.1, 15], light: 22 }),
  ),
  { at: [-10.8, 4.6, 1.5], size: [0.1, 3.4, 13], light: 4.4 },
  { at: [10.8, 3.8, -4], size: [0.1, 4.6, 5], light: 2.2 },
  { at: [3, 3.2, 10.8], size: [6, 3.6, 0.1], light: 1.5 },
]
const SOFT = 0.02 // rad, by which the lights are blurred

/** Return the light that a hall throws on what stands in it, as reflections see it. */
export function hallLight(renderer: WebGLRenderer): Texture {
  const box = new BoxGeometry()
  const materials: MeshBasicMaterial[] = []
  const hall = new Scene()
  const add = ({ at, size, light }: Glow, inside = false): void => {
    const color = new Color(light, light, light)
    const material = new MeshBasicMaterial(inside ? { color, side: BackSide } : { color })
    materials.push(material)
    const mesh = new Mesh(box, material)
    mesh.position.set(...at)
    mesh.scale.set(...size)
    hall.add(mesh)
  }
  const { wide, high, grey } = HALL
  add({ at: [0, high / 2 - 1, 0], size: [wide, high + 2, wide], light: grey }, true)
  add({ at: [0, -1, 0], size: [wide, 0.1, wide], light: FLOOR })
  for (const glow of GLOWS) add(glow)
  const generator = new PMREMGenerator(renderer)
  const { texture } = generator.fromScene(hall, SOFT)
  generator.dispose()
  box.dispose()
  for (const material of materials) material.dispose()
  return texture
}
