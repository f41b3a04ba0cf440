import type { Object3D, PerspectiveCamera, Vector3 } from 'three'
import type { CheckApi } from '../lab/robot_check'
import type { Link } from '../link/link'
import type { ServiceType } from '../protocol/message_type'
import type { TrajectoryInfo } from '../protocol/mrlab_msgs'
import { sentence, spoken, type Told } from '../words/diagnostic'
import type { Words } from '../words/en'
import type { Surroundings } from './panels/panel'
import type { Place, Support } from './place/supports'
import type { Drawings } from './scene/drawings'

/** A catalogue's entry with its picture, once that is read. */
export interface Entry {
  readonly id: string
  readonly name: string
  readonly note: string
  /** What the catalogue can be narrowed to. */
  readonly group: string
  picture: HTMLImageElement | null
}

/** What the parts of the room share. */
export interface RoomContext extends Surroundings {
  readonly link: Link
  readonly words: Words
  /** The lab's frame. */
  readonly world: Object3D
  /** Of the eyes, in the scene. */
  readonly head: Vector3
  readonly robots: readonly Entry[]
  readonly endEffectors: readonly Entry[]
  readonly trajectories: readonly TrajectoryInfo[]
  readonly supports: readonly Support[]
  readonly bases: Iterable<Place>
  readonly leftHanded: boolean
  readonly drawings: Drawings
  readonly checks: CheckApi
  /** Whether the person plays robots, and may have motions checked. */
  readonly commands: boolean
  /** Return the object nearest to a robot's fingers; empty: none is near. */
  objectAt(robot: string): string
  /** Return the robot whose fingers are at a place of the scene; empty: none is. */
  robotAt(place: Vector3): string
  readonly seated: boolean
  /** Nothing glides or pulses. */
  readonly still: boolean
  /** Robots are being chosen: a press takes one into the system, and carries none. */
  readonly choosing: boolean
  /** m: how far away text is read. */
  readonly readAt: number
  /** What the screen of a person without a headset shows; null: somebody is inside. */
  readonly screen: PerspectiveCamera | null
  /** Have the board painted anew. */
  repaintBoard(): void
  /** Tell the person a sentence, where they look; warns: something is wrong, which it is by default. */
  say(text: string, warns?: boolean): void
}

interface Answer extends Told {
  readonly success: boolean
}

/** Call a service; say why where it is refused. Returns the answer, null without one. */
export async function order<Request, Response extends Answer>(
  { link, say }: Pick<RoomContext, 'link' | 'say'>,
  service: string,
  type: ServiceType<Request, Response>,
  request: Request,
): Promise<Response | null> {
  try {
    const answer = await link.call(service, type, request)
    if (!answer.success) say(spoken(answer))
    return answer.success ? answer : null
  } catch (error) {
    say(sentence(error))
    return null
  }
}
