import {
  CanvasTexture,
  type Group,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  SRGBColorSpace,
} from 'three'
import { FONT, PANEL_THEME, TEXELS, TEXT } from './pen'

const MM = 0.001
/** mm before the panel, and its render order: right after the panel. */
const BEFORE = 1
const AFTER_PANELS = 13

/** Two short texts of a panel that change with the time: a canvas of their own, because painting a
 * whole panel for them costs a frame. */
export class Readout {
  private readonly canvas = document.createElement('canvas')
  private readonly texture: CanvasTexture
  private readonly face: Mesh<PlaneGeometry, MeshBasicMaterial>
  private left = ''
  private right = ''
  private theme: typeof PANEL_THEME | null = null

  /** Sizes in mm; x, y: of its middle, from that of the panel. */
  constructor(
    group: Group,
    private readonly width: number,
    private readonly height: number,
    x: number,
    y: number,
  ) {
    this.canvas.width = width * TEXELS
    this.canvas.height = height * TEXELS
    this.texture = new CanvasTexture(this.canvas)
    this.texture.colorSpace = SRGBColorSpace
    this.texture.anisotropy = 4
    const look = { map: this.texture, transparent: true, toneMapped: false }
    this.face = new Mesh(new PlaneGeometry(width * MM, height * MM), new MeshBasicMaterial(look))
    this.face.renderOrder = AFTER_PANELS
    this.face.position.set(x * MM, y * MM, BEFORE * MM)
    group.add(this.face)
  }

  set visible(on: boolean) {
    this.face.visible = on
  }

  /** Paint the text if it has changed; return whether it has. */
  set(left: string, right: string): boolean {
    const painted = this.theme === PANEL_THEME
    if (painted && left === this.left && right === this.right) return false
    const context = this.canvas.getContext('2d')
    if (context === null) return false
    this.theme = PANEL_THEME
    this.left = left
    this.right = right
    const { width, height } = this
    context.setTransform(TEXELS, 0, 0, TEXELS, 0, 0)
    context.fillStyle = PANEL_THEME.colours.card
    context.fillRect(0, 0, width, height)
    context.textBaseline = 'middle'
    context.font = `600 ${TEXT.small}px ${FONT}`
    context.fillStyle = PANEL_THEME.colours.ink
    context.textAlign = 'left'
    context.fillText(left, 0, height / 2)
    context.font = `400 ${TEXT.small}px ${FONT}`
    context.fillStyle = PANEL_THEME.colours.second
    context.textAlign = 'right'
    context.fillText(right, width, height / 2)
    this.texture.needsUpdate = true
    return true
  }

  dispose(): void {
    this.face.removeFromParent()
    this.texture.dispose()
    this.face.geometry.dispose()
    this.face.material.dispose()
  }
}
