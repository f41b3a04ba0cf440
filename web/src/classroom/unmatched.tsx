import { useState } from 'preact/hooks'
import type { Unmatched as One } from '../api/class_types'
import { Button } from '../design/button'
import { Select } from '../design/field'
import { showToast } from '../design/toast'
import { say, sentence } from '../words/diagnostic'
import { words } from '../words/words'
import type { ClassSteps } from './class_steps'

/** In a list of choices: the file is a submission of its own, nothing is chosen yet. */
const OWN = '\n'
const UNCHOSEN = '\n\n'

interface UnmatchedProps {
  readonly steps: ClassSteps
}

/** What belongs to nobody and who is in no row, before all else; a press takes a proposal. */
export function Unmatched({ steps }: UnmatchedProps) {
  const w = words.value.grades.desk
  const desk = steps.graded.value?.desk
  if (!desk || desk.unmatched.length === 0) return null
  const waiting = desk.unmatched.filter(({ decided }) => !decided)
  const proposed = waiting.filter(({ proposal }) => proposal)
  const files = desk.unmatched.some(({ decided, kind }) => decided && kind === 'file')
  if (waiting.length === 0 && !files) return null
  const takeAll = async () => {
    for (const each of proposed) if (!(await match(steps, each, each.proposal))) return
  }
  return (
    <section class="card stack-8 unmatched" aria-labelledby="class-unmatched">
      <h2 id="class-unmatched">{w.unmatched(waiting.length)}</h2>
      {waiting.length > 0 && (
        <ul>
          {waiting.map((each) => (
            <Match key={`${each.kind} ${each.what}`} steps={steps} one={each} />
          ))}
        </ul>
      )}
      {proposed.length > 1 && desk.locked === '' && (
        <Button onClick={takeAll}>{w.allProposals}</Button>
      )}
      {files && <p class="small">{w.decided}</p>}
    </section>
  )
}

function Match({ steps, one }: UnmatchedProps & { readonly one: One }) {
  const w = words.value.grades.desk
  const [choosing, setChoosing] = useState(false)
  const fixed = steps.graded.value?.desk.locked !== ''
  return (
    <li>
      <span class="grow">
        <bdi>{one.name}</bdi>
        <small class="second">{say(one.why).message}</small>
        {!one.proposal && !fixed && <small class="second">{w.noProposal}</small>}
      </span>
      {!fixed && one.proposal && (
        <Button look="primary" icon="check" onClick={() => match(steps, one, one.proposal)}>
          {w.itIs(one.proposed)}
        </Button>
      )}
      {fixed ? null : choosing ? (
        <>
          <Select
            label={w.whoIsIt}
            value={UNCHOSEN}
            onChange={(who) => void match(steps, one, who === OWN ? one.what : who)}
            options={choices(steps, one)}
          />
          <Button look="quiet" onClick={() => setChoosing(false)}>
            {words.value.cancel}
          </Button>
        </>
      ) : (
        <Button onClick={() => setChoosing(true)}>{w.somebodyElse}</Button>
      )}
    </li>
  )
}

/** Return who it can be, by what `match` takes. */
function choices(steps: ClassSteps, { kind }: One): [string, string][] {
  const w = words.value.grades.desk
  const { desk, submissions } = steps.graded.value ?? { desk: { rows: [] }, submissions: [] }
  const rows = desk.rows.map(({ key, name, identifier }): [string, string] =>
    kind === 'file' ? [key, name] : [identifier, `${name} (${identifier})`],
  )
  const students = submissions.map(({ key, name }): [string, string] => [key, name])
  return [
    [UNCHOSEN, ''],
    ...(kind === 'file' ? [...students, ...rows, [OWN, w.ofItsOwn] as [string, string]] : rows),
    ['', w.nobody],
  ]
}

/** Decide who it is, empty: nobody; return whether it was done. */
async function match(steps: ClassSteps, { kind, what }: One, who: string): Promise<boolean> {
  const act =
    kind === 'file'
      ? { did: 'assign', key: who, text: what }
      : { did: 'enrol', key: what, text: who }
  try {
    await steps.does('POST', 'acts', act)
    return true
  } catch (error) {
    showToast(sentence(error))
    return false
  }
}
