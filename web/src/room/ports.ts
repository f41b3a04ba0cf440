import type { Object3D, PerspectiveCamera, Quaternion, Vector3 } from 'three'
import type { Lab } from '../lab/commands'
import type { TrajectoryInfo } from '../protocol/mrlab_msgs'
import type { Words } from '../words/en'

export type { Lab }

/** The words of the reader's language, and a sentence shown on the board. */
export interface Speech extends Pick<Lab, 'say'> {
  readonly words: Words
}

/** Head and gaze of a person in the floor space, m. */
export interface Viewer {
  readonly head: Vector3
  readonly look: Quaternion
}

/** The lab's frame, and the viewer. */
export interface Frames extends Viewer {
  readonly world: Object3D
}

/** An entry of a catalogue. picture: null until it is loaded. */
export interface Entry {
  readonly id: string
  readonly name: string
  readonly note: string
  /** The catalogue can be narrowed to a group. */
  readonly group: string
  picture: HTMLImageElement | null
  /** Of a robot its shape; null: it has none of its own. */
  readonly body: {
    readonly joints: readonly string[]
    /** rad or m, of each joint */
    readonly home: readonly number[]
    /** m */
    readonly reach: number
    urdf(): Promise<string>
  } | null
}

/** The robots, end effectors and motions that the lab offers. */
export interface Catalogue {
  readonly robots: readonly Entry[]
  readonly endEffectors: readonly Entry[]
  readonly trajectories: readonly TrajectoryInfo[]
}

/** What the person who is signed in may do beside watching. */
export interface May {
  /** Undo, and set the surfaces of the room. */
  readonly scene: boolean
}

/** Settings of the viewer, and the display that they use. */
export interface Preferences {
  readonly leftHanded: boolean
  readonly seated: boolean
  /** Nothing glides or pulses. */
  readonly still: boolean
  /** Distance at which text is read, m. */
  readonly readAt: number
  /** Size of panels and their text; 1: the usual one. */
  readonly textScale: number
  /** Camera of a screen; null: a headset is in the room. */
  readonly screen: PerspectiveCamera | null
}

/** Robots chosen by touch: while it is on, a press chooses a robot and does not carry it. */
export interface Choosing {
  readonly on: boolean
  touch(robot: string): void
}
