import type { Diagnostic } from '../words/diagnostic'

/** A graded class; `mrlab_ros/classroom/page.py` writes it. */
export interface ClassDocument {
  readonly schema: 'mrlab.class.1'
  readonly title: string
  /** Source of the submissions: `folder`, or the name of a learning system. */
  readonly form: string
  readonly robot: string
  readonly scene: string
  readonly points: number
  /** mm, of the ways */
  readonly step: number
  readonly tests: readonly ClassTest[]
  readonly statistics: ClassStatistics
  readonly students: readonly ClassStudent[]
  readonly reference: ClassResult | null
  readonly similar: SimilarMotions
  readonly left_out: readonly { readonly file: string; readonly why: Diagnostic }[]
  readonly left_out_count: number
  /** Files of nobody, and students in no row of the platform's table. */
  readonly unmatched: readonly {
    readonly name: string
    readonly why: Diagnostic
    /** The name that is nearest; empty: none. */
    readonly proposed: string
  }[]
}

interface ClassTest {
  readonly name: string
  readonly points: number
  readonly hidden: boolean
}

/** bins: students by tenths of the points, the last with all of them. */
interface ClassStatistics {
  readonly mean: number
  readonly median: number
  readonly full: number
  readonly bins: readonly number[]
  readonly tests: readonly { readonly name: string; readonly students: number }[]
  readonly findings: readonly {
    readonly severity: 'info' | 'warning' | 'error'
    readonly students: number
    readonly said: Diagnostic
  }[]
}

export interface ClassResult {
  readonly key: string
  readonly marked: boolean
  readonly said: Diagnostic
  readonly file: string
  readonly points: number
  readonly of: number
  /** s; null: no motion */
  readonly duration: number | null
  readonly marks: readonly ClassMark[]
  /** Relative to this page; null: none. */
  readonly page: string | null
  /** Of the tool, as `wayOf` reads it; empty: no motion. */
  readonly path: string
}

export interface ClassMark {
  readonly points: number
  readonly passed: boolean
  /** s, at which points were lost; null: no instant */
  readonly time: number | null
  readonly found: Diagnostic
}

export interface ClassStudent extends ClassResult {
  readonly name: string
  readonly identifier: string
  readonly late: boolean
  readonly notes: readonly Diagnostic[]
}

/** Degrees RMS. usual: null: too few to say; as_reference: how many are as the solution. */
export interface SimilarMotions {
  readonly threshold: number
  readonly usual: number | null
  readonly as_reference: number
  readonly groups: readonly {
    readonly keys: readonly string[]
    readonly apart: number
    readonly equal: boolean
  }[]
  /** Keys of those in the picture of pairs, group by group. */
  readonly paired: readonly string[]
  /** How far each is from those before it; null: not to be compared. */
  readonly apart: readonly (readonly (number | null)[])[]
}
