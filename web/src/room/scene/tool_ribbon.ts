import { Color, type Object3D, Vector3 } from 'three'
import { Line2 } from 'three/addons/lines/Line2.js'
import { LineGeometry } from 'three/addons/lines/LineGeometry.js'
import { LineMaterial } from 'three/addons/lines/LineMaterial.js'
import type { Course } from '../../playback/course'
import type { Chain } from '../../scene/robot/chain'

const MOST_POINTS = 600
const WIDTH = 0.008 // m
/** From slow to fast: distinct with every kind of colour vision, and on light and dark walls. */
const RAMP = [0x2f5fd0, 0x2aa6b8, 0x8fd05a, 0xf5d13d, 0xff8a3c].map((each) => new Color(each))

/** The path of the tool in a motion, and its speed. */
interface ToolSpeeds {
  /** x, y, z, m, in the frame of the base */
  readonly points: Float32Array<ArrayBuffer>
  /** m/s at each point */
  readonly speeds: Float32Array
  /** m/s */
  readonly fastest: number
}

/** Follow the tool through a course. */
export function toolSpeeds(chain: Chain, course: Course): ToolSpeeds {
  const count = Math.max(Math.min(course.frameCount, MOST_POINTS), 2)
  const points = new Float32Array(count * 3)
  const speeds = new Float32Array(count)
  const positions = new Float64Array(course.jointCount)
  const at = new Vector3()
  const before = new Vector3()
  const step = course.duration / (count - 1)
  for (let i = 0; i < count; i++) {
    course.sample(i * step, positions)
    chain.tool(positions, at)
    at.toArray(points, i * 3)
    if (i > 0) speeds[i] = step > 0 ? at.distanceTo(before) / step : 0
    before.copy(at)
  }
  speeds[0] = speeds[1] ?? 0
  return { points, speeds, fastest: speeds.reduce((a, b) => Math.max(a, b), 0) }
}

/** Write the colour of a speed, as a share of the fastest. */
export function speedColour(share: number, into: Color): Color {
  const place = Math.min(Math.max(share, 0), 1) * (RAMP.length - 1)
  const low = Math.min(Math.floor(place), RAMP.length - 2)
  return into.copy(RAMP[low] as Color).lerp(RAMP[low + 1] as Color, place - low)
}

/** The path of a robot's tool as a ribbon whose colour is its speed. */
export class ToolRibbon {
  readonly fastest: number
  private readonly geometry = new LineGeometry()
  private readonly material = new LineMaterial({
    worldUnits: true,
    linewidth: WIDTH,
    vertexColors: true,
    toneMapped: false,
  })
  private readonly line: Line2

  constructor(chain: Chain, course: Course, base: Object3D) {
    const { points, speeds, fastest } = toolSpeeds(chain, course)
    this.fastest = fastest
    const colours = new Float32Array(points.length)
    const colour = new Color()
    speeds.forEach((speed, i) => {
      speedColour(fastest > 0 ? speed / fastest : 0, colour).toArray(colours, i * 3)
    })
    this.geometry.setPositions(points)
    this.geometry.setColors(colours)
    this.line = new Line2(this.geometry, this.material)
    this.line.frustumCulled = false
    base.add(this.line)
  }

  dispose(): void {
    this.line.removeFromParent()
    this.geometry.dispose()
    this.material.dispose()
  }
}
