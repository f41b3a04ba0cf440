import { useEffect, useMemo, useRef, useState } from 'preact/hooks'
import { Icon } from '../../design/icons'
import { Notice } from '../../design/notice'
import { printing } from '../../report/fold'
import { Page } from '../../report/page'
import { scaleOf } from '../../report/plot/thumbnail'
import { wayOf } from '../../report/plot/way'
import { say } from '../../words/diagnostic'
import { number, words } from '../../words/words'
import type { ClassDocument, ClassMark, ClassResult, ClassStudent } from '../class_document'
import { Alike } from './alike'
import { type Column, FILTERS, type Filter, isShown, sorted } from './class_rows'
import { Drawn, Linked, Picture } from './ways'

// Rows that are drawn at once; as many again come where the last of them is scrolled to.
const ROWS = 24
const HISTOGRAM = { width: 480, height: 150, base: 128 }
const STATES = {
  passed: ['complete', 'good'],
  partly: ['warning', 'part'],
  lost: ['error', 'bad'],
  none: ['circle', 'none'],
} as const
type State = keyof typeof STATES

/** The report of a graded class: common mistakes, a row for each student, and similar
 * submissions. */
export function ClassReport({ graded }: { graded: ClassDocument }) {
  const w = words.value.report.class
  const { students, reference, statistics } = graded
  const drawn = useMemo(() => {
    const all = reference ? [...students, reference] : students
    const ways = new Map(all.map(({ key, path }) => [key, wayOf(path, graded.step)]))
    return {
      ways,
      scale: scaleOf([...ways.values()]),
      reference: (reference && ways.get(reference.key)) ?? [],
    }
  }, [graded])
  useEffect(() => {
    document.documentElement.dataset.ready = 'true'
  }, [])
  const marked = students.filter((one) => one.marked).length
  const all = number(graded.points)
  return (
    <Drawn.Provider value={drawn}>
      <Page
        title={graded.title}
        facts={[
          graded.robot,
          graded.scene,
          w.checked(marked, students.length),
          w.average(number(statistics.mean), number(statistics.median), all),
          w.full(statistics.full),
          graded.form === 'folder' ? w.fromFolder : w.fromExport(graded.form),
        ]}
        notes={
          reference &&
          reference.points < reference.of && (
            <Notice severity="warning">
              {w.referenceGets(number(reference.points), number(reference.of))}
            </Notice>
          )
        }
        foot={[w.claim]}
      >
        {graded.unmatched.length > 0 && (
          <section class="card unmatched">
            <h2>{w.unmatched(graded.unmatched.length)}</h2>
            <ul class="small">
              {graded.unmatched.map(({ name, why, proposed }) => (
                <li key={name}>
                  <bdi>{name}</bdi>
                  <span>
                    {say(why).message} {proposed && w.proposal(proposed)}
                  </span>
                </li>
              ))}
            </ul>
          </section>
        )}
        <div class="class-cards">
          <Histogram graded={graded} />
          <Lost graded={graded} />
          <Common graded={graded} />
        </div>
        {graded.left_out_count > 0 && (
          <details class="card report-fold">
            <summary>
              <h2>{w.leftOut(graded.left_out_count)}</h2>
            </summary>
            <ul class="small">
              {graded.left_out.map(({ file, why }) => (
                <li key={file}>
                  <code>{file}</code> {say(why).message}
                </li>
              ))}
            </ul>
          </details>
        )}
        <Students graded={graded} />
        <Alike graded={graded} />
      </Page>
    </Drawn.Provider>
  )
}

