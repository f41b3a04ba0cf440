import { useEffect, useRef, useState } from 'preact/hooks'
import type { HandInState, InstantCheck } from '../api/types'
import { Button, ButtonLink } from '../design/button'
import { Icon } from '../design/icons'
import { Notice } from '../design/notice'
import { showToast } from '../design/toast'
import { useFileDrop } from '../shell/file_drop'
import '../pages/upload/upload.css'
import { useApi } from '../shell/session'
import { say, sentence, spoken } from '../words/diagnostic'
import { dateTime, number, words } from '../words/words'

const ACCEPTED = '.mat,.m,.json,.csv,.txt,.npz,.yaml,.yml,.mcap'
/** ms between two looks at a check. */
const LOOK = 1000

/** Where a student of a course hands in, and reads what the check found. */
export function HandIn() {
  const api = useApi()
  const w = words.value.grades.mine
  const [state, setState] = useState<HandInState | null>(null)
  const [problem, setProblem] = useState('')
  const [share, setShare] = useState<number | null>(null)
  const input = useRef<HTMLInputElement>(null)
  const load = () =>
    api.handedIn().then(
      (found) => {
        setState(found)
        setProblem('')
      },
      (error: unknown) => setProblem(sentence(error)),
    )
  useEffect(() => void load(), [api])
  const checking = state?.handed_in != null && state.check === null
  useEffect(() => {
    if (!checking) return
    const timer = setInterval(() => void load(), LOOK)
    return () => clearInterval(timer)
  }, [checking])
  const open = state?.member && state.task !== '' && state.closed === ''
  const take = async (file: File) => {
    if (!open || share !== null) return
    setShare(0)
    try {
      await api.handIn(file, setShare)
      await load()
    } catch (error) {
      showToast(sentence(error))
    } finally {
      setShare(null)
    }
  }
  const over = useFileDrop((file) => void take(file))
  if (problem)
    return (
      <Notice severity="error">
        <p>{problem}</p>
        <Button onClick={() => void load()}>{words.value.retry}</Button>
      </Notice>
    )
  if (state === null) return <p class="second">{words.value.loading}</p>
  const { handed_in: file } = state
  return (
    <article class="stack hand-in">
      <header>
        <p class="second small">{state.course}</p>
        <h1>{state.task || w.title}</h1>
      </header>
      {state.mark && (
        <section class="card stack-8" aria-labelledby="hand-in-mark">
          <h2 id="hand-in-mark">{w.mark}</h2>
          <p class="hand-in-points">
            {words.value.grades.points(number(state.mark.points), number(state.mark.of))}
          </p>
          {state.mark.comment && (
            <p>
              <strong>{w.comment}:</strong> {state.mark.comment}
            </p>
          )}
          <Tests check={state.mark} points />
        </section>
      )}
      {!state.member ? (
        <Notice severity="warning">
          <p>{w.notMember}</p>
        </Notice>
      ) : state.closed ? (
        !state.mark && (
          <Notice severity="info">
            <p>{w.closed}</p>
          </Notice>
        )
      ) : state.task === '' ? (
        <Notice severity="info">
          <p>{w.noTask}</p>
        </Notice>
      ) : (
        <section
          class={`drop-zone${over ? ' drop-zone-over' : ''}`}
          aria-label={w.drop}
          aria-busy={share !== null}
        >
          <p class="drop-title">{w.drop}</p>
          <p class="second small">{w.explanation}</p>
          {share !== null && (
            <progress class="progress" max={1} value={share} aria-label={w.drop} />
          )}
          <div class="row drop-buttons">
            <Button
              look="primary"
              icon="upload"
              disabled={share !== null}
              onClick={() => input.current?.click()}
            >
              {file ? words.value.grades.desk.another : words.value.grades.desk.choose}
            </Button>
            <ButtonLink look="quiet" icon="play" href="/">
              {w.looks}
            </ButtonLink>
          </div>
          <input
            ref={input}
            hidden
            type="file"
            aria-label={w.drop}
            accept={ACCEPTED}
            onChange={(event) => {
              const chosen = event.currentTarget.files?.[0]
              if (chosen) void take(chosen)
              event.currentTarget.value = ''
            }}
          />
        </section>
      )}
      {file && !state.mark && (
        <section class="card stack-8" aria-labelledby="hand-in-check" aria-live="polite">
          <h2 id="hand-in-check">{w.check}</h2>
          <p class="second small">{w.file(file.file, dateTime(file.at))}</p>
          {state.check ? (
            <>
              <Notice severity={severity(state.check)}>
                <p class="hand-in-said">{spoken(state.check.said)}</p>
              </Notice>
              <Tests check={state.check} />
            </>
          ) : (
            <p class="row" role="status">
              <progress class="progress" aria-label={w.checking} /> {w.checking}
            </p>
          )}
        </section>
      )}
    </article>
  )
}

function severity({ said, tests }: InstantCheck): 'info' | 'warning' | 'error' {
  if (said.severity === 'error') return 'error'
  return tests.every(({ passed }) => passed) ? 'info' : 'warning'
}

function Tests({ check, points }: { readonly check: InstantCheck; readonly points?: boolean }) {
  const w = words.value.grades.mine
  return (
    <>
      <ul class="class-marks">
        {check.tests.map((test) => (
          <li
            key={test.name}
            class={`class-mark class-mark-${test.passed ? 'complete' : 'warning'}`}
          >
            <p class="class-mark-head">
              <Icon name={test.passed ? 'complete' : 'warning'} />
              <strong class="grow">{test.name}</strong>
              <span class="class-points">
                {points
                  ? `${number(test.points)}${test.of > 0 ? ` / ${number(test.of)}` : ''}`
                  : test.passed
                    ? w.passed
                    : w.lost}
              </span>
            </p>
            <p class="small">{say(test.found).message}</p>
            {!test.passed && test.hint && <p class="second small">{test.hint}</p>}
          </li>
        ))}
      </ul>
      {check.hints.map((hint) => (
        <p key={hint} class="second small">
          {hint}
        </p>
      ))}
    </>
  )
}
