import { LOD, Matrix4, type Mesh, type Object3D, type Vector3 } from 'three'
import { pushCorners } from './corners'
import type { Hose } from './hose'
import { type HoseDetail, hoseMesh } from './hose_mesh'
import type { Looks } from './looks'
import { detach, type Part, partsBelow, RobotBody } from './robot_body'

/** m beyond a robot's reach from its base, from where on it is drawn with few triangles. */
const FAR = 3
/** Of that distance: a robot at the border does not change back and forth. */
const HYSTERESIS = 0.08
const NEAR_HOSE = { sides: 10, ribbed: true }
const FAR_HOSE = { sides: 6, ribbed: false }

export type Look = 'own' | 'grey' | 'ghost'

/** What is drawn of a robot: its links and hoses as one mesh, and as one of few triangles for a
 * robot that stands far off. */
export class DrawnBody {
  private readonly detail = new LOD()
  private readonly bodies: RobotBody[] = []
  private parts: readonly Part[] = []

  /** root: of the robot. linkOf: the link of a mesh. */
  constructor(
    private readonly root: Object3D,
    private readonly linkOf: (mesh: Mesh) => Object3D | null,
    private readonly hoses: readonly Hose[],
    private readonly looks: Looks,
  ) {}

  /** There is a mesh in place of those of the links. */
  get isMerged(): boolean {
    return this.bodies.length > 0
  }

  /** Take in what lies below the robot, as it is seen nearby. */
  merge(): void {
    const { root } = this
    this.parts = partsBelow(root, this.linkOf)
    const body = this.bodyOf(this.parts, NEAR_HOSE)
    if (body === null) return
    detach(this.parts)
    this.detail.addLevel(body)
    root.add(this.detail)
  }

  /** Add what is seen from afar in place of what came packed. levels: packed files, a child a link. */
  addFar(levels: readonly Object3D[], links: Readonly<Record<string, Object3D>>): void {
    const [near] = this.bodies
    if (near === undefined) return
    const parts = this.parts.filter(({ mesh }) => mesh.userData.packed !== true)
    for (const child of levels.flatMap(({ children }) => children)) {
      const link = links[child.name]
      if (link === undefined) continue
      for (const part of partsBelow(child, () => child)) parts.push({ ...part, link })
    }
    const far = this.bodyOf(parts, FAR_HOSE)
    if (far === null) return
    far.visible = false
    this.detail.addLevel(far, FAR + this.reach(near), HYSTERESIS)
  }

  /** The links have moved, and their frames in the world are computed. */
  follow(): void {
    for (const hose of this.hoses) hose.follow(this.root)
    for (const body of this.bodies) body.follow()
  }

  paint(look: Look, failing: string): void {
    const { looks } = this
    const ghost = look === 'ghost'
    const grey = look === 'grey' || failing !== ''
    const material = ghost ? looks.ghost : grey ? looks.grey : looks.body
    for (const body of this.bodies) {
      body.castShadow = !ghost
      body.receiveShadow = !ghost
      body.renderOrder = ghost ? 1 : 0
      body.paint(material, ghost ? '' : failing, looks.failing)
    }
  }

  release(): void {
    for (const body of this.bodies) body.release()
    this.detail.removeFromParent()
  }

  private bodyOf(parts: readonly Part[], detail: HoseDetail): RobotBody | null {
    const all = [...parts, ...this.hoses.map((hose) => partOf(hose, detail))]
    const body = RobotBody.of(all, this.looks.body, this.looks.shadow)
    if (body !== null) this.bodies.push(body)
    return body
  }

  /** Return how far from its base a body reaches as it stands, m. */
  private reach(body: RobotBody): number {
    const corners: Vector3[] = []
    pushCorners(body, this.root, corners)
    return Math.max(0, ...corners.map((corner) => corner.length()))
  }
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
