import { useSignal } from '@preact/signals'
import { Button } from '../../design/button'
import { OutcomeChip } from '../../design/chip'
import { spoken } from '../../words/diagnostic'
import { named, words } from '../../words/words'
import { Findings } from '../motion/findings'
import { optionLabels, robotMatters } from '../motion/fixes'
import { MotionView } from '../motion/lazy'
import { Candidates } from './candidates'
import type { Result, UploadFlow } from './flow'
import { Pickers } from './pickers'
import { Publish } from './publish'

interface VerdictProps {
  flow: UploadFlow
  result: Result
  file: File
}

function robotName(flow: UploadFlow, model: string): string {
  return flow.library.value?.robots.find((robot) => robot.model === model)?.name ?? model
}

/** The verdict of an accepted file; of a refused one the findings say it. */
function title(flow: UploadFlow, result: Result): string {
  const { conversion, choice } = result
  const w = words.value.upload
  if (conversion.outcome === 'accepted') return spoken(conversion)
  if (conversion.outcome === 'ambiguous') return w.several(conversion.candidates.length)
  if (!robotMatters(result.conversion)) return w.unread
  return w.refused(robotName(flow, choice.robot))
}

/** The outcome of a file: evidence, motion, findings, and the next steps. */
export function Verdict({ flow, result, file }: VerdictProps) {
  const w = words.value
  const selected = useSignal(0)
  const { conversion, motion, choice } = result
  const busy = flow.busy.value
  const labels = optionLabels(choice.options, w)
  const effector = flow.library.value?.end_effectors.find((each) => each.id === choice.effector)
  return (
    <article class="verdict" aria-busy={busy}>
      <header class="verdict-head">
        <div class="grow stack-8">
          <div class="row">
            <OutcomeChip outcome={conversion.outcome} />
            <span class="second small verdict-file">{file.name}</span>
          </div>
          <h1 class="verdict-message">{title(flow, result)}</h1>
          {labels.length > 0 && (
            <p class="row small">
              {labels.map((label) => (
                <span class="chip chip-plain" key={label}>
                  {label}
                </span>
              ))}
            </p>
          )}
        </div>
        <div class="row verdict-actions">
          {flow.canUndo.value && (
            <Button icon="undo" onClick={() => flow.undo()}>
              {w.undo}
            </Button>
          )}
          <Button icon="upload" onClick={() => flow.reset()}>
            {w.upload.otherFile}
          </Button>
        </div>
        {busy && <progress class="progress verdict-progress" aria-label={w.loading} />}
      </header>
      <div class={`verdict-columns${motion ? '' : ' verdict-plain'}`}>
        <div class="verdict-side stack">
          {conversion.outcome === 'ambiguous' && (
            <Candidates
              candidates={conversion.candidates}
              busy={busy}
              drawn={motion?.source.variable ?? ''}
              onChoose={(variable) => void flow.chooseVariable(variable)}
            />
          )}
          {conversion.draft && conversion.trajectory && (
            <Publish key={conversion.draft} flow={flow} trajectory={conversion.trajectory} />
          )}
          {conversion.diagnostics.length > 0 && (
            <Findings
              findings={conversion.diagnostics}
              selected={selected.value}
              onSelect={(number) => {
                selected.value = number
              }}
              onFix={(fix) => void flow.apply(fix)}
              chosenElsewhere={conversion.outcome === 'ambiguous'}
              busy={busy}
            />
          )}
          {robotMatters(result.conversion) && (
            <details class="card verdict-robot">
              <summary>
                <span class="second small">{w.upload.checkedFor}</span>
                <strong>
                  {robotName(flow, choice.robot)}
                  {effector && ` + ${named(effector.id, effector.name)}`}
                </strong>
                <span class="verdict-change">{w.upload.change}</span>
              </summary>
              <Pickers flow={flow} />
            </details>
          )}
        </div>
        {motion && (
          <div class="verdict-motion stack-8">
            {conversion.outcome === 'ambiguous' && (
              <p class="second small">{w.upload.drawn(motion.source.variable)}</p>
            )}
            <MotionView key={conversion.motion} motion={motion} selected={selected} />
          </div>
        )}
      </div>
    </article>
  )
}
