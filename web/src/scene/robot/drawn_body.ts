import { Box3, Matrix4, type Mesh, type Object3D, type Vector3 } from 'three'
import type { ShadowFit } from '../stage/shadow_fit'
import { pushCorners } from './corners'
import type { Hose } from './hose'
import { type HoseDetail, hoseMesh } from './hose'
import { FadingLevels } from './levels'
import type { Looks } from './looks'
import { atlasOf, detach, type Part, partsBelow, RobotBody } from './robot_body'

/** m beyond a robot's reach from its base, from where on it is drawn with few triangles. */
const FAR = 3
/** Of that distance: a robot at the border does not change back and forth. */
const HYSTERESIS = 0.08
/** s in which one level dissolves into the other: both are drawn so long. */
const FADE = 0.25
const NEAR_HOSE = { sides: 10, ribbed: true }
const FAR_HOSE = { sides: 6, ribbed: false }

const part = new Box3()

export type Look = 'own' | 'grey' | 'ghost'

/** The drawing of a robot: its links and hoses as one mesh, and a mesh of few triangles for a robot
 * that is far away. */
export class DrawnBody {
  private readonly levels: FadingLevels
  private readonly bodies: RobotBody[] = []
  private parts: readonly Part[] = []
  private look: Look = 'own'

  /** root: of the robot. linkOf: the link of a mesh. changed: another picture is due. */
  constructor(
    private readonly root: Object3D,
    private readonly linkOf: (mesh: Mesh) => Object3D | null,
    private readonly hoses: readonly Hose[],
    private readonly looks: Looks,
    changed: () => void,
  ) {
    // A transparent body would be drawn twice.
    const duration = () => (this.look === 'ghost' || looks.still() ? 0 : FADE)
    this.levels = new FadingLevels(changed, duration)
  }

  /** There is a mesh in place of those of the links. */
  get isMerged(): boolean {
    return this.bodies.length > 0
  }

  /** Take the meshes below the robot as its near level. */
  merge(): void {
    const { root } = this
    this.parts = alike(partsBelow(root, this.linkOf))
    const body = this.bodyOf(this.parts, NEAR_HOSE)
    if (body === null) return
    detach(this.parts)
    this.levels.setNear(body)
    root.add(this.levels)
  }

  /** Add the far level of packed meshes. levels: packed files, a child a link. */
  addFar(levels: readonly Object3D[], links: Readonly<Record<string, Object3D>>): void {
    const [near] = this.bodies
    if (near === undefined) return
    const parts = this.parts.filter(({ mesh }) => mesh.userData.packed !== true)
    for (const child of levels.flatMap(({ children }) => children)) {
      const link = links[child.name]
      if (link === undefined) continue
      for (const part of partsBelow(child, () => child)) parts.push({ ...part, link })
    }
    const far = this.bodyOf(alike(parts), FAR_HOSE)
    if (far === null) return
    this.levels.setFar(far, FAR + this.reach(near), HYSTERESIS)
  }

  /** The links have moved, and their frames in the world are computed. */
  follow(): void {
    for (const hose of this.hoses) hose.follow(this.root)
    for (const body of this.bodies) body.follow()
  }

  /** Return how high its highest point is, m in the scene; -Infinity until it is drawn. */
  top(): number {
    return this.bodies[0]?.top() ?? Number.NEGATIVE_INFINITY
  }

  /** Widen a shadow to the present places of the links. */
  castInto(shadow: ShadowFit): void {
    this.bodies[0]?.castInto(shadow)
  }

  /** Return how wide the links are together that are `meant`, across the robot's axis, m. */
  widthOf(meant: (link: Object3D) => boolean): number {
    const all = new Box3()
    const [body] = this.bodies
    body?.boxes.forEach((box, i) => {
      const link = body.skeleton.bones[i]
      if (link === undefined || box.isEmpty() || !meant(link)) return
      all.union(part.copy(box).applyMatrix4(toRoot(link, this.root)))
    })
    return all.isEmpty() ? 0 : Math.max(all.max.x - all.min.x, all.max.y - all.min.y)
  }

  paint(look: Look, failing: string): void {
    const { looks } = this
    this.look = look
    const ghost = look === 'ghost'
    const grey = look === 'grey' || failing !== ''
    this.levels.settle()
    for (const body of this.bodies) {
      const material = ghost ? looks.ghost : grey ? looks.grey : body.own
      body.receiveShadow = !ghost
      body.renderOrder = ghost ? 1 : 0
      body.paint(material, ghost ? '' : failing, looks.failing)
    }
    this.levels.setCasting(!ghost)
  }

  release(): void {
    this.levels.release()
    for (const body of this.bodies) body.release()
  }

  private bodyOf(parts: readonly Part[], detail: HoseDetail): RobotBody | null {
    const all = [...parts, ...this.hoses.map((hose) => partOf(hose, detail))]
    const body = RobotBody.of(all, this.looks.bodyOf(atlasOf(parts)), this.looks.shadow)
    if (body !== null) this.bodies.push(body)
    return body
  }

  /** Return the reach of a body from its base in its present pose, m. */
  private reach(body: RobotBody): number {
    const corners: Vector3[] = []
    pushCorners(body, this.root, corners)
    return Math.max(0, ...corners.map((corner) => corner.length()))
  }
}

/** Return the frame of a link in that of its robot. */
function toRoot(link: Object3D, root: Object3D): Matrix4 {
  return root.matrixWorld.clone().invert().multiply(link.matrixWorld)
}

/** Return the parts that can be drawn with one atlas, that of the first one which has any. */
function alike(parts: readonly Part[]): Part[] {
  const atlas = atlasOf(parts)
  return parts.filter((part) => [null, atlas].includes(atlasOf([part])))
}

function partOf(hose: Hose, detail: HoseDetail): Part {
  const { rings } = hose
  return {
    mesh: hoseMesh(hose, detail),
    link: rings[0] as Object3D,
    inLink: new Matrix4(),
    bones: rings,
  }
}
