import { signal } from '@preact/signals'
import type { Vector3 } from 'three'
import type { Pointer } from '../input/pointer'
import { XrInputs } from '../input/sources'
import type { Targets } from '../input/targets'
import type { SceneAnchor } from '../place/anchor'
import type { RoomStage } from '../scene/stage'
import type { Feature, Mode } from './features'
import { enter, type RoomSession } from './session'

/** Height of standing eyes above sitting ones, m. */
const LIFT = 0.4

/** The room of a visit. */
interface Visited {
  /** A session has ended. */
  left(): void
  readonly anchor: Pick<SceneAnchor, 'recentre'>
  /** A point of the floor space is pressed where no target is; returns whether that is used up. */
  touch(point: Vector3): boolean
}

/** A person's stay in the room with a headset: the session and its pointers. */
export class Visit {
  /** True while a headset is in the room. */
  readonly inside = signal(false)
  inputs: XrInputs | null = null
  private current: RoomSession | null = null
  private enteredAt = Number.NaN
  private depth = false
  /** The session's own floor space. */
  private floor: XRReferenceSpace | null = null

  constructor(
    private readonly stage: RoomStage,
    private readonly targets: Targets,
    private readonly visited: Visited,
  ) {}

  get session(): XRSession | null {
    return this.current?.session ?? null
  }

  /** True if the real room is visible. */
  get passthrough(): boolean {
    return this.current?.mode === 'immersive-ar'
  }

  /** The features that the session lacks. */
  get missing(): readonly Feature[] {
    return this.current?.missing ?? []
  }

  /** Return the time since the entry, s; NaN: nobody is inside. */
  lasts(now: number): number {
    return now - this.enteredAt
  }

  /** Enter with a headset; must be called by a person's tap. now: s. */
  async enter(mode: Mode, now: number, seated: boolean): Promise<XRSession> {
    this.current = await enter(this.stage.renderer, mode, this.depth, () => this.end())
    const { session } = this.current
    const marked = (point: Vector3) => this.visited.touch(point)
    this.inputs = new XrInputs(session, this.stage.scene, this.targets.all, marked)
    this.stage.controls.enabled = false
    this.stage.setPassthrough(this.passthrough)
    this.floor = this.stage.renderer.xr.getReferenceSpace()
    this.floor?.addEventListener('reset', ({ transform }) => {
      if (transform) this.visited.anchor.recentre(transform)
    })
    this.seat(seated)
    this.enteredAt = now
    this.inside.value = true
    return session
  }

  /** Raise a seated person to standing height, unless the real floor is visible. */
  seat(seated: boolean): void {
    if (this.floor === null) return
    const lift = seated && !this.passthrough
    const space = lift
      ? this.floor.getOffsetReferenceSpace(new XRRigidTransform({ x: 0, y: -LIFT, z: 0 }))
      : this.floor
    this.stage.renderer.xr.setReferenceSpace(space)
  }

  /** Hide robots and objects behind real things; requested at the next entry. */
  hide(behind: boolean): void {
    this.depth = behind
    this.stage.occlusion.wanted = behind
    this.stage.grounds.hide(behind)
  }

  leave(): void {
    this.current?.session.end().catch(() => undefined)
  }

  /** The pointers of the headset. */
  pointers(): Iterable<Pointer> {
    return this.inputs?.pointers() ?? []
  }

  private end(): void {
    this.inputs?.dispose()
    this.inputs = null
    this.current = null
    this.floor = null
    this.enteredAt = Number.NaN
    this.stage.controls.enabled = true
    this.stage.setPassthrough(false)
    this.inside.value = false
    this.visited.left()
  }
}
