import type { Submission } from '../api/types'
import { Icon } from '../design/icons'
import { say } from '../words/diagnostic'
import { number, words } from '../words/words'
import { numbersOf } from './class_steps'

interface MarksProps {
  readonly submission: Submission
  /** Go to the instant of a finding of the motion, by its number from 1. */
  readonly onSelect: (number: number) => void
}

/** The result of each test of the rubric; a lost point leads to its instant. */
export function Marks({ submission, onSelect }: MarksProps) {
  const w = words.value.grades
  const numbers = numbersOf(submission)
  return (
    <section class="card stack-8" aria-labelledby="class-marks">
      <h2 id="class-marks">{w.marks}</h2>
      <ul class="class-marks">
        {submission.marks.map((mark, i) => {
          const { passed, points, of, time } = mark
          const icon = passed ? 'complete' : points > 0 ? 'warning' : 'error'
          return (
            <li key={mark.name} class={`class-mark class-mark-${icon}`}>
              <p class="class-mark-head">
                <Icon name={icon} />
                <strong class="grow">{mark.name}</strong>
                <span class="class-points">
                  {number(points)} / {number(of)}
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
            </li>
          )
        })}
      </ul>
    </section>
  )
}
