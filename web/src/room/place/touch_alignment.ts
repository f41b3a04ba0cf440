import {
  type Group,
  type Matrix4,
  Mesh,
  MeshBasicMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from 'three'
import { COMMON } from '../../lab/people/parts'
import type { Words } from '../../words/en'
import type { Speech } from '../ports'
import type { SceneAnchor } from './anchor'
import type { RoomScan } from './scan'

const MARK = 0.02 // m

const position = new Vector3()
const turn = new Quaternion()

type Awaited = 'nothing' | 'first' | 'second'

/** Aligns the headsets of a room: people who touch the same two points in the same order see the
 * lab in the same place. */
export class TouchAlignment {
  awaited: Awaited = 'nothing'
  private readonly first = new Vector3()
  private readonly marks: readonly Mesh[]
  private readonly shape = new SphereGeometry(MARK, 16, 12)
  private readonly look = new MeshBasicMaterial({ color: 0xffe08a, toneMapped: false })
  /** The others that the last alignment was with, by their frame; another object each time. null:
   * it was undone, or there was none. */
  joined: { readonly frame: string } | null = null
  /** The frame of those with whom the awaited touches align. */
  private joins = COMMON
  /** The earlier pose of the scene in the frame of its present one: a recentre moves both. */
  private before: Matrix4 | null = null

  /** group: moved by the anchor. marks: shows the touched points, in the floor space. ports: says
   * which touch is awaited. */
  constructor(
    private readonly anchor: SceneAnchor,
    private readonly group: Group,
    private readonly scan: RoomScan,
    marks: Group,
    private readonly ports: Speech,
  ) {
    this.marks = [0, 1].map(() => new Mesh(this.shape, this.look))
    for (const mark of this.marks) mark.visible = false
    marks.add(...this.marks)
  }

  private get words(): Words['room'] {
    return this.ports.words.room
  }

  get canUndo(): boolean {
    return this.before !== null
  }

  /** frame: of those who touch the same points. */
  begin(frame = COMMON): void {
    this.joins = frame
    this.awaited = 'first'
    this.show(0, null)
    this.show(1, null)
    this.ports.say(this.words.alignFirst, false)
  }

  /** The session has ended. */
  end(): void {
    this.before = this.joined = null
    this.cancel()
  }

  cancel(): void {
    this.awaited = 'nothing'
    this.show(0, null)
    this.show(1, null)
  }

  /** A point was touched, in the floor space; returns whether it was awaited. */
  touch(point: Vector3): boolean {
    if (this.awaited === 'nothing') return false
    if (this.awaited === 'first') {
      this.first.copy(point)
      this.show(0, point)
      this.awaited = 'second'
      this.ports.say(this.words.alignSecond, false)
      return true
    }
    const footing = footingOf(this.first, point)
    if (footing === null) {
      this.ports.say(this.words.alignNear)
      return true
    }
    this.show(1, point)
    this.awaited = 'nothing'
    this.group.updateMatrixWorld(true)
    const old = this.group.matrixWorld.clone()
    stand(footing, Number.isNaN(this.scan.floor) ? 0 : this.scan.floor, position, turn)
    this.anchor.put(position, turn)
    this.group.updateMatrixWorld(true)
    this.before = this.group.matrixWorld.clone().invert().multiply(old)
    this.joined = { frame: this.joins }
    this.ports.say(this.words.alignDone, false)
    return true
  }

  /** Undo the last alignment. */
  undo(): void {
    if (this.before === null) return
    this.group.updateMatrixWorld(true)
    const old = this.group.matrixWorld.clone().multiply(this.before)
    this.before = this.joined = null
    old.decompose(position, turn, new Vector3())
    this.anchor.put(position, turn)
    this.group.updateMatrixWorld(true)
    this.cancel()
    this.ports.say(this.words.alignUndone, false)
  }

  dispose(): void {
    for (const mark of this.marks) mark.removeFromParent()
    this.shape.dispose()
    this.look.dispose()
  }

  private show(index: number, point: Vector3 | null): void {
    const mark = this.marks[index] as Mesh
    mark.visible = point !== null
    if (point !== null) mark.position.copy(point)
  }
}

/** m: nearer points define no reliable direction. */
const NEAREST = 0.4

/** The lab's origin in the floor space, and its heading about the vertical. */
interface Footing {
  readonly x: number
  readonly z: number
  /** rad; 0: the lab's x points along -z */
  readonly yaw: number
}

/** Return the lab's footing from two points touched in the floor space: its origin is below the
 * first, its x points to the second. null: they are too near to each other. Heights are ignored:
 * each headset knows its floor. */
export function footingOf(first: Vector3, second: Vector3): Footing | null {
  const x = second.x - first.x
  const z = second.z - first.z
  if (Math.hypot(x, z) < NEAREST) return null
  return { x: first.x, z: first.z, yaw: Math.atan2(-x, -z) }
}

/** Write a footing on a floor of a height, m. */
export function stand(
  { x, z, yaw }: Footing,
  floor: number,
  position: Vector3,
  turn: Quaternion,
): void {
  position.set(x, floor, z)
  turn.set(0, Math.sin(yaw / 2), 0, Math.cos(yaw / 2))
}
