import { type Object3D, Vector3 } from 'three'
import type { SystemView } from '../../lab/follower'
import type { LabScene } from '../../scene/lab/lab_scene'
import type { Targets } from '../input/targets'
import type { Arrangement, Shown } from '../layout/arrangement'
import type { Opened } from '../layout/opened'
import { Chip } from '../panels/chip'
import type { Panel } from '../panels/panel'
import { SystemPanel, type SystemPorts, stateOf } from './system_panel'

/** m above the bases: about where the arms are. */
const HIGH = 0.4

const at = new Vector3()

interface Entry {
  readonly panel: SystemPanel
  readonly chip: Chip
  readonly shown: readonly Shown[]
}

/** The panels of all robot systems: the open one has controls, the others are chips. */
export class SystemPanels {
  private readonly entries = new Map<string, Entry>()

  constructor(
    private readonly ports: SystemPorts,
    private readonly parent: Object3D,
    private readonly scene: LabScene,
    private readonly targets: Targets,
    private readonly arrangement: Arrangement,
    private readonly opened: Opened,
    private readonly away: () => boolean,
  ) {}

  /** Return the panel of a system. */
  of(name: string): SystemPanel | undefined {
    return this.entries.get(name)?.panel
  }

  get names(): string[] {
    return [...this.entries.keys()]
  }

  /** Take over the systems that there are. */
  show(views: readonly SystemView[]): void {
    for (const view of views) {
      const { system } = view
      const entry = this.entries.get(system.name) ?? this.add(view)
      entry.panel.show(view)
      const state = stateOf(system)
      const word = this.ports.words.states[state]
      entry.chip.show({ name: system.name, state, word, picture: null, playable: true })
    }
    for (const name of this.entries.keys()) {
      if (!views.some(({ system }) => system.name === name)) this.remove(name)
    }
  }

  repaint(): void {
    for (const { panel, chip } of this.entries.values()) {
      panel.panel.repaint()
      chip.panel.repaint()
    }
  }

  /** Before each picture. now: s. */
  update(now: number): void {
    for (const { panel, chip } of this.entries.values()) {
      panel.update(now)
      chip.panel.update()
    }
  }

  dispose(): void {
    for (const name of [...this.entries.keys()]) this.remove(name)
  }

  private add(view: SystemView): Entry {
    const { name } = view.system
    const panel = new SystemPanel(this.ports, view, () => this.opened.close())
    const chip = new Chip(
      this.ports,
      () => this.opened.open(name),
      () => panel.play(),
    )
    const shown = [
      this.place(panel, panel.panel, () => this.opened.name === name),
      this.place(panel, chip.panel, () => this.opened.name !== name),
    ]
    const entry = { panel, chip, shown }
    this.entries.set(name, entry)
    return entry
  }

  private remove(name: string): void {
    const entry = this.entries.get(name)
    if (entry === undefined) return
    this.entries.delete(name)
    for (const shown of entry.shown) {
      this.arrangement.remove(shown)
      this.targets.remove(shown.panel)
    }
    entry.panel.dispose()
    entry.chip.panel.dispose()
  }

  /** Give a panel of a system a place in the scene, beside the middle of its members. */
  private place(system: SystemPanel, panel: Panel, visible: () => boolean): Shown {
    const { scene, away } = this
    const shown: Shown = {
      panel,
      carried: false,
      get visible() {
        return visible() && !away()
      },
      about: (into) => {
        into.set(0, 0, 0)
        let count = 0
        for (const { robot } of system.members) {
          const base = scene.base(robot)
          if (base === undefined) continue
          into.add(at.setFromMatrixPosition(base.matrixWorld))
          count++
        }
        if (count > 0) into.divideScalar(count).setY(into.y + HIGH)
        return count > 0
      },
    }
    this.parent.add(panel.group)
    this.targets.add(panel)
    this.arrangement.add(shown)
    return shown
  }
}
