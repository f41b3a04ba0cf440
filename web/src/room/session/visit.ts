import { signal } from '@preact/signals'
import type { Pointer } from '../input/pointer'
import { XrInputs } from '../input/sources'
import type { Targets } from '../input/targets'
import type { RoomStage } from '../stage'
import type { Feature, Mode } from './features'
import { enter, type RoomSession } from './session'

/** Somebody's stay in the room with a headset: its session and what it points with. */
export class Visit {
  /** Whether a headset is in the room. */
  readonly inside = signal(false)
  inputs: XrInputs | null = null
  private current: RoomSession | null = null
  private enteredAt = Number.NaN

  /** left: a session has ended. */
  constructor(
    private readonly stage: RoomStage,
    private readonly targets: Targets,
    private readonly left: () => void,
  ) {}

  get session(): XRSession | null {
    return this.current?.session ?? null
  }

  /** Whether the real room is seen. */
  get passthrough(): boolean {
    return this.current?.mode === 'immersive-ar'
  }

  /** What the session came without. */
  get missing(): readonly Feature[] {
    return this.current?.missing ?? []
  }

  /** Return how long somebody has been inside, s; NaN: nobody is. */
  lasts(now: number): number {
    return now - this.enteredAt
  }

  /** Enter with a headset; must be called by a person's tap. now: s. */
  async enter(mode: Mode, now: number): Promise<XRSession> {
    this.current = await enter(this.stage.renderer, mode, () => this.end())
    const { session } = this.current
    this.inputs = new XrInputs(session, this.stage.scene, this.targets.all)
    this.stage.controls.enabled = false
    this.stage.setPassthrough(this.passthrough)
    this.enteredAt = now
    this.inside.value = true
    return session
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
    this.enteredAt = Number.NaN
    this.stage.controls.enabled = true
    this.stage.setPassthrough(false)
    this.inside.value = false
    this.left()
  }
}
