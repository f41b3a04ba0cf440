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

/** The outcome of a file. */
export function OutcomeChip({ outcome }: { outcome: keyof typeof OUTCOME_STATES }) {
  const look = OUTCOME_STATES[outcome].toLowerCase().replace('_', '-')
  return (
    <span class={`chip chip-${look}`}>
      <Icon name={OUTCOME_ICONS[outcome]} />
      {words.value.outcomes[outcome]}
    </span>
  )
}
