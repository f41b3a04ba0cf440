import { effect, signal } from '@preact/signals'
import { Matrix4, Quaternion, Vector3 } from 'three'
import type { Link } from '../link/link'
import { commandsOf } from '../pages/lab/commands'
import { type FollowedScene, LabFollower } from '../pages/lab/follow'
import type { DrawnArm } from '../pages/lab/followed_robot'
import type { Pose } from '../protocol/geometry_msgs'
import {
  listCatalogueType,
  type ObjectType,
  setSurfacesType,
  spawnRobotType,
  type TrajectoryInfo,
  trajectoryCatalogueType,
} from '../protocol/mrlab_msgs'
import { LabScene, type ShownRobot } from '../scene/lab_scene'
import { MeshLibrary } from '../scene/meshes'
import type { ShownSurface } from '../scene/surfaces'
import type { Words } from '../words/en'
import { SceneAnchor } from './anchor/anchor'
import { Arms } from './arms'
import { type Entry, order, type RoomContext } from './context'
import { soundFeedback } from './feedback'
import { poseInWorld } from './frames'
import { ObjectHandles } from './handles/object_handles'
import { RobotHandle } from './handles/robot_handle'
import { XrInputs } from './input/sources'
import type { Target } from './input/target'
import { Mouse } from './mouse'
import { Overlays } from './overlays'
import { Board } from './panels/board'
import { PANEL_THEME } from './panels/pen'
import { RobotPanels } from './panels/robot_panels'
import { Stand } from './panels/stand'
import { objectsTab, type Picking, robotsTab, roomTab, systemsTab } from './panels/tabs'
import { type Place, type Support, supportsOf } from './placement/supports'
import { RoomScan } from './room-scan/scan'
import type { Feature, Mode } from './session/features'
import { enter, type RoomSession } from './session/session'
import { RoomStage } from './stage'

/** m before the eyes: where the scene's middle comes to stand. */
const AWAY = 1.5
const SEATED = { head: new Vector3(0, 1.6, 0.9), look: new Quaternion() } as const
/** rad: a board that is this far to the side of where one looks, for so long, s, comes along. */
const ASIDE = (75 * Math.PI) / 180
const ASIDE_S = 1.5
const BOARD_SIDE = (36 * Math.PI) / 180
const BOARD_AWAY = 0.95
const BOARD_AWAY_SCREEN = 1.35
/** m */
const READ_AT = 0.9
const READ_AT_SCREEN = 1.5
const SCAN_WAIT_S = 3
/** s between a frame's start and the instant at which it is seen, where the device does not tell. */
const AHEAD_S = 0.015

const matrix = new Matrix4()
const scale = new Vector3()
const at = new Vector3()

/** What the room is made from. */
export interface RoomParts {
  readonly container: HTMLElement
  readonly link: Link
  readonly words: Words
  readonly robots: readonly Entry[]
  readonly endEffectors: readonly Entry[]
}

/** The lab in a person's room: wires what the folders beside it do, once a frame. */
export class Room {
  /** Whether a headset is in the room. */
  readonly inside = signal(false)
  readonly troubles = signal<readonly string[]>([])
  readonly follower: LabFollower
  readonly board: Board
  readonly panels: RobotPanels
  readonly stage: RoomStage
  readonly arms: Arms
  readonly scan: RoomScan
  readonly anchor: SceneAnchor
  readonly scene: LabScene
  readonly handles = new Map<string, RobotHandle>()
  readonly head = new Vector3().copy(SEATED.head)
  readonly look = new Quaternion()
  /** Frames drawn, and ms of JavaScript of the newest one. */
  frames = 0
  frameMs = 0
  supports: readonly Support[] = supportsOf([])
  private readonly context: RoomContext
  private readonly meshes = new MeshLibrary()
  private readonly overlays: Overlays
  private readonly objects: ObjectHandles
  private readonly mouse: Mouse
  private readonly targets: Target[] = []
  private readonly boardStand: Stand
  private readonly picking: Picking = { on: false, picked: [] }
  private readonly sound: ReturnType<typeof soundFeedback>
  private readonly undo: (() => void)[] = []
  private inputs: XrInputs | null = null
  private current: RoomSession | null = null
  private surfaces: readonly ShownSurface[] = []
  /** What of a robot messages move: the fingers, for its arm goes by the clock. */
  private readonly fingers = new Map<string, DrawnArm>()
  private boardYaw = 0
  private asideSince = Number.NaN
  private aligned = false
  private restoring = false
  private enteredAt = 0
  private last = 0
  private grid = false
  private leftHanded = localStorage.getItem('mrlab.room.left') === 'yes'
  private types: readonly ObjectType[] = []
  private trajectories: readonly TrajectoryInfo[] = []

