import {
  BoxGeometry,
  EdgesGeometry,
  Group,
  LineSegments,
  type Material,
  Matrix4,
  Mesh,
  MeshPhongMaterial,
  Object3D,
  Quaternion,
  Vector3,
} from 'three'
import URDFLoader, { type URDFJoint, type URDFMimicJoint, type URDFRobot } from 'urdf-loader'
import type { ShadowFit } from '../stage/shadow_fit'
import { Chain, type ChainJoint } from './chain'
import { DrawnBody, type Look } from './drawn_body'
import { Hose } from './hose'
import { hosesOf, type Level, levelsOf } from './levels'
import type { Looks } from './looks'
import type { MeshSource } from './meshes'
import { type Turn, turnOf } from './turn'

const PLACEHOLDER = 0.09 // m, edge of the box that stands for a missing mesh
const ONE = new Vector3(1, 1, 1)

interface Movable {
  readonly joint: URDFJoint
  readonly axis: Vector3
  readonly restPosition: Vector3
  readonly restTurn: Quaternion
  readonly prismatic: boolean
  readonly followers: readonly { movable: Movable; multiplier: number; offset: number }[]
  readonly upper: number
  readonly lower: number
  value: number
  /** It was moved at least once. */
  placed: boolean
}

interface Wanted {
  readonly uri: string
  readonly done: (object: Object3D) => void
}

/** A robot of a URDF that moves: no joint is clamped, so a refused pose looks refused. */
export class SceneRobot {
  readonly root: URDFRobot
  /** The files of meshes that could not be read; each has a placeholder. */
  readonly troubles: string[] = []
  /** Resolves when every mesh, or its placeholder, is loaded. */
  readonly ready: Promise<void>
  /** The number of meshes, and the number of those loaded. */
  meshCount = 0
  meshesHere = 0
  /** The frame that works: the end effector's tcp, else tool0, else the last link. */
  readonly tip: Object3D
  /** The flange's frame, in which a held object is placed. */
  readonly tool: Object3D
  private readonly movables = new Map<string, Movable>()
  private readonly ordered: (Movable | undefined)[]
  private readonly fingers: Movable[] = []
  private readonly own = new Map<Mesh, Material | Material[]>()
  private readonly placeholder = new EdgesGeometry(
    new BoxGeometry(PLACEHOLDER, PLACEHOLDER, PLACEHOLDER),
  )
  private readonly body: DrawnBody
  private disposed = false
  private look: Look = 'own'
  private failing = ''
  private readonly turn = new Quaternion()
  /** No joint has moved since its frames were last computed, below `above`. */
  private settled = false
  private readonly above = new Matrix4()

  /** jointNames: in the order of positions. changed: called when a picture is due. */
  constructor(
    urdf: string,
    jointNames: readonly string[],
    meshes: MeshSource,
    private readonly looks: Looks,
    private readonly changed: () => void,
  ) {
    const loader = new URDFLoader()
    loader.packages = (name) => `package://${name}`
    const description = new DOMParser().parseFromString(urdf, 'text/xml')
    const levels = levelsOf(description)
    const wanted: Wanted[] = []
    loader.loadMeshCb = (uri, _manager, _material, done) => wanted.push({ uri, done })
    this.root = loader.parse(description)
    const { links } = this.root
    const hoses = hosesOf(description).flatMap((stated) => Hose.between(stated, links) ?? [])
    this.body = new DrawnBody(this.root, linkAbove, hoses, looks, changed)
    this.meshCount = wanted.length
    this.root.updateMatrixWorld = () => this.settle()
    for (const joint of Object.values(this.root.joints)) {
      joint.ignoreLimits = true
      if (joint.jointType !== 'fixed') this.movables.set(joint.urdfName, movable(joint))
    }
    for (const joint of Object.values(this.root.joints)) {
      const mimic = joint as URDFMimicJoint
      if (mimic.mimicJoint === undefined) continue
      const leader = this.movables.get(mimic.mimicJoint)
      const follower = this.movables.get(joint.urdfName)
      if (leader === undefined || follower === undefined) continue
      const { multiplier, offset } = mimic
      ;(leader.followers as Movable['followers'][number][]).push({
        movable: follower,
        multiplier,
        offset,
      })
    }
    this.ordered = jointNames.map((name) => this.movables.get(name))
    for (const [name, found] of this.movables) {
      const mimics = (found.joint as URDFMimicJoint).mimicJoint !== undefined
      if (!jointNames.includes(name) && !mimics) this.fingers.push(found)
    }
    const last = this.root.joints[jointNames[jointNames.length - 1] ?? '']
    this.tip = this.root.links.tcp ?? this.root.links.tool0 ?? last ?? this.root
    this.tool = this.root.links.tool0 ?? this.tip
    const painted = new Set<Material>()
    this.root.traverse((node) => {
      if (!(node instanceof Mesh)) return
      painted.add(node.material as Material)
      this.adopt(node)
    })
    // urdf-loader takes the numbers of a description, which are sRGB, for light
    for (const each of painted)
      if (each instanceof MeshPhongMaterial) each.color.convertSRGBToLinear()
    this.ready = this.load(wanted, levels, meshes).then(() => this.merge(levels, meshes))
  }

