import { useSignal } from '@preact/signals'
import { useEffect, useMemo, useRef, useState } from 'preact/hooks'
import type { Submission } from '../api/types'
import { Button } from '../design/button'
import { Segments } from '../design/field'
import { Icon } from '../design/icons'
import { Notice } from '../design/notice'
import { Findings } from '../pages/motion/findings'
import { MotionView } from '../pages/motion/lazy'
import type { MotionDocument } from '../playback/motion'
import { path } from '../shell/router'
import { session, useApi } from '../shell/session'
import { sentence, spoken } from '../words/diagnostic'
import { number, words } from '../words/words'
import { ClassSteps, type Order, REFERENCE, stepOf } from './class_steps'
import './class.css'
import '../pages/motion/verdict.css'
import { Desk } from './desk'
import { HandIn } from './hand_in'
import { Marks } from './marks'
import { PlayInLab } from './play_in_lab'
import { Unmatched } from './unmatched'

interface Loaded {
  readonly key: string
  readonly motion: MotionDocument | null
  readonly reference: MotionDocument | null
  readonly error: string
}

/** Return the key of a submission in an address, such as /class/ben; empty: none. */
export function keyOfPath(text: string): string {
  const [, , key = ''] = text.split('/')
  try {
    return decodeURIComponent(key)
  } catch {
    return ''
  }
}

/** Load the motion of a submission and that of the solution; each is null until it is loaded. */
function useMotions(steps: ClassSteps, current: Submission | null): Loaded | null {
  const [loaded, setLoaded] = useState<Loaded | null>(null)
  const key = current?.key ?? ''
  const compares = steps.graded.value?.reference?.motion ?? false
  const runs = steps.runs.value
  useEffect(() => {
    if (current === null || !current.motion) return
    let here = true
    const reference = compares ? steps.motion(REFERENCE).catch(() => null) : null
    Promise.all([steps.motion(key), reference])
      .then(([motion, other]) => {
        if (!here) return
        setLoaded({ key, motion, reference: other, error: '' })
        steps.prepare()
      })
      .catch((problem: unknown) => {
        if (here) setLoaded({ key, motion: null, reference: null, error: sentence(problem) })
      })
    return () => {
      here = false
    }
  }, [steps, key, compares, runs])
  return loaded?.key === key ? loaded : null
}

function List({ steps }: { readonly steps: ClassSteps }) {
  const w = words.value.grades
  const current = steps.current.value
  const chosen = useRef<HTMLButtonElement>(null)
  // The list alone: scrollIntoView would scroll the page, away from the motion.
  useEffect(() => {
    const row = chosen.current
    const list = row?.closest('ol')
    if (!row || !list) return
    const [at, shown] = [row.getBoundingClientRect(), list.getBoundingClientRect()]
    list.scrollTop += Math.max(at.bottom - shown.bottom, 0) + Math.min(at.top - shown.top, 0)
  }, [current?.key])
  return (
    <section class="card stack-8" aria-labelledby="class-all">
      <h2 id="class-all">{w.all}</h2>
      <Segments<Order>
        label={w.order}
        value={steps.order.value}
        onChange={(order) => {
          steps.order.value = order
        }}
        options={[
          ['class', w.orders.class],
          ['points', w.orders.points],
        ]}
      />
      <ol class="class-list">
        {steps.submissions.value.map((each) => (
          <li key={each.key}>
            <button
              type="button"
              class="class-one"
              ref={each.key === current?.key ? chosen : null}
              aria-current={each.key === current?.key ? 'true' : undefined}
              onClick={() => show(steps, each.key)}
            >
              <Icon
                name={!each.motion ? 'error' : each.points >= each.of ? 'complete' : 'motion'}
              />
              <span class="grow">{each.name}</span>
              <span class="class-points">
                {number(each.points)} / {number(each.of)}
              </span>
            </button>
          </li>
        ))}
      </ol>
    </section>
  )
}

function show(steps: ClassSteps, key: string): void {
  if (key === '') return
  steps.choose(key)
  history.replaceState(null, '', `/class/${encodeURIComponent(key)}`)
}

