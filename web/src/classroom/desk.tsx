import { useEffect, useRef, useState } from 'preact/hooks'
import type { ClassAct, ClassDifference } from '../api/class_types'
import { Button, ButtonLink } from '../design/button'
import { Select } from '../design/field'
import { Icon } from '../design/icons'
import { Notice } from '../design/notice'
import { showToast } from '../design/toast'
import { session } from '../shell/session'
import { say, sentence } from '../words/diagnostic'
import { dateTime, fileSize, number, words } from '../words/words'
import type { ClassSteps } from './class_steps'
import { Course } from './course'

/** The files that a class is marked from, by the names that the desk has for them. */
const SOURCES = [
  ['export', 'export.zip', '.zip'],
  ['rubric', 'rubric.yaml', '.yaml,.yml'],
  ['solution', '', '.mat,.m,.json,.csv,.txt,.npz,.yaml,.yml,.mcap'],
  ['worksheet', 'worksheet.csv', '.csv'],
] as const
const FORMS = ['Moodle', 'Canvas', 'ILIAS', 'Gradescope', 'folder', 'course'] as const
/** ms between two looks at a run. */
const LOOK = 700

interface DeskProps {
  readonly steps: ClassSteps
}

/** Where a class is handed in, marked, marked again, locked, released and downloaded. */
export function Desk({ steps }: DeskProps) {
  const w = words.value.grades.desk
  const graded = steps.graded.value
  const running = graded?.desk.run?.running ?? false
  useEffect(() => {
    if (!running) return
    const timer = setInterval(() => void steps.load(), LOOK)
    return () => clearInterval(timer)
  }, [steps, running])
  const [form, setForm] = useState<string | null>(null)
  if (graded === null) return null
  const { desk } = graded
  const act = (
    method: 'POST' | 'DELETE',
    part: Parameters<ClassSteps['does']>[1],
    body?: object,
  ) => steps.does(method, part, body).catch((error: unknown) => showToast(sentence(error)))
  const has = (name: string) => desk.sources.some((source) => source.name === name)
  const ready = has('export.zip') && has('rubric.yaml') && desk.missing.length === 0
  const fixed = desk.locked !== ''
  const formName = (each: string) => (w.forms as Readonly<Record<string, string>>)[each] ?? each
  return (
    <details
      class="card desk"
      open={steps.deskOpen.value}
      onToggle={(event) => {
        steps.deskOpen.value = (event.currentTarget as HTMLDetailsElement).open
      }}
    >
      <summary>
        <h2>{w.title}</h2>
      </summary>
      <div class="desk-parts">
        <section class="stack-8" aria-label={w.handIn}>
          {session.value?.ways.course && <Course steps={steps} />}
          {SOURCES.map(([kind, name, accept]) => (
            <Source key={kind} steps={steps} kind={kind} name={name} accept={accept} />
          ))}
          {desk.missing.length > 0 && (
            <Notice severity="warning">{w.missing(desk.missing.join(', '))}</Notice>
          )}
          <Select
            label={w.form}
            value={form ?? desk.form}
            onChange={setForm}
            options={[['', w.recognise], ...FORMS.map((each) => [each, formName(each)] as const)]}
          />
          {graded.marked && <p class="second small">{w.read(formName(graded.form))}</p>}
          <Button
            look={graded.marked ? 'plain' : 'primary'}
            icon="check"
            disabled={running || fixed || !ready}
            onClick={() => act('POST', 'run', { form: form ?? desk.form })}
          >
            {graded.marked ? w.again : w.run}
          </Button>
        </section>
        <section class="stack-8">
          {desk.run?.running && (
            <div class="stack-8" role="status">
              <p>
                {w.runs[desk.run.how]}:{' '}
                {desk.run.all ? w.running(desk.run.done, desk.run.all) : w.starting}
              </p>
              <progress
                class="progress"
                max={1}
                value={desk.run.all ? desk.run.done / desk.run.all : undefined}
                aria-label={w.runs[desk.run.how]}
              />
              <Button onClick={() => act('DELETE', 'run')}>{w.stop}</Button>
            </div>
          )}
          {desk.run?.problem && (
            <Notice severity="error">
              <p>{say(desk.run.problem).message}</p>
            </Notice>
          )}
          {desk.run?.notes.map((note) => (
            <Notice key={note.message} severity="warning">
              <p>{say(note).message}</p>
            </Notice>
          ))}
          {!running && desk.proposed && (
            <Differences
              differences={desk.proposed}
              onAdopt={() => act('POST', 'proposed')}
              onDiscard={() => act('DELETE', 'proposed')}
            />
          )}
          {desk.differing > 0 && <Notice severity="warning">{w.differing(desk.differing)}</Notice>}
          {fixed && (
            <Notice severity="info">
              {desk.released ? w.releasedBy(desk.released) : w.lockedBy(desk.locked)}
            </Notice>
          )}
          {graded.marked && (
            <div class="row">
              <Button
                disabled={fixed || running}
                onClick={() => act('POST', 'acts', { did: 'lock' })}
              >
                {w.lock}
              </Button>
              <Button
                look="primary"
                disabled={desk.released !== '' || running || desk.proposed !== null}
                onClick={() => act('POST', 'release')}
              >
                {w.release}
              </Button>
              <Button
                icon="undo"
                disabled={!desk.undo || running}
                onClick={() => act('POST', 'acts', { did: 'undo' })}
              >
                {w.undo}
              </Button>
              {desk.before && !fixed && (
                <Button icon="undo" disabled={running} onClick={() => act('POST', 'before')}>
                  {w.goBack}
                </Button>
              )}
            </div>
          )}
          {desk.released && (
            <section class="stack-8">
              <h3>{w.downloads}</h3>
              <div class="row">
                <ButtonLink icon="download" href="/api/class/feedback.zip" download>
                  {w.feedback}
                </ButtonLink>
                {desk.worksheet && (
                  <ButtonLink icon="download" href="/api/class/worksheet.csv" download>
                    {w.filled}
                  </ButtonLink>
                )}
                <ButtonLink icon="download" href="/api/class/grades.csv" download>
                  {w.grades}
                </ButtonLink>
              </div>
            </section>
          )}
          {desk.left_out.length > 0 && (
            <details open>
              <summary>{w.leftOut(desk.left_out.length)}</summary>
              <ul class="desk-list small">
                {desk.left_out.map(({ file, why }) => (
                  <li key={file}>
                    <code>{file}</code> {say(why).message}
                  </li>
                ))}
              </ul>
            </details>
          )}
          {desk.journal.length > 0 && (
            <details>
              <summary>{w.journal}</summary>
              <ol class="desk-list small">
                {desk.journal.map((each) => (
                  <li key={each.at}>
                    <time class="second">{dateTime(each.at)}</time> {told(each)}
                  </li>
                ))}
              </ol>
            </details>
          )}
        </section>
      </div>
    </details>
  )
}

