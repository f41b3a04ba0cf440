import { type Object3D, Vector3 } from 'three'
import type { SystemView } from '../../lab/follower'
import type { LabScene } from '../../scene/lab/lab_scene'
import type { Targets } from '../input/targets'
import { Stand } from '../panels/stand'
import type { Frames, Preferences } from '../ports'
import { SystemPanel, type SystemPorts } from './system_panel'

/** m: the place of the panel, beside the members, on the person's side, below their eyes. */
const BESIDE = 0.72
const TOWARDS = 0.35
const BELOW_EYES = 0.28
const LOWEST = 0.75
const LOWEST_SEATED = 0.5

const UP = new Vector3(0, 1, 0)
const middle = new Vector3()
const toHead = new Vector3()
const side = new Vector3()
const at = new Vector3()

interface Entry {
  readonly panel: SystemPanel
  readonly stand: Stand
}

/** One panel for each robot system, beside its members. */
export class SystemPanels {
  private readonly entries = new Map<string, Entry>()

  constructor(
    private readonly ports: SystemPorts & Frames & Preferences,
    private readonly parent: Object3D,
    private readonly scene: LabScene,
    private readonly targets: Targets,
  ) {}

  /** Return the panel of a system. */
  of(name: string): SystemPanel | undefined {
    return this.entries.get(name)?.panel
  }

  /** Take over the systems that there are. */
  show(views: readonly SystemView[]): void {
    for (const view of views) {
      const entry = this.entries.get(view.system.name)
      if (entry !== undefined) entry.panel.show(view)
      else this.add(view)
    }
    for (const name of this.entries.keys()) {
      if (!views.some(({ system }) => system.name === name)) this.remove(name)
    }
  }

  repaint(): void {
    for (const { panel } of this.entries.values()) panel.panel.repaint()
  }

  /** Before each picture. now, step: s. */
  update(now: number, step: number): void {
    for (const { panel, stand } of this.entries.values()) {
      this.place(panel, stand, now, step)
      panel.update(now)
    }
  }

  dispose(): void {
    for (const name of [...this.entries.keys()]) this.remove(name)
  }

  private add(view: SystemView): void {
    const panel = new SystemPanel(this.ports, view)
    this.parent.add(panel.panel.group)
    this.targets.add(panel.panel)
    this.entries.set(view.system.name, { panel, stand: new Stand(panel.panel.group) })
  }

  private remove(name: string): void {
    const entry = this.entries.get(name)
    if (entry === undefined) return
    this.entries.delete(name)
    this.targets.remove(entry.panel.panel)
    entry.panel.dispose()
  }

  private place(panel: SystemPanel, stand: Stand, now: number, step: number): void {
    const { head, leftHanded, seated } = this.ports
    middle.set(0, 0, 0)
    let count = 0
    for (const { robot } of panel.members) {
      const base = this.scene.base(robot)
      if (base === undefined) continue
      middle.add(at.setFromMatrixPosition(base.matrixWorld))
      count++
    }
    panel.panel.group.visible = count > 0
    if (count === 0) return
    middle.divideScalar(count)
    toHead.subVectors(head, middle).setY(0)
    if (toHead.lengthSq() < 1e-4) toHead.set(0, 0, 1)
    toHead.normalize()
    side.crossVectors(UP, toHead).multiplyScalar(leftHanded ? -1 : 1)
    // beside the member that is farthest to that side
    let out = 0
    for (const { robot } of panel.members) {
      const base = this.scene.base(robot)
      if (base === undefined) continue
      at.setFromMatrixPosition(base.matrixWorld).sub(middle)
      out = Math.max(out, at.dot(side))
    }
    at.copy(middle)
      .addScaledVector(side, out + BESIDE)
      .addScaledVector(toHead, TOWARDS)
    at.y = Math.max(head.y - BELOW_EYES, seated ? LOWEST_SEATED : LOWEST)
    const held = panel.panel.pointers > 0
    if (stand.update(at, head, now, step, held, this.ports)) this.ports.stir()
  }
}