  /** Throws NoWebGL where the browser has none. */
  constructor(private readonly parts: RoomParts) {
    const { link, words } = parts
    this.stage = new RoomStage(parts.container, words.room.picture)
    this.scene = new LabScene(this.stage, this.meshes, () => {
      this.troubles.value = [...this.scene.troubles]
    })
    this.sound = soundFeedback((signal, strength, ms) =>
      this.inputs?.pulse(signal.pointer, strength, ms),
    )
    this.context = this.makeContext()
    this.board = new Board(this.context)
    this.boardStand = new Stand(this.board.panel.group)
    this.stage.panels.add(this.board.panel.group)
    this.targets.push(this.board.panel)
    this.panels = new RobotPanels(this.context, this.stage.panels, this.scene, this.targets)
    this.arms = new Arms(link, this.scene, (text) => this.board.say(text))
    this.anchor = new SceneAnchor(this.stage.anchor)
    this.objects = new ObjectHandles(this.scene, this.context, this.targets)
    this.overlays = new Overlays(link, this.scene, this.stage.world)
    this.scan = new RoomScan(this.stage.world, (surfaces) => {
      order(this.context, 'physics/set_surfaces', setSurfacesType, { source: '', surfaces })
    })
    this.follower = new LabFollower(link, {
      commands: (name) => commandsOf(link, name),
      word: (state) => words.states[state],
      colour: (state) => PANEL_THEME.states[state],
      stir: () => undefined,
      // the arms fetch it themselves, and are posed by them alone
      courseOf: () => Promise.reject(new Error('the arms have it')),
    })
    this.follower.attach(this.followed())
    this.mouse = new Mouse(this.stage, this.targets)
    this.board.tabs = this.makeTabs()
    this.listen()
    this.stage.renderer.setAnimationLoop((time, frame) => this.draw(time, frame))
  }

  /** Enter with a headset; must be called by a person's tap. */
  async enter(mode: Mode): Promise<void> {
    const { renderer } = this.stage
    this.current = await enter(renderer, mode, () => this.left())
    const { session } = this.current
    this.inputs = new XrInputs(session, this.stage.scene, this.targets)
    this.stage.controls.enabled = false
    this.stage.setPassthrough(mode === 'immersive-ar')
    this.aligned = false
    this.restoring = true
    this.enteredAt = performance.now() / 1000
    this.anchor.restore(session).then((restored) => {
      this.restoring = false
      this.aligned = restored
    })
    this.inside.value = true
    this.showSurfaces()
    this.board.panel.repaint()
  }

  /** What the session that runs came without. */
  get missing(): readonly Feature[] {
    return this.current?.missing ?? []
  }

  dispose(): void {
    this.current?.session.end().catch(() => undefined)
    for (const undo of this.undo) undo()
    this.mouse.dispose()
    this.follower.dispose()
    this.overlays.dispose()
    this.objects.dispose()
    for (const handle of this.handles.values()) handle.dispose()
    this.panels.dispose()
    this.board.panel.dispose()
    this.arms.dispose()
    this.scene.dispose()
    this.sound.dispose()
    this.stage.dispose()
    this.meshes.dispose()
  }

  private makeContext(): RoomContext {
    const room = this
    const { link, words, robots, endEffectors } = this.parts
    return {
      link,
      words,
      robots,
      endEffectors,
      feedback: this.sound.feedback,
      stir: () => room.stage.invalidate(),
      world: this.stage.world,
      head: this.head,
      get trajectories() {
        return room.trajectories
      },
      get supports() {
        return room.supports
      },
      get bases() {
        return room.bases()
      },
      get leftHanded() {
        return room.leftHanded
      },
      get readAt() {
        return room.inside.value ? READ_AT : READ_AT_SCREEN
      },
      say: (text) => room.board.say(text),
    }
  }

