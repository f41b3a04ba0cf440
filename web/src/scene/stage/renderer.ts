import {
  type Camera,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  type Scene,
  type Vector3,
  WebGLRenderer,
} from 'three'
import type { ShadowFit } from './shadow_fit'
import type { SceneTheme } from './theme'

const MATT = 0.15 // most metalness without reflections

/** A browser that cannot draw in 3D. */
export class NoWebGL extends Error {
  override readonly name = 'NoWebGL'
}

/** Let metal show its own colour: without reflections it would be black. */
export function matt(node: Object3D): void {
  if (!(node instanceof Mesh)) return
  const { material } = node
  if (material instanceof MeshStandardMaterial && material.metalness > MATT)
    material.metalness = MATT
}

/** Knows when the machine is done with a picture: WebGL takes orders long before, and a page whose
 * orders pile up stands still. */
export class Pace {
  private sync: WebGLSync | null = null

  constructor(private readonly context: WebGL2RenderingContext) {}

  /** Call it behind the orders of a picture. */
  ordered(): void {
    const { context } = this
    context.deleteSync(this.sync)
    this.sync = context.fenceSync(context.SYNC_GPU_COMMANDS_COMPLETE, 0)
    context.flush()
  }

  /** True while the machine still draws the last picture. */
  get draws(): boolean {
    const { context, sync } = this
    if (sync === null) return false
    if (context.getSyncParameter(sync, context.SYNC_STATUS) === context.UNSIGNALED) return true
    context.deleteSync(sync)
    this.sync = null
    return false
  }
}

/** Return a renderer on a canvas. Throws NoWebGL. */
function rendererOn(canvas: HTMLCanvasElement): WebGLRenderer {
  const context = canvas.getContext('webgl2', {
    alpha: true,
    antialias: true,
    powerPreference: 'high-performance',
  })
  if (context === null) throw new NoWebGL('this browser has no WebGL 2')
  try {
    return new WebGLRenderer({ canvas, context, alpha: true, antialias: true })
  } catch (error) {
    throw new NoWebGL(error instanceof Error ? error.message : 'this browser has no WebGL 2')
  }
}

/** Return whether a processor draws in place of a GPU, as far as the browser says. */
function drawsInSoftware(context: WebGL2RenderingContext): boolean {
  const info = context.getExtension('WEBGL_debug_renderer_info')
  const name = context.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER)
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(String(name))
}

/** A canvas with its renderer. Where a processor draws, a browser that shows a WebGL canvas waits
 * for its picture whenever it composes the page, and answers nothing meanwhile. There the picture
 * is drawn out of sight, and shown when it is done. */
export class Surface {
  readonly canvas: HTMLCanvasElement
  readonly renderer: WebGLRenderer
  /** A processor draws. */
  readonly software: boolean
  private readonly pace: Pace
  private readonly sight: CanvasRenderingContext2D | null

  /** Throws NoWebGL if the browser has none. */
  constructor() {
    this.canvas = document.createElement('canvas')
    this.renderer = rendererOn(this.canvas)
    const context = this.renderer.getContext() as WebGL2RenderingContext
    this.pace = new Pace(context)
    this.software = drawsInSoftware(context)
    if (this.software) this.canvas = document.createElement('canvas')
    this.sight = this.software ? this.canvas.getContext('2d') : null
  }

  /** True while the machine still draws the last picture. */
  get draws(): boolean {
    return this.pace.draws
  }

  /** Order a picture. */
  order(scene: Scene, camera: Camera): void {
    this.renderer.render(scene, camera)
    this.pace.ordered()
  }

  /** Show what was drawn out of sight. */
  show(): void {
    if (this.sight === null) return
    const { width, height } = this.renderer.domElement
    const { canvas } = this
    if (canvas.width !== width || canvas.height !== height)
      Object.assign(canvas, { width, height })
    this.sight.globalCompositeOperation = 'copy'
    this.sight.drawImage(this.renderer.domElement, 0, 0)
  }

  dispose(): void {
    this.renderer.dispose()
    this.canvas.remove()
  }
}

/** The host of a lab's scene: a page's picture, or the room. */
export interface SceneHost {
  /** The lab's frame `world`: z up, m. */
  readonly world: Object3D
  readonly theme: SceneTheme
  readonly shadow: ShadowFit
  onTheme(listener: (theme: SceneTheme) => void): () => void
  /** Ask for a new picture. */
  invalidate(): void
  /** Show points of the world's frame whole; a view that a person chose stays, unless `again`. */
  frame(points: readonly Vector3[], again?: boolean): void
}
