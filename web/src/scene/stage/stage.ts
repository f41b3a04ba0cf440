import './scene.css'
import {
  Box3,
  DirectionalLight,
  Group,
  HemisphereLight,
  NeutralToneMapping,
  type Object3D,
  PCFShadowMap,
  PerspectiveCamera,
  Quaternion,
  type Raycaster,
  Scene,
  Sphere,
  Vector2,
  Vector3,
  type WebGLRenderer,
} from 'three'
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js'
import { Floor } from './floor'
import { hallLight } from './hall'
import { matt, Surface } from './renderer'
import { ShadowFit } from './shadow_fit'
import { onTheme, reducedMotion, type SceneTheme, themeNow } from './theme'

const MOST_PIXEL_RATIO = 2
// While it moves, a machine that draws slowly gets fewer pixels; the last picture is always sharp.
const LEAST_SHARPNESS = 0.4
const SLOW = 0.045 // s, until a picture is drawn
const FAST = 0.022
const LONGEST_WAIT = 1 // s
const LOOK = 8 // ms, between looks whether a processor is done with a picture
const STANDS = 0.4 // s without a new picture
// From the front right and a little above, in ROS axes: as the pictures of the robots are taken.
const VIEW = new Vector3(1.05, -1.0, 0.62).normalize()
const LIGHT = new Vector3(0.55, 1.5, 0.75).normalize() // in the scene's axes
const SHADOW = 1.25 // half of the shadow's width, in radii of the shown points
const MARGIN = 1.08 // of the distance at which everything just fits
// degrees, of the height; a headset shows more, which on a screen would look bent
const FOV = 32
const EYES_FOV = 68
// from a camera's axes to those of a head: x forwards, z up
const EYES = new Quaternion(0.5, -0.5, -0.5, 0.5)
const TURN = Math.PI / 24 // rad, a press of an arrow key

/** Called before each picture; true requests another one. now: s, of performance.now(). */
type FrameListener = (now: number) => boolean

/** A canvas with light, floor and camera. It draws when something changed, and only then. */
export class Stage {
  readonly scene = new Scene()
  /** The lab's world: z up, m. */
  readonly world = new Group()
  readonly camera = new PerspectiveCamera(FOV, 1, 0.02, 60)
  readonly canvas: HTMLCanvasElement
  /** Pictures drawn so far. */
  drawn = 0
  theme: SceneTheme
  private readonly surface: Surface
  private readonly renderer: WebGLRenderer
  private readonly controls: OrbitControls
  private readonly floor = new Floor()
  private readonly sun = new DirectionalLight(0xffffff, 2.3)
  readonly shadow = new ShadowFit(this.sun, LIGHT)
  private readonly listeners = new Set<FrameListener>()
  private readonly themed = new Set<(theme: SceneTheme) => void>()
  private readonly undo: (() => void)[] = []
  private readonly scratch = new Vector3()
  private readonly pixel = new Vector2()
  /** The head that the picture is seen with; null: the viewer's own view. */
  private head: Object3D | null = null
  /** Points that the picture must contain, in the scene's frame. */
  private framed: Vector3[] = []
  private touched = false
  private request = 0
  private disposed = false
  private sharpness = 1
  /** s, from asking for a picture to drawing it; of a processor, to seeing it */
  private latency = FAST
  private requested = 0
  private waiting: ReturnType<typeof setTimeout> | undefined
  private sharpening: ReturnType<typeof setTimeout> | undefined
  private showing: ReturnType<typeof setTimeout> | undefined
  /** Another picture is due after the one that a processor draws. */
  private again = false

