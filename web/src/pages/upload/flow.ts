import { batch, computed, signal } from '@preact/signals'
import { type Api, ApiError, isAbort } from '../../api/api'
import type {
  CheckFinding,
  Conversion,
  ConvertOptions,
  Fix,
  Live,
  RobotLibrary,
  TrajectoryInfo,
  Upload,
} from '../../api/types'
import type { MotionDocument } from '../../playback/motion'
import { sentence } from '../../words/diagnostic'
import { applied } from '../motion/fixes'
import { countUse, FIRST_ROBOT } from '../motion/used_robots'

export type Stage =
  | { readonly kind: 'idle' }
  /** share: 0 to 1 */
  | { readonly kind: 'sending'; readonly share: number }
  | { readonly kind: 'converting' }
  | { readonly kind: 'loading' }

/** A person's choices for a conversion. */
interface Choice {
  readonly robot: string
  readonly effector: string
  readonly options: ConvertOptions
}

export interface Result {
  readonly choice: Choice
  readonly conversion: Conversion
  /** null: nothing to show in plots and 3D. */
  readonly motion: MotionDocument | null
  /** What the robot touches with it, among the findings too; undefined: not known. */
  readonly touched?: readonly CheckFinding[]
}

function withTouched(result: Result, touched: readonly CheckFinding[]): Result {
  const { conversion, motion } = result
  const diagnostics = [...conversion.diagnostics, ...touched]
  return {
    ...result,
    touched,
    conversion: { ...conversion, diagnostics },
    motion: motion && { ...motion, findings: [...motion.findings, ...touched] },
  }
}

const ROBOT_KEY = 'mrlab.robot'
const EFFECTOR_KEY = 'mrlab.end_effector'
/** ms until a gateway that did not answer is asked again. */
const AGAIN_MS = 2000

/** The way of a file: chosen, sent, converted, mended, published. Errors keep file and choices. */
export class UploadFlow {
  readonly library = signal<RobotLibrary | null>(null)
  readonly robot = signal(localStorage.getItem(ROBOT_KEY) ?? '')
  readonly effector = signal(localStorage.getItem(EFFECTOR_KEY) ?? '')
  readonly options = signal<ConvertOptions>({})
  readonly file = signal<File | null>(null)
  readonly stage = signal<Stage>({ kind: 'idle' })
  readonly result = signal<Result | null>(null)
  readonly error = signal('')
  readonly published = signal<TrajectoryInfo | null>(null)
  /** The motion as a fix would make it; null: none is looked at. */
  readonly tried = signal<{ readonly fix: Fix; readonly motion: MotionDocument } | null>(null)
  readonly #before = signal<readonly Result[]>([])
  readonly canUndo = computed(() => this.#before.value.length > 0)
  readonly busy = computed(() => this.stage.value.kind !== 'idle')
  /** Whether it is being found out what the robot touches. */
  readonly touching = signal(false)
  #upload: Upload | null = null
  #running: AbortController | null = null
  #trying: AbortController | null = null
  #touching: AbortController | null = null

  constructor(private readonly api: Api) {}

  async loadLibrary(): Promise<void> {
    try {
      const library = await this.api.robots()
      const models = library.robots.map((robot) => robot.model)
      if (!models.includes(this.robot.value))
        this.robot.value = models.includes(FIRST_ROBOT) ? FIRST_ROBOT : (models[0] ?? '')
      if (!library.end_effectors.some((each) => each.id === this.effector.value))
        this.effector.value = ''
      this.library.value = library
    } catch (error) {
      this.error.value = sentence(error)
    }
  }

  /** Take a file, and convert it. */
  async choose(file: File): Promise<void> {
    this.#running?.abort()
    this.file.value = file
    this.#upload = null
    this.options.value = {}
    this.#show(null)
    this.#before.value = []
    this.published.value = null
    await this.run()
  }

  /** Show each motion that a program of this person shows, in place of the one before, until
   * `signal` aborts. current: begin with the one that was shown before this page came. */
  async follow(signal: AbortSignal, current: boolean): Promise<void> {
    let known: string | null = null
    while (!signal.aborted) {
      const before: string | null = known
      try {
        const live: Live | null = await this.api.live(before, signal)
        known = live?.live ?? ''
        if (live !== null && live.live !== before && (before !== null || current))
          await this.#take(live, signal)
      } catch (error) {
        if (signal.aborted) return
        if (error instanceof ApiError && error.status === 401) return
        // one whose draft is there no more is not asked for again
        if (!(error instanceof ApiError && error.status === 404)) known = before
        await new Promise((resolve) => setTimeout(resolve, AGAIN_MS))
      }
    }
  }

  async #take(live: Live, signal: AbortSignal): Promise<void> {
    const { conversion, upload } = live
    const { robot_model: robot, end_effector: effector, id: _, ...given } = live.options
    const motion =
      conversion.motion === null ? null : await this.api.motion(conversion.motion, signal)
    this.#running?.abort()
    const chosen = Object.entries(given).filter(([, value]) => Boolean(value))
    const options: ConvertOptions = Object.fromEntries(chosen)
    batch(() => {
      this.file.value = new File([], upload.file_name)
      this.#upload = upload
      this.robot.value = robot
      this.effector.value = effector
      this.options.value = options
      this.published.value = null
      this.error.value = ''
      this.#before.value = []
      this.tried.value = null
      this.#show({ choice: { robot, effector, options }, conversion, motion })
    })
  }

