import { effect, signal } from '@preact/signals'
import { Matrix4, Quaternion, Vector3 } from 'three'
import type { LabFollower } from '../lab/follower'
import { LookHere } from '../lab/people/look_here'
import { People } from '../lab/people/people'
import { type TrajectoryInfo, trajectoryCatalogueReader } from '../protocol/mrlab_msgs'
import { LabScene } from '../scene/lab/lab_scene'
import type { ShownSurface } from '../scene/lab/surfaces'
import { MeshLibrary } from '../scene/robot/meshes'
import { named } from '../words/words'
import { Board } from './board/board'
import { BoardPlace } from './board/board_place'
import { followedScene, haltWords, listen, roomFollower } from './follow'
import { ObjectHandles } from './handles/object_handles'
import { Placing } from './handles/placing'
import { Pointing } from './handles/pointing'
import { Mouse } from './input/mouse'
import type { Pointer } from './input/pointer'
import { Targets } from './input/targets'
import { Stats } from './latency'
import { Arrangement } from './layout/arrangement'
import { Opened } from './layout/opened'
import { Caption } from './panels/caption'
import { soundFeedback } from './panels/feedback'
import { OwnPresence } from './people/own_presence'
import { pauseNews } from './people/pausing'
import { Alignment, SEATED } from './place/alignment'
import { anchorNews, SceneAnchor } from './place/anchor'
import { CommonPlace } from './place/common_place'
import { RoomScan } from './place/scan'
import { Spawning } from './place/spawning'
import { type Support, supportsOf, type Wall, wallsOf } from './place/supports'
import { TouchAlignment } from './place/touch_alignment'
import { ControlPanel } from './robots/control'
import { RobotPanels } from './robots/robot_panels'
import { RoomRobots } from './robots/robots'
import { Drawings } from './scene/drawings'
import { Overlays } from './scene/overlays'
import { RoomStage } from './scene/stage'
import type { Feature, Mode } from './session/features'
import { applySettings, deviceId, randomId, Settings } from './session/settings'
import { Visit } from './session/visit'
import { Creation } from './systems/creation'
import { SystemPanels } from './systems/system_panels'
import { Guide } from './tour/guide'
import { portsOf, type RoomParts, tabsOf } from './wiring'

/** s from the start of a frame to its display, unless the device reports it; and the most. */
const AHEAD_S = 0.015
const MOST_AHEAD_S = 0.05
/** s */
const LONGEST_STEP = 0.1

/** Height of robots' names, as a part of the distance: their letters have 0.9 degrees. */
const NAME = 0.03

const matrix = new Matrix4()
const scale = new Vector3()
const tip = new Vector3()

/** The lab in a person's room: makes the parts of the folders beside it, and calls them in each
 * frame. */
export class Room {
  readonly troubles = signal<readonly string[]>([])
  readonly head = new Vector3().copy(SEATED.head)
  readonly look = new Quaternion()
  readonly follower: LabFollower
  readonly board: Board
  readonly caption: Caption
  readonly panels: RobotPanels
  readonly systems: SystemPanels
  readonly opened = new Opened()
  private readonly arrangement: Arrangement
  readonly stage: RoomStage
  readonly scan: RoomScan
  readonly anchor: SceneAnchor
  readonly common: CommonPlace
  readonly scene: LabScene
  readonly robots: RoomRobots
  readonly visit: Visit
  readonly creation: Creation
  readonly settings = new Settings()
  readonly people: People
  private readonly presence: OwnPresence
  readonly lookHere: LookHere
  readonly pointing: Pointing
  readonly touching: TouchAlignment
  readonly guide: Guide
  /** Frames drawn, and ms of JavaScript of the newest one. */
  frames = 0
  frameMs = 0
  /** s, of the frame before. */
  private drawnAt = 0
  /** The bounded surfaces of the room. */
  surfaces: readonly ShownSurface[] = []
  supports: readonly Support[] = supportsOf([])
  walls: readonly Wall[] = []
  trajectories: readonly TrajectoryInfo[] = []
  private readonly targets: Targets
  readonly meshes = new MeshLibrary()
  private readonly overlays: Overlays
  readonly objects: ObjectHandles
  readonly drawings: Drawings
  readonly stats: Stats
  readonly spawning: Spawning
  readonly placing: Placing
  readonly alignment: Alignment
  private readonly mouse: Mouse
  private readonly boardPlace: BoardPlace
  private readonly sound: ReturnType<typeof soundFeedback>
  private readonly undo: readonly (() => void)[]

