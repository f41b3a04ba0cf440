import { signal } from '@preact/signals'
import { Quaternion, Vector3 } from 'three'
import type { LabFollower } from '../lab/follower'
import { type TrajectoryInfo, trajectoryCatalogueReader } from '../protocol/mrlab_msgs'
import { LabScene } from '../scene/lab/lab_scene'
import type { ShownSurface } from '../scene/lab/surfaces'
import { MeshLibrary } from '../scene/robot/meshes'
import { named } from '../words/words'
import { Board } from './board/board'
import { BoardPlace } from './board/board_place'
import { boardTabs } from './board/board_tabs'
import type { Fixtures, RoomParts } from './fixtures'
import { followedScene, listen, roomFollower } from './follow'
import { Frame } from './frame'
import { ObjectHandles } from './handles/object_handles'
import { Mouse } from './input/mouse'
import { Targets } from './input/targets'
import { Stats } from './latency'
import { soundFeedback } from './panels/feedback'
import { pauseNews } from './people/pausing'
import { People } from './people/people'
import { Alignment, SEATED } from './place/alignment'
import { SceneAnchor } from './place/anchor'
import { orderSurfaces, RoomScan } from './place/scan'
import { Spawning } from './place/spawning'
import { type Support, supportsOf } from './place/supports'
import { TouchAlignment } from './place/touch_alignment'
import { RobotPanels } from './robots/robot_panels'
import { RoomRobots } from './robots/robots'
import { contextOf } from './room_context'
import { Drawings } from './scene/drawings'
import { Overlays } from './scene/overlays'
import { RoomStage } from './scene/stage'
import type { Feature, Mode } from './session/features'
import { applySettings, deviceId, randomId, Settings } from './session/settings'
import { Visit } from './session/visit'
import { Creation } from './systems/creation'
import { SystemPanels } from './systems/system_panels'
import { Guide } from './tour/guide'

/** The lab in a person's room: wires what the folders beside it do, once a frame. */
export class Room implements Fixtures {
  readonly troubles = signal<readonly string[]>([])
  readonly head = new Vector3().copy(SEATED.head)
  readonly look = new Quaternion()
  readonly follower: LabFollower
  readonly board: Board
  readonly panels: RobotPanels
  readonly systems: SystemPanels
  readonly stage: RoomStage
  readonly scan: RoomScan
  readonly anchor: SceneAnchor
  readonly scene: LabScene
  readonly robots: RoomRobots
  readonly visit: Visit
  readonly creation: Creation
  readonly settings = new Settings()
  readonly people: People
  readonly touching: TouchAlignment
  readonly guide: Guide
  /** Frames drawn, and ms of JavaScript of the newest one. */
  frames = 0
  frameMs = 0
  /** Of the room, those that have an end. */
  surfaces: readonly ShownSurface[] = []
  supports: readonly Support[] = supportsOf([])
  trajectories: readonly TrajectoryInfo[] = []
  private readonly targets: Targets
  private readonly meshes = new MeshLibrary()
  readonly overlays: Overlays
  readonly objects: ObjectHandles
  readonly drawings: Drawings
  readonly stats: Stats
  readonly spawning: Spawning
  readonly alignment: Alignment
  readonly mouse: Mouse
  readonly boardPlace: BoardPlace
  private readonly sound: ReturnType<typeof soundFeedback>
  private readonly undo: readonly (() => void)[]

