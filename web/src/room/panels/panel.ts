import {
  CanvasTexture,
  Group,
  LinearFilter,
  LinearMipmapLinearFilter,
  Mesh,
  MeshBasicMaterial,
  Plane,
  PlaneGeometry,
  type Ray,
  SRGBColorSpace,
  Vector3,
} from 'three'
import type { Hit, Signal, Target } from '../input/pointer'
import { Pen, TEXELS, type Zone } from './pen'

const MM = 0.001
const AFTER_NAMES = 12
const normal = new Vector3()
const local = new Vector3()

/** The feedback of a panel to a pointer: a sound, a pulse. */
export type Feedback = (what: 'hover' | 'press', signal: Signal) => void

/** The parts of the room that a panel uses. */
export interface Surroundings {
  readonly feedback: Feedback
  /** A picture is due. */
  stir(): void
}

/** A flat panel that faces along its z: one canvas, one draw call. It is painted when something
 * changed, never in each frame. */
export class Panel implements Target {
  readonly group = new Group()
  private readonly canvas = document.createElement('canvas')
  private readonly texture: CanvasTexture
  private readonly geometry: PlaneGeometry
  private readonly material: MeshBasicMaterial
  private readonly plane = new Plane()
  private zones: readonly Zone[] = []
  private hovered = ''
  private active: Zone | null = null
  /** Last position of a drag, 0 to 1. */
  private share = 0
  private due = true
  /** Number of pointers over it: it does not move away under one. */
  pointers = 0

  /** Sizes in mm. draw: paints it whole. */
  constructor(
    readonly width: number,
    readonly height: number,
    private readonly draw: (pen: Pen) => void,
    private readonly surroundings: Surroundings,
  ) {
    this.canvas.width = width * TEXELS
    this.canvas.height = height * TEXELS
    this.texture = new CanvasTexture(this.canvas)
    this.texture.colorSpace = SRGBColorSpace
    this.texture.anisotropy = 4
    this.texture.minFilter = LinearMipmapLinearFilter
    this.texture.magFilter = LinearFilter
    this.geometry = new PlaneGeometry(width * MM, height * MM)
    this.material = new MeshBasicMaterial({
      map: this.texture,
      alphaTest: 0.5,
      toneMapped: false,
      // Drawn after transparent things and the names of robots: nothing covers a panel.
      transparent: true,
    })
    const face = new Mesh(this.geometry, this.material)
    face.renderOrder = AFTER_NAMES
    this.group.add(face)
  }

  /** Have it painted before the next picture. */
  repaint(): void {
    this.due = true
  }

  /** Paint it if it is due. */
  update(): void {
    if (!this.due || !this.group.visible) return
    const context = this.canvas.getContext('2d')
    if (context === null) return
    this.due = false
    const pen = new Pen(context, this.width, this.height, this.hovered, this.active?.id ?? '')
    this.draw(pen)
    this.zones = pen.zones
    // A drag continues in the repainted zone.
    if (this.active !== null) {
      this.active = this.zones.find(({ id }) => id === this.active?.id) ?? null
    }
    this.texture.needsUpdate = true
    this.surroundings.stir()
  }

  /** Press a zone as a pointer would, by its id; false: there is none, or it is off. */
  act(id: string, share = 0.5): boolean {
    this.update()
    const zone = this.zones.find((each) => each.id === id)
    if (zone === undefined || !zone.enabled) return false
    zone.press(share, true)
    this.repaint()
    return true
  }

  /** Return where in the scene the middle of a zone is; null: there is none of that id. */
  centre(id: string, share = 0.5): Vector3 | null {
    const zone = this.zones.find((each) => each.id === id)
    if (zone === undefined) return null
    const x = zone.x + zone.width * share - this.width / 2
    const y = this.height / 2 - zone.y - zone.height / 2
    return this.group.localToWorld(new Vector3(x * MM, y * MM, 0))
  }

  /** Ids of the enabled zones. */
  get ids(): string[] {
    return this.zones.filter(({ enabled }) => enabled).map(({ id }) => id)
  }

  cast(ray: Ray, hit: Hit): boolean {
    if (!this.group.visible) return false
    normal.set(0, 0, 1).transformDirection(this.group.matrixWorld)
    // from behind there is nothing to press
    if (normal.dot(ray.direction) > 0) return false
    local.setFromMatrixPosition(this.group.matrixWorld)
    this.plane.setFromNormalAndCoplanarPoint(normal, local)
    if (ray.intersectPlane(this.plane, hit.point) === null) return false
    hit.distance = hit.point.distanceTo(ray.origin)
    return this.place(hit.point, hit) || this.active !== null
  }

  face(point: Vector3, hit: Hit): number {
    if (!this.group.visible || !this.place(point, hit)) return Number.NaN
    hit.point.copy(point)
    return local.z * this.group.matrixWorld.getMaxScaleOnAxis()
  }

  on(signal: Signal): void {
    const { hit } = signal.pointer
    switch (signal.kind) {
      case 'enter':
        this.pointers++
        return
      case 'leave':
        this.pointers--
        this.over(null, signal)
        return
      case 'move':
        if (this.active === null) this.over(this.zoneAt(hit), signal)
        else if (this.active.drags) this.drag(this.active, hit)
        return
      case 'down':
        if (signal.button !== 'select') return
        this.active = this.zoneAt(hit)
        if (this.active === null) return
        this.surroundings.feedback('press', signal)
        if (this.active.drags) this.drag(this.active, hit)
        this.repaint()
        return
      case 'up': {
        const { active } = this
        this.active = null
        this.repaint()
        if (active === null) return
        if (active.drags || this.zoneAt(hit)?.id === active.id) {
          active.press(shareOf(active, hit), true)
        }
        return
      }
      case 'cancel': {
        const { active } = this
        this.active = null
        this.repaint()
        // A drag ends at its last position; a button that was not released does nothing.
        if (active?.drags) active.press(this.share, true)
      }
    }
  }

  dispose(): void {
    this.group.removeFromParent()
    this.texture.dispose()
    this.geometry.dispose()
    this.material.dispose()
  }

  private drag(zone: Zone, hit: Hit): void {
    this.share = shareOf(zone, hit)
    zone.press(this.share, false)
  }

  /** Fill u and v, mm from the left top corner; return whether the point is before the panel. */
  private place(point: Vector3, hit: Hit): boolean {
    this.group.worldToLocal(local.copy(point))
    hit.u = local.x / MM + this.width / 2
    hit.v = this.height / 2 - local.y / MM
    return hit.u >= 0 && hit.u <= this.width && hit.v >= 0 && hit.v <= this.height
  }

  private zoneAt({ u, v }: Hit): Zone | null {
    for (const zone of this.zones) {
      const inside =
        u >= zone.x && u <= zone.x + zone.width && v >= zone.y && v <= zone.y + zone.height
      if (inside && zone.enabled) return zone
    }
    return null
  }

  private over(zone: Zone | null, signal: Signal): void {
    const id = zone?.id ?? ''
    if (id === this.hovered) return
    this.hovered = id
    if (id !== '') this.surroundings.feedback('hover', signal)
    this.repaint()
  }
}

function shareOf(zone: Zone, { u }: Hit): number {
  return Math.min(Math.max((u - zone.x) / zone.width, 0), 1)
}