  /** Throws NoWebGL if the browser has none. label: of the picture, for screen readers. */
  constructor(
    private readonly container: HTMLElement,
    label: string,
  ) {
    this.surface = new Surface()
    const { canvas, renderer, software } = this.surface
    this.canvas = canvas
    this.renderer = renderer
    this.canvas.className = 'scene-canvas'
    this.canvas.tabIndex = 0
    this.canvas.setAttribute('role', 'img')
    this.canvas.setAttribute('aria-label', label)
    if (software) this.sharpness = LEAST_SHARPNESS
    this.renderer.toneMapping = NeutralToneMapping
    this.renderer.toneMappingExposure = software ? 1.05 : 1
    this.renderer.shadowMap.enabled = true
    this.renderer.shadowMap.type = PCFShadowMap
    container.append(this.canvas)

    this.world.rotation.x = -Math.PI / 2
    this.scene.add(this.world)
    this.world.add(this.floor.group)
    this.lightUp(software)

    this.controls = new OrbitControls(this.camera, this.canvas)
    this.controls.enableDamping = !reducedMotion()
    this.controls.dampingFactor = 0.12
    this.controls.maxPolarAngle = Math.PI * 0.497
    this.controls.minDistance = 0.15
    this.controls.maxDistance = 25
    this.controls.zoomToCursor = true
    const moved = () => this.invalidate()
    const began = () => {
      this.touched = true
    }
    this.controls.addEventListener('change', moved)
    this.controls.addEventListener('start', began)
    this.canvas.addEventListener('keydown', this.onKey)
    const watched = new ResizeObserver(() => this.resize())
    watched.observe(container)
    this.theme = themeNow()
    this.setTheme(this.theme)
    this.undo.push(
      () => this.controls.removeEventListener('change', moved),
      () => this.controls.removeEventListener('start', began),
      () => this.canvas.removeEventListener('keydown', this.onKey),
      () => watched.disconnect(),
      onTheme((theme) => this.setTheme(theme)),
    )
    this.resize()
  }

  /** Ask for a new picture. */
  invalidate(): void {
    this.again = this.showing !== undefined
    if (this.again || this.request !== 0 || this.waiting !== undefined || this.disposed) return
    this.requested = performance.now() / 1000
    if (this.latency < SLOW) this.request = requestAnimationFrame(this.drawNext)
    // leave a machine that cannot keep up as much time for the rest of the page as for pictures
    else this.waiting = setTimeout(this.drawSoon, Math.min(this.latency, LONGEST_WAIT) * 1000)
  }

  onFrame(listener: FrameListener): () => void {
    this.listeners.add(listener)
    this.invalidate()
    return () => this.listeners.delete(listener)
  }

  onTheme(listener: (theme: SceneTheme) => void): () => void {
    this.themed.add(listener)
    listener(this.theme)
    return () => this.themed.delete(listener)
  }

  /** Show points of the world's frame whole; a view that a person chose stays, unless `again`. */
  frame(points: readonly Vector3[], again = false): void {
    if (points.length === 0) return
    this.world.updateMatrixWorld()
    this.framed = points.map((point) => point.clone().applyMatrix4(this.world.matrixWorld))
    const { center, radius } = new Box3()
      .setFromPoints(this.framed)
      .getBoundingSphere(new Sphere())
    this.floor.setReach(Math.max(radius, 0.1) * 5)
    this.shadow.about(center, Math.max(radius, 0.1) * SHADOW)
    if (!this.touched || again) {
      this.touched = false
      this.place()
    }
    this.invalidate()
  }

  /** Show the picture that a person has whose head this is, x forwards, until null is given: then
   * the view is as it was. */
  seeWith(head: Object3D | null): void {
    if ((head === null) === (this.head === null)) {
      this.head = head
      return
    }
    this.head = head
    this.controls.enabled = head === null
    this.camera.fov = head === null ? FOV : EYES_FOV
    this.camera.updateProjectionMatrix()
    if (head === null) this.controls.update()
    this.invalidate()
  }

  /** Return the ray through a place of the page, CSS pixels, in the world's frame. */
  ray(clientX: number, clientY: number, into: Raycaster): Raycaster {
    const { left, top, width, height } = this.canvas.getBoundingClientRect()
    const x = ((clientX - left) / width) * 2 - 1
    const y = 1 - ((clientY - top) / height) * 2
    into.setFromCamera(this.pixel.set(x, y), this.camera)
    return into
  }

  /** Return where on the canvas, CSS pixels from its corner, a point of the world frame is. */
  toScreen(point: Vector3, into: Vector3): Vector3 {
    into.copy(point).applyMatrix4(this.world.matrixWorld).project(this.camera)
    into.x = ((into.x + 1) / 2) * this.canvas.clientWidth
    into.y = ((1 - into.y) / 2) * this.canvas.clientHeight
    return into
  }

