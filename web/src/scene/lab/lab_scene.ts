import { Group, InstancedMesh, type Object3D, type Vector3 } from 'three'
import { pushCorners } from '../robot/corners'
import { Looks } from '../robot/looks'
import type { MeshSource } from '../robot/meshes'
import { SceneRobot } from '../robot/robot'
import { ContactPatch } from '../stage/floor'
import { Label } from '../stage/labels'
import { type Pose, place } from '../stage/pose'
import type { SceneHost } from '../stage/renderer'
import type { SceneTheme } from '../stage/theme'
import { Contacts, GraspMarks, type ShownTarget } from './grasp_marks'
import { LabObjects, type ShownObject } from './lab_objects'
import { LabSurfaces, type ShownSurface } from './surfaces'

const NAME = 0.021 // of a label, as a part of the distance to it
const NAME_PROJECTED = 0.036 // readable at 8 m
const ABOVE = 0.07 // m, of a label over a robot

/** A robot of the scene: the fields of mrlab_msgs/msg/Robot that are drawn, and its URDF. */
export interface ShownRobot {
  readonly name: string
  readonly urdf: string
  readonly pose: Pose
  readonly joint_names: readonly string[]
}

interface Entry {
  readonly base: Group
  robot: SceneRobot
  urdf: string
  readonly joints: readonly string[]
  readonly patch: ContactPatch
  readonly marks: GraspMarks
  targets: readonly ShownTarget[]
  label: Label | null
  state: string
  colour: string
  filled: boolean
}

/** Robots, objects, contacts and the room of a lab, live or out of a bag. */
export class LabScene {
  /** The files of meshes that could not be read. */
  readonly troubles = new Set<string>()
  private readonly robots = new Map<string, Entry>()
  private readonly objects: LabObjects
  private readonly contacts = new Contacts()
  private readonly surfaces = new LabSurfaces()
  private readonly looks = new Looks()
  private readonly undo: (() => void)[] = []
  private nameHeight = NAME

  constructor(
    private readonly stage: SceneHost,
    private readonly meshes: MeshSource,
    private readonly onTrouble: () => void = () => undefined,
  ) {
    const trouble = (mesh: string) => {
      this.troubles.add(mesh)
      this.onTrouble()
    }
    this.objects = new LabObjects(stage, meshes, (name) => this.toolOf(name), trouble)
    stage.world.add(this.contacts.mesh, this.surfaces.group)
    this.undo.push(stage.onTheme((theme) => this.setTheme(theme)))
  }

  /** Take over which robots there are, and where; those without a URDF yet are left out. */
  setRobots(robots: readonly ShownRobot[]): void {
    let fresh = false
    let changed = false
    for (const shown of robots) {
      if (shown.urdf === '') continue
      let entry = this.robots.get(shown.name)
      if (entry !== undefined && entry.urdf !== shown.urdf) {
        this.remove(shown.name, entry)
        entry = undefined
      }
      if (entry === undefined) {
        entry = this.add(shown)
        fresh = true
      }
      changed = place(entry.base, shown.pose) || changed
    }
    for (const [name, entry] of this.robots) {
      if (robots.some((shown) => shown.name === name)) continue
      this.remove(name, entry)
      changed = true
    }
    if (fresh) this.frame()
    if (fresh || changed) this.stage.invalidate()
  }

  /** Return the joints of a robot in the order in which setJoints wants them. */
  robot(name: string): SceneRobot | undefined {
    return this.robots.get(name)?.robot
  }

  /** What a ray can meet: robots, objects, and surfaces that are not seen through. */
  get solid(): Object3D[] {
    const robots = [...this.robots.values()].map(({ robot }) => robot.root)
    const objects = this.stage.world.children.filter((each) => each instanceof InstancedMesh)
    return [...robots, ...objects, ...this.surfaces.met]
  }

  /** Return a ghost of a robot at its place; the caller disposes of it. */
  ghost(name: string): SceneRobot | undefined {
    const entry = this.robots.get(name)
    if (entry === undefined) return undefined
    const { urdf, joints, base } = entry
    const ghost = new SceneRobot(urdf, joints, this.meshes, this.looks, () =>
      this.stage.invalidate(),
    )
    ghost.setLook('ghost')
    base.add(ghost.root)
    return ghost
  }

  /** Return the frame of a robot's base. */
  base(name: string): Object3D | undefined {
    return this.robots.get(name)?.base
  }

  /** Move a robot's base. */
  placeRobot(name: string, pose: Pose): void {
    const entry = this.robots.get(name)
    if (entry !== undefined) place(entry.base, pose)
  }

  /** Set the state of a robot: the word is drawn above it, in the state's colour. */
  setState(name: string, word: string, colour: string, filled = false): void {
    const entry = this.robots.get(name)
    if (entry === undefined) return
    if (entry.state === word && entry.colour === colour) return
    entry.state = word
    entry.colour = colour
    entry.filled = filled
    this.paintLabel(name, entry)
    this.stage.invalidate()
  }

  /** Have a person's choice of less motion looked up elsewhere than in the browser. */
  setStill(still: () => boolean): void {
    this.looks.still = still
  }

  /** Draw a robot, or leave it out of the picture. */
  showRobot(name: string, there: boolean): void {
    const entry = this.robots.get(name)
    if (entry === undefined || entry.base.visible === there) return
    entry.base.visible = there
    this.stage.invalidate()
  }