  get jointNames(): string[] {
    return [...this.movables.keys()]
  }

  /** Move the joints, rad or m, in the order of the names given at the start. */
  setPositions(positions: ArrayLike<number>): void {
    for (let i = 0; i < this.ordered.length; i++) {
      const found = this.ordered[i]
      const value = positions[i]
      if (found !== undefined && value !== undefined) this.move(found, value)
    }
  }

  /** Return the position of a joint, rad or m. */
  angle(joint: string): number | undefined {
    return this.movables.get(joint)?.value
  }

  /** Move one joint by its name, rad or m; return whether there is one and it moves. */
  setJoint(name: string, value: number): boolean {
    const found = this.movables.get(name)
    if (found === undefined || found.value === value) return false
    this.move(found, value)
    return true
  }

  /** Move the fingers of the end effector: 0 is open, their upper limit closed. */
  setGripper(closed: boolean): void {
    for (const finger of this.fingers) this.move(finger, closed ? finger.upper : finger.lower)
  }

  /** Return the chain from its base to its tip, with the arm's joints in the order of its
   * positions; other joints stay as they are now. */
  chain(): Chain {
    const places = new Map(this.ordered.map((found, place) => [found?.joint, place] as const))
    const joints: ChainJoint[] = []
    const between = new Matrix4()
    const path: Object3D[] = []
    for (let node: Object3D | null = this.tip; node !== null && node !== this.root; ) {
      path.unshift(node)
      node = node.parent
    }
    for (const node of path) {
      const found = [...this.movables.values()].find(({ joint }) => joint === node)
      const place = found === undefined ? undefined : places.get(found.joint)
      if (found === undefined || place === undefined) {
        node.updateMatrix()
        between.multiply(node.matrix)
        continue
      }
      const rest = new Matrix4().compose(found.restPosition, found.restTurn, ONE)
      const { axis, prismatic, lower, upper } = found
      joints.push({ rest: between.clone().multiply(rest), axis, prismatic, lower, upper, place })
      between.identity()
    }
    return new Chain(joints, between)
  }

  /** Return where a joint turns; null: it slides, or there is none. */
  turnOf(joint: string): Turn | null {
    const found = this.movables.get(joint)
    if (found === undefined || found.prismatic) return null
    return turnOf(joint, found, this.tip, [...this.movables.values()])
  }

  /** Return the height of its body or joints above its base, m, as it was last drawn. */
  height(): number {
    const base = this.root.matrixWorld.elements[13] as number
    let highest = Math.max(0, this.body.top() - base)
    for (const { joint } of this.movables.values()) {
      // the scene's y is the world's z
      highest = Math.max(highest, (joint.matrixWorld.elements[13] as number) - base)
    }
    return highest
  }

  /** Widen a shadow to its present place. */
  castInto(shadow: ShadowFit): void {
    this.body.castInto(shadow)
  }

  /** Return how wide the part of it is that no joint moves, m; 0 until it is drawn. */
  footprint(): number {
    return this.body.widthOf((link) => stands(link, this.root))
  }

  /** Return the link that a joint moves; empty: there is no such joint. */
  linkOf(joint: string): string {
    const found = this.root.joints[joint]
    const link = found?.children.find((child) => 'isURDFLink' in child)
    return link?.name ?? ''
  }

  /** Show the robot unpainted, grey, or as a ghost; `failing` names a link that is painted. */
  setLook(look: Look, failing = ''): void {
    if (look === this.look && failing === this.failing) return
    this.look = look
    this.failing = failing
    for (const [mesh, material] of this.own) this.paint(mesh, material)
    this.body.paint(look, failing)
    this.changed()
  }

  dispose(): void {
    this.disposed = true
    this.placeholder.dispose()
    this.body.release()
    this.root.removeFromParent()
  }

  /** Compute where its frames are, unless nothing has moved: most of the nodes of a scene are
   * links. */
  private settle(): void {
    const { root } = this
    const above = root.parent?.matrixWorld
    if (this.settled && above?.equals(this.above)) return
    Object3D.prototype.updateMatrixWorld.call(root, true)
    this.settled = true
    this.body.follow()
    if (above !== undefined) this.above.copy(above)
  }

  private move(found: Movable, value: number): void {
    const { joint, axis } = found
    if (found.value === value && found.placed) return
    found.placed = true
    found.value = value
    this.settled = false
    if (found.prismatic) {
      joint.position.copy(axis).applyQuaternion(found.restTurn).multiplyScalar(value)
      joint.position.add(found.restPosition)
    } else {
      this.turn.setFromAxisAngle(axis, value)
      joint.quaternion.multiplyQuaternions(found.restTurn, this.turn)
    }
    joint.updateMatrix()
    for (const { movable: follower, multiplier, offset } of found.followers) {
      this.move(follower, value * multiplier + offset)
    }
  }

  private missing(uri: string, error: unknown): Object3D {
    console.warn(`${uri}:`, error)
    this.troubles.push(uri.slice(uri.lastIndexOf('/') + 1))
    const group = new Group()
    group.add(new LineSegments(this.placeholder, this.looks.missing))
    return group
  }