  /** Throws NoWebGL where the browser has none. */
  constructor(parts: RoomParts) {
    const { link, words } = parts
    this.stage = new RoomStage(parts.container, words.room.picture)
    this.scene = new LabScene(this.stage, this.meshes, () => {
      this.troubles.value = [...this.scene.troubles]
    })
    this.scene.setStill(() => this.settings.still.value)
    this.sound = soundFeedback((signal, strength, ms) =>
      this.visit.inputs?.pulse(signal.pointer, strength, ms),
    )
    this.targets = new Targets((target) => {
      this.mouse.pointer.forget(target)
      for (const pointer of this.visit.pointers()) pointer.forget(target)
    })
    this.mouse = new Mouse(this.stage, this.targets.all)
    const marked = (point: Vector3) => this.touching.touch(point)
    this.visit = new Visit(this.stage, this.targets, marked, () => this.left())
    const context = contextOf(this, parts, this.sound.feedback)
    const { targets } = this
    this.board = new Board(context)
    this.stats = new Stats(context, this.board.panel.group)
    this.boardPlace = new BoardPlace(this.board, context)
    this.stage.panels.add(this.board.panel.group)
    targets.add(this.board.panel)
    this.panels = new RobotPanels(context, this.stage.panels, this.scene, targets)
    this.systems = new SystemPanels(context, this.stage.panels, this.scene, targets)
    this.anchor = new SceneAnchor(this.stage.anchor, (hold) => {
      context.say(hold === 'session' ? words.room.anchorSession : words.room.anchorNone)
    })
    this.objects = new ObjectHandles(this.scene, context, targets)
    this.overlays = new Overlays(link, this.scene, this.stage.world)
    this.drawings = new Drawings(
      this.scene,
      () => this.follower,
      (text) => this.board.say(text),
    )
    this.creation = new Creation(() => this.board.panel.repaint())
    this.robots = new RoomRobots(this.scene, this.overlays, context, targets, {
      touched: (name) => this.creation.touch(name),
      stick: (pointer, axis) => this.visit.inputs?.stick(pointer, axis) ?? 0,
    })
    const device = deviceId()
    this.scan = new RoomScan(this.stage.world, (surfaces) => {
      orderSurfaces(context, device, surfaces)
    })
    const repaint = () => this.board.panel.repaint()
    const display = `${device}.${randomId(3)}`
    this.people = new People(link, this.stage.world, display, words, repaint)
    const { anchor, panels } = this.stage
    this.touching = new TouchAlignment(this.anchor, anchor, this.scan, panels, context)
    const bases = () => this.robots.bases()
    this.alignment = new Alignment(this.stage, this.anchor, this.scan, bases)
    this.spawning = new Spawning(context, this, () => this.board.panel.repaint())
    this.follower = roomFollower(link, context, parts.courseOf)
    this.follower.attach(
      followedScene({
        scene: this.scene,
        robots: this.robots,
        objects: this.objects,
        came: () => this.came(),
        setSurfaces: (surfaces) => this.setSurfaces(surfaces),
      }),
    )
    this.guide = new Guide(context, this, targets)
    this.board.tabs = boardTabs(context, this, parts.person, parts.lesson)
    this.undo = [
      pauseNews(link, (who, names) =>
        context.say(words.room.pausedBy(named(who), names.join(', '))),
      ),
      applySettings(this.settings, this.visit, () => this.repaint()),
      link.subscribe('trajectories', trajectoryCatalogueReader, ({ trajectories }) => {
        this.trajectories = trajectories
        this.panels.repaint()
      }),
      listen({
        context,
        follower: this.follower,
        board: this.board,
        panels: this.panels,
        systems: this.systems,
        troubles: this.troubles,
        halt: () => this.sound.halt(),
      }),
    ]
    const pictures = new Frame(this)
    this.stage.renderer.setAnimationLoop((time, frame) => pictures.draw(time, frame))
  }

  get handles(): RoomRobots['handles'] {
    return this.robots.handles
  }

  get inside(): Visit['inside'] {
    return this.visit.inside
  }

  /** What the session that runs came without. */
  get missing(): readonly Feature[] {
    return this.visit.missing
  }

  /** Enter with a headset; must be called by a person's tap. */
  async enter(mode: Mode): Promise<void> {
    const session = await this.visit.enter(
      mode,
      performance.now() / 1000,
      this.settings.seated.value,
    )
    this.alignment.begin(session)
    this.showSurfaces()
    this.board.panel.repaint()
  }

  dispose(): void {
    this.visit.leave()
    for (const undo of this.undo) undo()
    this.people.dispose()
    this.touching.dispose()
    this.guide.dispose()
    this.spawning.dispose()
    this.mouse.dispose()
    this.follower.dispose()
    this.overlays.dispose()
    this.drawings.dispose()
    this.objects.dispose()
    this.robots.dispose()
    this.panels.dispose()
    this.stats.dispose()
    this.systems.dispose()
    this.board.panel.dispose()
    this.scene.dispose()
    this.sound.dispose()
    this.stage.dispose()
    this.meshes.dispose()
  }

  /** Draw the room's surfaces where the room itself is not seen. */
  private showSurfaces(): void {
    this.scene.setSurfaces(this.visit.passthrough ? [] : this.surfaces)
  }

  /** The robots are there, or others. */
  private came(): void {
    this.creation.keep((name) => this.handles.has(name))
    const waits = this.alignment.due && !this.inside.value && this.handles.size > 0
    if (waits) this.alignment.align(SEATED)
  }

  private setSurfaces(surfaces: readonly ShownSurface[]): void {
    this.supports = supportsOf(surfaces)
    this.surfaces = surfaces.filter(({ vertices }) => vertices.length > 0)
    this.showSurfaces()
    this.board.panel.repaint()
  }

  private repaint(): void {
    this.board.panel.repaint()
    this.guide.panel.panel.repaint()
    this.panels.repaint()
    this.systems.repaint()
    this.stage.invalidate()
  }

  private left(): void {
    this.people.leave()
    this.touching.cancel()
    this.anchor.end()
    this.alignment.align(SEATED)
    this.showSurfaces()
    this.board.panel.repaint()
  }
}
