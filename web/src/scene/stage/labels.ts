import { CanvasTexture, Sprite, SpriteMaterial, SRGBColorSpace } from 'three'

const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Liberation Sans", sans-serif'
const LEAST_PIXELS = 20 // CSS pixels
const SCALE = 3 // texels a CSS pixel: sharp on dense screens

/** A finding's number in a disc, or a word in a pill, that keeps its size on the screen. */
export class Label {
  readonly sprite: Sprite
  private grown = 1
  private readonly canvas = document.createElement('canvas')
  private readonly texture = new CanvasTexture(this.canvas)
  private readonly material = new SpriteMaterial({
    map: this.texture,
    depthTest: false,
    sizeAttenuation: false,
    toneMapped: false,
    transparent: true,
  })

  /** text: a change is seen once it is painted. height: as a part of the distance from which it is seen. */
  constructor(
    public text: string,
    private readonly height: number,
  ) {
    this.texture.colorSpace = SRGBColorSpace
    this.sprite = new Sprite(this.material)
    this.sprite.renderOrder = 10
    this.sprite.center.set(0.5, -0.25)
  }

  /** Paint it; a ring marks the chosen one. */
  paint(background: string, ink: string, chosen = false): void {
    const pixels = 28 * SCALE
    const context = this.canvas.getContext('2d')
    if (context === null) return
    const font = `600 ${pixels * 0.54}px ${FONT}`
    context.font = font
    const width = Math.max(pixels, context.measureText(this.text).width + pixels * 0.62)
    this.canvas.width = Math.ceil(width)
    this.canvas.height = pixels
    const line = pixels * 0.07
    const inset = line / 2 + 1
    context.beginPath()
    context.roundRect(inset, inset, this.canvas.width - 2 * inset, pixels - 2 * inset, pixels / 2)
    context.fillStyle = background
    context.fill()
    context.lineWidth = chosen ? line * 2 : line
    context.strokeStyle = ink
    context.stroke()
    context.font = font
    context.fillStyle = ink
    context.textAlign = 'center'
    context.textBaseline = 'middle'
    context.fillText(this.text, this.canvas.width / 2, pixels * 0.53)
    this.texture.dispose()
    this.texture.needsUpdate = true
    this.grown = chosen ? 1.25 : 1
    this.fit(Number.POSITIVE_INFINITY)
  }

  /** Keep it legible in a small view. pixels: of something as high as its distance. */
  fit(pixels: number): void {
    const scale = Math.max(this.height, LEAST_PIXELS / pixels) * this.grown
    this.sprite.scale.set((scale * this.canvas.width) / this.canvas.height, scale, 1)
  }

  dispose(): void {
    this.sprite.removeFromParent()
    this.texture.dispose()
    this.material.dispose()
  }
}
