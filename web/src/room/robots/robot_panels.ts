import { type Object3D, Vector3 } from 'three'
import type { RobotView } from '../../lab/followed_robot'
import type { Unsubscribe } from '../../link/link'
import { telemetryReader } from '../../protocol/mrlab_msgs'
import type { LabScene } from '../../scene/lab/lab_scene'
import type { Targets } from '../input/targets'
import type { Surroundings } from '../panels/panel'
import { Stand } from '../panels/stand'
import type { Frames, Lab, Preferences, Speech } from '../ports'
import type { ControlPanel } from './control'
import { TelemetryPanel } from './telemetry'

/** m */
const LEAST_SIDE = 0.72
const TOWARDS = 0.3
const BELOW_EYES = 0.32
const LOWEST = 0.75
const LOWEST_SEATED = 0.5
const BETWEEN = 0.66

const UP = new Vector3(0, 1, 0)
const toHead = new Vector3()
const side = new Vector3()
const at = new Vector3()
const base = new Vector3()

interface Entry {
  readonly control: ControlPanel
  readonly stand: Stand
  telemetry: { readonly panel: TelemetryPanel; readonly undo: Unsubscribe } | null
  /** m: the largest reach of the arm so far. */
  reach: number
}

/** The control panels of all robots, each at its robot on the person's side. */
export class RobotPanels {
  private readonly entries = new Map<string, Entry>()

  /** away: true while robots are chosen or placed, and panels are in the way. make: the panel of a
   * robot. */
  constructor(
    private readonly ports: Speech & Lab & Frames & Preferences & Surroundings,
    private readonly parent: Object3D,
    private readonly scene: LabScene,
    private readonly targets: Targets,
    private readonly away: () => boolean,
    private readonly make: (robot: RobotView) => ControlPanel,
  ) {}

  /** Return the panel of a robot. */
  of(name: string): ControlPanel | undefined {
    return this.entries.get(name)?.control
  }

  /** Take over the present robots; return whether one has begun to halt. Members of a system have
   * no panels of their own: the system has one for all. */
  show(views: readonly RobotView[]): boolean {
    let halts = false
    const wanted = new Set<string>()
    for (const view of views) {
      const { name } = view.robot
      if (view.playback?.system) continue
      wanted.add(name)
      const entry = this.entries.get(name)
      if (entry === undefined) this.add(view)
      else {
        const before = entry.control.collisions.length
        entry.control.show(view)
        halts ||= entry.control.collisions.length > before
      }
    }
    for (const [name, entry] of this.entries) if (!wanted.has(name)) this.remove(name, entry)
    return halts
  }

  /** Number of completed drags of all timelines. */
  get scrubs(): number {
    let count = 0
    for (const { control } of this.entries.values()) count += control.scrubs
    return count
  }

  repaint(): void {
    for (const { control } of this.entries.values()) control.panel.repaint()
  }

  /** Before each picture. now, step: s. */
  update(now: number, step: number): void {
    for (const [name, entry] of this.entries) {
      this.place(name, entry, now, step)
      entry.control.update(now)
      this.updateTelemetry(name, entry, now)
    }
  }

  dispose(): void {
    for (const [name, entry] of this.entries) this.remove(name, entry)
  }

  private add(view: RobotView): void {
    const { name } = view.robot
    const control = this.make(view)
    this.parent.add(control.panel.group)
    this.targets.add(control.panel)
    const stand = new Stand(control.panel.group)
    this.entries.set(name, { control, stand, telemetry: null, reach: 0 })
  }

  private remove(name: string, entry: Entry): void {
    this.entries.delete(name)
    this.targets.remove(entry.control.panel)
    entry.control.dispose()
    entry.telemetry?.undo()
    entry.telemetry?.panel.dispose()
  }

  private place(name: string, entry: Entry, now: number, step: number): void {
    const frame = this.scene.base(name)
    const robot = this.scene.robot(name)
    entry.control.panel.group.visible = frame !== undefined && !this.away()
    if (frame === undefined || robot === undefined) return
    const { head, leftHanded, seated } = this.ports
    base.setFromMatrixPosition(frame.matrixWorld)
    at.setFromMatrixPosition(robot.tip.matrixWorld)
    entry.reach = Math.max(entry.reach, 0.8 * at.distanceTo(base))
    toHead.subVectors(head, base).setY(0)
    if (toHead.lengthSq() < 1e-4) toHead.set(0, 0, 1)
    toHead.normalize()
    side.crossVectors(UP, toHead).multiplyScalar(leftHanded ? -1 : 1)
    at.copy(base)
      .addScaledVector(side, Math.max(entry.reach, LEAST_SIDE))
      .addScaledVector(toHead, TOWARDS)
    at.y = Math.max(head.y - BELOW_EYES, seated ? LOWEST_SEATED : LOWEST)
    const held = entry.control.panel.pointers > 0
    if (entry.stand.update(at, head, now, step, held, this.ports)) this.ports.stir()
  }

  private updateTelemetry(name: string, entry: Entry, now: number): void {
    const robot = this.scene.robot(name)
    const { control } = entry
    if (control.telemetry && entry.telemetry === null && robot !== undefined) {
      const panel = new TelemetryPanel(this.ports, control.joints)
      panel.panel.group.position.x = BETWEEN
      control.panel.group.add(panel.panel.group)
      this.targets.add(panel.panel)
      const undo = this.ports.link.subscribe(`${name}/telemetry`, telemetryReader, (message) =>
        panel.take(message),
      )
      const gone = () => {
        undo()
        this.targets.remove(panel.panel)
      }
      entry.telemetry = { panel, undo: gone }
    } else if (!control.telemetry && entry.telemetry !== null) {
      entry.telemetry.undo()
      entry.telemetry.panel.dispose()
      entry.telemetry = null
    }
    entry.telemetry?.panel.update(now, (joint) => robot?.angle(joint) ?? 0)
  }
}