  /** Show a result; what the robot touches with it follows. */
  #show(result: Result | null): void {
    this.#touching?.abort()
    this.touching.value = false
    this.result.value = result
    const draft = result?.conversion.draft
    if (draft && result.touched === undefined) void this.#touches(result, draft)
  }

  async #touches(result: Result, draft: string): Promise<void> {
    const asked = new AbortController()
    this.#touching = asked
    this.touching.value = true
    try {
      const touched = await this.api.touches(draft, asked.signal)
      if (asked.signal.aborted) return
      this.result.value =
        touched.length === 0 ? { ...result, touched } : withTouched(result, touched)
    } catch {
      // the lab says it before it plays the motion
    }
    if (!asked.signal.aborted) this.touching.value = false
  }

  /** Return to the drop zone. */
  reset(): void {
    this.#running?.abort()
    this.file.value = null
    this.#upload = null
    this.options.value = {}
    this.#show(null)
    this.#before.value = []
    this.published.value = null
    this.error.value = ''
    this.stage.value = { kind: 'idle' }
  }

  chooseRobot(model: string): Promise<void> | undefined {
    if (model === this.robot.value) return
    localStorage.setItem(ROBOT_KEY, model)
    this.robot.value = model
    return this.#again()
  }

  chooseEffector(id: string): Promise<void> | undefined {
    if (id === this.effector.value) return
    localStorage.setItem(EFFECTOR_KEY, id)
    this.effector.value = id
    return this.#again()
  }

  chooseVariable(variable: string): Promise<void> | undefined {
    this.options.value = { ...this.options.value, variable }
    return this.#again()
  }

  apply(fix: Fix): Promise<void> | undefined {
    const options = applied(this.options.value, fix)
    if (options === null) return
    this.options.value = options
    return this.#again()
  }

  /** Convert with a fix to show what it does; null: look at none. */
  async try(fix: Fix | null): Promise<void> {
    this.#trying?.abort()
    this.tried.value = null
    const options = fix && applied(this.options.value, fix)
    if (!fix || !options || this.#upload === null || this.busy.value) return
    const trying = new AbortController()
    this.#trying = trying
    try {
      const { motion } = await this.#convert(options, this.#upload.upload, trying.signal)
      if (motion !== null && !trying.signal.aborted) this.tried.value = { fix, motion }
    } catch {
      // nothing is shown; the press itself says what went wrong
    }
  }

  async #convert(options: ConvertOptions, upload: string, signal: AbortSignal) {
    const robot = { robot_model: this.robot.value, end_effector: this.effector.value }
    const conversion = await this.api.convert({ ...options, upload, ...robot }, signal)
    this.stage.value = this.busy.value ? { kind: 'loading' } : this.stage.value
    const motion = conversion.motion && (await this.api.motion(conversion.motion, signal))
    signal.throwIfAborted()
    return { conversion, motion: motion || null }
  }

  /** Go back to the result before the last change. */
  undo(): void {
    const before = this.#before.value.at(-1)
    if (before === undefined) return
    this.#running?.abort()
    this.#before.value = this.#before.value.slice(0, -1)
    this.robot.value = before.choice.robot
    this.effector.value = before.choice.effector
    this.options.value = before.choice.options
    this.#show(before)
    this.published.value = null
    this.error.value = ''
  }

  cancel(): void {
    this.#touching?.abort()
    this.#running?.abort()
  }

  async publish(id: string, shared: boolean): Promise<void> {
    const draft = this.result.value?.conversion.draft
    if (!draft) return
    countUse(this.robot.value)
    this.published.value = await this.api.publish(draft, id, shared)
  }

  /** Send the file, unless it was sent, and convert it. */
  async run(): Promise<void> {
    const file = this.file.value
    if (file === null) return
    this.#running?.abort()
    const running = new AbortController()
    this.#running = running
    this.error.value = ''
    try {
      if (this.library.value === null) {
        // a file that is faster than the list of robots waits for it
        this.stage.value = { kind: 'sending', share: 0 }
        await this.loadLibrary()
        running.signal.throwIfAborted()
        if (this.library.value === null) return
      }
      const choice: Choice = {
        robot: this.robot.value,
        effector: this.effector.value,
        options: this.options.value,
      }
      if (this.#upload === null) {
        this.stage.value = { kind: 'sending', share: 0 }
        const upload = await this.api.upload(
          file,
          (share) => {
            if (!running.signal.aborted) this.stage.value = { kind: 'sending', share }
          },
          running.signal,
        )
        running.signal.throwIfAborted()
        this.#upload = upload
      }
      this.stage.value = { kind: 'converting' }
      const { upload } = this.#upload
      this.#show({ choice, ...(await this.#convert(choice.options, upload, running.signal)) })
    } catch (error) {
      if (!isAbort(error) && this.#running === running) this.error.value = sentence(error)
    } finally {
      if (this.#running === running) {
        this.#running = null
        this.stage.value = { kind: 'idle' }
      }
    }
  }

  #again(): Promise<void> | undefined {
    void this.try(null)
    this.published.value = null
    if (this.file.value === null) return
    const { value } = this.result
    if (value) this.#before.value = [...this.#before.value, value]
    return this.run()
  }
}
