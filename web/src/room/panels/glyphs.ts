import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  Color,
  DynamicDrawUsage,
  type Group,
  Mesh,
  MeshBasicMaterial,
  SRGBColorSpace,
} from 'three'
import { FONT, TEXELS, TEXT } from './pen'

const MM = 0.001
/** Right after the panel, and mm before it. */
export const AFTER_PANELS = 13
const BEFORE = 1
/** px of the atlas, and of a glyph's cell in it. */
const SIDE = 512
const CELL = 48
const COLUMNS = Math.floor(SIDE / CELL)
const SIZE = TEXT.small * TEXELS
/** px from a cell's left edge to its glyph. */
const INSET = 6
const FIRST = '0123456789.,-−°/ :×%·()abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ'

interface Glyph {
  readonly u: number
  readonly v: number
  /** mm */
  readonly wide: number
}

/** All glyphs of texts that change with the time, painted once for all panels. */
class Atlas {
  readonly material: MeshBasicMaterial
  private readonly canvas = document.createElement('canvas')
  private readonly texture: CanvasTexture
  private readonly glyphs = new Map<string, Glyph>()

  constructor() {
    this.canvas.width = this.canvas.height = SIDE
    this.texture = new CanvasTexture(this.canvas)
    this.texture.colorSpace = SRGBColorSpace
    this.texture.anisotropy = 4
    this.material = new MeshBasicMaterial({
      map: this.texture,
      transparent: true,
      depthWrite: false,
      toneMapped: false,
      vertexColors: true,
    })
    for (const letter of FIRST) this.of(letter)
  }

  /** Return a glyph; it is painted when it is used for the first time. */
  of(letter: string): Glyph {
    const known = this.glyphs.get(letter)
    if (known !== undefined) return known
    const context = this.canvas.getContext('2d')
    const place = Math.min(this.glyphs.size, COLUMNS * COLUMNS - 1)
    const x = (place % COLUMNS) * CELL
    const y = Math.floor(place / COLUMNS) * CELL
    let wide = SIZE / 2
    if (context !== null) {
      context.font = `600 ${SIZE}px ${FONT}`
      context.fillStyle = '#ffffff'
      context.textBaseline = 'middle'
      context.clearRect(x, y, CELL, CELL)
      context.fillText(letter, x + INSET, y + CELL / 2)
      // figures of one width: a number does not tremble
      wide = context.measureText(/\d/.test(letter) ? '0' : letter).width
      this.texture.needsUpdate = true
    }
    const glyph = { u: x / SIDE, v: 1 - y / SIDE, wide: wide / TEXELS }
    this.glyphs.set(letter, glyph)
    return glyph
  }
}

let shared: Atlas | null = null
const colour = new Color()

/** Short texts of a panel that change with the time: quads of painted glyphs, so that a change sends
 * some kilobytes to the graphics card and no picture. One draw call. */
export class GlyphText {
  private readonly atlas: Atlas
  private readonly geometry = new BufferGeometry()
  private readonly places: BufferAttribute
  private readonly cells: BufferAttribute
  private readonly colours: BufferAttribute
  private readonly mesh: Mesh
  private count = 0

  /** most: letters at once; more are left out. width, height: of the panel, mm. */
  constructor(
    group: Group,
    private readonly most: number,
    private readonly width: number,
    private readonly height: number,
  ) {
    shared ??= new Atlas()
    this.atlas = shared
    this.places = new BufferAttribute(new Float32Array(most * 8), 2)
    this.cells = new BufferAttribute(new Float32Array(most * 8), 2)
    this.colours = new BufferAttribute(new Uint8Array(most * 12), 3, true)
    for (const each of [this.places, this.cells, this.colours]) each.setUsage(DynamicDrawUsage)
    this.geometry.setAttribute('position', this.places)
    this.geometry.setAttribute('uv', this.cells)
    this.geometry.setAttribute('color', this.colours)
    const index = new Uint16Array(most * 6)
    for (let i = 0; i < most; i++) {
      index.set(
        [0, 2, 1, 1, 2, 3].map((corner) => corner + 4 * i),
        6 * i,
      )
    }
    this.geometry.setIndex(new BufferAttribute(index, 1))
    this.mesh = new Mesh(this.geometry, this.atlas.material)
    this.mesh.renderOrder = AFTER_PANELS
    this.mesh.frustumCulled = false
    this.mesh.position.z = BEFORE * MM
    group.add(this.mesh)
  }

  set visible(on: boolean) {
    this.mesh.visible = on
  }

  /** Begin anew: the texts before are gone. */
  begin(): void {
    this.count = 0
  }

  /** Write a text; x: its left or right edge, y: its middle, mm from the panel's left top corner. */
  put(words: string, x: number, y: number, ink: string, align: 'left' | 'right' = 'left'): void {
    let at = x
    if (align === 'right') for (const letter of words) at -= this.atlas.of(letter).wide
    colour.set(ink)
    for (const letter of words) {
      const glyph = this.atlas.of(letter)
      if (letter !== ' ') this.quad(glyph, at, y)
      at += glyph.wide
    }
  }

  /** Show what was put. */
  end(): void {
    this.geometry.setDrawRange(0, this.count * 6)
    for (const each of [this.places, this.cells, this.colours]) {
      each.clearUpdateRanges()
      each.addUpdateRange(0, this.count * 4 * each.itemSize)
      each.needsUpdate = true
    }
  }

  dispose(): void {
    this.mesh.removeFromParent()
    this.geometry.dispose()
  }

  private quad({ u, v }: Glyph, x: number, y: number): void {
    if (this.count >= this.most) return
    const first = this.count++ * 4
    const left = x - INSET / TEXELS - this.width / 2
    const top = this.height / 2 - y + CELL / TEXELS / 2
    for (let corner = 0; corner < 4; corner++) {
      const across = corner & 1
      const down = corner >> 1
      const px = (left + (across * CELL) / TEXELS) * MM
      const py = (top - (down * CELL) / TEXELS) * MM
      this.places.setXY(first + corner, px, py)
      this.cells.setXY(first + corner, u + (across * CELL) / SIDE, v - (down * CELL) / SIDE)
      this.colours.setXYZ(first + corner, colour.r, colour.g, colour.b)
    }
  }
}
