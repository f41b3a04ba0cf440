import { Vector3 } from 'three'
import type { Course } from '../../playback/course'
import type { MotionDocument } from '../../playback/motion'
import type { Diagnostic } from '../../words/diagnostic'
import type { SceneWords } from '../../words/words'
import { LabelSpacing } from '../lab/shapes'
import { pushCorners } from '../robot/corners'
import { Looks } from '../robot/looks'
import type { MeshSource } from '../robot/meshes'
import { SceneRobot } from '../robot/robot'
import { ContactPatch } from '../stage/floor'
import { Label } from '../stage/labels'
import type { Stage } from '../stage/stage'
import type { SceneTheme } from '../stage/theme'
import { placeOf, ToolPath, type Track, trackOf } from './tool_path'

const LABEL = 0.019 // as a part of the distance to it
const MARK = 0.024
const MARK_PIXELS = 27 // its height, about
const SAME_PLACE = 0.02 // m, between labels that would hide each other
const POSES = 7 // of the robot that the camera shows whole

interface Marker {
  readonly label: Label
  readonly finding: Diagnostic
}

/** A motion on the stage: the robot, its first and last pose, the tool's path, the findings. In
 * place of the two poses a second motion of the same robot may go along as a ghost. */
export class PreviewScene {
  readonly robot: SceneRobot
  readonly ready: Promise<void>
  private readonly ghosts: readonly SceneRobot[]
  private readonly path: ToolPath
  private readonly markers: Marker[] = []
  private readonly ends: readonly Label[]
  private readonly looks = new Looks()
  private readonly patch = new ContactPatch()
  private readonly positions: Float64Array
  private readonly undo: (() => void)[] = []
  private chosen = 0
  private frame = -1
  private time = 0

  constructor(
    private readonly stage: Stage,
    private readonly motion: MotionDocument,
    private readonly course: Course,
    meshes: MeshSource,
    words: SceneWords,
    private readonly compared: Course | null = null,
  ) {
    const { urdf, joints } = motion.robot
    const names = joints.map((joint) => joint.name)
    const changed = () => stage.invalidate()
    const make = () => new SceneRobot(urdf, names, meshes, this.looks, changed)
    this.positions = new Float64Array(course.jointCount)
    this.robot = make()
    const track = trackOf(this.robot, course)
    this.ghosts = compared === null ? [make(), make()] : [make()]
    const last = course.duration
    for (const [i, ghost] of this.ghosts.entries()) {
      ghost.setLook('ghost')
      course.sample(i === 0 ? 0 : last, this.positions)
      ghost.setPositions(this.positions)
      ghost.setGripper(course.gripperAt(i === 0 ? 0 : last) === true)
      stage.world.add(ghost.root)
    }
    stage.world.add(this.robot.root, this.patch)

    const bad = motion.findings.filter((one) => one.severity === 'error' && one.first_row > 0)
    const marked = (frame: number) => {
      const row = course.rowOf(frame)
      return bad.some(
        (one) => one.first_row <= row && row <= Math.max(one.last_row, one.first_row),
      )
    }
    this.path = new ToolPath(track, marked)
    stage.world.add(this.path.line)
    const first = this.endLabel(words.start, 0)
    const final = this.endLabel(words.end, last)
    this.ends = [first, final]
    if (first.sprite.position.distanceTo(final.sprite.position) < SAME_PLACE) {
      first.dispose()
      final.dispose()
      this.ends = [this.endLabel(`${words.start}, ${words.end}`, 0)]
    }
    this.mark()
    const spacing = new LabelSpacing(stage, [
      ...this.markers.map((marker) => marker.label),
      ...this.ends,
    ])
    this.undo.push(
      stage.onTheme((theme) => this.setTheme(theme)),
      stage.onFrame(() => {
        spacing.place()
        return false
      }),
    )

    this.ready = Promise.all([this.robot, ...this.ghosts].map((one) => one.ready)).then(() => {
      this.patch.fit(this.robot.footprint())
      this.fit(track)
    })
    this.fit(track)
    this.show(0)
  }

  /** Move the robot to a time, s. */
  show(time: number): void {
    const { course, robot } = this
    this.time = time
    this.frame = course.sample(time, this.positions)
    robot.setPositions(this.positions)
    const closed = course.gripperAt(time)
    if (closed !== null) robot.setGripper(closed)
    this.showCompared(time)
    this.paint()
    this.stage.invalidate()
  }