  /** Throws NoWebGL if the browser has none. */
  constructor(parts: RoomParts) {
    const { link, words } = parts
    this.stage = new RoomStage(parts.container, words.room.picture)
    this.scene = new LabScene(this.stage, this.meshes, () => {
      this.troubles.value = [...this.scene.troubles]
    })
    this.scene.setNames(NAME)
    this.scene.setStill(() => this.settings.still.value)
    this.sound = soundFeedback((signal, strength, ms) =>
      this.visit.inputs?.pulse(signal.pointer, strength, ms),
    )
    this.targets = new Targets((target) => {
      this.mouse.pointer.forget(target)
      for (const pointer of this.visit.pointers()) pointer.forget(target)
    })
    this.mouse = new Mouse(this.stage, this.targets.all)
    this.visit = new Visit(this.stage, this.targets, this)
    const ports = portsOf(parts, this, this.sound.feedback)
    const { targets } = this
    this.board = new Board(ports)
    const repaint = () => this.board.panel.repaint()
    this.creation = new Creation(repaint)
    this.stats = new Stats(ports, this.board.panel.group)
    this.boardPlace = new BoardPlace(this.board, ports, () => this.placing.active)
    const stick = (pointer: Pointer, axis: 'x' | 'y') =>
      this.visit.inputs?.stick(pointer, axis) ?? 0
    this.placing = new Placing(ports, targets, stick, repaint)
    this.caption = new Caption(
      ports,
      () => this.settings.captions.value && this.visit.inside.value,
    )
    this.stage.panels.add(this.board.panel.group, this.caption.panel.group)
    targets.add(this.board.panel)
    const arrangement = new Arrangement(ports, {
      robots: () => this.robots.links(),
      people: () => this.people.heads(),
      board: this.board.panel,
    })
    this.arrangement = arrangement
    const shelf = this.stage.panels
    const away = () => this.creation.on || this.placing.active
    this.panels = new RobotPanels(
      ports,
      shelf,
      this.scene,
      targets,
      arrangement,
      this.opened,
      away,
      (name) => this.handles.get(name)?.carried ?? false,
      (robot) =>
        new ControlPanel(
          ports,
          robot,
          this.drawings,
          (name) => this.objectAt(name),
          () => this.opened.close(),
        ),
    )
    this.systems = new SystemPanels(
      ports,
      shelf,
      this.scene,
      targets,
      arrangement,
      this.opened,
      away,
    )
    this.anchor = new SceneAnchor(this.stage.anchor, anchorNews(ports))
    this.objects = new ObjectHandles(
      this.scene,
      ports,
      targets,
      (place) => this.robots.fingersAt(place),
      repaint,
    )
    this.overlays = new Overlays(link, this.scene, this.stage.world)
    this.drawings = new Drawings(
      this.scene,
      () => this.follower,
      (text) => this.board.say(text),
    )
    this.robots = new RoomRobots(
      this.scene,
      this.overlays,
      this.drawings,
      ports,
      targets,
      this.creation,
      stick,
    )
    this.scan = new RoomScan(this.stage.world, (surfaces) => this.common.tell(surfaces))
    const device = deviceId()
    const display = `${device}.${randomId(3)}`
    this.people = new People(link, this.stage.world, display, words, repaint)
    this.presence = new OwnPresence(link, this.stage.world, this.people)
    this.lookHere = new LookHere(link, this.stage.world, words, (text) => ports.say(text, false))
    this.pointing = new Pointing(ports, targets, this.lookHere, repaint)
    const { anchor, panels } = this.stage
    this.touching = new TouchAlignment(this.anchor, anchor, this.scan, panels, ports)
    this.common = new CommonPlace(
      ports,
      device,
      this.people,
      this.presence,
      this.scan,
      this.touching,
      this.anchor,
    )
    const bases = () => this.robots.bases()
    this.alignment = new Alignment(this.stage, this.anchor, this.scan, bases)
    this.spawning = new Spawning(ports, repaint, (name) => this.opened.open(name))
    this.follower = roomFollower(ports, parts.courseOf)
    this.follower.attach(
      followedScene({
        scene: this.scene,
        robots: this.robots,
        objects: this.objects,
        came: () => this.came(),
        setSurfaces: (surfaces) => this.setSurfaces(surfaces),
      }),
    )
    this.guide = new Guide(ports, this, targets)
    this.board.tabs = tabsOf(ports, parts, this)
    this.undo = [
      effect(() => this.common.goTo(this.follower.place.value?.id ?? '')),
      effect(() => {
        this.lookHere.stand(this.follower.recorder.value)
        this.stage.invalidate()
      }),
      pauseNews(link, (who, names) =>
        ports.say(words.room.pausedBy(named(who), names.join(', '))),
      ),
      applySettings(this.settings, this.visit, this.stage, () => this.repaint()),
      link.subscribe('trajectories', trajectoryCatalogueReader, ({ trajectories }) => {
        this.trajectories = trajectories
        this.panels.repaint()
      }),
      listen({
        ports,
        follower: this.follower,
        board: this.board,
        panels: this.panels,
        systems: this.systems,
        troubles: this.troubles,
        halt: () => {
          this.sound.halt()
          this.caption.say(haltWords(this.follower.robots.value, words))
        },
      }),
    ]
    this.stage.renderer.setAnimationLoop((time, frame) => this.draw(time, frame))
  }

  get handles(): RoomRobots['handles'] {
    return this.robots.handles
  }

  get inside(): Visit['inside'] {
    return this.visit.inside
  }