  /** Turn the camera about its target, rad. */
  turn(azimuth: number, polar: number): void {
    const offset = this.scratch.copy(this.camera.position).sub(this.controls.target)
    const radius = offset.length()
    const upward = Math.acos(offset.y / radius)
    const around = Math.atan2(offset.x, offset.z) + azimuth
    const down = Math.min(Math.max(upward + polar, 0.05), this.controls.maxPolarAngle)
    offset.set(
      radius * Math.sin(down) * Math.sin(around),
      radius * Math.cos(down),
      radius * Math.sin(down) * Math.cos(around),
    )
    this.camera.position.copy(this.controls.target).add(offset)
    this.controls.update()
    this.invalidate()
  }

  /** Return the present picture, a data: URL. */
  picture(): string {
    for (const listener of this.listeners) listener(performance.now() / 1000)
    this.shadow.apply()
    this.renderer.render(this.scene, this.camera)
    return this.renderer.domElement.toDataURL()
  }

  dispose(): void {
    this.disposed = true
    cancelAnimationFrame(this.request)
    clearTimeout(this.sharpening)
    clearTimeout(this.waiting)
    clearTimeout(this.showing)
    for (const undo of this.undo) undo()
    this.controls.dispose()
    this.floor.dispose()
    this.sun.shadow.dispose()
    this.scene.environment?.dispose()
    this.surface.dispose()
  }

  private readonly draw = (): void => {
    this.request = 0
    if (this.disposed) return
    const now = performance.now() / 1000
    let more = false
    for (const listener of this.listeners) more = listener(now) || more
    if (this.head === null) this.controls.update()
    else this.follow(this.head)
    if (!this.surface.software) this.adapt(now - this.requested)
    this.setPixels(this.sharpness)
    if (this.scene.environment === null) this.scene.traverse(matt)
    this.shadow.apply()
    this.order(true)
    this.drawn++
    if (more) this.invalidate()
  }

  /** Have a picture drawn; a processor's is shown when it is done. moving: one that is not sharp is
   * followed by one that is, when nothing moves any more. */
  private order(moving: boolean): void {
    clearTimeout(this.sharpening)
    clearTimeout(this.showing)
    this.surface.order(this.scene, this.camera)
    if (this.surface.software) this.show(moving, performance.now() / 1000)
    else if (moving) this.sharpenLater()
  }

  /** Show what a processor draws since `began`, s, once it is done. */
  private show(moving: boolean, began: number): void {
    this.showing = setTimeout(() => {
      if (this.surface.draws) {
        this.show(moving, began)
        return
      }
      this.showing = undefined
      this.surface.show()
      if (moving) {
        this.adapt(performance.now() / 1000 - began)
        this.sharpenLater()
      }
      if (this.again) this.invalidate()
    }, LOOK)
  }

  private follow(head: Object3D): void {
    head.updateWorldMatrix(true, false)
    head.matrixWorld.decompose(this.camera.position, this.camera.quaternion, this.scratch)
    this.camera.quaternion.multiply(EYES)
    this.camera.updateMatrixWorld()
  }

  private readonly drawSoon = (): void => {
    this.waiting = undefined
    this.requested = performance.now() / 1000
    this.request = requestAnimationFrame(this.drawNext)
  }

  /** Draw once the machine is done with the picture before. */
  private readonly drawNext = (): void => {
    if (this.surface.draws) this.request = requestAnimationFrame(this.drawNext)
    else this.draw()
  }

  /** Choose how many pixels a picture gets, by how long the last ones were waited for, s. */
  private adapt(waited: number): void {
    this.latency += 0.2 * (Math.min(waited, 1) - this.latency)
    if (this.latency > SLOW) this.sharpness = Math.max(this.sharpness * 0.85, LEAST_SHARPNESS)
    else if (this.latency < FAST) this.sharpness = Math.min(this.sharpness * 1.05, 1)
  }

  private sharpenLater(): void {
    if (this.sharpness === 1) return
    this.sharpening = setTimeout(() => {
      if (this.disposed || this.request !== 0 || this.waiting !== undefined) return
      this.setPixels(1)
      this.order(false)
    }, STANDS * 1000)
  }

