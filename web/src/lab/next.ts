import type { SystemMember } from '../protocol/mrlab_msgs'
import type { Words } from '../words/en'
import { fixed } from '../words/words'
import type { RobotView } from './followed_robot'

/** s; what is so near is happening */
const NOW = 0.005

/** A robot on the timeline of its system. */
export interface Turn {
  readonly member: SystemMember
  /** s, where the system is */
  readonly position: number
}

/** Return what a robot does next, in words; empty: nothing is known of it.
 *
 * position: s, where it is on its motion. turn: null: it belongs to no system.
 */
export function nextOf(
  { state, playback, targets, down }: RobotView,
  position: number,
  turn: Turn | null,
  w: Words['lab']['next'],
): string {
  if (down) return w.down
  if (playback === null || playback.frame_count === 0) return w.load
  const time = (at: number) => fixed(at, 2)
  if (turn !== null && state !== 'PLAYING' && state !== 'COLLISION_HALT') {
    const { waiting_for: other, start } = turn.member
    if (other !== '') return w.waits(other)
    if (turn.position < start - NOW) return w.turn(time(start - turn.position))
  }
  if (state === 'COLLISION_HALT') return w.free(time(position))
  if (state === 'PAUSED') return w.goesOn(time(position))
  if (state === 'READY' || state === 'COMPLETE' || state === 'IDLE')
    return w.plays(playback.trajectory_id, time(playback.duration / Math.abs(playback.rate || 1)))
  if (state === 'ADJUSTING') return w.afterAdjusting
  const ahead =
    playback.rate < 0
      ? targets.findLast((target) => target.time < position - NOW)
      : targets.find((target) => target.time > position + NOW)
  if (ahead) {
    // played backwards, what closed the gripper opens it
    const closes = ahead.close === playback.rate > 0
    return closes ? w.closes(time(ahead.time)) : w.opens(time(ahead.time))
  }
  if (playback.loop) return w.again
  return w.ends(time(playback.rate < 0 ? 0 : playback.duration))
}