function Histogram({ graded }: { graded: ClassDocument }) {
  const w = words.value.report
  const { bins } = graded.statistics
  const { width, height, base } = HISTOGRAM
  const most = Math.max(...bins, 1)
  const step = width / bins.length
  return (
    <section class="card">
      <h2>{w.pointsHead}</h2>
      <svg
        class="histogram"
        viewBox={`0 0 ${width} ${height}`}
        role="img"
        aria-label={w.class.histogram(bins.join(', '))}
      >
        <line x1="0" x2={width} y1={base} y2={base} />
        {bins.map((count, i) => {
          const tall = ((base - 20) * count) / most
          return (
            <g key={i}>
              <rect x={i * step + 3} y={base - tall} width={step - 6} height={tall} rx="2" />
              {count > 0 && (
                <text x={(i + 0.5) * step} y={base - tall - 5}>
                  {count}
                </text>
              )}
              {i % 2 === 0 && (
                <text class="tick" x={i * step} y={height - 6}>
                  {number((graded.points * i) / bins.length)}
                </text>
              )}
            </g>
          )
        })}
        <text class="tick end" x={width} y={height - 6}>
          {number(graded.points)}
        </text>
      </svg>
    </section>
  )
}

function Lost({ graded }: { graded: ClassDocument }) {
  const w = words.value.report.class
  const { tests } = graded.statistics
  return (
    <section class="card">
      <h2>{w.lost}</h2>
      {tests.length === 0 && <p class="small">{w.nobodyLost}</p>}
      <ol class="counts">
        {tests.map(({ name, students }) => (
          <li key={name}>
            <meter min={0} max={graded.students.length} value={students} />
            <b>{students}</b>
            <span>{name}</span>
          </li>
        ))}
      </ol>
    </section>
  )
}

function Common({ graded }: { graded: ClassDocument }) {
  const w = words.value.report.class
  const { findings } = graded.statistics
  return (
    <section class="card">
      <h2>{w.commonest}</h2>
      {findings.length === 0 && <p class="small">{w.nothingFound}</p>}
      <ol class="counts messages">
        {findings.map(({ severity, students, said }) => (
          <li key={said.code + said.message} class={`tone-${severity}`}>
            <b>{students}</b>
            <span>{say(said).message}</span>
          </li>
        ))}
      </ol>
    </section>
  )
}

function Students({ graded }: { graded: ClassDocument }) {
  const w = words.value.report
  const { students, reference, tests, similar } = graded
  const [text, setText] = useState('')
  const [filter, setFilter] = useState<Filter>('')
  const [order, setOrder] = useState<{ column: Column; descending: boolean } | null>(null)
  const [count, setCount] = useState(ROWS)
  const search = useRef<HTMLInputElement>(null)
  const more = useRef<HTMLParagraphElement>(null)
  const alike = useMemo(() => new Set(similar.groups.flatMap(({ keys }) => keys)), [similar])
  useEffect(() => {
    const key = (event: KeyboardEvent) => {
      if (event.key !== '/' || event.target instanceof HTMLInputElement) return
      event.preventDefault()
      search.current?.focus()
    }
    document.addEventListener('keydown', key)
    return () => document.removeEventListener('keydown', key)
  }, [])
  const found = students.filter((row) => isShown(row, text, filter, alike))
  const rows = order === null ? found : sorted(found, order.column, order.descending)
  const drawn = printing.value ? rows : rows.slice(0, count)
  useEffect(() => {
    if (more.current === null) return
    const near = new IntersectionObserver(([entry]) => {
      if (entry?.isIntersecting) setCount(count + ROWS)
    })
    near.observe(more.current)
    return () => near.disconnect()
  }, [count, drawn.length < rows.length])
  // names from A, points from the most; once more turns it round
  const sortBy = (column: Column) => {
    const descending = order?.column === column ? !order.descending : column !== 'name'
    setOrder({ column, descending })
  }
  const head = (column: Column, title: string, more: readonly string[] = []) => (
    <th
      scope="col"
      key={column}
      class={typeof column === 'number' ? 'test' : column}
      aria-sort={order?.column !== column ? 'none' : order.descending ? 'descending' : 'ascending'}
    >
      <button type="button" onClick={() => sortBy(column)}>
        {title}
      </button>
      {more.map((each) => (
        <small key={each}>{each}</small>
      ))}
    </th>
  )
  return (
    <section class="card students" aria-label={w.class.students}>
      <div class="tools">
        <label>
          {w.class.search}{' '}
          <input
            type="search"
            ref={search}
            value={text}
            onInput={(event) => setText(event.currentTarget.value)}
          />
        </label>
        <label>
          {w.class.show}{' '}
          <select
            value={filter}
            onChange={(event) => setFilter(event.currentTarget.value as Filter)}
          >
            {FILTERS.map((each) => (
              <option key={each} value={each}>
                {w.class.filters[each]}
              </option>
            ))}
          </select>
        </label>
        <span class="legend">
          {(Object.keys(STATES) as State[]).map((state) => (
            <span key={state} class={`result result-${STATES[state][1]}`}>
              <Icon name={STATES[state][0]} />
              {w.class.states[state]}
            </span>
          ))}
        </span>
        <output aria-live="polite">{w.class.shown(rows.length, students.length)}</output>
      </div>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls is reached by keyboard */}
      <div class="scroll" tabIndex={0}>
        <table>
          <thead>
            <tr>
              {head('name', w.class.student)}
              <th scope="col">{w.class.motion}</th>
              {head('points', w.pointsHead, [number(graded.points)])}
              {tests.map((test, place) =>
                head(place, test.name, [number(test.points), ...(test.hidden ? [w.hidden] : [])]),
              )}
            </tr>
          </thead>
          <tbody>
            {drawn.map((row) => (
              <Row key={row.key} result={row} student={row} />
            ))}
          </tbody>
          {reference && (
            <tfoot>
              <Row result={reference} student={null} />
            </tfoot>
          )}
        </table>
        {drawn.length < rows.length && (
          <p ref={more}>
            <button type="button" class="button" onClick={() => setCount(count + ROWS)}>
              {w.class.more(rows.length - drawn.length)}
            </button>
          </p>
        )}
      </div>
    </section>
  )
}

