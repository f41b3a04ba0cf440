import { useEffect, useRef } from 'preact/hooks'
import type { Diagnostic, Fix } from '../../api/types'
import { Button } from '../../design/button'
import { FindingItem } from '../../design/finding'
import { showToast } from '../../design/toast'
import { nameOfJoint, said, say } from '../../words/diagnostic'
import { words } from '../../words/words'
import { applied, fixLabel } from './fixes'

interface FindingsProps {
  /** Of the robot, in its order. */
  joints: readonly { readonly name: string }[] | undefined
  findings: readonly Diagnostic[]
  /** Number of the shown finding, from 1; 0: none. */
  selected: number
  onSelect: (number: number) => void
  /** Number of the finding whose message is the page's title; 0: none. */
  titled?: number
  /** Absent: nothing can be mended here. */
  onFix?: (fix: Fix) => void
  /** Absent: no other robot makes the file acceptable. */
  onOtherRobot?: (() => void) | undefined
  /** Show what a fix would do; null: no longer. */
  onTry?: (fix: Fix | null) => void
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

function place(finding: Diagnostic, joints: FindingsProps['joints']): string {
  const w = words.value.upload
  const rows =
    finding.first_row === 0
      ? ''
      : finding.last_row > finding.first_row
        ? w.rows(finding.first_row, finding.last_row)
        : w.row(finding.first_row)
  return [finding.variable, nameOfJoint(finding, joints), rows].filter(Boolean).join(' · ')
}

function Finding(props: FindingsProps & { finding: Diagnostic; number: number }) {
  const { finding, number, selected, onSelect, onFix, onTry, busy = false } = props
  const w = words.value
  const where = place(finding, props.joints)
  const fixes = finding.fixes.filter((fix) => !props.chosenElsewhere || fix.option !== 'variable')
  // Several options may have the same line of MATLAB.
  const lines = [...new Set(fixes.map((fix) => fix.matlab).filter(Boolean))]
  return (
    <FindingItem
      number={number}
      severity={finding.severity}
      code={finding.code}
      where={where}
      remedy={say(finding).remedy}
      message={said(finding, props.joints)}
      {...(props.titled === number && selected === number && { message: '' })}
      onShow={finding.first_row > 0 || selected !== number ? () => onSelect(number) : undefined}
      shown={selected === number}
      folded={selected !== number}
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
                onPointerEnter={(event) => event.pointerType === 'mouse' && onTry?.(fix)}
                onPointerLeave={() => onTry?.(null)}
                onFocus={(event) => event.currentTarget.matches(':focus-visible') && onTry?.(fix)}
                onBlur={() => onTry?.(null)}
              >
                {fixLabel(fix, w, finding.variable)}
              </Button>
            ))}
          {props.onOtherRobot && OF_ROBOT.has(finding.code) && (
            <Button look="quiet" icon="robot" onClick={props.onOtherRobot}>
              {w.upload.otherRobot}
            </Button>
          )}
        </div>
      )}
      {lines.map((line) => (
        <Matlab key={line} line={line} />
      ))}
    </FindingItem>
  )
}

/** Return the number of the finding that is shown first: the first error, else the first. */
export function firstFinding(findings: readonly Diagnostic[]): number {
  return (
    Math.max(
      findings.findIndex(({ severity }) => severity === 'error'),
      0,
    ) + 1
  )
}

/** Errors that another robot would not have. */
const OF_ROBOT: ReadonlySet<string> = new Set([
  'joint_limit',
  'names_other',
  'robot_stated',
  'velocity_limit',
])

const SWIPE = 48 // px

/** The findings of the converter, one unfolded; the numbers are those of plots and 3D. The arrow
 * keys and a swipe lead to the next and the one before. */
export function Findings(props: FindingsProps) {
  const w = words.value.upload
  const { findings, onSelect } = props
  const selected = props.selected || firstFinding(findings)
  const swipe = useRef<readonly [number, number] | null>(null)
  const step = (by: number) => {
    const next = selected + by
    if (next >= 1 && next <= findings.length) onSelect(next)
  }
  const key = (event: KeyboardEvent) => {
    const by = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key]
    if (by === undefined) return
    event.preventDefault()
    step(by)
  }
  // where nothing has the focus, left and right need none
  const free = useRef(key)
  free.current = (event) => {
    if (event.target === document.body && /^Arrow(Left|Right)$/.test(event.key)) key(event)
  }
  useEffect(() => {
    const listen = (event: KeyboardEvent) => free.current(event)
    document.addEventListener('keydown', listen)
    return () => document.removeEventListener('keydown', listen)
  }, [])
  return (
    <section
      class="stack-8 motion-findings"
      aria-labelledby="findings"
      onKeyDown={key}
      onTouchStart={({ touches: [touch] }) => {
        swipe.current = touch ? [touch.clientX, touch.clientY] : null
      }}
      onTouchEnd={({ changedTouches: [touch] }) => {
        if (!touch || !swipe.current) return
        const [x, y] = [touch.clientX - swipe.current[0], touch.clientY - swipe.current[1]]
        if (Math.abs(x) > SWIPE && Math.abs(x) > 2 * Math.abs(y)) step(x < 0 ? 1 : -1)
      }}
    >
      <div class="motion-findings-head">
        <h2 id="findings">{w.findings(findings.length)}</h2>
        {findings.length > 1 && (
          <>
            <Button
              look="quiet"
              icon="back"
              label={w.previousFinding}
              disabled={selected === 1}
              onClick={() => step(-1)}
            />
            <Button
              look="quiet"
              icon="next"
              label={w.nextFinding}
              disabled={selected === findings.length}
              onClick={() => step(1)}
            />
          </>
        )}
      </div>
      <ol class="findings">
        {findings.map((finding, index) => (
          <Finding
            key={`${finding.code} ${finding.first_row} ${finding.joint} ${finding.message}`}
            {...props}
            selected={selected}
            finding={finding}
            number={index + 1}
          />
        ))}
      </ol>
    </section>
  )
}
