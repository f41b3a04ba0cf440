import {
  ConeGeometry,
  EdgesGeometry,
  Group,
  InstancedMesh,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  TorusGeometry,
} from 'three'
import { Label } from '../stage/labels'
import { type Pose, place } from '../stage/pose'
import type { SceneTheme } from '../stage/theme'

const LENGTH = 0.06 // m, of the pointer along the tool's z
const RADIUS = 0.016 // m
const NUMBER = 0.017 // as a part of the distance to it
const SAME_PLACE = 0.02 // m, between numbers that would hide each other
const MOST_NUMBERS = 24

/** A place at which a trajectory grasps or releases: the fields of mrlab_msgs/msg/GraspTarget. */
export interface ShownTarget {
  /** s from the first frame */
  readonly time: number
  /** true closes, false opens */
  readonly close: boolean
  /** Of tool0 in the robot's base_link, m. */
  readonly tool0: Pose
}

/** Marks at which the loaded trajectory closes the gripper (filled) and opens it (hollow), numbered
 * as in the list beside the picture. */
export class GraspMarks {
  /** To be placed in the robot's base. */
  readonly group = new Group()
  private readonly cone = new ConeGeometry(RADIUS, LENGTH, 20)
    .rotateX(Math.PI / 2)
    .translate(0, 0, -LENGTH / 2)
  private readonly edges = new EdgesGeometry(this.cone, 10)
  private readonly ring = new TorusGeometry(RADIUS * 1.5, 0.0022, 8, 40)
  private readonly fill = new MeshBasicMaterial()
  private readonly line = new LineBasicMaterial()
  private labels: Label[] = []

  set(targets: readonly ShownTarget[], theme: SceneTheme): void {
    this.clear()
    for (const [i, { close, tool0 }] of targets.entries()) {
      const mark = new Group()
      place(mark, tool0)
      mark.add(new Mesh(this.ring, this.fill))
      mark.add(close ? new Mesh(this.cone, this.fill) : new LineSegments(this.edges, this.line))
      this.group.add(mark)
      if (i < MOST_NUMBERS) this.number(String(i + 1), mark)
    }
    this.setTheme(theme)
  }

  setTheme(theme: SceneTheme): void {
    this.fill.color.set(theme.info)
    this.line.color.set(theme.info)
    for (const label of this.labels) label.paint(theme.info, theme.card)
  }

  dispose(): void {
    this.clear()
    this.group.removeFromParent()
    for (const each of [this.cone, this.edges, this.ring, this.fill, this.line]) each.dispose()
  }

  private number(text: string, mark: Group): void {
    const label = new Label(text, NUMBER)
    label.sprite.position.copy(mark.position)
    const beside = this.labels.filter(
      ({ sprite }) => sprite.position.distanceTo(mark.position) < SAME_PLACE,
    )
    label.sprite.center.x -= beside.length * 1.05
    this.labels.push(label)
    this.group.add(label.sprite)
  }

  private clear(): void {
    for (const label of this.labels) label.dispose()
    this.labels = []
    this.group.clear()
  }
}

const MOST = 64
const DOT = 0.012 // m

/** The contact points of robots. */
export class Contacts {
  readonly mesh: InstancedMesh<SphereGeometry, MeshBasicMaterial>
  private readonly matrix = new Matrix4()

  constructor() {
    const material = new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9 })
    this.mesh = new InstancedMesh(new SphereGeometry(DOT, 16, 12), material, MOST)
    this.mesh.count = 0
    this.mesh.renderOrder = 5
    this.mesh.frustumCulled = false
  }

  /** Show contacts at these points of the world, m. */
  set(contacts: readonly { readonly point: { x: number; y: number; z: number } }[]): void {
    this.mesh.count = Math.min(contacts.length, MOST)
    for (let i = 0; i < this.mesh.count; i++) {
      const point = contacts[i]?.point
      if (point !== undefined)
        this.mesh.setMatrixAt(i, this.matrix.makeTranslation(point.x, point.y, point.z))
    }
    this.mesh.instanceMatrix.needsUpdate = true
  }

  setTheme(theme: SceneTheme): void {
    // A grasp is a contact too: red is for collisions.
    this.mesh.material.color.set(theme.info)
  }

  dispose(): void {
    this.mesh.removeFromParent()
    this.mesh.geometry.dispose()
    this.mesh.material.dispose()
    this.mesh.dispose()
  }
}
