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
import { JointArc } from './joint_arc'
import { placeOf, ToolPath, trackOf } from './tool_path'

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
  private readonly arc = new JointArc()
  private compared: Course | null = null
  private comparedPath: ToolPath | null = null
  /** The first and the last pose are shown: of a refused motion they would hide what is wrong. */
  showsGhosts: boolean
  private chosen = 0
  private frame = -1
  private time = 0

  constructor(
    private readonly stage: Stage,
    private readonly motion: MotionDocument,
    private readonly course: Course,
    meshes: MeshSource,
    words: SceneWords,
  ) {
    const { urdf, joints } = motion.robot
    const names = joints.map((joint) => joint.name)
    const changed = () => stage.invalidate()
    const make = () => new SceneRobot(urdf, names, meshes, this.looks, changed)
    this.positions = new Float64Array(course.jointCount)
    this.robot = make()
    const track = trackOf(this.robot, course)
    this.showsGhosts = motion.verdict !== 'refused'
    this.ghosts = [make(), make()]
    const last = course.duration
    for (const ghost of this.ghosts) {
      ghost.setLook('ghost')
      stage.world.add(ghost.root)
    }
    stage.world.add(this.robot.root, this.patch, this.arc.group, this.arc.label.sprite)

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
      this.arc.label,
    ])
    this.undo.push(
      stage.onTheme((theme) => this.setTheme(theme)),
      stage.onFrame(() => {
        spacing.place()
        return false
      }),
    )

    this.setCompared(null)
    this.ready = Promise.all([this.robot, ...this.ghosts].map((one) => one.ready)).then(() => {
      this.patch.fit(this.robot.footprint())
      this.fit()
    })
    this.fit()
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
    if (this.compared !== null) this.poseGhost(this.ghosts[0], this.compared, time)
    this.arc.follow(robot)
    this.paint()
    this.stage.invalidate()
  }

  /** Show another motion of the same joints as a ghost; null: the first and the last pose. */
  setCompared(compared: Course | null): void {
    this.compared = compared
    this.comparedPath?.dispose()
    this.comparedPath = null
    const [first] = this.ghosts
    if (compared !== null && first !== undefined) {
      this.comparedPath = new ToolPath(trackOf(first, compared), null)
      this.comparedPath.setTheme(this.stage.theme)
      this.comparedPath.line.visible = this.path.line.visible
      this.stage.world.add(this.comparedPath.line)
    } else {
      for (const [i, ghost] of this.ghosts.entries()) {
        this.poseGhost(ghost, this.course, i === 0 ? 0 : this.course.duration)
      }
    }
    this.setGhosts(this.showsGhosts)
    this.show(this.time)
  }

  private poseGhost(ghost: SceneRobot | undefined, course: Course, time: number): void {
    course.sample(time, this.positions)
    ghost?.setPositions(this.positions)
    ghost?.setGripper(course.gripperAt(time) === true)
  }

  /** Choose a finding by its number, from 1; 0: none. Return its time, s, or null without rows. */
  choose(number: number): number | null {
    this.chosen = number
    const finding = this.motion.findings[number - 1]
    this.showArc(finding)
    this.setTheme(this.stage.theme)
    this.stage.invalidate()
    if (finding === undefined || finding.first_row === 0) return null
    return this.course.timeOfRow(finding.first_row)
  }

  /** Draw the limit at the joint of a finding whose rows go beyond it. */
  private showArc(finding: Diagnostic | undefined): void {
    const { course, motion, robot } = this
    const place = motion.robot.joints.findIndex(({ name }) => name === finding?.joint)
    const joint = motion.robot.joints[place]
    this.arc.clear()
    if (finding === undefined || joint === undefined || joint.kind === 'prismatic') return
    const first = course.frameAt(course.timeOfRow(finding.first_row))
    const last = course.frameAt(course.timeOfRow(finding.last_row))
    let [low, high] = [joint.lower ?? -Infinity, joint.upper ?? Infinity]
    const allowed = [low, high] as const
    for (let frame = first; frame <= last; frame++) {
      const angle = course.positions[frame * course.jointCount + place] as number
      if (angle < low) low = angle
      if (angle > high) high = angle
    }
    const turn = robot.turnOf(joint.name)
    if (turn === null) return
    if (high > allowed[1]) this.arc.set(turn, allowed[1], high, allowed[0])
    else if (low < allowed[0]) this.arc.set(turn, allowed[0], low, allowed[1])
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
    this.showsGhosts = on
    for (const [i, ghost] of this.ghosts.entries())
      ghost.root.visible = this.compared === null ? on : i === 0
    for (const label of this.ends) label.sprite.visible = on && this.compared === null
    this.stage.invalidate()
  }

  setPath(on: boolean): void {
    for (const path of [this.path, this.comparedPath]) if (path !== null) path.line.visible = on
    this.stage.invalidate()
  }

  dispose(): void {
    for (const undo of this.undo) undo()
    for (const robot of [this.robot, ...this.ghosts]) robot.dispose()
    for (const { label } of this.markers) label.dispose()
    for (const label of this.ends) label.dispose()
    this.path.dispose()
    this.comparedPath?.dispose()
    this.arc.dispose()
    this.patch.release()
    this.looks.dispose()
  }

  /** Fit the camera to the paths of the tool and to the robot in some poses. */
  private fit(): void {
    const points = [new Vector3(-0.1, -0.1, 0), new Vector3(0.1, 0.1, 0)]
    const paths = [
      [this.course, this.path],
      [this.compared, this.comparedPath],
    ] as const
    for (const [course, path] of paths) {
      if (course === null || path === null) continue
      const along = path.track.points
      for (let i = 0; i < along.length; i += 3 * Math.ceil(along.length / 600))
        points.push(new Vector3().fromArray(along, i))
      for (let pose = 0; pose < POSES; pose++) {
        course.sample((pose / (POSES - 1)) * course.duration, this.positions)
        this.robot.setPositions(this.positions)
        pushCorners(this.robot.root, this.stage.world, points)
      }
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
      if (!here || !counts) continue
      const { link } = finding.values
      failing = this.robot.linkOf(finding.joint) || (typeof link === 'string' ? link : failing)
    }
    const refused = this.motion.verdict === 'refused'
    this.robot.setLook(refused || failing !== '' ? 'grey' : 'own', failing)
  }

  private setTheme(theme: SceneTheme): void {
    this.looks.setTheme(theme)
    this.path.setTheme(theme)
    this.comparedPath?.setTheme(theme)
    this.arc.setTheme(theme)
    for (const label of this.ends) label.paint(theme.card, theme.second)
    for (const [i, { label, finding }] of this.markers.entries()) {
      const chosen = this.motion.findings[this.chosen - 1] === finding
      label.paint(theme[finding.severity], theme.card, chosen)
      label.sprite.renderOrder = chosen ? 20 : 10 + (this.markers.length - i) / 100
    }
  }
}
