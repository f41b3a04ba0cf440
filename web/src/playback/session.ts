import type { PackedArray } from './motion'

/** A recorded session; `mrlab_ros/core/show/session.py` writes it. Times are s from the first
 * message of the bag, poses x, y, z, qx, qy, qz, qw in the frame world, m. */
export interface SessionDocument {
  readonly schema: 'mrlab.session.1'
  readonly title: string
  readonly duration: number
  readonly robots: readonly SessionRobot[]
  readonly objects: readonly SessionObject[]
  /** Of the room; a recording has none. */
  readonly surfaces: readonly SessionSurface[]
  readonly events: readonly SessionEvent[]
}

/** The fields of mrlab_msgs/msg/Surface. */
export interface SessionSurface {
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

export interface SessionRobot {
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

export interface SessionEvent {
  readonly time: number
  readonly robot: string
  readonly severity: 'info' | 'warning' | 'error'
  readonly text: string
}

export interface SessionTrack {
  readonly times: PackedArray
  /** (times, columns) */
  readonly values: PackedArray
}
