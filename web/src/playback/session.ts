import type { Diagnostic } from '../words/diagnostic'
import type { PackedArray } from './motion'

/** Robots and objects that moved: a recording, or what a check rehearsed. Times are s from the first
 * message of the bag, poses x, y, z, qx, qy, qz, qw in the frame world, m. */
export interface SessionDocument {
  readonly schema: string
  readonly title: string
  readonly duration: number
  readonly robots: readonly SessionRobot[]
  readonly objects: readonly SessionObject[]
  /** Of the room; a recording has none. */
  readonly surfaces: readonly SessionSurface[]
  readonly events: readonly SessionEvent[]
}

/** The fields of mrlab_msgs/msg/Surface. */
interface SessionSurface {
  readonly name: string
  readonly label: string
  readonly pose: {
    readonly position: { readonly x: number; readonly y: number; readonly z: number }
    readonly orientation: {
      readonly x: number
      readonly y: number
      readonly z: number
      readonly w: number
    }
  }
  readonly vertices: readonly { readonly x: number; readonly y: number; readonly z: number }[]
  readonly triangles: readonly number[]
}

interface SessionRobot {
  readonly name: string
  readonly model: string
  readonly end_effector: string
  readonly urdf: string
  /** Names in the order of the track's values; fingers too. */
  readonly joints: readonly string[]
  readonly track: SessionTrack
  /** Pose of the base. */
  readonly base: SessionTrack
  /** When each state began, and its name, such as PLAYING. */
  readonly states: readonly (readonly [number, string])[]
  /** From when to when the scene had it, null: to the last; empty: always. */
  readonly there: readonly (readonly [number, number | null])[]
  /** When it was halted by a collision, and which link touched. */
  readonly collisions: readonly (readonly [number, string])[]
}

export interface SessionObject {
  readonly name: string
  readonly mesh: string
  readonly size: { readonly x: number; readonly y: number; readonly z: number }
  readonly color: {
    readonly r: number
    readonly g: number
    readonly b: number
    readonly a: number
  }
  readonly primitive: { readonly type: number; readonly dimensions: readonly number[] }
  /** From when to when it was there. */
  readonly first: number
  readonly last: number
  readonly track: SessionTrack
  /** Since when who holds it; empty: nobody. */
  readonly holders: readonly (readonly [number, string])[]
}

interface SessionEvent {
  readonly time: number
  readonly robot: string
  /** Number of the run, from 1. */
  readonly run: number
  readonly said: Diagnostic
  /** m, in the frame world */
  readonly place: readonly number[]
}

/** The facts of `SessionReport.facts()` that a page shows, and the curves. */
export interface SessionFacts {
  /** ns since the epoch; 0: nothing was recorded */
  readonly start_ns: number
  readonly summary: Diagnostic
  readonly troubles: readonly Diagnostic[]
  readonly runs: readonly SessionRun[]
  readonly robots: readonly RobotFacts[]
  readonly series: readonly MeasuredSeries[]
}

export interface SessionRun {
  readonly number: number
  readonly robot: string
  readonly system: string
  readonly trajectory: string
  readonly start: number
  readonly end: number
  readonly result: 'completed' | 'stopped' | 'halted' | 'open'
  readonly outcome: Diagnostic
  /** s of the trajectory that were played, and its length; 0: not known */
  readonly position: number
  readonly length: number
  readonly speeds: readonly number[]
  readonly actions: readonly { readonly time: number; readonly said: Diagnostic }[]
  readonly deviation: RunDeviation | null
  readonly joints: readonly RunJoint[]
  readonly figures: RunFigures | null
  /** null: not recorded, or left out of many runs */
  readonly curves: RunCurves | null
}

interface RunJoint {
  readonly name: string
  readonly prismatic: boolean
  /** rad or m; null: not known */
  readonly lower: number | null
  readonly upper: number | null
}

/** rad or m; the tool's in m */
interface RunDeviation {
  readonly reference: string
  readonly most: number
  readonly joint: string
  readonly time: number
  readonly tool: number | null
  readonly prismatic: boolean
  readonly said: Diagnostic
}

/** m and m/s of the tool; null: not known */
interface RunFigures {
  readonly way: number | null
  readonly fastest: number | null
  readonly fastest_at: number | null
  readonly near: {
    readonly joint: string
    readonly prismatic: boolean
    readonly room: number
    readonly time: number
  } | null
}

/** (N) s; (N, joints) rad or m; (N, 3) m in world. null: not known */
export interface RunCurves {
  readonly times: PackedArray
  readonly joints: PackedArray
  readonly expected: PackedArray | null
  readonly tool: PackedArray | null
  readonly expected_tool: PackedArray | null
}

export interface Span {
  readonly start: number
  readonly end: number
  readonly label: string
  readonly detail: string
}

export interface RobotFacts {
  readonly name: string
  readonly model: string
  readonly states: readonly Span[]
  readonly grasps: readonly Span[]
  readonly collisions: readonly {
    readonly time: number
    readonly link: string
    readonly other: string
  }[]
  readonly contacts: number
  readonly joint_states: number
  readonly frames_lost: number
}

/** A quantity of the lab itself over time: s, tracking rad. robot: empty: of all topics. */
export interface MeasuredSeries {
  readonly robot: string
  readonly quantity: 'deadline' | 'tracking' | 'latency'
  readonly hop: { readonly ends: string; readonly observer: string } | null
  readonly p50: number
  readonly p95: number
  readonly max: number
  readonly curve: { readonly times: PackedArray; readonly values: PackedArray } | null
}

export interface SessionTrack {
  readonly times: PackedArray
  /** (times, columns) */
  readonly values: PackedArray
}