  private setPixels(sharpness: number): void {
    const ratio = Math.min(devicePixelRatio, MOST_PIXEL_RATIO) * sharpness
    if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio)
  }

  private readonly onKey = (event: KeyboardEvent): void => {
    const turns: Record<string, readonly [number, number]> = {
      ArrowLeft: [-TURN, 0],
      ArrowRight: [TURN, 0],
      ArrowUp: [0, -TURN],
      ArrowDown: [0, TURN],
    }
    const turn = turns[event.key]
    if (turn !== undefined) {
      this.touched = true
      this.turn(turn[0], turn[1])
    } else if (event.key === '+' || event.key === '=' || event.key === '-') {
      this.touched = true
      const way = this.scratch.copy(this.camera.position).sub(this.controls.target)
      this.camera.position.copy(this.controls.target)
      this.camera.position.add(way.multiplyScalar(event.key === '-' ? 1.15 : 1 / 1.15))
      this.controls.update()
    } else if (event.key === '0' || event.key === 'Home') {
      this.touched = false
      this.place()
      this.invalidate()
    } else {
      return
    }
    event.preventDefault()
  }

  /** Put the camera where all that is framed just fits, seen from VIEW. */
  private place(): void {
    if (this.framed.length === 0) return
    const high = Math.tan((this.camera.fov * Math.PI) / 360)
    const wide = high * this.camera.aspect
    const back = new Vector3(VIEW.x, VIEW.z, -VIEW.y)
    const right = new Vector3(0, 1, 0).cross(back).normalize()
    const up = new Vector3().crossVectors(back, right)
    const target = new Box3().setFromPoints(this.framed).getCenter(new Vector3())
    let distance = 0
    // Centring changes the distance that just fits: a few rounds converge.
    for (let round = 0; round < 4; round++) {
      distance = 0
      for (const point of this.framed) {
        const to = this.scratch.copy(point).sub(target)
        const needed = Math.max(Math.abs(to.dot(right)) / wide, Math.abs(to.dot(up)) / high)
        distance = Math.max(distance, needed + to.dot(back))
      }
      distance = Math.max(distance, 0.2)
      const seen = { left: 1, right: -1, low: 1, high: -1 }
      for (const point of this.framed) {
        const to = this.scratch.copy(point).sub(target)
        const depth = distance - to.dot(back)
        const x = to.dot(right) / depth / wide
        const y = to.dot(up) / depth / high
        seen.left = Math.min(seen.left, x)
        seen.right = Math.max(seen.right, x)
        seen.low = Math.min(seen.low, y)
        seen.high = Math.max(seen.high, y)
      }
      target.addScaledVector(right, ((seen.left + seen.right) / 2) * distance * wide)
      target.addScaledVector(up, ((seen.low + seen.high) / 2) * distance * high)
    }
    this.controls.target.copy(target)
    this.camera.position
      .copy(back)
      .multiplyScalar(distance * MARGIN)
      .add(target)
    this.controls.update()
  }

  private resize(): void {
    const width = this.container.clientWidth
    const height = this.container.clientHeight
    if (width === 0 || height === 0 || this.disposed) return
    this.setPixels(this.sharpness)
    this.renderer.setSize(width, height, false)
    this.camera.aspect = width / height
    this.camera.updateProjectionMatrix()
    if (!this.touched) this.place()
    // at once: a canvas that was resized is empty until it is drawn again
    this.draw()
  }

  private lightUp(software: boolean): void {
    this.sun.castShadow = true
    if (software) {
      // its reflections alone would take a processor ten seconds
      this.sun.shadow.mapSize.set(1024, 1024)
      this.sun.intensity = 2.4
      const fill = new DirectionalLight(0xffffff, 0.9)
      fill.position.set(-LIGHT.x, LIGHT.y * 0.35, -LIGHT.z)
      this.scene.add(new HemisphereLight(0xffffff, 0x9aa4b0, 1.7), fill)
    } else {
      this.scene.environment = hallLight(this.renderer)
      this.sun.shadow.mapSize.set(2048, 2048)
      this.scene.add(new HemisphereLight(0xffffff, 0x8895a5, 0.2))
    }
    this.sun.shadow.radius = 6
    this.scene.add(this.sun, this.sun.target)
  }

  private setTheme(theme: SceneTheme): void {
    this.theme = theme
    this.floor.setTheme(theme)
    this.scene.environmentIntensity = theme.name === 'dark' ? 0.5 : 0.62
    for (const listener of this.themed) listener(theme)
    this.invalidate()
  }
}
