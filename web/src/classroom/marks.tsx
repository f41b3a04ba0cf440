import { useState } from 'preact/hooks'
import type { ClassMark, Submission } from '../api/types'
import { Button } from '../design/button'
import { Field } from '../design/field'
import { Icon } from '../design/icons'
import { showToast } from '../design/toast'
import { say, sentence } from '../words/diagnostic'
import { dateTime, number, words } from '../words/words'
import { type ClassSteps, numbersOf } from './class_steps'

interface MarksProps {
  readonly steps: ClassSteps
  readonly submission: Submission
  /** Go to the instant of a finding of the motion, by its number from 1. */
  readonly onSelect: (number: number) => void
}

/** The result of each test of the rubric; a lost point leads to its instant, and the teacher may
 * change it. */
export function Marks({ steps, submission, onSelect }: MarksProps) {
  const w = words.value.grades
  const numbers = numbersOf(submission)
  return (
    <section class="card stack-8" aria-labelledby="class-marks">
      <h2 id="class-marks">{w.marks}</h2>
      <ul class="class-marks">
        {submission.marks.map((mark, i) => {
          const { passed, points, of, time, change, second } = mark
          const icon = passed ? 'complete' : points > 0 ? 'warning' : 'error'
          return (
            <li key={mark.name} class={`class-mark class-mark-${icon}`}>
              <p class="class-mark-head">
                <Icon name={icon} />
                <strong class="grow">{mark.name}</strong>
                <span class="class-points">
                  {number(points)}
                  {of > 0 && ` / ${number(of)}`}
                </span>
              </p>
              <p class="small">
                {say(mark.found).message}
                {time !== null && !passed && submission.motion && (
                  <>
                    {' '}
                    <button
                      type="button"
                      class="class-jump"
                      onClick={() => onSelect(numbers[i] ?? 0)}
                    >
                      {w.at(number(time, 2))}
                    </button>
                  </>
                )}
              </p>
              {!passed && mark.hint && <p class="second small">{mark.hint}</p>}
              {mark.hidden && <p class="second tiny">{w.hidden}</p>}
              {mark.bonus && <p class="second tiny">{w.bonus}</p>}
              {change && (
                <p class="small">
                  {w.desk.changed(
                    change.who,
                    number(change.given),
                    dateTime(change.at),
                    change.reason,
                  )}
                </p>
              )}
              {second && <p class="small">{w.desk.seconds(second.who, number(second.points))}</p>}
              <Change steps={steps} submission={submission} mark={mark} />
            </li>
          )
        })}
      </ul>
      <Comment key={`${submission.key} ${submission.comment}`} {...{ steps, submission }} />
    </section>
  )
}

type Rest = Pick<MarksProps, 'steps' | 'submission'>

/** Do something to a submission; return whether it was done. */
async function done({ steps, submission }: Rest, act: object): Promise<boolean> {
  try {
    await steps.does('POST', 'acts', { key: submission.key, ...act })
    return true
  } catch (error) {
    showToast(sentence(error))
    return false
  }
}

function Change({ mark, ...rest }: Rest & { readonly mark: ClassMark }) {
  const w = words.value.grades.desk
  const [points, setPoints] = useState<string | null>(null)
  const [reason, setReason] = useState('')
  if (rest.steps.graded.value?.desk.locked) return null
  if (points === null)
    return (
      <button
        type="button"
        class="class-jump small"
        aria-label={`${w.change}: ${mark.name}`}
        onClick={() => setPoints(number(mark.points))}
      >
        {w.change}
      </button>
    )
  const value = Number(points.trim().replace(',', '.'))
  const wrong = points.trim() === '' || !Number.isFinite(value)
  const does = async (act: object) => {
    if (await done(rest, { test: mark.name, ...act })) {
      setPoints(null)
      setReason('')
    }
  }
  return (
    <form
      class="stack-8"
      onSubmit={(event) => {
        event.preventDefault()
        if (!wrong) void does({ did: 'mark', points: value, text: reason })
      }}
    >
      <Field label={w.points} value={points} onInput={setPoints} />
      <Field label={w.reason} value={reason} onInput={setReason} />
      <div class="row">
        <Button look="primary" type="submit" disabled={wrong || reason.trim() === ''}>
          {w.asFirst}
        </Button>
        <Button disabled={wrong} onClick={() => does({ did: 'second', points: value })}>
          {w.asSecond}
        </Button>
        {mark.change && (
          <Button onClick={() => does({ did: 'mark', points: null })}>{w.back}</Button>
        )}
        {mark.second && (
          <Button onClick={() => does({ did: 'second', points: null })}>{w.secondBack}</Button>
        )}
        <Button look="quiet" onClick={() => setPoints(null)}>
          {w.cancel}
        </Button>
      </div>
    </form>
  )
}

function Comment(rest: Rest) {
  const w = words.value.grades.desk
  const { comment } = rest.submission
  const [text, setText] = useState(comment)
  const fixed = Boolean(rest.steps.graded.value?.desk.locked)
  return (
    <div class="field">
      <label class="field-label">
        {w.comment}
        <textarea
          class="input"
          rows={3}
          maxLength={4000}
          value={text}
          disabled={fixed}
          onInput={(event) => setText(event.currentTarget.value)}
        />
      </label>
      {text !== comment && (
        <div class="row">
          <Button look="primary" onClick={() => done(rest, { did: 'comment', text })}>
            {w.keep}
          </Button>
        </div>
      )}
    </div>
  )
}
