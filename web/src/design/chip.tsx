import { words } from '../words/words'
import { Icon } from './icons'
import { STATE_ICONS, type StateName } from './tokens'

/** The state of a playback: colour, icon and word, never the colour alone. */
export function StateChip({ state }: { state: StateName }) {
  return (
    <span class={`chip chip-${state.toLowerCase().replace('_', '-')}`}>
      <Icon name={STATE_ICONS[state]} />
      {words.value.states[state]}
    </span>
  )
}

const OUTCOME_STATES = {
  accepted: 'PLAYING',
  rejected: 'COLLISION_HALT',
  ambiguous: 'PAUSED',
} as const satisfies Record<string, StateName>
const OUTCOME_ICONS = { accepted: 'complete', rejected: 'error', ambiguous: 'warning' } as const

interface OutcomeProps {
  readonly outcome: keyof typeof OUTCOME_STATES
  /** True if it is taken with a warning: it then looks like one. */
  readonly doubted?: boolean
}

/** The outcome of a file. */
export function OutcomeChip({ outcome, doubted = false }: OutcomeProps) {
  const like = doubted && outcome === 'accepted' ? 'ambiguous' : outcome
  const look = OUTCOME_STATES[like].toLowerCase().replace('_', '-')
  return (
    <span class={`chip chip-${look}`}>
      <Icon name={OUTCOME_ICONS[like]} />
      {words.value.outcomes[outcome]}
    </span>
  )
}
