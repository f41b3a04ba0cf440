import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Vector3,
} from 'three'
import type { Chain } from '../../scene/robot/chain'

const ACROSS = 40
const UP = 20
const COUNT = ACROSS * (UP + 1)
/** Directions that are searched in one picture: about 3 ms of a headset's 13.9. */
const EACH = 24
const COLOUR = 0x6cb6ff

const direction = new Vector3()
const place = new Vector3()
const centre = new Vector3()

/** Write the direction of a corner of the hull: rings from the lowest to the highest. */
function directionOf(corner: number, into: Vector3): Vector3 {
  const turn = ((corner % ACROSS) / ACROSS) * 2 * Math.PI
  const lift = Math.floor(corner / ACROSS) / UP - 0.5
  const out = Math.cos(lift * Math.PI)
  return into.set(out * Math.cos(turn), out * Math.sin(turn), Math.sin(lift * Math.PI))
}

/** The hull of a robot's workspace: the reach of its tool in every direction, within the limits of
 * its joints. It is computed over several pictures. */
export class Envelope {
  private readonly faces = new BufferGeometry()
  private readonly rings = new BufferGeometry()
  private readonly solid = new MeshBasicMaterial({
    color: COLOUR,
    transparent: true,
    opacity: 0.08,
    side: DoubleSide,
    depthWrite: false,
    toneMapped: false,
  })
  private readonly line = new LineBasicMaterial({
    color: COLOUR,
    transparent: true,
    opacity: 0.35,
    depthWrite: false,
    toneMapped: false,
  })
  private readonly parts: readonly Object3D[]
  private readonly scratch: Float64Array
  /** The farthest place of each direction, m. */
  private readonly farthest = new Float64Array(COUNT * 3)
  private next = 0

  /** floor: height of the floor in the frame of the base, m: points below it are not shown. */
  constructor(
    private readonly chain: Chain,
    jointCount: number,
    private readonly base: Object3D,
    private readonly floor: number,
  ) {
    this.scratch = new Float64Array(jointCount)
    this.parts = [new Mesh(this.faces, this.solid), new LineSegments(this.rings, this.line)]
    for (const part of this.parts) part.frustumCulled = false
  }

  /** Search on; return whether a picture is due. */
  update(): boolean {
    if (this.next >= COUNT) return false
    const end = Math.min(this.next + EACH, COUNT)
    for (; this.next < end; this.next++) {
      this.chain.farthest(directionOf(this.next, direction), this.scratch, place)
      place.toArray(this.farthest, this.next * 3)
    }
    if (this.next < COUNT) return true
    this.build()
    this.base.add(...this.parts)
    return true
  }

  dispose(): void {
    for (const part of this.parts) part.removeFromParent()
    for (const each of [this.faces, this.rings, this.solid, this.line]) each.dispose()
  }

  /** Put each corner where a ray from the middle leaves the hull: no plane that bounds the hull is
   * passed. */
  private build(): void {
    const { farthest } = this
    centre.set(0, 0, 0)
    for (let i = 0; i < COUNT; i++) centre.add(place.fromArray(farthest, i * 3))
    centre.divideScalar(COUNT)
    const bounds = new Float64Array(COUNT)
    for (let i = 0; i < COUNT; i++) {
      // the farthest of all that were found: a search may have ended on a lower hill
      directionOf(i, direction)
      let most = Number.NEGATIVE_INFINITY
      for (let j = 0; j < COUNT; j++) {
        most = Math.max(most, place.fromArray(farthest, j * 3).dot(direction))
      }
      bounds[i] = most - centre.dot(direction)
    }
    const corners = new Float32Array(COUNT * 3)
    for (let i = 0; i < COUNT; i++) {
      directionOf(i, direction)
      let length = Number.POSITIVE_INFINITY
      for (let j = 0; j < COUNT; j++) {
        const along = directionOf(j, place).dot(direction)
        if (along > 0.05) length = Math.min(length, (bounds[j] as number) / along)
      }
      // on the floor rather than below it
      const down = this.floor - centre.z
      if (down < 0 && direction.z * length < down) length = down / direction.z
      place
        .copy(direction)
        .multiplyScalar(length)
        .add(centre)
        .toArray(corners, i * 3)
    }
    const attribute = new BufferAttribute(corners, 3)
    this.faces.setAttribute('position', attribute)
    this.faces.setIndex(facesOf())
    this.rings.setAttribute('position', attribute)
    this.rings.setIndex(ringsOf())
  }
}

function facesOf(): number[] {
  const faces: number[] = []
  for (let ring = 0; ring < UP; ring++) {
    for (let i = 0; i < ACROSS; i++) {
      const a = ring * ACROSS + i
      const b = ring * ACROSS + ((i + 1) % ACROSS)
      faces.push(a, b, b + ACROSS, a, b + ACROSS, a + ACROSS)
    }
  }
  return faces
}

/** Every second ring, and every fourth line from the lowest to the highest corner. */
function ringsOf(): number[] {
  const lines: number[] = []
  for (let ring = 1; ring < UP; ring++) {
    for (let i = 0; i < ACROSS; i++) {
      const a = ring * ACROSS + i
      if (ring % 2 === 0) lines.push(a, ring * ACROSS + ((i + 1) % ACROSS))
      if (i % 4 === 0 && ring < UP - 1) lines.push(a, a + ACROSS)
    }
  }
  return lines
}
