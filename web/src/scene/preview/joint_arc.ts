import { Color, DoubleSide, Group, Mesh, MeshBasicMaterial, RingGeometry, Vector3 } from 'three'
import { fixed } from '../../words/words'
import type { SceneRobot } from '../robot/robot'
import { placeTurn, type Turn } from '../robot/turn'
import { Label } from '../stage/labels'
import type { SceneTheme } from '../stage/theme'

const DEGREES = 180 / Math.PI
const MOST_RADIUS = 0.32 // m
const LEAST_RADIUS = 0.12
const LINE = 0.025 // rad, half the width of a line towards the axis
const STEP = 0.05 // rad, of a segment
const LABEL = 0.022 // as a part of the distance to it

/** What a joint may turn and how far a motion turns it beyond, as an arc at the joint. */
export class JointArc {
  readonly group = new Group()
  /** The limit, such as 180°. */
  readonly label = new Label('', LABEL)
  private readonly beyond = plain(0.45)
  private readonly allowed = plain(0.55)
  private readonly line = plain(1)
  private readonly needle = new Mesh(new RingGeometry(0, 1, 1, 1, -LINE, 2 * LINE), plain(1))
  private turn: Turn | null = null
  private readonly at = new Vector3()

  constructor() {
    this.group.matrixAutoUpdate = false
    this.group.visible = false
    this.label.sprite.visible = false
    this.needle.renderOrder = 8
  }

  /** Show the limit, how far the joint turns beyond it, and its other limit, rad. */
  set(turn: Turn, limit: number, worst: number, other: number): void {
    this.turn = turn
    const radius = Math.min(Math.max(turn.length * 0.7, LEAST_RADIUS), MOST_RADIUS)
    const range = Math.min(Math.abs(limit - other), 2 * Math.PI) * Math.sign(other - limit)
    this.add(this.allowed, radius * 0.94, radius, limit, limit + range)
    this.add(this.beyond, 0, radius, limit, worst)
    this.add(this.line, 0, radius * 1.15, limit - LINE / 2, limit + LINE / 2)
    this.needle.scale.setScalar(radius * 1.05)
    this.group.add(this.needle)
    this.label.text = `${fixed(limit * DEGREES, 0)}°`
    this.at.set(Math.cos(limit), Math.sin(limit), 0).multiplyScalar(radius * 1.2)
    this.group.visible = true
    this.label.sprite.visible = true
  }

  clear(): void {
    this.turn = null
    this.group.visible = false
    this.label.sprite.visible = false
    for (const child of [...this.group.children]) {
      child.removeFromParent()
      if (child !== this.needle) (child as Mesh).geometry.dispose()
    }
  }

  /** Follow the joint as the robot is posed now. */
  follow(robot: SceneRobot): void {
    if (this.turn === null) return
    placeTurn(robot.root, this.turn, this.group.matrix)
    this.group.matrixWorldNeedsUpdate = true
    this.needle.rotation.z = robot.angle(this.turn.joint) ?? 0
    this.label.sprite.position.copy(this.at).applyMatrix4(this.group.matrix)
  }

  setTheme(theme: SceneTheme): void {
    this.beyond.color = new Color(theme.failing)
    this.line.color = new Color(theme.error)
    this.allowed.color = new Color(theme.info)
    ;(this.needle.material as MeshBasicMaterial).color = new Color(theme.ink)
    this.label.paint(theme.card, theme.error)
  }

  dispose(): void {
    this.clear()
    this.label.dispose()
    this.needle.geometry.dispose()
    for (const each of [this.beyond, this.allowed, this.line]) each.dispose()
    ;(this.needle.material as MeshBasicMaterial).dispose()
  }

  private add(
    material: MeshBasicMaterial,
    inner: number,
    outer: number,
    from: number,
    to: number,
  ): void {
    const steps = Math.max(Math.ceil(Math.abs(to - from) / STEP), 1)
    const start = Math.min(from, to)
    const shape = new RingGeometry(inner, outer, steps, 1, start, Math.abs(to - from))
    const mesh = new Mesh(shape, material)
    mesh.renderOrder = 7
    this.group.add(mesh)
  }
}

function plain(opacity: number): MeshBasicMaterial {
  return new MeshBasicMaterial({
    side: DoubleSide,
    depthTest: false,
    depthWrite: false,
    transparent: true,
    toneMapped: false,
    opacity,
  })
}
