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
const AFTER_PANELS = 13
const BEFORE = 1
/** mm, of a curve. */
const THICK = 2.2
/** px of the atlas, and of a glyph's cell in it. */
const SIDE = 512
const CELL = 48
const COLUMNS = Math.floor(SIDE / CELL)
/** The last row is for shapes: at an edge a neighbour is seen faintly. */
const CELLS = COLUMNS * COLUMNS
const SIZE = TEXT.small * TEXELS
/** px from a cell's left edge to its glyph. */
const INSET = 6
const FIRST = '0123456789.,-−°/ :×%·()abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ'

/** Left top corner of a cell of the atlas, 0 to 1. */
interface Cell {
  readonly u: number
  readonly v: number
}

interface Glyph extends Cell {
  /** mm */
  readonly wide: number
}

/** Return the left top corner of a cell of the atlas, px. */
function cornerOf(cell: number): { readonly x: number; readonly y: number } {
  return { x: (cell % COLUMNS) * CELL, y: Math.floor(cell / COLUMNS) * CELL }
}

/** All glyphs of texts that change with the time, painted once for all panels. */
class Atlas {
  readonly material: MeshBasicMaterial
  /** A place within a white cell, and a cell with a disc. */
  readonly solid: Cell
  readonly disc: Cell
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
    const context = this.canvas.getContext('2d')
    if (context !== null) context.fillStyle = '#ffffff'
    const box = cornerOf(CELLS - 1)
    context?.fillRect(box.x, box.y, CELL, CELL)
    this.solid = { u: (box.x + CELL / 2) / SIDE, v: 1 - (box.y + CELL / 2) / SIDE }
    const disc = cornerOf(CELLS - 3)
    context?.beginPath()
    context?.arc(disc.x + CELL / 2, disc.y + CELL / 2, CELL / 2 - 1, 0, 2 * Math.PI)
    context?.fill()
    this.disc = { u: disc.x / SIDE, v: 1 - disc.y / SIDE }
    for (const letter of FIRST) this.of(letter)
  }

  /** Return a glyph; it is painted when it is used for the first time. */
  of(letter: string): Glyph {
    const known = this.glyphs.get(letter)
    if (known !== undefined) return known
    const context = this.canvas.getContext('2d')
    const { x, y } = cornerOf(Math.min(this.glyphs.size, CELLS - COLUMNS - 1))
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
/** Of what is written next: red, green and blue, 0 to 255. */
const ink = new Uint8Array(3)

function dip(into: string): void {
  const { r, g, b } = colour.set(into)
  ink.set([Math.round(r * 255), Math.round(g * 255), Math.round(b * 255)])
}

/** How much of a panel changes with the time. */
interface Parts {
  /** Letters at once; more are left out. */
  readonly letters: number
  /** Boxes, and curves of so many samples each. */
  readonly boxes?: number
  readonly curves?: number
  readonly samples?: number
}

/** Texts, boxes and curves of a panel that change with the time: quads of painted glyphs and ribbons
 * in one mesh, so that a change sends some kilobytes to the graphics card and no picture. One draw
 * call. Places are mm from the panel's left top corner. */
export class LiveInk {
  private readonly atlas: Atlas
  private readonly geometry = new BufferGeometry()
  /** Written ten times a second: into the arrays, without calls. */
  private readonly xy: Float32Array
  private readonly uv: Float32Array
  private readonly rgb: Uint8Array
  private readonly places: BufferAttribute
  private readonly cells: BufferAttribute
  private readonly colours: BufferAttribute
  private readonly mesh: Mesh
  private readonly boxes: number
  private readonly curves: number
  private readonly samples: number
  /** First vertex of the curves: behind boxes and letters. */
  private readonly ribbons: number
  private readonly letters: number
  private count = 0
  /** True until new colours of the curves are sent. */
  private painted = false

  /** width, height: of the panel, mm. */
  constructor(
    group: Group,
    { letters, boxes = 0, curves = 0, samples = 0 }: Parts,
    private readonly width: number,
    private readonly height: number,
  ) {
    shared ??= new Atlas()
    this.atlas = shared
    this.letters = letters
    this.boxes = boxes
    this.curves = curves
    this.samples = samples
    this.ribbons = (boxes + letters) * 4
    const corners = this.ribbons + curves * samples * 2
    this.xy = new Float32Array(corners * 2)
    this.uv = new Float32Array(corners * 2)
    this.rgb = new Uint8Array(corners * 3)
    this.places = new BufferAttribute(this.xy, 2)
    this.cells = new BufferAttribute(this.uv, 2)
    this.colours = new BufferAttribute(this.rgb, 3, true)
    for (const each of [this.places, this.cells, this.colours]) each.setUsage(DynamicDrawUsage)
    this.geometry.setAttribute('position', this.places)
    this.geometry.setAttribute('uv', this.cells)
    this.geometry.setAttribute('color', this.colours)
    this.geometry.setIndex(new BufferAttribute(Uint16Array.from(this.index()), 1))
    const { u, v } = this.atlas.solid
    for (let i = this.ribbons; i < corners; i++) this.uv.set([u, v], 2 * i)
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

  /** Write a text; x: its left or right edge, y: its middle. */
  put(
    words: string,
    x: number,
    y: number,
    colour: string,
    align: 'left' | 'right' = 'left',
  ): void {
    let at = x
    if (align === 'right') for (const letter of words) at -= this.atlas.of(letter).wide
    dip(colour)
    const wide = CELL / TEXELS
    for (const letter of words) {
      const glyph = this.atlas.of(letter)
      if (letter !== ' ' && this.count < this.letters) {
        const corner = (this.boxes + this.count++) * 4
        this.quad(corner, at - INSET / TEXELS, y - wide / 2, wide, wide)
        this.cell(corner, glyph, CELL / SIDE)
      }
      at += glyph.wide
    }
  }

  /** Show the texts that were put. */
  end(): void {
    const { boxes, count, curves, samples } = this
    const quads = boxes + count
    this.geometry.setDrawRange(0, 6 * (quads + curves * Math.max(samples - 1, 0)))
    for (const each of [this.places, this.cells, this.colours]) {
      each.clearUpdateRanges()
      if (!this.painted) each.addUpdateRange(0, quads * 4 * each.itemSize)
      each.needsUpdate = true
    }
    this.painted = false
  }

  /** Fill a box, or a disc as wide and high, in a colour; it keeps it until it is filled anew. */
  fill(box: number, colour: string, shape: 'box' | 'disc'): void {
    dip(colour)
    if (shape === 'disc') this.cell(4 * box, this.atlas.disc, CELL / SIDE)
    else this.cell(4 * box, this.atlas.solid, 0)
    this.cells.needsUpdate = this.colours.needsUpdate = true
  }

  /** Move a box: its left and top edge, width and height. */
  move(box: number, x: number, y: number, width: number, height: number): void {
    this.quad(4 * box, x, y, width, height)
    this.places.addUpdateRange(8 * box, 8)
    this.places.needsUpdate = true
  }

  /** Paint the curves; shown with the texts that follow. */
  paint(colours: readonly string[]): void {
    const each = this.samples * 2
    for (let curve = 0; curve < this.curves; curve++) {
      dip(colours[curve % colours.length] as string)
      for (let i = 0; i < each; i++) this.rgb.set(ink, 3 * (this.ribbons + curve * each + i))
    }
    this.painted = true
  }

  /** Set a point of a curve; shown with the texts that follow. */
  point(curve: number, sample: number, x: number, y: number): void {
    const { xy } = this
    const first = 2 * (this.ribbons + 2 * (curve * this.samples + sample))
    const py = this.height / 2 - y
    xy[first] = xy[first + 2] = (x - this.width / 2) * MM
    xy[first + 1] = (py + THICK / 2) * MM
    xy[first + 3] = (py - THICK / 2) * MM
  }

  /** Show the points that were set. */
  drawn(): void {
    const corners = this.curves * this.samples * 2
    // Without a range all is sent.
    if (this.places.updateRanges.length > 0)
      this.places.addUpdateRange(2 * this.ribbons, 2 * corners)
    this.places.needsUpdate = true
  }

  dispose(): void {
    this.mesh.removeFromParent()
    this.geometry.dispose()
  }

  /** Ribbons first: the rest ends with the last letter. */
  private index(): number[] {
    const found: number[] = []
    for (let curve = 0; curve < this.curves; curve++) {
      for (let i = 0; i < this.samples - 1; i++) {
        const a = this.ribbons + 2 * (curve * this.samples + i)
        found.push(a, a + 1, a + 2, a + 2, a + 1, a + 3)
      }
    }
    for (let a = 0; a < this.ribbons; a += 4) found.push(a, a + 2, a + 1, a + 1, a + 2, a + 3)
    return found
  }

  private quad(first: number, x: number, y: number, width: number, height: number): void {
    const left = (x - this.width / 2) * MM
    const top = (this.height / 2 - y) * MM
    for (let corner = 0; corner < 4; corner++) {
      const at = 2 * (first + corner)
      this.xy[at] = left + (corner & 1 ? width * MM : 0)
      this.xy[at + 1] = top - (corner & 2 ? height * MM : 0)
    }
  }

  /** Show a cell of the atlas in the quad that begins at a vertex, in the present colour. */
  private cell(first: number, { u, v }: Cell, side: number): void {
    for (let corner = 0; corner < 4; corner++) {
      const at = 2 * (first + corner)
      this.uv[at] = u + (corner & 1 ? side : 0)
      this.uv[at + 1] = v - (corner & 2 ? side : 0)
      this.rgb.set(ink, 3 * (first + corner))
    }
  }
}