  /** Where robots stand, with their names for `support`. */
  private *bases(): Iterable<Place> {
    for (const name of this.handles.keys()) {
      const base = this.scene.base(name)
      if (base === undefined) continue
      const { x, y, z } = base.position
      yield { x, y, z, support: name }
    }
  }

  /** The scene as the follower moves it: joints are moved by the clock, not by messages. */
  private followed(): FollowedScene {
    const { scene } = this
    return {
      setRobots: (robots) => this.setRobots(robots),
      setState: (name, word, colour, filled) => scene.setState(name, word, colour, filled),
      setCollision: (name, link) => scene.setCollision(name, link),
      setObjects: (objects) => {
        scene.setObjects(objects)
        this.objects.set(objects)
      },
      setContacts: (contacts) => scene.setContacts(contacts),
      setSurfaces: (surfaces) => this.setSurfaces(surfaces),
      // cubes between the fingers mark them here
      setTargets: () => undefined,
      frame: () => undefined,
      robot: (name) => this.fingers.get(name),
    }
  }

  private setSurfaces(surfaces: readonly ShownSurface[]): void {
    this.supports = supportsOf(surfaces)
    this.surfaces = surfaces.filter(({ vertices }) => vertices.length > 0)
    this.showSurfaces()
    this.board.panel.repaint()
  }

  /** Draw the room's surfaces where the room itself is not seen. */
  private showSurfaces(): void {
    this.scene.setSurfaces(this.current?.mode === 'immersive-ar' ? [] : this.surfaces)
  }

  private setRobots(robots: readonly ShownRobot[]): void {
    this.scene.setRobots(robots)
    for (const { name, urdf, joint_names } of robots) {
      const base = this.scene.base(name)
      if (urdf === '' || base === undefined) continue
      this.arms.setJoints(name, joint_names)
      const before = this.handles.get(name)
      if (before?.base === base) continue
      if (before !== undefined) this.dropHandle(name, before)
      const handle = new RobotHandle(
        name,
        base,
        this.scene,
        this.context,
        (touched) => this.touch(touched),
        (pointer, axis) => this.inputs?.stick(pointer, axis) ?? 0,
      )
      this.handles.set(name, handle)
      this.fingers.set(name, {
        setPositions: () => undefined,
        setJoint: (joint, value) =>
          !joint_names.includes(joint) &&
          (this.scene.robot(name)?.setJoint(joint, value) ?? false),
      })
      this.targets.push(handle)
    }
    for (const [name, handle] of this.handles) {
      if (robots.some((robot) => robot.name === name)) continue
      this.dropHandle(name, handle)
      this.arms.forget(name)
      this.fingers.delete(name)
      this.overlays.forget(name)
    }
    if (!this.aligned && !this.inside.value && this.handles.size > 0) this.align(SEATED)
  }

  private dropHandle(name: string, handle: RobotHandle): void {
    this.handles.delete(name)
    this.forgetTarget(handle)
    handle.dispose()
  }

  private forgetTarget(target: Target): void {
    const index = this.targets.indexOf(target)
    if (index >= 0) this.targets.splice(index, 1)
    this.mouse.pointer.forget(target)
    for (const pointer of this.inputs?.pointers() ?? []) pointer.forget(target)
  }

  /** A robot's base was pressed and let go in place. */
  private touch(name: string): void {
    if (!this.picking.on) return
    const index = this.picking.picked.indexOf(name)
    if (index >= 0) this.picking.picked.splice(index, 1)
    else this.picking.picked.push(name)
    this.board.panel.repaint()
  }