  /** Grey a robot and paint the link that collides; empty: it does not. */
  setCollision(name: string, link: string): void {
    this.robots.get(name)?.robot.setLook(link === '' ? 'own' : 'grey', link)
  }

  setObjects(objects: readonly ShownObject[]): void {
    this.objects.set(objects)
  }

  setSurfaces(surfaces: readonly ShownSurface[]): void {
    this.surfaces.set(surfaces)
    this.stage.invalidate()
  }

  /** Mark where the trajectory that a robot has loaded grasps and releases. */
  setTargets(name: string, targets: readonly ShownTarget[]): void {
    const entry = this.robots.get(name)
    if (entry === undefined || entry.targets === targets) return
    entry.targets = targets
    entry.marks.set(targets, this.stage.theme)
    this.stage.invalidate()
  }

  moveObject(name: string, pose: Pose, heldBy: string): void {
    this.objects.move(name, pose, heldBy)
  }

  setContacts(contacts: Parameters<Contacts['set']>[0]): void {
    if (contacts.length === 0 && this.contacts.mesh.count === 0) return
    this.contacts.set(contacts)
    this.stage.invalidate()
  }

  /** Large names for a projector. */
  setProjected(on: boolean): void {
    this.setNames(on ? NAME_PROJECTED : NAME)
  }

  /** Set the height of names, as a part of the distance to them. */
  setNames(height: number): void {
    this.nameHeight = height
    for (const [name, entry] of this.robots) {
      entry.label?.dispose()
      entry.label = null
      this.paintLabel(name, entry)
    }
    this.stage.invalidate()
  }

  /** Resolves when every mesh of the present robots, or its placeholder, is loaded. */
  get ready(): Promise<unknown> {
    return Promise.all([...this.robots.values()].map(({ robot }) => robot.ready))
  }

  /** Before each picture: held objects follow the hands. */
  update(): void {
    this.stage.world.updateMatrixWorld(true)
    this.objects.follow()
    for (const { base, robot, label } of this.robots.values()) {
      if (base.visible) robot.castInto(this.stage.shadow)
      if (label !== null) label.sprite.position.z = robot.height() + ABOVE
    }
  }

  /** Show everything whole. */
  frame(again = false): void {
    const points: Vector3[] = []
    this.reach(points)
    this.stage.frame(points, again)
  }

  /** Add points to `into` that enclose the robots, in the world's frame. */
  reach(into: Vector3[]): void {
    this.stage.world.updateMatrixWorld(true)
    for (const { base, robot } of this.robots.values()) {
      into.push(base.position.clone())
      into.push(base.position.clone().setZ(base.position.z + robot.height() + 3 * ABOVE))
      pushCorners(base, this.stage.world, into)
    }
  }

  dispose(): void {
    for (const undo of this.undo) undo()
    for (const [name, entry] of this.robots) this.remove(name, entry)
    this.objects.dispose()
    this.contacts.dispose()
    this.surfaces.dispose()
    this.looks.dispose()
  }

  private toolOf(name: string): Object3D | undefined {
    return this.robots.get(name)?.robot.tool
  }

  private add(shown: ShownRobot): Entry {
    const changed = () => this.stage.invalidate()
    const robot = new SceneRobot(shown.urdf, shown.joint_names, this.meshes, this.looks, changed)
    const base = new Group()
    const patch = new ContactPatch()
    const marks = new GraspMarks()
    base.add(robot.root, patch, marks.group)
    this.stage.world.add(base)
    const entry: Entry = {
      base,
      robot,
      urdf: shown.urdf,
      joints: shown.joint_names,
      patch,
      marks,
      targets: [],
      label: null,
      state: '',
      colour: '',
      filled: false,
    }
    this.robots.set(shown.name, entry)
    this.paintLabel(shown.name, entry)
    robot.ready.then(() => {
      if (this.robots.get(shown.name) !== entry) return
      for (const mesh of robot.troubles) this.troubles.add(mesh)
      if (robot.troubles.length > 0) this.onTrouble()
      patch.fit(robot.footprint())
      this.frame()
    })
    return entry
  }

  private remove(name: string, entry: Entry): void {
    this.robots.delete(name)
    entry.robot.dispose()
    entry.label?.dispose()
    entry.marks.dispose()
    entry.patch.release()
    entry.base.removeFromParent()
  }

  private paintLabel(name: string, entry: Entry): void {
    const text = entry.state === '' ? name : `${name} · ${entry.state}`
    if (entry.label === null || entry.label.text !== text) {
      entry.label?.dispose()
      entry.label = new Label(text, this.nameHeight)
      entry.base.add(entry.label.sprite)
    }
    const { theme } = this.stage
    const colour = entry.colour === '' ? theme.second : entry.colour
    entry.label.paint(entry.filled ? colour : theme.card, entry.filled ? theme.card : colour)
    entry.label.sprite.position.z = entry.robot.height() + ABOVE
  }

  private setTheme(theme: SceneTheme): void {
    this.looks.setTheme(theme)
    this.contacts.setTheme(theme)
    this.surfaces.setTheme(theme)
    for (const [name, entry] of this.robots) {
      entry.marks.setTheme(theme)
      this.paintLabel(name, entry)
    }
  }
}
