import { Icon } from '../design/icons'
import type { Diagnostic } from '../words/diagnostic'
import { say } from '../words/diagnostic'
import { number, words } from '../words/words'
import { Table } from './findings'
import { dotted } from './page'
import { Go } from './run'

/** Marks by a rubric, as JSON has them. */
export interface CheckMarks {
  readonly points: number
  readonly of: number
  readonly tests: readonly {
    readonly name: string
    readonly points: number
    readonly of: number
    readonly passed: boolean
    readonly hidden: boolean
    readonly hint: string
    readonly time: number | null
    readonly found: Diagnostic
  }[]
  readonly hints: readonly string[]
  /** Why there was nothing to mark. */
  readonly note: Diagnostic | null
}

export const STATES = {
  ok: ['complete', 'good'],
  not: ['error', 'bad'],
  unknown: ['warning', 'part'],
} as const

/** The marks by a rubric; lost points lead to their instant. Of what could not be marked, the tests
 * that have points all the same. */
export function Marks({ marks }: { marks: CheckMarks }) {
  const w = words.value
  const tests = marks.tests.filter(({ points }) => marks.note === null || points !== 0)
  return (
    <Table
      name="marks"
      title={dotted([w.grades.marks, w.report.points(number(marks.points), number(marks.of))])}
      heads={
        tests.length > 0
          ? [w.report.result, w.report.pointsHead, w.report.test, w.report.time, w.report.found]
          : []
      }
    >
      {tests.map((test) => {
        const state = test.passed ? 'ok' : test.points > 0 ? 'unknown' : 'not'
        const [icon, kind] = STATES[state]
        return (
          <tr key={test.name}>
            <td>
              <span class={`result result-${kind}`}>
                <Icon name={icon} />
                {w.report.results[state]}
              </span>
            </td>
            <td class="figure">{`${number(test.points)} / ${number(test.of)}`}</td>
            <th scope="row">
              {test.name}
              {test.hidden && <small>{w.report.hidden}</small>}
            </th>
            <td class="figure">{test.time !== null && <Go time={test.time} />}</td>
            <td>
              {say(test.found).message}
              {test.hint && !test.passed && <small>{test.hint}</small>}
            </td>
          </tr>
        )
      })}
      {marks.hints.map((hint) => (
        <tr key={hint}>
          <td class="second" colSpan={5}>
            {hint}
          </td>
        </tr>
      ))}
    </Table>
  )
}
