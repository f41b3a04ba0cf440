import type { Diagnostic, Fix } from '../../api/types'
import { Button } from '../../design/button'
import { FindingItem } from '../../design/finding'
import { showToast } from '../../design/toast'
import { say } from '../../words/diagnostic'
import { words } from '../../words/words'
import { applied, fixLabel } from './fixes'

interface FindingsProps {
  findings: readonly Diagnostic[]
  /** Number of the shown finding, from 1; 0: none. */
  selected: number
  onSelect: (number: number) => void
  /** Absent: nothing can be mended here. */
  onFix?: (fix: Fix) => void
  /** The choice between matrices is offered elsewhere on the page. */
  chosenElsewhere?: boolean
  busy?: boolean
}

async function copy(text: string): Promise<void> {
  await navigator.clipboard.writeText(text)
  showToast(words.value.copied)
}

function Matlab({ line }: { line: string }) {
  return (
    <div class="matlab">
      <code>{line}</code>
      {/* Without HTTPS there is no clipboard; the line can be selected all the same. */}
      {navigator.clipboard && (
        <Button
          look="quiet"
          icon="copy"
          label={words.value.upload.copyMatlab}
          onClick={() => void copy(line)}
        />
      )}
    </div>
  )
}

function place(finding: Diagnostic): string {
  const w = words.value.upload
  const rows =
    finding.first_row === 0
      ? ''
      : finding.last_row > finding.first_row
        ? w.rows(finding.first_row, finding.last_row)
        : w.row(finding.first_row)
  return [finding.variable, finding.joint, rows].filter(Boolean).join(' · ')
}

function Finding(props: FindingsProps & { finding: Diagnostic; number: number }) {
  const { finding, number, selected, onSelect, onFix, busy = false, chosenElsewhere } = props
  const w = words.value
  const where = place(finding)
  const fixes = finding.fixes.filter((fix) => !chosenElsewhere || fix.option !== 'variable')
  // Several options may have the same line of MATLAB.
  const lines = [...new Set(fixes.map((fix) => fix.matlab).filter(Boolean))]
  return (
    <FindingItem
      number={number}
      severity={finding.severity}
      code={finding.code}
      where={where}
      {...say(finding)}
      onShow={finding.first_row > 0 ? () => onSelect(number) : undefined}
      shown={selected === number}
    >
      {onFix && (
        <div class="finding-fixes">
          {fixes
            .filter((fix) => applied({}, fix) !== null)
            .map((fix) => (
              <Button
                key={`${fix.option}=${fix.value}`}
                icon="wrench"
                disabled={busy}
                onClick={() => onFix(fix)}
              >
                {fixLabel(fix, w)}
              </Button>
            ))}
        </div>
      )}
      {lines.map((line) => (
        <Matlab key={line} line={line} />
      ))}
    </FindingItem>
  )
}

/** The findings of the converter; the numbers are those of plots and 3D. */
export function Findings(props: FindingsProps) {
  const w = words.value.upload
  return (
    <section class="stack-8" aria-labelledby="findings">
      <h2 id="findings">{w.findings(props.findings.length)}</h2>
      <ol class="findings">
        {props.findings.map((finding, index) => (
          <Finding
            key={`${finding.code} ${finding.first_row} ${finding.joint} ${finding.message}`}
            {...props}
            finding={finding}
            number={index + 1}
          />
        ))}
      </ol>
    </section>
  )
}
