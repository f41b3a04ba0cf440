import { Line3, type Object3D, type Ray, Vector3 } from 'three'
import type { Hit } from '../input/pointer'

/** m: radius of an arm about the line through its links. */
const RADIUS = 0.07

const segment = new Line3()
const near = new Vector3()
const onRay = new Vector3()

/** A link and its parent link. */
interface Bone {
  readonly link: Object3D
  readonly parent: Object3D
}

/** An arm as capsules from link to link: near enough for a finger that touches it. */
export class ArmShape {
  private readonly bones: readonly Bone[]

  /** links: of the URDF, each below its joint, which is below the link that carries it. */
  constructor(links: Readonly<Record<string, Object3D>>) {
    const all = new Set(Object.values(links))
    this.bones = [...all].flatMap((link) => {
      let parent = link.parent
      while (parent !== null && !all.has(parent)) parent = parent.parent
      return parent === null ? [] : [{ link, parent }]
    })
  }

  /** Return the distance of a place of the scene from the arm's surface, m; negative: inside. */
  distance(point: Vector3): number {
    let least = Number.POSITIVE_INFINITY
    for (const bone of this.bones) {
      place(bone)
      segment.closestPointToPoint(point, true, near)
      least = Math.min(least, near.distanceTo(point))
    }
    return least - RADIUS
  }

  /** Return whether a ray meets the arm; if so, fill `hit`. */
  cast(ray: Ray, hit: Hit): boolean {
    let least = Number.POSITIVE_INFINITY
    for (const bone of this.bones) {
      place(bone)
      const gap = ray.distanceSqToSegment(segment.start, segment.end, onRay, near)
      if (gap > RADIUS * RADIUS) continue
      const along = Math.max(onRay.distanceTo(ray.origin) - RADIUS, 0)
      if (along >= least) continue
      least = along
    }
    if (least === Number.POSITIVE_INFINITY) return false
    hit.distance = least
    ray.at(least, hit.point)
    return true
  }
}

function place({ link, parent }: Bone): void {
  segment.start.setFromMatrixPosition(parent.matrixWorld)
  segment.end.setFromMatrixPosition(link.matrixWorld)
}