  /** The features that the running session lacks. */
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
    this.common.begin(performance.now() / 1000)
    this.alignment.begin(session)
    this.showSurfaces()
    this.board.panel.repaint()
  }

  dispose(): void {
    this.visit.leave()
    for (const undo of this.undo) undo()
    this.presence.leave()
    this.people.dispose()
    this.pointing.dispose()
    this.lookHere.dispose()
    this.touching.dispose()
    this.guide.dispose()
    this.spawning.dispose()
    this.placing.dispose()
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
    this.caption.panel.dispose()
    this.scene.dispose()
    this.sound.dispose()
    this.stage.dispose()
    this.meshes.dispose()
  }

  /** Draw the room's surfaces, unless the real room is visible. */
  private showSurfaces(): void {
    this.scene.setSurfaces(this.visit.passthrough ? [] : this.surfaces)
  }

  /** The set of robots has changed. */
  private came(): void {
    this.creation.keep((name) => this.handles.has(name))
    const waits = this.alignment.due && !this.inside.value && this.handles.size > 0
    if (waits) this.alignment.align(SEATED)
  }

  private setSurfaces(measured: readonly ShownSurface[]): void {
    // What a headset sees during a replay are its own surfaces, not those of the recorded room.
    const replayed = this.inside.value && this.follower.replays
    const surfaces = replayed ? this.scan.surfaces() : measured
    this.supports = supportsOf(surfaces)
    this.walls = wallsOf(surfaces)
    this.surfaces = surfaces.filter(({ vertices }) => vertices.length > 0)
    this.stage.grounds.set(this.surfaces)
    if (!replayed) this.common.keep(surfaces)
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

  touch(point: Vector3): boolean {
    return this.scan.touch(point) || this.touching.touch(point)
  }

  left(): void {
    this.presence.leave()
    this.common.end()
    this.anchor.end()
    this.placing.end()
    this.alignment.align(SEATED)
    this.showSurfaces()
    this.board.panel.repaint()
  }

  /** Return the object nearest to a robot's fingers; empty: none is near. */
  private objectAt(name: string): string {
    const robot = this.scene.robot(name)
    if (robot === undefined) return ''
    return this.objects.nearest(tip.setFromMatrixPosition(robot.tip.matrixWorld))
  }

  /** Draw a frame: poses, input, playback, robots, panels, picture. time: of the frame, ms; frame:
   * of a session, undefined without a headset. */
  private draw(time: number, frame: XRFrame | undefined): void {
    const began = performance.now()
    const now = began / 1000
    const step = Math.min(now - this.drawnAt, LONGEST_STEP)
    this.stage.measure(now - this.drawnAt)
    this.drawnAt = now
    let ahead = AHEAD_S
    const space = this.stage.renderer.xr.getReferenceSpace()
    if (frame !== undefined && space !== null) {
      ahead = Math.max((frame.predictedDisplayTime ?? time + AHEAD_S * 1000) - began, 0) / 1000
      this.track(frame, space, now)
    } else if (!this.inside.value) {
      this.stage.controls.update()
      this.stage.camera.updateMatrixWorld()
      this.stage.camera.matrixWorld.decompose(this.head, this.look, scale)
      this.mouse.update(now)
    }
    this.robots.update(now, step)
    this.objects.update(now)
    this.placing.update(step)
    if (this.follower.pose(Math.min(ahead, MOST_AHEAD_S))) this.stage.invalidate()
    if (this.drawings.update()) this.stage.invalidate()
    this.stage.lightAbout(this.robots.handles.values())
    this.scene.update()
    this.overlays.setPicked(this.creation.picked)
    this.overlays.update(this.settings.still.value ? 0 : now)
    if (this.boardPlace.update(this, now, step)) this.stage.invalidate()
    this.board.update(now)
    this.caption.update(this, now, step)
    this.guide.update(this.visit.inputs)
    if (this.people.update(now, step)) this.stage.invalidate()
    if (this.lookHere.update(now)) this.stage.invalidate()
    this.pointing.update(this)
    this.opened.keep([...this.systems.names, ...this.panels.names])
    this.arrangement.update(now, step)
    this.panels.update(now)
    this.systems.update(now)
    if (this.stage.draw(now)) this.frames++
    this.frameMs = performance.now() - began
    this.stats.frame(now, this.frameMs)
  }

  /** Follow the headset, its surfaces and its pointers. now: s. */
  private track(frame: XRFrame, space: XRReferenceSpace, now: number): void {
    this.anchor.update(frame, space)
    const viewer = frame.getViewerPose(space)
    if (viewer !== undefined) {
      matrix.fromArray(viewer.transform.matrix).decompose(this.head, this.look, scale)
      if (this.alignment.due) {
        this.alignment.align(this)
        this.boardPlace.face(this.look)
      }
    }
    this.common.update(now)
    this.scan.update(frame, space, now)
    const { inputs } = this.visit
    inputs?.update(frame, space, now)
    if (inputs !== null) this.presence.tell(this, inputs, now)
  }
}