  private makeTabs() {
    const { context, follower } = this
    const motionOf = (name: string) =>
      follower.robots.value.find(({ robot }) => robot.name === name)?.playback?.trajectory_id ?? ''
    const room = this
    return [
      robotsTab(context, (entry) => this.spawn(entry)),
      objectsTab(
        context,
        () => this.types,
        () => this.before(0.8),
      ),
      systemsTab(context, this.picking, motionOf, () =>
        follower.systems.value.map(({ system }) => system),
      ),
      roomTab(context, {
        lines: () => this.roomLines(),
        get grid() {
          return room.grid
        },
        toggleGrid: () => {
          this.grid = !this.grid
          this.stage.setGrid(this.grid)
        },
        get leftHanded() {
          return room.leftHanded
        },
        toggleHand: () => {
          this.leftHanded = !this.leftHanded
          localStorage.setItem('mrlab.room.left', this.leftHanded ? 'yes' : 'no')
        },
        get scan() {
          const session = room.current?.session
          if (session?.initiateRoomCapture === undefined) return null
          return () => {
            session.initiateRoomCapture?.().catch((error: Error) => room.board.say(error.message))
          }
        },
        bringHere: () => this.align(this),
        leave: () => void this.current?.session.end(),
      }),
    ]
  }

  private roomLines(): string[] {
    const w = this.parts.words.room
    const lines = [w.surfaces(this.surfaces.length)]
    if (this.inside.value) {
      const waited = performance.now() / 1000 - this.enteredAt > SCAN_WAIT_S
      if (waited && this.scan.count === 0) lines.push(w.notSetUp)
      const holds = { kept: w.anchorKept, session: w.anchorSession, none: w.anchorNone }
      lines.push(holds[this.anchor.hold])
      if (this.missing.length > 0) lines.push(w.lacks(this.missing.join(', ')))
    }
    return lines
  }

  private listen(): void {
    const { link } = this.parts
    this.undo.push(
      link.subscribe('trajectories', trajectoryCatalogueType, ({ trajectories }) => {
        this.trajectories = trajectories
        this.panels.repaint()
      }),
      effect(() => {
        const views = this.follower.robots.value
        const halted = this.panels.show(views)
        if (halted) this.sound.halt()
      }),
      effect(() => {
        const { phase, reason } = this.follower.status.value
        const { hops } = this.parts.words.room
        this.board.standing =
          phase === 'open' ? '' : phase === 'connecting' ? hops.connecting : hops[phase](reason)
      }),
      effect(() => {
        void this.follower.systems.value
        this.board.panel.repaint()
      }),
      // pictures of the catalogue come later than the panel
      ...[...this.parts.robots, ...this.parts.endEffectors].map(({ picture }) => {
        const here = () => this.board.panel.repaint()
        picture?.addEventListener('load', here)
        return () => picture?.removeEventListener('load', here)
      }),
    )
    const listed = link.onOffer(() => this.listObjects())
    this.undo.push(listed)
    this.listObjects()
  }

  private listObjects(): void {
    if (this.types.length > 0) return
    const { link } = this.parts
    link
      .call('physics/list_catalogue', listCatalogueType, {})
      .then(({ types }) => {
        this.types = types
        this.board.panel.repaint()
      })
      // without physics there are no objects; the offer tells when it is there
      .catch(() => undefined)
  }

  private async spawn({ id }: Entry): Promise<void> {
    const request = spawnRobotType.request.create({
      model: id,
      automatic: true,
      has_viewer: true,
      viewer: poseInWorld(this.stage.world, this.head, this.look),
    })
    const answer = await order(this.context, 'lab/spawn_robot', spawnRobotType, request)
    if (answer !== null) this.board.say(this.parts.words.room.placed(answer.robot.name), false)
  }

  /** Return a place so far before the eyes, m, a little below them. */
  private before(distance: number): Pose {
    at.set(0, 0, -distance).applyQuaternion(this.look).add(this.head)
    at.y = Math.max(at.y - 0.2, 0.3)
    return { ...poseInWorld(this.stage.world, at, SEATED.look), orientation: UPRIGHT }
  }

  /** Put the scene's middle on the floor before somebody. */
  private align({ head, look }: { readonly head: Vector3; readonly look: Quaternion }): void {
    at.set(0, 0, 0)
    let count = 0
    for (const { x, y, z } of this.bases()) {
      at.x += x
      at.y += y
      at.z += z
      count++
    }
    if (count > 0) at.divideScalar(count).applyQuaternion(this.stage.world.quaternion)
    const floor = Number.isNaN(this.scan.floor) ? 0 : this.scan.floor
    this.anchor.place(head, look, at, count > 0 ? AWAY : 0, floor)
    this.stage.anchor.updateMatrixWorld(true)
    this.aligned = true
  }

