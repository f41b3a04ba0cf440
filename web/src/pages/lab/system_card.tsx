import { StateChip } from '../../design/chip'
import { STATE_NAMES, type StateName } from '../../design/tokens'
import { words } from '../../words/words'
import type { SystemView } from './follow'
import { Timeline } from './timeline'

function stateOf(label: string): StateName {
  if (label === 'STAGING') return 'ADJUSTING'
  return STATE_NAMES.find((name) => name === label) ?? 'READY'
}

/** A robot system: its segments on one timeline. */
export function SystemCard({ view }: { view: SystemView }) {
  const { system, player } = view
  const length = Math.max(system.duration, 1e-9)
  const w = words.value.lab
  return (
    <article class="lab-card" aria-label={system.name}>
      <header class="lab-card-head">
        <h3>{system.name}</h3>
        <StateChip state={stateOf(system.label)} />
      </header>
      <p class="second small">{system.mode === 0 ? w.parallel : w.sequential}</p>
      {system.message && <p class="small">{system.message}</p>}
      <svg
        class="lab-segments"
        viewBox={`0 0 100 ${system.members.length * 9}`}
        role="img"
        aria-label={system.members.map((m) => `${m.robot} ${m.start.toFixed(1)} s`).join(', ')}
        preserveAspectRatio="none"
      >
        {system.members.map((member, row) => (
          <rect
            key={member.robot}
            class={`segment-${(row % 7) + 1}`}
            x={(member.start / length) * 100}
            y={row * 9 + 1}
            width={Math.max((member.duration / length) * 100, 0.5)}
            height={7}
            rx={1}
          />
        ))}
      </svg>
      <ul class="lab-members small">
        {system.members.map((member, row) => (
          <li key={member.robot}>
            <span class={`lab-dot segment-${(row % 7) + 1}`} aria-hidden="true" />
            {member.robot} · {member.trajectory_id}
            {member.waiting_for && <span class="second"> · {w.waitsFor(member.waiting_for)}</span>}
          </li>
        ))}
      </ul>
      <Timeline player={player} rate={100} />
    </article>
  )
}
