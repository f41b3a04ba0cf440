/** The clock of a trajectory: position(t) = position + rate * (t - stamp). The same pair as
 * `mrlab_msgs/msg/PlaybackClock` and `mrlab_ros/core/base/clock.py`. */
export interface PlaybackClock {
  /** Lab time at which `position` holds, s; if it is in the future, the clock starts then. */
  readonly stamp: number
  /** s from the first frame */
  readonly position: number
  /** 1: the declared speed, 0: paused, negative: backwards */
  readonly rate: number
}

/** Return the place on the trajectory at a lab time, s; it may lie past either end. */
export function positionAt(clock: PlaybackClock, labTime: number): number {
  if (labTime <= clock.stamp) return clock.position
  return clock.position + clock.rate * (labTime - clock.stamp)
}
