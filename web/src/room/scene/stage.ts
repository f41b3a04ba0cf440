import {
  CircleGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  Group,
  HemisphereLight,
  Mesh,
  NeutralToneMapping,
  type Object3D,
  PCFShadowMap,
  PerspectiveCamera,
  Scene,
  ShadowMaterial,
  Vector3,
  WebGLRenderer,
} from 'three'
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js'
import { XREstimatedLight } from 'three/examples/jsm/webxr/XREstimatedLight.js'
import { Floor } from '../../scene/stage/floor'
import { hallLight } from '../../scene/stage/hall'
import type { SceneHost } from '../../scene/stage/renderer'
import { NoWebGL } from '../../scene/stage/renderer'
import { ShadowFit } from '../../scene/stage/shadow_fit'
import { onTheme, type SceneTheme, themeNow } from '../../scene/stage/theme'
import { stand } from './frames'
import { Grounds } from './grounds'
import { Occlusion } from './occlusion'

/** m above the floor, of the eyes of the desktop view. */
const EYES = 1.6
const SHADOW = 1.6 // m, half of the least width of the shadow
const SUN = new Vector3(1.2, 3.2, 1.4)
/** s */
const STILL_PERIOD = 0.5
const LONGEST_PAUSE = 0.4
const SMOOTH = 0.04
/** 0 is sharp everywhere; three's 1 blurs text. */
const FOVEATION = 0.4
const DAYLIGHT = new Color(0xffffff)
const LAMP = new Color(0xffc98a)
/** Of the sun beside an estimate of the real light. */
const FAINT_SUN = 0.5

const place = new Vector3()

/** The scene in the room: `scene` is the headset's floor space, `anchor` the one thing that an
 * XRAnchor moves, `world` in it the lab's frame in ROS axes. Without a headset a mouse turns the
 * view. */
export class RoomStage implements SceneHost {
  readonly scene = new Scene()
  readonly anchor = new Group()
  readonly world = new Group()
  /** Panels: in the floor space, never under a robot. */
  readonly panels = new Group()
  readonly camera = new PerspectiveCamera(60, 1, 0.02, 60)
  readonly renderer: WebGLRenderer
  readonly controls: OrbitControls
  readonly occlusion: Occlusion
  readonly canvas = document.createElement('canvas')
  theme: SceneTheme = themeNow()
  private readonly floor = new Floor()
  private readonly sun = new DirectionalLight(0xffffff, 2.2)
  readonly shadow = new ShadowFit(this.sun, SUN)
  private readonly shadowFloor = new Mesh(
    new CircleGeometry(6, 48),
    new ShadowMaterial({ color: 0x0a1420, opacity: 0.35, side: DoubleSide }),
  )
  readonly grounds = new Grounds(this.shadowFloor.material)
  private readonly sky = new HemisphereLight(0xffffff, 0x8895a5, 0.2)
  private readonly themed = new Set<(theme: SceneTheme) => void>()
  private readonly undo: (() => void)[] = []
  private stirred = true
  private drawnAt = Number.NEGATIVE_INFINITY
  private cost = 0
  private pause = 0

  /** Throws NoWebGL if the browser has none. label: for screen readers. */
  constructor(
    private readonly container: HTMLElement,
    label: string,
  ) {
    this.canvas.className = 'room-canvas'
    this.canvas.tabIndex = 0
    this.canvas.setAttribute('role', 'img')
    this.canvas.setAttribute('aria-label', label)
    this.renderer = rendererOn(this.canvas)
    this.renderer.toneMapping = NeutralToneMapping
    this.renderer.shadowMap.enabled = true
    this.renderer.shadowMap.type = PCFShadowMap
    this.renderer.xr.enabled = true
    this.renderer.xr.setReferenceSpaceType('local-floor')
    this.renderer.xr.setFoveation(FOVEATION)
    this.occlusion = new Occlusion(this.renderer, this.world)
    container.append(this.canvas)
    stand(this.world)
    this.anchor.add(this.world)
    this.shadowFloor.receiveShadow = true
    this.world.add(this.floor.group, this.shadowFloor, this.grounds.group)
    this.scene.add(this.anchor, this.panels)
    this.lightUp()
    this.followLight()
    this.camera.position.set(0, EYES, 0.9)
    this.controls = new OrbitControls(this.camera, this.canvas)
    this.controls.target.set(0, 0.85, -0.8)
    this.controls.maxPolarAngle = Math.PI * 0.55
    this.controls.minDistance = 0.3
    this.controls.maxDistance = 12
    this.controls.update()
    const stir = () => this.invalidate()
    this.controls.addEventListener('change', stir)
    this.undo.push(() => this.controls.removeEventListener('change', stir))
    const watched = new ResizeObserver(() => this.resize())
    watched.observe(container)
    this.undo.push(
      () => watched.disconnect(),
      onTheme((theme) => {
        this.theme = theme
        this.floor.setTheme(theme)
        for (const listener of this.themed) listener(theme)
      }),
    )
    this.floor.setTheme(this.theme)
    this.setPassthrough(false)
    this.resize()
  }

