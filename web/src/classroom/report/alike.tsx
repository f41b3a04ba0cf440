import { useMemo, useState } from 'preact/hooks'
import { number, words } from '../../words/words'
import type { ClassDocument, ClassStudent } from '../class_document'
import { Linked, Picture } from './ways'

const MOST_GROUPS = 60
const MOST_MEMBERS = 12

/** Who is nearly the same: a picture of pairs, two of them side by side, and the groups. */
export function Alike({ graded }: { graded: ClassDocument }) {
  const w = words.value.report.class
  const { groups, threshold, usual, as_reference } = graded.similar
  const byKey = useMemo(
    () => new Map(graded.students.map((student) => [student.key, student])),
    [graded],
  )
  const more = groups.length - MOST_GROUPS
  return (
    <section class="card alike">
      <h2>{w.alike}</h2>
      {groups.length === 0 && <p class="small">{w.nobodyAlike}</p>}
      {groups.length > 0 && <Pairs graded={graded} byKey={byKey} />}
      <ol class="groups">
        {groups.slice(0, MOST_GROUPS).map(({ keys, equal, apart }) => (
          <li key={keys.join()}>
            <p class="second small">{equal ? w.sameFile : w.apart(number(apart, 2))}</p>
            <ul>
              {keys.slice(0, MOST_MEMBERS).map((key) => {
                const student = byKey.get(key)
                return (
                  student && (
                    <li key={key} data-alike={key}>
                      <Picture result={student} spots={false} />
                      <Linked to={student.page}>
                        <bdi>{student.name}</bdi>
                      </Linked>
                    </li>
                  )
                )
              })}
              {keys.length > MOST_MEMBERS && <li>{w.andMore(keys.length - MOST_MEMBERS)}</li>}
            </ul>
          </li>
        ))}
        {more > 0 && <li>{w.andMoreGroups(more)}</li>}
      </ol>
      <p class="second small">
        {w.howAlike(number(threshold), usual === null ? null : number(usual))}
        {as_reference > 0 && ` ${w.asReference(as_reference)}`}
      </p>
    </section>
  )
}

/** Each of the groups against each, darker where they are nearer, and a pair that is pressed. */
function Pairs({
  graded,
  byKey,
}: {
  graded: ClassDocument
  byKey: ReadonlyMap<string, ClassStudent>
}) {
  const w = words.value.report.class
  const { paired, apart, groups, threshold, usual } = graded.similar
  const [[row, column], setPair] = useState<readonly [number, number]>([1, 0])
  const far = usual ?? 10 * threshold
  const nameOf = (place: number) => byKey.get(paired[place] ?? '')?.name ?? ''
  const equal = (i: number, j: number) =>
    groups.some(
      (group) => group.equal && [i, j].every((at) => group.keys.includes(paired[at] ?? '')),
    )
  const said = (i: number, j: number, degrees: number) =>
    equal(i, j) ? w.sameFile : w.pairApart(number(degrees, 2))
  const shown = apart[row]?.[column] ?? null
  return (
    <div class="pairs">
      <div>
        <p class="second small">{w.pairs}</p>
        {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by keyboard */}
        <div class="pairs-grid" tabIndex={0}>
          {apart.map((cells, i) => (
            <p key={paired[i]}>
              {cells.map((degrees, j) =>
                degrees === null ? (
                  <i key={paired[j]} />
                ) : (
                  <button
                    type="button"
                    key={paired[j]}
                    // of many only what is near is a stop of the keyboard
                    tabIndex={degrees <= threshold ? 0 : -1}
                    aria-pressed={row === i && column === j}
                    aria-label={`${nameOf(i)}, ${nameOf(j)}: ${said(i, j, degrees)}`}
                    title={`${nameOf(i)}, ${nameOf(j)}: ${said(i, j, degrees)}`}
                    onClick={() => setPair([i, j])}
                  >
                    <i
                      style={{
                        opacity: degrees <= threshold ? 1 : 0.6 * (1 - Math.min(degrees / far, 1)),
                      }}
                    />
                  </button>
                ),
              )}
              <bdi>{nameOf(i)}</bdi>
            </p>
          ))}
        </div>
      </div>
      {shown !== null && (
        <div class="pair" aria-live="polite">
          <p>{said(row, column, shown)}</p>
          {[
            [row, column],
            [column, row],
          ].map(([at = 0, other = 0]) => {
            const student = byKey.get(paired[at] ?? '')
            return (
              student && (
                <figure key={student.key}>
                  <Picture result={student} beside={paired[other]} spots={false} />
                  <figcaption>
                    <Linked to={student.page}>
                      <bdi>{student.name}</bdi>
                    </Linked>
                    <small>
                      <bdi>{student.file}</bdi> ·{' '}
                      {w.pairFigures(number(student.points), number(student.duration ?? 0, 2))}
                    </small>
                  </figcaption>
                </figure>
              )
            )
          })}
        </div>
      )}
    </div>
  )
}
