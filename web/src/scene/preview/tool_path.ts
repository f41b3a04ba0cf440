import { Box3, Color, Vector3 } from 'three'
import { Line2 } from 'three/addons/lines/Line2.js'
import { LineGeometry } from 'three/addons/lines/LineGeometry.js'
import { LineMaterial } from 'three/addons/lines/LineMaterial.js'
import type { Course } from '../../playback/course'
import type { SceneRobot } from '../robot/robot'
import type { SceneTheme } from '../stage/theme'

const MOST_POINTS = 1200
const WIDTH = 2.5 // CSS pixels

/** The path of the tool: one place for each sampled frame, in the frame of the robot's base. */
export interface Track {
  readonly frames: Uint32Array
  /** x, y, z, m, of each */
  readonly points: Float32Array
  readonly box: Box3
}

/** Follow the tool by moving the robot through a course; afterwards the robot is at the first
 * frame. */
export function trackOf(robot: SceneRobot, course: Course): Track {
  const count = Math.min(course.frameCount, MOST_POINTS)
  const frames = new Uint32Array(count)
  const points = new Float32Array(count * 3)
  const box = new Box3()
  const positions = new Float64Array(course.jointCount)
  const point = new Vector3()
  for (let i = 0; i < count; i++) {
    const frame = count < 2 ? 0 : Math.round((i * (course.frameCount - 1)) / (count - 1))
    course.sample(course.timeOf(frame), positions)
    placeOf(robot, positions, point)
    frames[i] = frame
    point.toArray(points, i * 3)
    box.expandByPoint(point)
  }
  course.sample(0, positions)
  robot.setPositions(positions)
  return { frames, points, box }
}

/** Write where the tool is at some joint positions, in the frame of the robot's base, m. */
export function placeOf(robot: SceneRobot, positions: Float64Array, into: Vector3): Vector3 {
  robot.setPositions(positions)
  robot.root.updateWorldMatrix(true, false)
  robot.tip.updateWorldMatrix(true, false)
  into.setFromMatrixPosition(robot.tip.matrixWorld)
  return robot.root.worldToLocal(into)
}

/** The line of a track; `marked` says which frames are where a finding applies, null that it is
 * of a motion for comparison. */
export class ToolPath {
  readonly line: Line2
  private readonly geometry = new LineGeometry()
  private readonly material = new LineMaterial({
    linewidth: WIDTH,
    vertexColors: true,
    transparent: true,
    opacity: 0.95,
  })
  private readonly colours: Float32Array

  constructor(
    readonly track: Track,
    private readonly marked: ((frame: number) => boolean) | null,
  ) {
    this.geometry.setPositions(track.points as Float32Array<ArrayBuffer>)
    this.colours = new Float32Array(track.points.length)
    this.line = new Line2(this.geometry, this.material)
    this.line.renderOrder = 2
  }

  setTheme(theme: SceneTheme): void {
    const plain = new Color(this.marked === null ? theme.second : theme.accent)
    const wrong = new Color(theme.failing)
    for (let i = 0; i < this.track.frames.length; i++) {
      const colour = this.marked?.(this.track.frames[i] as number) ? wrong : plain
      colour.toArray(this.colours, i * 3)
    }
    this.geometry.setColors(this.colours as Float32Array<ArrayBuffer>)
  }

  dispose(): void {
    this.line.removeFromParent()
    this.geometry.dispose()
    this.material.dispose()
  }
}
