import type { Diagnostic } from '../words/diagnostic'

export interface ClassRun {
  readonly how: 'propose' | 'hold' | 'back' | 'final'
  readonly running: boolean
  readonly done: number
  readonly all: number
  readonly problem: Diagnostic | null
  readonly notes: readonly Diagnostic[]
}

/** Points before and after; null: the student or the test is not there. */
export interface ClassDifference {
  readonly key: string
  readonly name: string
  readonly before: number | null
  readonly after: number | null
  readonly tests: readonly {
    readonly name: string
    readonly before: number | null
    readonly after: number | null
  }[]
}

/** A file of nobody, or a student in no row of the platform's table. */
export interface Unmatched {
  readonly kind: 'file' | 'student'
  /** Path of the file, or the student's key. */
  readonly what: string
  readonly name: string
  readonly why: Diagnostic
  /** A student's key, or the identifier of a row; empty: nobody is near. */
  readonly proposal: string
  readonly proposed: string
  /** Since the last run. */
  readonly decided: boolean
}

export interface PlatformRow {
  /** Of the submission that it would have. */
  readonly key: string
  readonly name: string
  readonly identifier: string
}

export interface ClassAct {
  /** s since 1970 */
  readonly at: number
  readonly who: string
  readonly did:
    | 'mark'
    | 'second'
    | 'comment'
    | 'assign'
    | 'enrol'
    | 'lock'
    | 'release'
    | 'undo'
    | 'adopt'
    | 'take_back'
  /** Of the student; empty: of all. */
  readonly name: string
  readonly test: string
  readonly points: number | null
  readonly text: string
}
