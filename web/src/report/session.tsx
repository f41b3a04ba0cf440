import { useSignal } from '@preact/signals'
import { useEffect, useMemo, useRef } from 'preact/hooks'
import { Icon } from '../design/icons'
import type { SessionDocument, SessionFacts, SessionRun } from '../playback/session'
import type { MeshBytes } from '../scene/robot/meshes'
import { say } from '../words/diagnostic'
import { dateTime, words } from '../words/words'
import { Table } from './findings'
import { Fold, printing } from './fold'
import { instantOf } from './instant'
import { Page } from './page'
import { lasting } from './plot/axis'
import { type Playhead, PlayheadContext } from './plot/playhead'
import { stateWord, Timeline } from './plot/timeline'
import { Go, RunView, Technical } from './run'
import { createSessionView, type SessionView } from './session_view'

const MOST_EVENTS = 200
const MOST_MARKS = 60
/** Most pictures of the scene on paper. */
const MOST_PICTURES = 6
const RESULTS = {
  completed: ['complete', 'good'],
  stopped: ['pause', 'part'],
  halted: ['halt', 'bad'],
  open: ['play', 'part'],
} as const

/** A recording and its report; `mrlab_ros/app/show/session.py` writes it. */
export interface RecordedSession extends SessionDocument {
  readonly schema: 'mrlab.session.1'
  readonly report: SessionFacts
}

interface SceneMark {
  readonly time: number
  readonly severity: 'info' | 'warning' | 'error'
  readonly words: string
}

/** Return the playhead of a session, and the function that puts its scene into an element. first:
 * the finding at which it opens, null: at its beginning. */
export function useSession(
  session: SessionDocument,
  meshes: MeshBytes,
  marks: readonly SceneMark[],
  first: { readonly number: number; readonly time: number } | null = null,
) {
  const view = useRef<HTMLElement>(null)
  const shown = useRef<SessionView | null>(null)
  const time = useSignal(0)
  const selected = useSignal(0)
  const playhead = useMemo<Playhead>(
    () => ({
      time,
      selected,
      seek: (to) => {
        if (shown.current) shown.current.seek(to)
        else time.value = to
      },
    }),
    [time, selected],
  )
  useEffect(() => {
    if (view.current === null) {
      document.documentElement.dataset.ready = 'true'
      return
    }
    shown.current = createSessionView(view.current, session, {
      meshes,
      words: words.value.scene,
      marks: marks.slice(0, MOST_MARKS),
      wordOf: stateWord,
      onTime: (now) => {
        time.value = now
      },
    })
    // A link from elsewhere opens the page at an instant: check.html#t=3.2
    const follow = () => {
      const instant = instantOf(location.hash, session.duration)
      if (instant !== null) playhead.seek(instant)
      return instant !== null
    }
    addEventListener('hashchange', follow)
    if (follow()) return
    if (first === null) return
    selected.value = first.number
    playhead.seek(first.time)
  }, [])
  return { view, shown, playhead }
}

/** Pictures of the scene in its place on paper. */
export function Film({
  shown,
  times,
}: {
  shown: { readonly current: SessionView | null }
  times: readonly number[]
}) {
  if (!printing.value) return null
  const different = [...new Set(times)]
  const step = Math.ceil(different.length / MOST_PICTURES)
  const some = different.filter((_, i) => i % step === 0)
  const pictures = (some.length > 0 ? some : [0]).flatMap((time) => {
    const source = shown.current?.pictureAt(time) ?? ''
    return source === '' ? [] : [{ time, source }]
  })
  if (pictures.length === 0) return null
  return (
    <figure class="poster film">
      {pictures.map(({ time, source }) => (
        <div key={time}>
          <img src={source} alt={lasting(time)} />
          <p>{lasting(time)}</p>
        </div>
      ))}
    </figure>
  )
}

