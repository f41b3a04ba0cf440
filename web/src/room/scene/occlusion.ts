import {
  ExternalTexture,
  type Material,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  MeshPhongMaterial,
  MeshStandardMaterial,
  type Object3D,
  Vector2,
  Vector4,
  type WebGLRenderer,
} from 'three'
import { originOf } from '../../scene/robot/cross_fade'
import { hidden } from './depth_material'

/** s between two searches for materials of new robots and objects. */
const PERIOD = 0.5
const KINDS = [MeshStandardMaterial, MeshPhongMaterial, MeshLambertMaterial]

/** Fields that a Quest adds to its depth image: the values are those of a projection. */
interface Projected {
  readonly depthNear?: number
  readonly depthFar?: number
}

/** Hides robots and objects behind real things whose depth the headset measures. Each fragment is
 * compared with the depth at its place, so that no pass over the whole picture is needed, and
 * edges are soft. */
export class Occlusion {
  /** True if the person switched it on. */
  wanted = false
  private readonly map = new ExternalTexture()
  private readonly uniforms = {
    roomDepth: { value: null as ExternalTexture | null },
    roomDepthView: { value: new Vector4() },
    roomDepthLayer: { value: new Vector2() },
    roomDepthFromView: { value: [new Matrix4(), new Matrix4()] },
  }
  private lookedAt = Number.NEGATIVE_INFINITY
  private active = true

  /** root: is hidden behind real things, with all below it. */
  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly root: Object3D,
  ) {
    // three would write the room's depth over the whole picture, hard-edged, and from one texture
    // where the device hands out several in turn
    renderer.xr.getDepthSensingMesh = () => null
  }

  /** Before each picture. now: s. */
  update(now: number): void {
    const view = this.uniforms.roomDepthView.value
    view.x = 0
    const session = this.renderer.xr.getSession()
    if (session?.depthUsage !== 'gpu-optimized') return
    this.pause(session)
    if (!this.wanted) return
    if (now - this.lookedAt > PERIOD) {
      this.lookedAt = now
      this.root.traverse((node) => this.take(node))
    }
    this.read(view)
  }

  dispose(): void {
    this.uniforms.roomDepth.value = null
    this.map.sourceTexture = null
    this.map.dispose()
  }

  /** Stop the measurement of depth while it is unused. */
  private pause(session: XRSession): void {
    if (this.active === this.wanted) return
    this.active = this.wanted
    if (this.wanted) session.resumeDepthSensing?.()
    else session.pauseDepthSensing?.()
  }

  private read(view: Vector4): void {
    const { xr } = this.renderer
    const { cameras } = xr.getCamera()
    const viewer = xr.getReferenceSpace()
    const pose = viewer === null ? undefined : xr.getFrame().getViewerPose(viewer)
    const { roomDepthLayer: layer, roomDepthFromView: from, roomDepth } = this.uniforms
    const eyes = pose?.views ?? []
    for (let i = 0; i < Math.min(eyes.length, 2); i++) {
      const depth = xr.getBinding().getDepthInformation(eyes[i] as XRView)
      const viewport = cameras[i]?.viewport
      if (depth == null || viewport === undefined) return
      // a depth of one layer, as phones have it, is another kind of sampler
      if (depth.textureType !== undefined && depth.textureType !== 'texture-array') return
      const { depthNear = 0, depthFar = 0 } = depth as XRWebGLDepthInformation & Projected
      const far = Number.isFinite(depthFar) && depthFar > depthNear ? depthFar : 0
      if (i === 0) {
        this.map.sourceTexture = depth.texture
        view.set(viewport.z, viewport.w, depthNear > 0 ? depthNear : -depth.rawValueToMeters, far)
      }
      layer.value.setComponent(i, depth.imageIndex ?? i)
      from.value[i]?.fromArray(depth.normDepthBufferFromNormView.matrix)
    }
    if (eyes.length === 0) return
    roomDepth.value = this.map
  }

  private take(node: Object3D): void {
    if (!(node instanceof Mesh)) return
    const { material } = node
    if (Array.isArray(material)) for (const each of material) this.patch(each)
    else this.patch(material)
  }

  private patch(drawn: Material): void {
    const material = originOf(drawn)
    const kind = KINDS.find((each) => material instanceof each)
    if (kind !== undefined) hidden(material as MeshStandardMaterial, this.uniforms)
  }
}
