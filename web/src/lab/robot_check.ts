import { type Signal, signal } from '@preact/signals'
import { type Api, ApiError } from '../api/api'
import type { Check, CheckFinding } from '../api/types'
import { sentence } from '../words/diagnostic'
import type { Words } from '../words/en'

/** ms between two requests for a check that runs, and for one whose scene may change. */
export const RUNNING_MS = 1000
export const STALE_MS = 10_000
/** Marks on a timeline; more would be one band. */
const MOST_MARKS = 60

export type CheckApi = Pick<Api, 'check' | 'startCheck'>

/** A finding at its instant, s. */
interface CheckMark {
  readonly finding: CheckFinding
  readonly time: number
}

/** The check of the motion that a robot has loaded, polled while it runs. */
export class RobotCheck {
  /** null: unknown, or never started. */
  readonly check: Signal<Check | null> = signal(null)
  /** The problem of the last request; empty: none. */
  readonly problem = signal('')
  private trajectory = ''
  private timer: ReturnType<typeof setTimeout> | null = null
  private asked = 0

  constructor(
    private readonly api: CheckApi,
    readonly robot: string,
  ) {}

  /** Take over the loaded motion, such as quintic@3; empty: none. begins: start a check if there
   * is none. */
  async follow(trajectory: string, begins: boolean): Promise<void> {
    if (trajectory === this.trajectory) return
    this.trajectory = trajectory
    this.check.value = null
    this.problem.value = ''
    this.stop()
    if (trajectory === '') return
    const known = await this.ask(() => this.api.check(this.robot, trajectory))
    if (begins && known?.state === 'none') await this.start()
  }

  /** Start a check of the loaded motion in the present scene. */
  async start(): Promise<void> {
    const { trajectory } = this
    if (trajectory === '') return
    await this.ask(() => this.api.startCheck(this.robot, trajectory))
  }

  dispose(): void {
    this.trajectory = ''
    this.stop()
  }

  private stop(): void {
    this.asked++
    if (this.timer !== null) clearTimeout(this.timer)
    this.timer = null
  }

  /** Request a check, unless a newer request follows; repeat it later if the answer may change. */
  private async ask(question: () => Promise<Check>): Promise<Check | null> {
    this.stop()
    const { asked, trajectory } = this
    let answer: Check | null = null
    try {
      answer = await question()
      if (asked !== this.asked) return null
      this.check.value = answer.state === 'none' ? null : answer
      this.problem.value = ''
    } catch (error) {
      if (asked !== this.asked) return null
      // a motion that this person may not see has no check to look at
      if (!(error instanceof ApiError && error.status === 404))
        this.problem.value = sentence(error)
      return null
    }
    const { state } = answer
    if (state === 'none' || state === 'failed') return answer
    const wait = state === 'done' ? STALE_MS : RUNNING_MS
    this.timer = setTimeout(() => {
      void this.ask(() => this.api.check(this.robot, trajectory))
    }, wait)
    return answer
  }
}

/** Return the findings that have an instant within a motion, in their order on the timeline. */
export function marksOf(check: Check | null, duration: number): CheckMark[] {
  if (check === null || check.state !== 'done') return []
  const marks: CheckMark[] = []
  for (const finding of check.findings) {
    if (finding.time !== null && finding.time <= duration + 0.5)
      marks.push({ finding, time: Math.min(finding.time, duration) })
  }
  return marks.sort((a, b) => a.time - b.time).slice(0, MOST_MARKS)
}

/** Return the number of errors and of warnings of a check. */
export function counted(check: Check): { readonly refusing: number; readonly warning: number } {
  let refusing = 0
  let warning = 0
  for (const { severity } of check.findings) {
    if (severity === 'error') refusing++
    else if (severity === 'warning') warning++
  }
  return { refusing, warning }
}

/** Return the words for the code of a finding of a check or a rubric. */
export function kindOf(code: string, { check }: Pick<Words, 'check'>): string {
  const kinds: Readonly<Record<string, string>> = check.kinds
  return kinds[code] ?? code.replaceAll('_', ' ')
}