  onTheme(listener: (theme: SceneTheme) => void): () => void {
    this.themed.add(listener)
    listener(this.theme)
    return () => this.themed.delete(listener)
  }

  /** Ask for a new picture; a headset gets one in every frame. */
  invalidate(): void {
    this.stirred = true
  }

  /** Draw a picture: in a headset in each frame, on a desktop on request and twice a second, so
   * that a slow renderer leaves the page time for clicks. now: s. */
  draw(now: number): boolean {
    const inside = this.renderer.xr.isPresenting
    if (!inside) {
      const still = !this.stirred && now - this.drawnAt < STILL_PERIOD
      if (still || now - this.drawnAt < this.pause) return false
      this.pause = Math.min(2 * this.cost, LONGEST_PAUSE)
    }
    this.stirred = false
    this.drawnAt = now
    this.occlusion.update(now)
    this.shadow.apply()
    this.renderer.render(this.scene, this.camera)
    return true
  }

  /** Note how long the browser took from one frame to the next, s: all that drawing costs. */
  measure(step: number): void {
    this.cost = step < SMOOTH ? 0 : this.cost + 0.3 * (step - this.cost)
  }

  /** Do nothing: a person in the room walks. */
  frame(_points: readonly Vector3[]): void {}

  /** Show the real floor with shadows on it, or a grid. */
  setPassthrough(on: boolean): void {
    this.setGrid(!on)
    this.grounds.group.visible = on
  }

  get grid(): boolean {
    return this.floor.group.visible
  }

  setGrid(on: boolean): void {
    this.floor.group.visible = on
    this.shadowFloor.visible = !on
  }

  /** Fit the light to the real room by hand: few headsets estimate it. brightness: 1 is a bright
   * day. warmth: 0 is daylight, 1 a lamp. */
  setLight(brightness: number, warmth: number): void {
    this.renderer.toneMappingExposure = brightness
    for (const light of [this.sun, this.sky]) light.color.set(DAYLIGHT).lerp(LAMP, warmth)
    this.invalidate()
  }

  /** Keep light and shadow about the middle of robots' bases. */
  lightAbout(robots: Iterable<{ readonly base: Object3D }>): void {
    place.set(0, 0, 0)
    let count = 0
    for (const { base } of robots) {
      const { elements } = base.matrixWorld
      place.x += elements[12] as number
      place.y += elements[13] as number
      place.z += elements[14] as number
      count++
    }
    if (count === 0) return
    place.divideScalar(count)
    this.shadow.about(place, SHADOW)
  }

  dispose(): void {
    for (const undo of this.undo) undo()
    this.renderer.setAnimationLoop(null)
    this.controls.dispose()
    this.occlusion.dispose()
    this.floor.dispose()
    this.grounds.dispose()
    this.shadowFloor.geometry.dispose()
    this.shadowFloor.material.dispose()
    this.sun.shadow.dispose()
    this.scene.environment?.dispose()
    this.renderer.dispose()
    this.renderer.forceContextLoss()
    this.canvas.remove()
  }

  private resize(): void {
    if (this.renderer.xr.isPresenting) return
    const { clientWidth: width, clientHeight: height } = this.container
    if (width === 0 || height === 0) return
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2))
    this.renderer.setSize(width, height, false)
    this.camera.aspect = width / height
    this.camera.updateProjectionMatrix()
    this.invalidate()
  }

  /** Light the robots as the real room is lit, where the device says how. */
  private followLight(): void {
    const real = new XREstimatedLight(this.renderer)
    const { scene, sun } = this
    const { environment } = scene
    const { intensity } = sun
    real.addEventListener('estimationstart', () => {
      scene.add(real)
      if (real.environment !== null) scene.environment = real.environment
      // its shadow stays
      sun.intensity = FAINT_SUN
    })
    real.addEventListener('estimationend', () => {
      scene.remove(real)
      scene.environment = environment
      sun.intensity = intensity
    })
    this.undo.push(() => real.removeFromParent())
  }

  private lightUp(): void {
    this.scene.environment = hallLight(this.renderer)
    this.scene.environmentIntensity = 0.62
    const { shadow } = this.sun
    this.sun.castShadow = true
    shadow.mapSize.set(1024, 1024)
    shadow.radius = 5
    this.scene.add(this.sky, this.sun, this.sun.target)
  }
}

function rendererOn(canvas: HTMLCanvasElement): WebGLRenderer {
  const context = canvas.getContext('webgl2', {
    alpha: true,
    antialias: true,
    powerPreference: 'high-performance',
    xrCompatible: true,
  })
  if (context === null) throw new NoWebGL('this browser has no WebGL 2')
  return new WebGLRenderer({ canvas, context, alpha: true, antialias: true })
}
