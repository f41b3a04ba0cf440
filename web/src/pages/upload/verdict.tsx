import { signal } from '@preact/signals'
import { useEffect, useMemo, useRef } from 'preact/hooks'
import type { Diagnostic } from '../../api/types'
import { Button } from '../../design/button'
import { OutcomeChip } from '../../design/chip'
import { said, spoken } from '../../words/diagnostic'
import { named, words } from '../../words/words'
import { Findings, firstFinding } from '../motion/findings'
import { fixLabel, optionLabels, robotMatters } from '../motion/fixes'
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

/** What a file is refused or doubted for: number of the finding; 0: it fits, or is to be chosen. */
function causeOf({ conversion: { outcome, diagnostics } }: Result): number {
  const first = firstFinding(diagnostics)
  const doubted = (diagnostics[first - 1]?.severity ?? 'info') !== 'info'
  return outcome !== 'ambiguous' && doubted ? first : 0
}

/** Return whether a finding says what was assumed, with a line or a press that says otherwise. */
function assumed({ severity, fixes }: Diagnostic): boolean {
  return severity === 'info' && fixes.length > 0
}

/** The cause, else the verdict. */
function title(result: Result): string {
  const { conversion, motion } = result
  const w = words.value.upload
  if (conversion.outcome === 'ambiguous') return w.several(conversion.candidates.length)
  const cause = conversion.diagnostics[causeOf(result) - 1]
  return cause ? said(cause, motion?.robot.joints) : spoken(conversion)
}

/** The outcome of a file: evidence, motion, findings, and the next steps. */
export function Verdict({ flow, result, file }: VerdictProps) {
  const w = words.value
  const { conversion, motion, choice } = result
  const selected = useMemo(() => signal(firstFinding(conversion.diagnostics)), [conversion])
  const robots = useRef<HTMLDetailsElement>(null)
  const heading = useRef<HTMLHeadingElement>(null)
  // What was pressed is gone with its page: keyboards and screen readers go on at the answer.
  useEffect(() => {
    if (document.activeElement === document.body) heading.current?.focus({ preventScroll: true })
  }, [conversion])
  const tried = flow.tried.value
  const busy = flow.busy.value
  const labels = optionLabels(choice.options, w)
  const effector = flow.library.value?.end_effectors.find((each) => each.id === choice.effector)
  return (
    <article class="verdict" aria-busy={busy}>
      <header class="verdict-head">
        <div class="grow stack-8">
          <div class="row">
            <OutcomeChip outcome={conversion.outcome} doubted={causeOf(result) > 0} />
            <span class="second small verdict-file">{file.name}</span>
            {flow.canUndo.value && (
              <Button look="quiet" icon="undo" onClick={() => flow.undo()}>
                {w.undo}
              </Button>
            )}
            <Button look="quiet" icon="upload" onClick={() => flow.reset()}>
              {w.upload.otherFile}
            </Button>
          </div>
          <h1 class="verdict-message" ref={heading} tabIndex={-1}>
            {title(result)}
          </h1>
          {conversion.outcome === 'accepted' &&
            conversion.diagnostics.filter(assumed).map((each) => (
              <p class="second small" key={each.code}>
                {said(each, motion?.robot.joints)}
              </p>
            ))}
          {(flow.touching.value || result.touched?.length === 0) && (
            <p class="second small" role="status">
              {flow.touching.value ? w.upload.touching : w.upload.touchesNothing}
            </p>
          )}
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
              joints={motion?.robot.joints}
              titled={causeOf(result)}
              selected={selected.value}
              onSelect={(number) => {
                selected.value = number
              }}
              onFix={(fix) => void flow.apply(fix)}
              onOtherRobot={
                robotMatters(conversion) && conversion.outcome === 'rejected'
                  ? () => {
                      if (!robots.current) return
                      robots.current.open = true
                      robots.current.scrollIntoView({ block: 'center' })
                      robots.current.querySelector('summary')?.focus()
                    }
                  : undefined
              }
              onTry={(fix) => void flow.try(fix)}
              chosenElsewhere={conversion.outcome === 'ambiguous'}
              busy={busy}
            />
          )}
          {robotMatters(result.conversion) && (
            <details class="card verdict-robot" ref={robots}>
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
            <MotionView
              motion={motion}
              compared={tried?.motion ?? null}
              note={tried ? w.upload.wouldBe(fixLabel(tried.fix, w)) : ''}
              selected={selected}
            />
          </div>
        )}
      </div>
    </article>
  )
}
