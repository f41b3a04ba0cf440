import { useEffect, useRef } from 'preact/hooks'
import { StateChip } from '../../design/chip'
import { STATE_NAMES, type StateName } from '../../design/tokens'
import type { SystemView } from '../../lab/follower'
import type { RemotePlayer } from '../../playback/player'
import { spoken } from '../../words/diagnostic'
import { number, words } from '../../words/words'
import { useLab } from './context'
import { Timeline } from './timeline'

const ROW = 12 // of a segment and the space below it, in the drawing's units
const BAR = 8

function stateOf(label: string): StateName {
  if (label === 'STAGING') return 'ADJUSTING'
  return STATE_NAMES.find((name) => name === label) ?? 'READY'
}

/** The position of the system on its timeline, over the segments. */
function Playhead({ player, height }: { player: RemotePlayer; height: number }) {
  const line = useRef<SVGLineElement>(null)
  useEffect(() => {
    let request = 0
    const place = () => {
      const share = player.duration > 0 ? player.position() / player.duration : 0
      line.current?.setAttribute('transform', `translate(${share * 100} 0)`)
      request = player.playing ? requestAnimationFrame(place) : 0
    }
    const stir = () => {
      if (request === 0) request = requestAnimationFrame(place)
    }
    const stop = player.onChange(stir)
    stir()
    return () => {
      stop()
      cancelAnimationFrame(request)
    }
  }, [player])
  return <line ref={line} class="lab-playhead" x1="0" x2="0" y1="0" y2={height} />
}

/** A robot system: the segments of its robots on one timeline. */
export function SystemCard({ view }: { view: SystemView }) {
  const { may } = useLab()
  const { system, player } = view
  const length = Math.max(system.duration, 1e-9)
  const height = system.members.length * ROW
  const w = words.value.lab
  return (
    <article class="lab-card" aria-label={system.name}>
      <header class="lab-card-head">
        <h2>{system.name}</h2>
        <StateChip state={stateOf(system.label)} />
      </header>
      <p class="second small">{system.mode === 0 ? w.parallel : w.sequential}</p>
      {system.message && <p class="small">{spoken(system)}</p>}
      <svg
        class="lab-segments"
        viewBox={`0 0 100 ${height}`}
        role="img"
        aria-label={system.members
          .map((m) => w.segment(m.robot, number(m.start, 1), number(m.start + m.duration, 1)))
          .join(', ')}
        preserveAspectRatio="none"
      >
        {system.members.map((member, row) => (
          <rect
            key={member.robot}
            class={`segment-${(row % 7) + 1}`}
            x={(member.start / length) * 100}
            y={row * ROW + (ROW - BAR) / 2}
            width={Math.max((member.duration / length) * 100, 0.5)}
            height={BAR}
          />
        ))}
        <Playhead player={player} height={height} />
      </svg>
      <ul class="lab-members small">
        {system.members.map((member, row) => (
          <li key={member.robot}>
            <span class={`lab-dot segment-${(row % 7) + 1}`} aria-hidden="true" />
            {member.robot} · {member.trajectory_id}
            <span class="second">
              {' '}
              · {w.fromTo(number(member.start, 1), number(member.start + member.duration, 1))}
            </span>
            {member.waiting_for && <span class="second"> · {w.waitsFor(member.waiting_for)}</span>}
          </li>
        ))}
      </ul>
      <Timeline key="timeline" player={player} rate={100} enabled={may.commands} />
    </article>
  )
}