  private adopt(object: Object3D): void {
    this.settled = false
    object.traverse((node) => {
      if (!(node instanceof Mesh)) return
      const material = node.material as Material | Material[]
      if (!this.own.has(node)) this.own.set(node, material)
      this.paint(node, this.own.get(node) ?? material)
    })
  }

  /** Fetch all meshes, those of a model in one packed file where its description names such. */
  private async load(
    wanted: readonly Wanted[],
    levels: readonly Level[],
    meshes: MeshSource,
  ): Promise<void> {
    const one = async ({ uri, done }: Wanted) => {
      const object = await meshes.load(uri).catch((error: unknown) => this.missing(uri, error))
      done(object)
      this.arrived([object], 1)
    }
    const rest = wanted.filter(({ uri }) => !levels.some((level) => uri.startsWith(level.meshes)))
    const packed = levels.map(async ({ meshes: start, near }) => {
      const own = wanted.filter(({ uri }) => uri.startsWith(start))
      if (own.length === 0) return
      try {
        const { children } = await meshes.load(near)
        this.arrived(this.attach([...children]), own.length)
      } catch {
        // such as in a page that holds the meshes of the links alone
        await Promise.all(own.map(one))
      }
    })
    await Promise.all([...rest.map(one), ...packed])
  }

  /** Put the links of a packed file in their places. */
  private attach(found: readonly Object3D[]): readonly Object3D[] {
    for (const child of found) {
      child.traverse((node) => {
        node.userData.packed = true
      })
      this.root.links[child.name]?.add(child)
    }
    return found
  }

  /** True once the meshes, or their placeholders, are loaded. */
  private arrived(objects: readonly Object3D[], meshes: number): void {
    this.meshesHere += meshes
    for (const object of objects) this.adopt(object)
    this.changed()
  }

  /** Draw the links as one mesh from now on, and from afar as one of few triangles. */
  private merge(levels: readonly Level[], meshes: MeshSource): void {
    if (this.disposed) return
    // A robot that collided while it was loaded is painted: make its body from its unpainted look.
    for (const [mesh, material] of this.own) mesh.material = material
    this.body.merge()
    this.settleBody()
    if (levels.length === 0) return
    Promise.all(levels.map(({ far }) => meshes.load(far))).then(
      (far) => {
        if (this.disposed) return
        this.body.addFar(far, this.root.links)
        this.settleBody()
      },
      // The near level is drawn from afar, too.
      () => undefined,
    )
  }

  private settleBody(): void {
    for (const mesh of [...this.own.keys()]) {
      if (!isBelow(mesh, this.root)) this.own.delete(mesh)
    }
    this.rest()
    this.body.paint(this.look, this.failing)
    this.changed()
  }

  /** Freeze matrices that no longer change: of a link in its joint, and of links that the body
   * draws. */
  private rest(): void {
    this.settled = false
    this.root.traverse((node) => {
      node.updateMatrix()
      node.matrixAutoUpdate = false
    })
    if (!this.body.isMerged) return
    for (const child of this.root.children) child.visible = isDrawn(child)
  }

  private paint(mesh: Mesh, own: Material | Material[]): void {
    const link = linkAbove(mesh)?.name ?? ''
    const ghost = this.look === 'ghost'
    mesh.castShadow = !ghost
    mesh.receiveShadow = !ghost
    mesh.renderOrder = ghost ? 1 : 0
    if (ghost) mesh.material = this.looks.ghost
    else if (this.failing !== '' && link === this.failing) mesh.material = this.looks.failing
    else if (this.look === 'grey' || this.failing !== '') mesh.material = this.looks.grey
    else mesh.material = own
  }
}

function movable(joint: URDFJoint): Movable {
  return {
    joint,
    axis: joint.axis.clone(),
    restPosition: joint.position.clone(),
    restTurn: joint.quaternion.clone(),
    prismatic: joint.jointType === 'prismatic',
    followers: [],
    upper: joint.limit.upper,
    lower: joint.limit.lower,
    value: 0,
    placed: false,
  }
}

function linkAbove(object: Object3D): Object3D | null {
  for (let node: Object3D | null = object; node !== null; node = node.parent) {
    if ('isURDFLink' in node || 'isURDFRobot' in node) return node
  }
  return null
}

/** Return whether a link is fixed to the base of its robot. */
function stands(link: Object3D, root: Object3D): boolean {
  for (let node: Object3D | null = link; node !== null; node = node.parent) {
    if (node === root) return true
    const { jointType } = node as URDFJoint
    if (jointType !== undefined && jointType !== 'fixed') return false
  }
  return false
}

/** Return whether an object or one of its descendants can be drawn. */
function isDrawn(object: Object3D): boolean {
  const own = object instanceof Mesh || object instanceof LineSegments
  return own || object.children.some(isDrawn)
}

function isBelow(object: Object3D, root: Object3D): boolean {
  for (let node: Object3D | null = object; node !== null; node = node.parent) {
    if (node === root) return true
  }
  return false
}
