import { computed, signal } from '@preact/signals'
import { type Api, type ClassPart, submissionUrl } from '../api/api'
import type { GradedClass, Submission } from '../api/types'
import type { MotionDocument } from '../playback/motion'
import { sentence } from '../words/diagnostic'

export type Order = 'class' | 'points'
type ClassApi = Pick<Api, 'gradedClass' | 'motion' | 'classSource' | 'classDo'>

/** The key of the solution's motion. */
export const REFERENCE = 'reference'
/** Motions that are kept: the one shown, those beside it, and the solution. */
const MOST_KEPT = 6

/** Return the submissions as they are stepped through; equal points keep the order of the class. */
export function ordered(all: readonly Submission[], order: Order): readonly Submission[] {
  if (order === 'class') return all
  const share = ({ points, of }: Submission) => (of > 0 ? points / of : 0)
  return [...all].sort((a, b) => share(a) - share(b))
}

/** The submissions of a class, one of which is shown. */
export class ClassSteps {
  readonly graded = signal<GradedClass | null>(null)
  readonly problem = signal('')
  readonly order = signal<Order>('class')
  /** Whether the desk is open: at first where something is to be done, then as its teacher leaves
   * it. */
  readonly deskOpen = signal(false)
  readonly submissions = computed(() =>
    ordered(this.graded.value?.submissions ?? [], this.order.value),
  )
  readonly current = computed(
    () =>
      this.submissions.value.find(({ key }) => key === this.key.value) ??
      this.submissions.value[0] ??
      null,
  )
  /** Its place among all, from 0; -1: there is none. */
  readonly place = computed(() =>
    this.submissions.value.findIndex(({ key }) => key === this.current.value?.key),
  )
  /** How often other motions may have come to hold since the page was opened. */
  readonly runs = signal(0)
  private readonly key = signal('')
  private readonly motions = new Map<string, Promise<MotionDocument>>()

  constructor(private readonly api: ClassApi) {}

  async load(): Promise<void> {
    try {
      const graded = await this.api.gradedClass()
      if (this.graded.value === null) {
        const { run, proposed } = graded.desk
        this.deskOpen.value = !graded.marked || run?.running === true || proposed !== null
      }
      const before = this.graded.value?.desk.run
      if (before?.running && before.how !== 'propose' && !graded.desk.run?.running) {
        this.motions.clear()
        this.runs.value += 1
      }
      this.graded.value = graded
      this.problem.value = ''
    } catch (error) {
      this.problem.value = sentence(error)
    }
  }

  /** Do something at the desk, and read the class again; rejects with why it was not done. */
  async does(method: 'POST' | 'DELETE', part: ClassPart, body?: object): Promise<void> {
    await this.api.classDo(method, part, body)
    await this.load()
  }

  /** Hand in a file under the name that the desk has for it; rejects with why it is not taken. */
  async handIn(name: string, file: File, onProgress: (share: number) => void): Promise<void> {
    await this.api.classSource(name, file, onProgress)
    await this.load()
  }

  choose(key: string): void {
    this.key.value = key
  }

  /** Go to the submission `by` places on; return its key, empty if there is none. */
  step(by: number): string {
    const found = this.submissions.value[this.place.value + by]
    if (found === undefined) return ''
    this.key.value = found.key
    return found.key
  }

  /** Return whether there is a submission `by` places on. */
  has(by: number): boolean {
    return this.submissions.value[this.place.value + by] !== undefined
  }

  /** Return the motion of a submission, or of the solution; rejects with why there is none. */
  motion(key: string): Promise<MotionDocument> {
    let motion = this.motions.get(key)
    if (motion !== undefined) this.motions.delete(key)
    else {
      motion = this.api.motion(submissionUrl(key))
      motion.catch(() => this.motions.delete(key))
    }
    this.motions.set(key, motion)
    for (const old of this.motions.keys()) {
      if (this.motions.size <= MOST_KEPT) break
      if (old !== REFERENCE) this.motions.delete(old)
    }
    return motion
  }

  /** Load the next motion in advance. */
  prepare(): void {
    const next = this.submissions.value[this.place.value + 1]
    if (next?.motion) this.motion(next.key).catch(() => undefined)
  }
}

/** Return the number of places that a key of the keyboard steps; 0: none, or a text is being
 * typed. */
export function stepOf({
  key,
  ctrlKey,
  metaKey,
  altKey,
  target,
}: Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'altKey' | 'target'>): number {
  if (ctrlKey || metaKey || altKey) return 0
  if (
    target instanceof Element &&
    target.closest('input:not([type=range], [type=radio], [type=checkbox]), select, textarea')
  )
    return 0
  return key === 'n' ? 1 : key === 'p' ? -1 : 0
}

/** Return the number of each lost test among the findings of its motion, from 1; kept points: 0. */
export function numbersOf({ marks }: Submission): number[] {
  let number = 0
  return marks.map(({ passed }) => (passed ? 0 : ++number))
}

/** Return the name under which a submission's motion is published, for its teacher alone. */
export function publishedName(key: string): string {
  const plain = key.toLowerCase().replace(/[^a-z0-9]+/g, '_')
  return `class_${plain.replace(/^_+|_+$/g, '')}`.slice(0, 60)
}
