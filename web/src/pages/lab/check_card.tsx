import { useState } from 'preact/hooks'
import type { Check, CheckFinding } from '../../api/types'
import { Button } from '../../design/button'
import { Icon, type IconName } from '../../design/icons'
import { counted, kindOf, type RobotCheck } from '../../lab/robot_check'
import { say, spoken } from '../../words/diagnostic'
import { number, words } from '../../words/words'

/** Findings that are shown before all are requested. */
const FEW = 3
const MOST = 100
const VERDICTS = {
  ready: 'complete',
  not_ready: 'error',
  running: 'ready',
  failed: 'warning',
} as const satisfies Record<string, IconName>

interface CheckCardProps {
  readonly check: RobotCheck
  /** True if the person may start a check. */
  readonly enabled: boolean
  readonly onSeek: ((time: number) => void) | null
}

function verdictOf({ state, verdict }: Check): keyof typeof VERDICTS {
  if (state === 'failed') return 'failed'
  if (state !== 'done') return 'running'
  return verdict === 'ready' ? 'ready' : 'not_ready'
}

function Finding({
  finding,
  onSeek,
}: {
  finding: CheckFinding
  onSeek: ((time: number) => void) | null
}) {
  const w = words.value
  const { severity, time } = finding
  const { message, remedy } = say(finding)
  const at = time === null ? '' : w.check.at(number(time, 2))
  return (
    <li class={`check-finding check-${severity}`}>
      <p class="check-head small">
        <span class="check-severity">
          <Icon name={severity} />
          {w.severities[severity]}
        </span>
        <strong>{kindOf(finding.code, w)}</strong>
        {time !== null && (
          <button
            type="button"
            class="check-time"
            disabled={onSeek === null}
            onClick={() => onSeek?.(time)}
          >
            {at}
          </button>
        )}
      </p>
      <p class="small">{message}</p>
      {remedy && <p class="second tiny">{remedy}</p>}
    </li>
  )
}

/** The check of the motion that a robot has loaded. */
export function CheckCard({ check, enabled, onSeek }: CheckCardProps) {
  const [all, setAll] = useState(false)
  const w = words.value.check
  const known = check.check.value
  const problem = check.problem.value
  const again = (
    <Button look="quiet" disabled={!enabled} onClick={() => void check.start()}>
      {known === null || known.state === 'failed' ? w.check : w.again}
    </Button>
  )
  if (known === null)
    return (
      <section class="check" aria-label={w.of(check.robot)}>
        {enabled && (
          <div class="check-line">
            <p class="grow second small">{problem || w.notYet}</p>
            {again}
          </div>
        )}
      </section>
    )
  const verdict = verdictOf(known)
  const running = verdict === 'running'
  const { refusing, warning } = counted(known)
  const said = [refusing > 0 && w.refusing(refusing), warning > 0 && w.warnings(warning)]
  const findings = known.findings.slice(0, all ? MOST : FEW)
  const left = known.findings.length - findings.length
  return (
    <section class="check" aria-label={w.of(check.robot)}>
      <div class="check-line">
        <p class={`grow check-verdict check-${verdict}`} role="status">
          <Icon name={VERDICTS[verdict]} />
          <span>
            <strong>{w.verdicts[verdict]}</strong>
            {verdict === 'failed' && (
              <span class="small"> {known.problem !== null && spoken(known.problem)}</span>
            )}
            {!running && verdict !== 'failed' && (
              <span class="small second"> {said.filter(Boolean).join(', ') || w.nothing}</span>
            )}
          </span>
        </p>
        {!running && enabled && again}
      </div>
      {known.stale && (
        <p class="check-stale small">
          <Icon name="warning" />
          <span>{w.stale(say(known.stale).message)}</span>
        </p>
      )}
      {problem && <p class="field-error small">{problem}</p>}
      {findings.length > 0 && (
        <ol class="check-findings" aria-label={w.findings}>
          {findings.map((finding) => (
            <Finding
              key={`${finding.code} ${finding.robot} ${finding.link} ${finding.time} ${finding.message}`}
              finding={finding}
              onSeek={onSeek}
            />
          ))}
        </ol>
      )}
      {left > 0 && (
        <Button look="quiet" onClick={() => setAll(true)}>
          {w.more(left)}
        </Button>
      )}
      {verdict === 'ready' && <p class="second tiny">{w.claim}</p>}
    </section>
  )
}