/** The class: a student hands in, a teacher marks. */
export function ClassPage() {
  return session.value?.may.hands_in ? <HandIn /> : <Graded />
}

/** A graded class, one submission after another beside the solution. */
function Graded() {
  const api = useApi()
  const w = words.value.grades
  const steps = useMemo(() => new ClassSteps(api), [api])
  const selected = useSignal(0)
  useEffect(() => {
    steps.choose(keyOfPath(path.value))
    void steps.load()
  }, [steps])
  useEffect(() => {
    const press = (event: KeyboardEvent) => show(steps, steps.step(stepOf(event)))
    addEventListener('keydown', press)
    return () => removeEventListener('keydown', press)
  }, [steps])
  const current = steps.current.value
  const loaded = useMotions(steps, current)
  useEffect(() => {
    selected.value = 0
  }, [current?.key])
  if (steps.problem.value)
    return (
      <Notice severity="error">
        <p>{steps.problem.value}</p>
        <Button onClick={() => void steps.load()}>{words.value.retry}</Button>
      </Notice>
    )
  const { graded } = steps
  if (graded.value === null) return <p class="second">{words.value.loading}</p>
  if (current === null)
    return (
      <section class="stack">
        <h1>{graded.value.title || words.value.nav.grades}</h1>
        {graded.value.marked && <p>{w.none}</p>}
        <Unmatched steps={steps} />
        <Desk steps={steps} />
      </section>
    )
  const compared = loaded?.reference ?? null
  return (
    <article class="verdict class-page">
      <header class="verdict-head">
        <div class="grow stack-8" aria-live="polite">
          <p class="second small">{graded.value.title}</p>
          <h1 class="verdict-message">{current.name}</h1>
          <p class="row small">
            <span class="chip chip-plain">
              {w.points(number(current.points), number(current.of))}
            </span>
            <span class="second">
              {w.place(steps.place.value + 1, steps.submissions.value.length)}
            </span>
          </p>
        </div>
        <div class="class-steps">
          <Button
            icon="back"
            disabled={!steps.has(-1)}
            aria-keyshortcuts="p"
            onClick={() => show(steps, steps.step(-1))}
          >
            {w.previous}
          </Button>
          <Button
            look="primary"
            icon="next"
            disabled={!steps.has(1)}
            aria-keyshortcuts="n"
            onClick={() => show(steps, steps.step(1))}
          >
            {w.next}
          </Button>
          <p class="second tiny">{w.keys}</p>
        </div>
      </header>
      <Unmatched steps={steps} />
      <Desk steps={steps} />
      <div class="verdict-columns">
        <div class="verdict-side stack">
          <Marks
            key={current.key}
            steps={steps}
            submission={current}
            onSelect={(finding) => {
              // A second click on the same number seeks again.
              selected.value = 0
              selected.value = finding
            }}
          />
          {loaded?.motion && loaded.motion.findings.length > 0 && (
            <details class="card">
              <summary>{words.value.check.findings}</summary>
              <Findings
                findings={loaded.motion.findings.map((each) => ({ ...each, where: '' }))}
                joints={loaded.motion.robot.joints}
                selected={selected.value}
                onSelect={(finding) => {
                  selected.value = finding
                }}
              />
            </details>
          )}
          {current.motion && session.value?.may.commands && (
            <PlayInLab key={current.key} submission={current} />
          )}
          <List steps={steps} />
        </div>
        {!current.motion ? (
          <div class="motion-view">
            <Notice severity="warning">
              <h2>{w.noMotion}</h2>
              <p>{spoken(current.found)}</p>
            </Notice>
          </div>
        ) : loaded?.motion ? (
          <div class="class-motion">
            <p class="comparison-legend small">
              <span>
                <i class="line-solid" /> {w.solid}
              </span>
              {compared ? (
                <span>
                  <i class="line-dashed" /> {w.dashed}
                </span>
              ) : (
                <span class="second">{w.noReference}</span>
              )}
            </p>
            <MotionView
              key={current.key}
              motion={loaded.motion}
              compared={compared}
              selected={selected}
            />
          </div>
        ) : (
          <div class="motion-view motion-waiting second">
            {loaded?.error || words.value.loading}
          </div>
        )}
      </div>
    </article>
  )
}
