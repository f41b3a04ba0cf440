import { DoubleSide, Mesh, MeshBasicMaterial, type Object3D, SphereGeometry, Vector3 } from 'three'
import type { Chain } from '../../scene/chain'

const ACROSS = 36
const UP = 20
/** Directions that are searched in one picture: about 3 ms of a headset's 13.9. */
const EACH = 60
const COLOUR = 0x6cb6ff

const direction = new Vector3()
const place = new Vector3()

/** How far a robot's tool reaches in every direction, within the limits of its joints: the hull of
 * its workspace. It is found over several pictures. */
export class Envelope {
  private readonly geometry = new SphereGeometry(1, ACROSS, UP)
  private readonly solid = new MeshBasicMaterial({
    color: COLOUR,
    transparent: true,
    opacity: 0.07,
    side: DoubleSide,
    depthWrite: false,
    toneMapped: false,
  })
  private readonly lines = new MeshBasicMaterial({
    color: COLOUR,
    transparent: true,
    opacity: 0.22,
    wireframe: true,
    depthWrite: false,
    toneMapped: false,
  })
  private readonly meshes: readonly Mesh[]
  private readonly scratch: Float64Array
  private next = 0

  /** floor: height of the floor in the frame of the base, m: what is below is not shown. */
  constructor(
    private readonly chain: Chain,
    jointCount: number,
    private readonly base: Object3D,
    private readonly floor: number,
  ) {
    this.scratch = new Float64Array(jointCount)
    this.meshes = [this.solid, this.lines].map((look) => new Mesh(this.geometry, look))
    for (const mesh of this.meshes) mesh.frustumCulled = false
  }

  /** Search on; return whether a picture is due. */
  update(): boolean {
    const places = this.geometry.getAttribute('position')
    if (this.next >= places.count) return false
    const end = Math.min(this.next + EACH, places.count)
    for (; this.next < end; this.next++) {
      direction.fromBufferAttribute(places, this.next)
      this.chain.farthest(direction, this.scratch, place)
      places.setXYZ(this.next, place.x, place.y, Math.max(place.z, this.floor))
    }
    if (this.next < places.count) return true
    places.needsUpdate = true
    this.base.add(...this.meshes)
    return true
  }

  dispose(): void {
    for (const mesh of this.meshes) mesh.removeFromParent()
    this.geometry.dispose()
    this.solid.dispose()
    this.lines.dispose()
  }
}