/** The report of a recorded session. */
export function SessionReport({
  session,
  meshes,
}: {
  session: RecordedSession
  meshes: MeshBytes
}) {
  const w = words.value.report
  const { events, report } = session
  const { runs, robots } = report
  const marks = events
    .filter(({ said }) => said.severity !== 'info')
    .map(({ time, robot, said }) => ({
      time,
      severity: said.severity,
      words: `${robot}: ${say(said).message}`,
    }))
  const { view, shown, playhead } = useSession(session, meshes, marks)
  const drawn = session.robots.length > 0
  return (
    <PlayheadContext.Provider value={playhead}>
      <Page
        title={session.title}
        facts={[
          report.start_ns > 0 && dateTime(report.start_ns / 1e9),
          say(report.summary).message,
        ]}
        notes={report.troubles.map((trouble) => (
          <p class="trouble" key={trouble.message}>
            {say(trouble).message} <span class="second">{say(trouble).remedy}</span>
          </p>
        ))}
        foot={[]}
      >
        <div class={`report-top${drawn && events.length > 0 ? ' beside' : ''}`}>
          {drawn && <section class="report-view" id="view" ref={view} aria-label={w.view} />}
          <Film shown={shown} times={runs.flatMap((run) => run.actions.map(({ time }) => time))} />
          {events.length > 0 && (
            <section class="report-findings events" aria-label={w.events}>
              <h2>{w.events}</h2>
              <ol class="card">
                {events.slice(0, MOST_EVENTS).map(({ time, robot, said }, i) => (
                  <li key={`${time} ${robot} ${said.code}`} class={`tone-${said.severity}`}>
                    <span class="finding-number">{i + 1}</span>
                    <button type="button" onClick={() => playhead.seek(time)}>
                      <span class="second">{lasting(time)}</span> <b>{robot}</b>{' '}
                      {say(said).message}
                    </button>
                  </li>
                ))}
              </ol>
              {events.length > MOST_EVENTS && (
                <p class="second small">{w.moreEvents(events.length - MOST_EVENTS)}</p>
              )}
            </section>
          )}
        </div>
        <Runs runs={runs} />
        <Fold title={w.robots} open>
          <Timeline robots={robots} runs={runs} duration={session.duration} />
        </Fold>
        {runs.map(
          (run, i) =>
            run.curves && (
              <Fold
                key={run.number}
                title={w.runOf(run.number)}
                facts={`${run.robot} · ${run.trajectory} · ${say(run.outcome).message}`}
                open={i === 0}
              >
                <RunView run={run} curves={run.curves} />
              </Fold>
            ),
        )}
        <Fold title={w.technical} facts={w.technicalNote}>
          <Technical
            series={report.series}
            counts={robots.map(({ name, joint_states, frames_lost, contacts }) => [
              name,
              w.counts(joint_states, frames_lost, contacts),
            ])}
            duration={session.duration}
          />
        </Fold>
      </Page>
    </PlayheadContext.Provider>
  )
}

function Runs({ runs }: { runs: readonly SessionRun[] }) {
  const w = words.value.report
  if (runs.length === 0) return <p class="card">{w.noRun}</p>
  return (
    <Table
      name="runs"
      title={w.runs}
      heads={['', w.robot, w.trajectory, w.began, w.took, w.result, w.done]}
    >
      {runs.map((run) => {
        const [icon, kind] = RESULTS[run.result]
        const speed = run.speeds.at(-1) ?? 1
        return (
          <tr key={run.number}>
            <td class="no">
              <Go time={run.start} label={w.toRun(run.number)}>
                {run.number}
              </Go>
            </td>
            <th scope="row">
              {run.robot}
              {run.system && <small>{run.system}</small>}
            </th>
            <td>
              {run.trajectory}
              {speed !== 0 && speed !== 1 && <small>{speed}×</small>}
            </td>
            <td class="figure">{lasting(run.start)}</td>
            <td class="figure">{lasting(run.end - run.start)}</td>
            <td>
              <span class={`result result-${kind}`}>
                <Icon name={icon} />
              </span>{' '}
              {say(run.outcome).message}
            </td>
            <td class="done">
              <ul>
                {run.actions.map(({ time, said }) => (
                  <li key={`${time} ${said.code}`} class={`tone-${said.severity}`}>
                    <Go time={time} /> <span>{say(said).message}</span>
                  </li>
                ))}
              </ul>
              {run.deviation && <small>{say(run.deviation.said).message}</small>}
            </td>
          </tr>
        )
      })}
    </Table>
  )
}
