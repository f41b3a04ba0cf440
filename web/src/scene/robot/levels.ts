import { type Camera, LOD, type PerspectiveCamera, Vector3 } from 'three'
import { CrossFade, Dissolve } from './cross_fade'
import type { RobotBody } from './robot_body'

/** A model drawn from packed files in place of the meshes of its links. */
export interface Level {
  /** Prefix of the URIs of the meshes that it replaces. */
  readonly meshes: string
  readonly near: string
  readonly far: string
}

/** A hose between two links, as a description states it; m. */
export interface StatedHose {
  readonly radius: number
  readonly length: number
  readonly ends: readonly [StatedEnd, StatedEnd]
}

export interface StatedEnd {
  readonly link: string
  readonly point: Vector3
  readonly direction: Vector3
}

/** Return the packed levels that a description names; they replace the folder meshes/ beside
 * theirs. */
export function levelsOf(description: Document): Level[] {
  return [...description.querySelectorAll('robot > level_of_detail')].map((element) => {
    const near = element.getAttribute('near') ?? ''
    const meshes = near.replace(/lod\/[^/]*$/, 'meshes/')
    return { meshes, near, far: element.getAttribute('far') ?? '' }
  })
}

/** Return the hoses of a description; an incomplete one is ignored. */
export function hosesOf(description: Document): StatedHose[] {
  const found: StatedHose[] = []
  for (const element of description.querySelectorAll('robot > hose')) {
    const [from, to] = [...element.querySelectorAll('end')].map(stated)
    const [radius = 0] = numbers(element, 'radius')
    const [length = 0] = numbers(element, 'length')
    if (from === undefined || to === undefined || !(radius > 0) || !(length > 0)) continue
    found.push({ radius, length, ends: [from, to] })
  }
  return found
}

function stated(element: Element): StatedEnd {
  const [x = 0, y = 0, z = 0] = numbers(element, 'xyz')
  const [ahead = 0, left = 0, up = 1] = numbers(element, 'direction')
  return {
    link: element.getAttribute('link') ?? '',
    point: new Vector3(x, y, z),
    direction: new Vector3(ahead, left, up).normalize(),
  }
}

function numbers(element: Element, name: string): number[] {
  const text = element.getAttribute(name)?.trim() ?? ''
  return text === '' ? [] : text.split(/\s+/).map(Number)
}

const eye = new Vector3()
const here = new Vector3()

/** A near and a far level of a body, which dissolve into each other as the camera approaches or
 * leaves. */
export class FadingLevels extends LOD {
  private fade: CrossFade | null = null
  private near: RobotBody | null = null
  private far: RobotBody | null = null
  private dissolves: readonly Dissolve[] = []
  private casting = true
  /** Both are drawn once when they are new, which compiles their shaders for a dissolve. */
  private fresh = true

  /** changed: another picture is due. duration: s in which they dissolve, 0: at once. now: s. */
  constructor(
    private readonly changed: () => void,
    private readonly duration: () => number,
    private readonly now = () => performance.now() / 1000,
  ) {
    super()
  }

  /** Set the near level. */
  setNear(body: RobotBody): void {
    this.near = body
    this.addLevel(body)
  }

  /** Set the level that is shown from `border` m on; it stays until `hysteresis`, a part of that,
   * nearer. */
  setFar(body: RobotBody, border: number, hysteresis: number): void {
    if (this.near === null) return
    this.far = body
    this.fade = new CrossFade(border, hysteresis, this.duration)
    this.dissolves = [new Dissolve(this.near), new Dissolve(body)]
    body.visible = false
    this.addLevel(body, border, hysteresis)
  }

  override update(camera: Camera): void {
    const { near, far, fade } = this
    if (near === null || far === null || fade === null) return
    eye.setFromMatrixPosition(camera.matrixWorld)
    here.setFromMatrixPosition(this.matrixWorld)
    const distance = eye.distanceTo(here) / (camera as PerspectiveCamera).zoom
    const first = this.fresh && this.duration() > 0
    this.fresh = false
    const both = fade.step(distance, this.now()) || first
    near.visible = both || fade.share < 0.5
    far.visible = both || fade.share >= 0.5
    if (!both) {
      this.whole()
      return
    }
    this.dissolves[0]?.show(fade.share, 1)
    this.dissolves[1]?.show(0, fade.share)
    // the shadow of the one would lie on the other
    near.castShadow = this.casting && fade.share < 0.5
    far.castShadow = this.casting && fade.share >= 0.5
    this.changed()
  }

  /** Say whether the bodies cast a shadow, once their materials are set. */
  setCasting(on: boolean): void {
    this.casting = on
    this.whole()
  }

  /** End a dissolve, so that the bodies have their own materials. */
  settle(): void {
    this.fade?.end()
    this.whole()
  }

  release(): void {
    for (const dissolve of this.dissolves) dissolve.dispose()
    this.removeFromParent()
  }

  /** Draw the visible level as a whole. */
  private whole(): void {
    for (const dissolve of this.dissolves) dissolve.end()
    if (this.near !== null) this.near.castShadow = this.casting
    if (this.far !== null) this.far.castShadow = this.casting
  }
}
