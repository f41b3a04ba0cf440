import type { ComponentChildren } from 'preact'
import { useContext } from 'preact/hooks'
import { FindingItem } from '../design/finding'
import type { Diagnostic } from '../words/diagnostic'
import { said, say } from '../words/diagnostic'
import { words } from '../words/words'
import { PlayheadContext } from './plot/playhead'

/** Findings on a page of paper; as in report.css. */
const PRINTED = 8

interface FindingsProps<Found extends Diagnostic> {
  readonly title: string
  readonly findings: readonly Found[]
  /** Of the robot, in its order. */
  readonly joints?: readonly { readonly name: string }[] | undefined
  /** The place to which each applies. */
  readonly where: (finding: Found) => string
  /** Return whether a finding has an instant to go to. */
  readonly placed: (finding: Found) => boolean
  readonly onShow: (number: number) => void
}

/** The findings, with the numbers that plots and the 3D view use. */
export function Findings<Found extends Diagnostic>(props: FindingsProps<Found>) {
  const { title, findings, joints, where, placed, onShow } = props
  const { selected } = useContext(PlayheadContext)
  if (findings.length === 0) return null
  return (
    <section class="report-findings" aria-labelledby="findings">
      <h2 id="findings">{title}</h2>
      <ol class="findings">
        {findings.map((finding, index) => {
          const lines = new Set(finding.fixes.map((fix) => fix.matlab).filter(Boolean))
          return (
            <FindingItem
              key={`${finding.code} ${index}`}
              number={index + 1}
              severity={finding.severity}
              code={finding.code}
              where={where(finding)}
              message={said(finding, joints)}
              remedy={say(finding).remedy}
              onShow={placed(finding) ? () => onShow(index + 1) : undefined}
              shown={selected.value === index + 1}
            >
              {[...lines].map((line) => (
                <div class="matlab" key={line}>
                  <code>{line}</code>
                </div>
              ))}
            </FindingItem>
          )
        })}
      </ol>
      {findings.length > PRINTED && (
        <p class="findings-more second">
          {words.value.report.morePrinted(findings.length - PRINTED)}
        </p>
      )}
    </section>
  )
}

/** Return how a row or several are named; empty: none. */
export function rowsOf(finding: Diagnostic): string {
  const w = words.value.upload
  if (finding.first_row === 0) return ''
  return finding.last_row > finding.first_row
    ? w.rows(finding.first_row, finding.last_row)
    : w.row(finding.first_row)
}

/** The picture that was there before the script, for paper. */
export function Still({ pictures }: { pictures: readonly Picture[] }) {
  if (pictures.length === 0) return null
  return (
    <figure class="poster">
      {pictures.map(({ source, text }) => (
        <img key={source} src={source} alt={text} title={text} />
      ))}
    </figure>
  )
}

export interface Picture {
  readonly source: string
  readonly text: string
}

/** A table with a heading. */
export function Table(props: {
  title: ComponentChildren
  name: string
  heads: readonly ComponentChildren[]
  children: ComponentChildren
}) {
  return (
    <section class={`card report-table ${props.name}`}>
      <h2>{props.title}</h2>
      <table class="table">
        {props.heads.length > 0 && (
          <thead>
            <tr>
              {props.heads.map((head, i) => (
                <th scope="col" key={i}>
                  {head}
                </th>
              ))}
            </tr>
          </thead>
        )}
        <tbody>{props.children}</tbody>
      </table>
    </section>
  )
}
