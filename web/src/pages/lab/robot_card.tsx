import { Button } from '../../design/button'
import { StateChip } from '../../design/chip'
import type { Link } from '../../link/link'
import { words } from '../../words/words'
import { trigger } from './commands'
import type { RobotView } from './follow'
import { Timeline } from './timeline'

/** One robot: what it does, what it holds, and its timeline. */
export function RobotCard({ view, link }: { view: RobotView; link: Link }) {
  const { robot, state, playback, holding, touching, player } = view
  const w = words.value.lab
  const loaded = playback !== null && playback.frame_count > 0
  return (
    <article class="lab-card" aria-label={robot.name}>
      <header class="lab-card-head">
        <h3>{robot.name}</h3>
        <StateChip state={state} />
      </header>
      <p class="second small">
        {robot.model}
        {robot.end_effector && ` + ${robot.end_effector}`}
        {playback?.trajectory_id && ` · ${playback.trajectory_id}`}
        {playback?.system && ` · ${w.inSystem(playback.system)}`}
      </p>
      {playback?.message && <p class="small">{playback.message}</p>}
      {touching && <p class="lab-halt small">{touching}</p>}
      {holding && <p class="small">{w.holds(holding)}</p>}
      {loaded ? (
        <Timeline player={player} rate={playback.frame_rate} />
      ) : (
        <p class="second small">{w.nothingLoaded}</p>
      )}
      {state === 'COLLISION_HALT' && (
        <Button onClick={() => trigger(link, `${robot.name}/clear_halt`)}>{w.clearHalt}</Button>
      )}
    </article>
  )
}
