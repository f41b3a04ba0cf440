import { type Object3D, Vector3 } from 'three'
import type { RobotView } from '../../lab/followed_robot'
import type { Unsubscribe } from '../../link/link'
import { telemetryReader } from '../../protocol/mrlab_msgs'
import type { LabScene } from '../../scene/lab/lab_scene'
import type { Targets } from '../input/targets'
import type { Arrangement, Shown } from '../layout/arrangement'
import type { Opened } from '../layout/opened'
import { Chip } from '../panels/chip'
import type { Panel, Surroundings } from '../panels/panel'
import type { Catalogue, Frames, Lab, Preferences, Speech } from '../ports'
import type { ControlPanel } from './control'
import { TelemetryPanel } from './telemetry'

const tip = new Vector3()

interface Entry {
  readonly control: ControlPanel
  readonly chip: Chip
  /** Those that have a place in the scene. */
  readonly shown: Shown[]
  telemetry: { readonly panel: TelemetryPanel; readonly undo: Unsubscribe } | null
}

/** The panels of all robots: the open one has controls, the others are chips. */
export class RobotPanels {
  private readonly entries = new Map<string, Entry>()

  /** away: true while robots are chosen or placed, and panels are in the way. carried: a robot is
   * carried now. make: the panel of a robot. */
  constructor(
    private readonly ports: Speech & Lab & Catalogue & Frames & Preferences & Surroundings,
    private readonly parent: Object3D,
    private readonly scene: LabScene,
    private readonly targets: Targets,
    private readonly arrangement: Arrangement,
    private readonly opened: Opened,
    private readonly away: () => boolean,
    private readonly carried: (robot: string) => boolean,
    private readonly make: (robot: RobotView) => ControlPanel,
  ) {}

  /** Return the panel of a robot. */
  of(name: string): ControlPanel | undefined {
    return this.entries.get(name)?.control
  }

  get names(): string[] {
    return [...this.entries.keys()]
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
      const entry = this.entries.get(name) ?? this.add(view)
      const before = entry.control.collisions.length
      entry.control.show(view)
      halts ||= entry.control.collisions.length > before
      this.showChip(entry.chip, view)
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
    for (const { control, chip, telemetry } of this.entries.values()) {
      for (const each of [control, chip, telemetry?.panel]) each?.panel.repaint()
    }
  }

  /** Before each picture. now: s. */
  update(now: number): void {
    for (const [name, entry] of this.entries) {
      entry.control.update(now)
      entry.chip.panel.update()
      this.updateTelemetry(name, entry, now)
    }
  }

  dispose(): void {
    for (const [name, entry] of this.entries) this.remove(name, entry)
  }

  private showChip(chip: Chip, { robot, state, playback }: RobotView): void {
    chip.show({
      name: robot.name,
      state,
      word: this.ports.words.states[state],
      picture: this.ports.robots.find(({ id }) => id === robot.model)?.picture ?? null,
      playable: (playback?.frame_count ?? 0) > 0,
    })
  }

  private add(view: RobotView): Entry {
    const { name } = view.robot
    const control = this.make(view)
    const chip = new Chip(
      this.ports,
      () => this.opened.open(name),
      () => control.play(),
    )
    const entry: Entry = { control, chip, shown: [], telemetry: null }
    this.entries.set(name, entry)
    this.place(name, entry, control.panel, () => this.opened.name === name)
    this.place(name, entry, chip.panel, () => this.opened.name !== name)
    return entry
  }

  /** Give a panel of a robot a place in the scene. */
  private place(robot: string, entry: Entry, panel: Panel, visible: () => boolean): Shown {
    const { scene, away, carried } = this
    const shown: Shown = {
      panel,
      get visible() {
        return visible() && !away()
      },
      get carried() {
        return carried(robot)
      },
      about: (into) => {
        const drawn = scene.robot(robot)
        const base = scene.base(robot)
        if (drawn === undefined || base === undefined) return false
        into.setFromMatrixPosition(base.matrixWorld)
        into.lerp(tip.setFromMatrixPosition(drawn.tip.matrixWorld), 0.5)
        return true
      },
    }
    this.parent.add(panel.group)
    this.targets.add(panel)
    this.arrangement.add(shown)
    entry.shown.push(shown)
    return shown
  }

  private remove(name: string, entry: Entry): void {
    this.entries.delete(name)
    entry.telemetry?.undo()
    for (const shown of entry.shown) this.leave(shown)
    entry.control.dispose()
    entry.chip.panel.dispose()
    entry.telemetry?.panel.dispose()
  }

  private leave(shown: Shown): void {
    this.arrangement.remove(shown)
    this.targets.remove(shown.panel)
  }

  private updateTelemetry(name: string, entry: Entry, now: number): void {
    const robot = this.scene.robot(name)
    const { control } = entry
    if (control.telemetry && entry.telemetry === null && robot !== undefined) {
      const panel = new TelemetryPanel(this.ports, control.joints)
      const shown = this.place(name, entry, panel.panel, () => true)
      const unsubscribe = this.ports.link.subscribe(
        `${name}/telemetry`,
        telemetryReader,
        (message) => panel.take(message),
      )
      const undo = () => {
        unsubscribe()
        this.leave(shown)
        entry.shown.splice(entry.shown.indexOf(shown), 1)
      }
      entry.telemetry = { panel, undo }
    } else if (!control.telemetry && entry.telemetry !== null) {
      entry.telemetry.undo()
      entry.telemetry.panel.dispose()
      entry.telemetry = null
    }
    entry.telemetry?.panel.update(now, (joint) => robot?.angle(joint) ?? 0)
  }
}