  private showCompared(time: number): void {
    const [ghost] = this.ghosts
    if (this.compared === null || ghost === undefined) return
    this.compared.sample(time, this.positions)
    ghost.setPositions(this.positions)
    ghost.setGripper(this.compared.gripperAt(time) === true)
  }

  /** Choose a finding by its number, from 1; 0: none. Return its time, s, or null without rows. */
  choose(number: number): number | null {
    this.chosen = number
    this.setTheme(this.stage.theme)
    this.stage.invalidate()
    const finding = this.motion.findings[number - 1]
    if (finding === undefined || finding.first_row === 0) return null
    return this.course.timeOfRow(finding.first_row)
  }

  /** Return the number of the finding whose mark is at a place on the canvas, CSS pixels; 0:
   * none. */
  markAt(x: number, y: number): number {
    const at = new Vector3()
    for (const { label, finding } of this.markers) {
      this.stage.toScreen(label.sprite.position, at)
      // It is above its point, above earlier labels of the same place.
      const up = at.y + (label.sprite.center.y - 0.5) * MARK_PIXELS
      const near = Math.hypot(at.x - x, up - y) < 22
      if (near) return this.motion.findings.indexOf(finding) + 1
    }
    return 0
  }

  setGhosts(on: boolean): void {
    for (const ghost of this.ghosts) ghost.root.visible = on
    for (const label of this.ends) label.sprite.visible = on
    this.stage.invalidate()
  }

  setPath(on: boolean): void {
    this.path.line.visible = on
    this.stage.invalidate()
  }

  dispose(): void {
    for (const undo of this.undo) undo()
    for (const robot of [this.robot, ...this.ghosts]) robot.dispose()
    for (const { label } of this.markers) label.dispose()
    for (const label of this.ends) label.dispose()
    this.path.dispose()
    this.patch.release()
    this.looks.dispose()
  }

  /** Fit the camera to the tool's path and to the robot in some poses. */
  private fit(track: Track): void {
    const points = [new Vector3(-0.1, -0.1, 0), new Vector3(0.1, 0.1, 0)]
    for (let i = 0; i < track.points.length; i += 3 * Math.ceil(track.points.length / 600)) {
      points.push(new Vector3().fromArray(track.points, i))
    }
    for (let pose = 0; pose < POSES; pose++) {
      this.course.sample((pose / (POSES - 1)) * this.course.duration, this.positions)
      this.robot.setPositions(this.positions)
      pushCorners(this.robot.root, this.stage.world, points)
    }
    this.stage.frame(points)
    this.show(Math.max(this.time, 0))
  }

  private endLabel(text: string, time: number): Label {
    const label = new Label(text, LABEL)
    this.course.sample(time, this.positions)
    placeOf(this.robot, this.positions, label.sprite.position)
    this.stage.world.add(label.sprite)
    return label
  }

  private mark(): void {
    for (const [i, finding] of this.motion.findings.entries()) {
      if (finding.first_row === 0) continue
      const label = new Label(String(i + 1), MARK)
      this.course.sample(this.course.timeOfRow(finding.first_row), this.positions)
      placeOf(this.robot, this.positions, label.sprite.position)
      this.stage.world.add(label.sprite)
      this.markers.push({ label, finding })
    }
  }

  /** Grey the robot and paint the link that fails, where a finding applies. */
  private paint(): void {
    const row = this.course.rowOf(this.frame)
    let failing = ''
    for (const [i, finding] of this.motion.findings.entries()) {
      const here =
        finding.first_row > 0 &&
        finding.first_row <= row &&
        row <= Math.max(finding.last_row, finding.first_row)
      const counts = finding.severity === 'error' || i + 1 === this.chosen
      if (here && counts && finding.joint !== '') failing = this.robot.linkOf(finding.joint)
    }
    const refused = this.motion.verdict === 'refused'
    this.robot.setLook(refused || failing !== '' ? 'grey' : 'own', failing)
  }

  private setTheme(theme: SceneTheme): void {
    this.looks.setTheme(theme)
    this.path.setTheme(theme)
    for (const label of this.ends) label.paint(theme.card, theme.second)
    for (const [i, { label, finding }] of this.markers.entries()) {
      const chosen = this.motion.findings[this.chosen - 1] === finding
      label.paint(theme[finding.severity], theme.card, chosen)
      label.sprite.renderOrder = chosen ? 20 : 10 + (this.markers.length - i) / 100
    }
  }
}