function Row({ result, student }: { result: ClassResult; student: ClassStudent | null }) {
  const w = words.value.report
  const { marked, duration, page } = result
  const notes = student?.notes ?? []
  // a row without a motion says why
  const why = !marked || duration === null ? [result.said, ...notes] : notes
  return (
    <tr data-key={result.key}>
      <th scope="row">
        <Linked to={page}>
          {student === null ? w.class.reference : <bdi>{student.name}</bdi>}
        </Linked>
        {student?.identifier && <small>{student.identifier}</small>}
        {student?.late && <small class="late">{w.class.late}</small>}
        {student && result.file && (
          <small>
            <bdi>{result.file}</bdi>
          </small>
        )}
        {why.map((note) => (
          <small key={note.message} class="why" title={say(note).message}>
            {say(note).message}
          </small>
        ))}
      </th>
      <td>
        <Picture result={result} />
      </td>
      <td class="points">
        <b>{number(result.points)}</b>
        {student && <meter min={0} max={result.of || 1} value={result.points} />}
      </td>
      {result.marks.map((mark, place) => (
        <Cell key={place} mark={mark} marked={marked} page={page} />
      ))}
    </tr>
  )
}

function Cell({ mark, marked, page }: { mark: ClassMark; marked: boolean; page: string | null }) {
  const state: State = !marked
    ? 'none'
    : mark.passed
      ? 'passed'
      : mark.points > 0
        ? 'partly'
        : 'lost'
  const [icon, kind] = STATES[state]
  const at = mark.time === null ? '' : `#t=${mark.time.toFixed(2)}`
  const when = mark.time === null ? '' : `${number(mark.time, 2, 2)} s: `
  return (
    <td title={`${when}${say(mark.found).message}`}>
      <Linked to={page === null ? null : page + at}>
        <span class={`result result-${kind}`}>
          <Icon name={icon} />
          <span class="spoken">{words.value.report.class.states[state]}</span>
          {number(mark.points)}
        </span>
      </Linked>
    </td>
  )
}