  private left(): void {
    this.inputs?.dispose()
    this.inputs = null
    this.current = null
    this.anchor.end()
    this.stage.controls.enabled = true
    this.stage.setPassthrough(false)
    this.align(SEATED)
    this.inside.value = false
    this.showSurfaces()
    this.board.panel.repaint()
  }

  private draw(time: number, frame: XRFrame | undefined): void {
    const began = performance.now()
    const now = began / 1000
    const step = Math.min(now - this.last, 0.1)
    this.stage.measure(now - this.last)
    this.last = now
    let ahead = AHEAD_S
    const space = this.stage.renderer.xr.getReferenceSpace()
    if (frame !== undefined && space !== null) {
      ahead = Math.max((frame.predictedDisplayTime ?? time + AHEAD_S * 1000) - began, 0) / 1000
      this.track(frame, space, now)
    } else if (!this.inside.value) {
      this.stage.controls.update()
      this.stage.camera.matrixWorld.decompose(this.head, this.look, scale)
      this.mouse.update(now)
    }
    for (const handle of this.handles.values()) handle.update(now, step)
    this.objects.update(now)
    if (this.arms.update(this.parts.link.labTime() + Math.min(ahead, 0.05))) {
      this.stage.invalidate()
    }
    this.scene.update()
    this.overlays.setPicked(this.picking.on ? this.picking.picked : NONE)
    this.overlays.update(now)
    this.standBoard(now, step)
    this.board.update(now)
    this.panels.update(now, step)
    this.lightUp()
    if (this.stage.draw(now)) this.frames++
    this.frameMs = performance.now() - began
  }

  private track(frame: XRFrame, space: XRReferenceSpace, now: number): void {
    this.anchor.update(frame, space)
    const viewer = frame.getViewerPose(space)
    if (viewer !== undefined) {
      matrix.fromArray(viewer.transform.matrix).decompose(this.head, this.look, scale)
      if (!this.aligned && !this.restoring) {
        this.align(this)
        this.boardYaw = yawOf(this.look)
      }
    }
    this.scan.update(frame, space, now)
    this.inputs?.update(frame, space, now)
  }

  /** Keep the board at the hand that does not work, a little to the side of where one looks. */
  private standBoard(now: number, step: number): void {
    const yaw = yawOf(this.look)
    const off = Math.abs(Math.atan2(Math.sin(yaw - this.boardYaw), Math.cos(yaw - this.boardYaw)))
    if (off < ASIDE) this.asideSince = Number.NaN
    else if (Number.isNaN(this.asideSince)) this.asideSince = now
    else if (now - this.asideSince > ASIDE_S) this.boardYaw = yaw
    const away = this.inside.value ? BOARD_AWAY : BOARD_AWAY_SCREEN
    const side = this.boardYaw + (this.leftHanded ? -BOARD_SIDE : BOARD_SIDE)
    at.set(-Math.sin(side), 0, -Math.cos(side)).multiplyScalar(away).add(this.head)
    at.y = this.head.y - 0.22
    const held = this.board.panel.pointers > 0
    const { readAt } = this.context
    if (this.boardStand.update(at, this.head, now, step, held, readAt)) this.stage.invalidate()
  }

  private lightUp(): void {
    at.set(0, 0, 0)
    let count = 0
    for (const name of this.handles.keys()) {
      const base = this.scene.base(name)
      if (base === undefined) continue
      at.x += base.matrixWorld.elements[12] as number
      at.y += base.matrixWorld.elements[13] as number
      at.z += base.matrixWorld.elements[14] as number
      count++
    }
    if (count > 0) this.stage.lightAt(at.divideScalar(count))
  }
}

const NONE: readonly string[] = []
const UPRIGHT = { x: 0, y: 0, z: 0, w: 1 } as const

/** Return the heading of a look about the vertical, rad; 0 looks along -z. */
function yawOf({ x, y, z, w }: Quaternion): number {
  return Math.atan2(2 * (w * y + x * z), 1 - 2 * (x * x + y * y))
}