function Source({
  steps,
  kind,
  name,
  accept,
}: DeskProps & {
  readonly kind: 'export' | 'rubric' | 'solution' | 'worksheet'
  /** Under which it is kept; empty: its own. */
  readonly name: string
  readonly accept: string
}) {
  const w = words.value.grades.desk
  const input = useRef<HTMLInputElement>(null)
  const [share, setShare] = useState<number | null>(null)
  const sources = steps.graded.value?.desk.sources ?? []
  const known: readonly string[] = SOURCES.map(([, each]) => each)
  const there = sources.filter((each) => (name ? each.name === name : !known.includes(each.name)))
  const take = async (file: File | undefined) => {
    if (file === undefined) return
    setShare(0)
    try {
      await steps.handIn(name || file.name, file, setShare)
    } catch (error) {
      showToast(sentence(error))
    } finally {
      setShare(null)
    }
  }
  return (
    <div class="desk-source">
      <span>
        {w[kind]}
        {there.map((each) => (
          <small key={each.name} class="second">
            <Icon name="check" /> {w.there(each.name, fileSize(each.size))}
          </small>
        ))}
        {share !== null && (
          <progress class="progress" max={1} value={share} aria-label={w[kind]} />
        )}
      </span>
      <Button
        icon="upload"
        disabled={share !== null || steps.graded.value?.desk.locked !== ''}
        onClick={() => input.current?.click()}
        label={`${there.length > 0 ? w.another : w.choose}: ${w[kind]}`}
      >
        {there.length > 0 ? w.another : w.choose}
      </Button>
      <input
        type="file"
        hidden
        ref={input}
        accept={accept}
        aria-label={w[kind]}
        onChange={(event) => {
          const chosen = event.currentTarget
          void take(chosen.files?.[0]).then(() => {
            chosen.value = ''
          })
        }}
      />
    </div>
  )
}

function Differences({
  differences,
  onAdopt,
  onDiscard,
}: {
  readonly differences: readonly ClassDifference[]
  readonly onAdopt: () => void
  readonly onDiscard: () => void
}) {
  const w = words.value.grades.desk
  const points = (value: number | null) => (value === null ? w.gone : number(value))
  return (
    <section class="stack-8" role="status">
      <p>{w.proposed(differences.length)}</p>
      {differences.length > 0 && (
        <div class="desk-scroll">
          <table class="table">
            <thead>
              <tr>
                <th scope="col">{w.student}</th>
                <th scope="col">{w.before}</th>
                <th scope="col">{w.after}</th>
                <th scope="col">{w.tests}</th>
              </tr>
            </thead>
            <tbody>
              {differences.map(({ key, name, before, after, tests }) => (
                <tr key={key}>
                  <th scope="row">{name}</th>
                  <td>{points(before)}</td>
                  <td>{points(after)}</td>
                  <td class="small">
                    {tests
                      .map((t) => `${t.name}: ${points(t.before)} → ${points(t.after)}`)
                      .join('; ')}
                  </td>
                </tr>
              ))}
            </tbody>
          </table>
        </div>
      )}
      <div class="row">
        <Button look="primary" onClick={onAdopt}>
          {w.adopt}
        </Button>
        <Button onClick={onDiscard}>{w.discard}</Button>
      </div>
    </section>
  )
}

function told({ did, who, name, test, points, text }: ClassAct): string {
  const w = words.value.grades.desk
  const of = test === 'points' ? w.total : test
  if (did === 'mark' || did === 'second') {
    if (points === null) return w.acts.taken(who, name, of)
    return did === 'mark'
      ? w.acts.mark(who, name, of, number(points), text)
      : w.acts.second(who, name, of, number(points))
  }
  if (did === 'assign') return w.acts.assign(who, text, name || w.nobody)
  if (did === 'enrol') return w.acts.enrol(who, name, text || w.nobody)
  return did === 'comment' ? w.acts.comment(who, name, text) : w.acts[did](who)
}
