import type { ComponentChildren } from 'preact'
import { words } from '../words/words'
import { Icon } from './icons'
import './finding.css'

interface FindingItemProps {
  readonly number: number
  readonly severity: 'info' | 'warning' | 'error'
  readonly code: string
  /** The place to which it applies, such as a joint and rows. */
  readonly where: string
  readonly message: string
  readonly remedy: string
  /** Absent: it has no place. */
  readonly onShow?: (() => void) | undefined
  /** True for the finding that is shown. */
  readonly shown: boolean
  /** Only its message, on one line; a press shows it. */
  readonly folded?: boolean
  readonly children?: ComponentChildren
}

/** A finding in a list, with the number that it has in plots and in 3D. */
export function FindingItem(props: FindingItemProps) {
  const { number, severity, code, where, message, remedy, onShow, shown, children } = props
  if (props.folded)
    return (
      <li class={`finding finding-${severity} finding-folded`} data-code={code}>
        <button type="button" aria-expanded={false} onClick={onShow}>
          <span class="finding-number">{number}</span>
          <span class="finding-line">{message}</span>
        </button>
      </li>
    )
  return (
    <li
      class={`finding finding-${severity}`}
      data-code={code}
      aria-current={shown ? 'true' : undefined}
    >
      <span class="finding-number">{number}</span>
      <div class="finding-body">
        <p class="finding-head">
          <span class="finding-severity">
            <Icon name={severity} />
            {words.value.severities[severity]}
          </span>
          {onShow ? (
            <button type="button" class="finding-place" onClick={onShow}>
              {where}
            </button>
          ) : (
            <span class="second">{where}</span>
          )}
        </p>
        {message && <p>{message}</p>}
        {remedy && <p class="second small">{remedy}</p>}
        {children}
      </div>
    </li>
  )
}
