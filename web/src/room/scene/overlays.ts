import {
  BoxGeometry,
  Color,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  Quaternion,
  RingGeometry,
  Vector3,
} from 'three'
import type { Link } from '../../link/link'
import { collisionReader, type GraspTarget, graspTargetsReader } from '../../protocol/mrlab_msgs'
import type { LabScene } from '../../scene/lab/lab_scene'
import { Label } from '../../scene/stage/labels'

/** m, edge of the cube at a grasp; most of them a robot. */
const CUBE = 0.05
const MOST = 16
const IMPACT = 0.05 // m
const GRASP = 0x5be0a8
const RELEASE = 0xffe08a

const matrix = new Matrix4()
const tool = new Matrix4()
const place = new Vector3()
const turn = new Quaternion()
const one = new Vector3(1, 1, 1)
const AHEAD = new Vector3(0, 0, 1)
const colour = new Color()

interface Holograms {
  readonly grasps: InstancedMesh<BoxGeometry, MeshBasicMaterial>
  readonly targets: readonly GraspTarget[]
  placed: boolean
}

/** Marks beside the robots: cubes at the grasps and releases of a motion, the place of an impact,
 * and the order in which robots were picked. */
export class Overlays {
  private readonly holograms = new Map<string, Holograms>()
  private readonly impacts = new Map<string, Mesh<RingGeometry, MeshBasicMaterial>>()
  private readonly badges = new Map<string, Label>()
  private readonly cube = new BoxGeometry(CUBE, CUBE, CUBE)
  private readonly ring = new RingGeometry(0.35, 0.5, 40)
  private readonly undo: (() => void)[]

  constructor(
    link: Link,
    private readonly scene: LabScene,
    private readonly world: Object3D,
  ) {
    this.undo = [
      link.subscribe('*/targets', graspTargetsReader, (message, { key }) => {
        this.setTargets(key.slice(0, key.indexOf('/')), message.targets)
      }),
      link.subscribe('*/collision', collisionReader, ({ colliding, contact }, { key }) => {
        const name = key.slice(0, key.indexOf('/'))
        if (!colliding) this.removeImpact(name)
        else this.showImpact(name, contact.point, contact.normal)
      }),
    ]
  }

  /** Before each picture. now: s. */
  update(now: number): void {
    for (const [name, hologram] of this.holograms) {
      if (!hologram.placed) this.placeTargets(name, hologram)
      hologram.grasps.material.opacity = 0.35 + 0.1 * Math.sin(now * 2.5)
    }
    for (const ring of this.impacts.values()) {
      ring.scale.setScalar(IMPACT * (1.4 + 0.5 * Math.sin(now * 5)))
    }
  }

  /** Number the robots that were picked, in order. */
  setPicked(names: readonly string[]): void {
    for (const [name, badge] of this.badges) {
      if (names[Number(badge.text) - 1] === name) continue
      badge.dispose()
      this.badges.delete(name)
    }
    names.forEach((name, i) => {
      const base = this.scene.base(name)
      if (base === undefined || this.badges.has(name)) return
      const badge = new Label(String(i + 1), 0.05)
      badge.paint('#6CB6FF', '#0D1B2A', true)
      badge.sprite.position.z = 0.3
      base.add(badge.sprite)
      this.badges.set(name, badge)
    })
  }

  forget(name: string): void {
    this.setTargets(name, [])
    this.removeImpact(name)
  }

  dispose(): void {
    for (const undo of this.undo) undo()
    for (const name of [...this.holograms.keys()]) this.setTargets(name, [])
    for (const name of [...this.impacts.keys()]) this.removeImpact(name)
    this.setPicked([])
    this.cube.dispose()
    this.ring.dispose()
  }

  private setTargets(name: string, targets: readonly GraspTarget[]): void {
    const before = this.holograms.get(name)
    if (before !== undefined) {
      before.grasps.removeFromParent()
      before.grasps.material.dispose()
      before.grasps.dispose()
      this.holograms.delete(name)
    }
    if (targets.length === 0) return
    const look = { transparent: true, depthWrite: false, toneMapped: false }
    const grasps = new InstancedMesh(this.cube, new MeshBasicMaterial(look), MOST)
    grasps.count = Math.min(targets.length, MOST)
    grasps.frustumCulled = false
    this.holograms.set(name, { grasps, targets: [...targets], placed: false })
  }

  /** Put the cubes between the fingers: at the tip, which is fixed in tool0. */
  private placeTargets(name: string, hologram: Holograms): void {
    const base = this.scene.base(name)
    const robot = this.scene.robot(name)
    if (base === undefined || robot === undefined) return
    hologram.placed = true
    base.add(hologram.grasps)
    const tool0 = robot.root.links.tool0
    tool.identity()
    if (tool0 !== undefined) {
      tool.copy(tool0.matrixWorld).invert().multiply(robot.tip.matrixWorld)
    }
    hologram.targets.slice(0, MOST).forEach(({ tool0: at, close }, i) => {
      const { position: p, orientation: q } = at
      matrix.compose(place.set(p.x, p.y, p.z), turn.set(q.x, q.y, q.z, q.w), one)
      hologram.grasps.setMatrixAt(i, matrix.multiply(tool))
      hologram.grasps.setColorAt(i, colour.set(close ? GRASP : RELEASE))
    })
    hologram.grasps.instanceMatrix.needsUpdate = true
  }

  private showImpact(
    name: string,
    at: { readonly x: number; readonly y: number; readonly z: number },
    normal: { readonly x: number; readonly y: number; readonly z: number },
  ): void {
    let ring = this.impacts.get(name)
    if (ring === undefined) {
      const look = { color: 0xff4d3d, transparent: true, opacity: 0.95, depthTest: false }
      ring = new Mesh(this.ring, new MeshBasicMaterial({ ...look, toneMapped: false, side: 2 }))
      ring.renderOrder = 6
      this.world.add(ring)
      this.impacts.set(name, ring)
    }
    ring.position.set(at.x, at.y, at.z)
    turn.setFromUnitVectors(AHEAD, place.set(normal.x, normal.y, normal.z).normalize())
    ring.quaternion.copy(turn)
  }

  private removeImpact(name: string): void {
    const ring = this.impacts.get(name)
    this.impacts.delete(name)
    ring?.removeFromParent()
    ring?.material.dispose()
  }
}
