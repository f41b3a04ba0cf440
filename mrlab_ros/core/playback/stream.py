"""The joint states of one robot: what each one holds and when it leaves.

A `Stream` follows a trajectory, an approach to it, or repeats a standing pose. It knows no
states: `Playback` decides what the arm does and calls the matching method.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.playback.planner import Motion
from mrlab_ros.core.trajectory.trajectory import ON_FRAME, Trajectory

# Joint states that are late by less than this are sent late; later ones are left out, because
# catching up would take too long.
LOST_AFTER_NS = 10 * SECOND
# Late joint states follow each other no closer than this share of the period: the stream
# catches up without a burst.
CATCH_UP_SPACING = 0.5
# The arm is on the trajectory when no joint is further off than this, rad.
ON_TRAJECTORY = 1e-6
# Slack when a position is turned into a number of ticks, ticks.
ON_TICK = 1e-6


class Sample(NamedTuple):
    """One joint state.

    due_ns: its deadline and its stamp, ns. positions, velocities: (J,) rad and rad/s.
    position: on the trajectory, s. frame: the last source frame reached. streamed: whether it
    is part of the trajectory, not of an approach or a standing pose.
    """

    due_ns: int
    positions: Array
    velocities: Array
    position: float
    frame: int
    streamed: bool


class Stream:
    """The joint states of one robot. The methods between the samples say what the arm does.

    trajectory: what follow() follows; the caller loads one before it calls anything but stand().
    clock: the position on the trajectory at any time; its rate is 0 unless the arm follows.
    rate: the speed of the next follow(), negative: backwards. until: where it ends, s; None: at
    the end of the trajectory.
    arm: the joint positions sent last, (J,) rad. streamed: the position of the last joint state
    of the trajectory, s; None where none was sent since the arm was moved otherwise.
    sent, lost: joint states of this run that left, and that were left out.
    next_ns: when the next joint state leaves; None: not before something changes.
    arrived, ended, held: whether the last joint state taken was the last one of the approach, of
    the trajectory, or the one at `until`.
    """

    def __init__(self, home: Array, standing_rate: float) -> None:
        """Stand at `home`, (J,) rad; repeat a standing pose at `standing_rate` Hz (0: never)."""
        self.trajectory: Trajectory | None = None
        # The clock of the next joint state, then those that hold later: what is late when the rate
        # changes still leaves as it was scheduled.
        self._clocks = deque([PlaybackClock()])
        self.rate = 1.0
        self.until: float | None = None
        self.arm = home
        self.streamed: float | None = None
        self.sent = 0
        self.lost = 0
        self.next_ns: int | None = 0
        self._standing_ns = _period_ns(standing_rate)
        # The next joint state of the trajectory: its number at this rate, its position (s) and
        # its deadline.
        self._tick, self._next_position, self._due_ns = 0, 0.0, 0
        # The run that it belongs to: where it begins and where it ends, s; joint states a second.
        self._run_begin, self._run_end, self._frame_rate = 0.0, 0.0, 1.0
        self._motion: Motion | None = None
        self._motion_start_ns = 0
        self._last: Sample | None = None
        self.arrived = self.ended = self.held = False

    @property
    def clock(self) -> PlaybackClock:
        """The newest clock: the position on the trajectory at any time from its stamp on."""
        return self._clocks[-1]

    # what the arm does ----------------------------------------------------------------------

    def stand(self, now_ns: int, position: float, *, sent: bool = False) -> None:
        """Stand still at `position` (s) of the clock.

        sent: the pose has just left, so its first repetition follows a standing period later.
        """
        self._motion = None
        self.streamed = None
        self.until = None
        self._clocks = deque([PlaybackClock(now_ns, position, 0.0)])
        self.next_ns = self._repetition(now_ns) if sent else now_ns

    def jump(self, now_ns: int, position: float) -> None:
        """Put the arm at `position` (s) of the trajectory at once and stand there."""
        self.arm = self._loaded.sample(position)
        self.stand(now_ns, position)

    def halt(self, now_ns: int) -> None:
        """Stand still where the last joint state left the arm; follow() goes on behind it."""
        streamed = self.streamed
        self.stand(now_ns, self.position)
        self.streamed = streamed

    def stand_at(self, now_ns: int, arm: Array) -> None:
        """Put the arm at `arm`, (J,) rad, and stand there."""
        self.arm = arm
        self.stand(now_ns, self.clock.position)

    def come_back(self, now_ns: int, position: float, arm: Array) -> None:
        """Stand at `arm` as after halt(): the joint state at `position` (s) was sent before."""
        self.arm = arm
        self.stand(now_ns, position)
        if self.is_at(position):
            self.streamed = position

    def approach(self, now_ns: int, motion: Motion, position: float) -> None:
        """Start `motion`, which brings the arm to `position` (s) of the trajectory."""
        self.stand(now_ns, position)
        self._motion, self._motion_start_ns = motion, now_ns

    def follow(self, start_ns: int, position: float) -> None:
        """Follow the trajectory from `position` (s) on, which the clock shows at `start_ns`.

        The joint state at `position` leaves first, unless it was the last that was sent.
        """
        resumed = self.streamed == position
        if self.clock.rate == 0 and not resumed:
            self.sent = self.lost = 0
        self._motion = None
        self._clocks = deque([PlaybackClock(start_ns, position, self.rate)])
        self.streamed = position if resumed else None
        self._schedule_from(position, skip=resumed)
        self.next_ns = self._due_ns

    def set_rate(self, since_ns: int, rate: float) -> None:
        """Set the speed; an arm that follows the trajectory goes on at it from `since_ns` on.

        Joint states that are late then leave as they were scheduled; a turn starts from the last
        one that was sent instead.
        """
        turns = (rate < 0) != (self.rate < 0)
        before, self.rate = self.clock, rate
        if turns:
            self.until = None
        if before.rate == 0:
            return
        start_ns = max(since_ns, before.stamp_ns)
        position = min(max(before.at(start_ns), 0.0), self._loaded.duration)
        late = self._due_ns < start_ns
        if late and turns:
            position = self.position
        clock = PlaybackClock(start_ns, position, rate)
        if late and not turns:
            self._clocks.append(clock)
        else:
            self._clocks = deque([clock])
            self._schedule_on()
            self.next_ns = self._due_ns

    def end_at(self, until: float | None) -> None:
        """End the run at `until` (s), which lies ahead; None: at the trajectory's end."""
        self.until = until
        if self.clock.rate != 0:
            self._begin_run()
            self._schedule(self._tick)
            self.next_ns = self._due_ns

    def motion(self, now_ns: int, within_ns: int) -> tuple[int, Array, Array | None]:
        """Return when the arm was sent last, where it is, and its velocities, or now and None.

        ns, (J,) rad, (J,) rad/s; None: it stands, or nothing was sent in the last two periods. The
        instant is at most `within_ns` before `now_ns`: what starts there is not late.
        """
        last = self._last
        if last is None or now_ns - last.due_ns > 2 * self.period_ns:
            return now_ns, self.arm, None
        return max(last.due_ns, now_ns - within_ns), self.arm, last.velocities

    def go_on_from(self, now_ns: int) -> None:
        """Take the pose that left at `now_ns` as the first of the trajectory just loaded."""
        self.stand(now_ns, 0.0)
        self.streamed = 0.0
        self.sent, self.lost = 1, 0

    # where it is ----------------------------------------------------------------------------

    @property
    def position(self) -> float:
        """The position of the last joint state on the trajectory, s."""
        return self.clock.position if self.streamed is None else self.streamed

    @property
    def begin(self) -> float:
        """Return the start of a run of the whole trajectory, s: backwards the last frame."""
        return self._loaded.duration if self.rate < 0 else 0.0

    @property
    def end(self) -> float:
        """Return the end of a run of the whole trajectory, s: backwards the first frame."""
        return 0.0 if self.rate < 0 else self._loaded.duration

    @property
    def frame(self) -> int:
        """The last source frame reached; 0 without a trajectory."""
        return 0 if self.trajectory is None else self.trajectory.frame_at(self.position)

    def passed(self, position: float) -> bool:
        """Return whether the next run, or this one, does not reach `position` (s) any more."""
        furthest = max if self.rate > 0 else min
        reached = furthest(self.position, self._clocks[0].position)
        return (position - reached) * self.rate < 0 or position == self.streamed

    def is_at(self, position: float) -> bool:
        """Return whether the arm is on the trajectory at `position`, s."""
        goal = self._loaded.sample(position)
        return bool(np.abs(goal - self.arm).max() <= ON_TRAJECTORY)

    @property
    def period_ns(self) -> int:
        """The time between two joint states, ns."""
        return round(SECOND / self._loaded.frame_rate)

    # the joint states -----------------------------------------------------------------------

    def standing_sample(self, now_ns: int) -> Sample:
        """Return the standing pose, and schedule its repetition."""
        sample = self._off_trajectory(now_ns, np.zeros_like(self.arm))
        self.next_ns = self._repetition(now_ns)
        return sample

    def approach_sample(self, now_ns: int) -> Sample:
        """Return the next joint state of the approach, and schedule the one after it."""
        assert self._motion is not None
        assert self.next_ns is not None
        due_ns = self.next_ns
        elapsed = (due_ns - self._motion_start_ns) / SECOND
        self.arm, velocities = self._motion.at(elapsed)
        self.arrived = elapsed >= self._motion.duration
        return self._sample_off_trajectory(due_ns, velocities, now_ns)

    def live_sample(
        self, now_ns: int, step: Callable[[int, Array], tuple[Array, Array]]
    ) -> Sample:
        """Return the next joint state of a stream of set-points, and schedule the one after it.

        step: takes its deadline, ns, and the arm, (J,) rad, and returns positions and velocities.
        """
        assert self.next_ns is not None
        due_ns = self.next_ns
        self.arm, velocities = step(due_ns, self.arm)
        return self._sample_off_trajectory(due_ns, velocities, now_ns)

    def trajectory_sample(self, now_ns: int) -> Sample:
        """Return the next joint state of the trajectory, and schedule the one after it."""
        trajectory = self._loaded
        if now_ns - self._due_ns > LOST_AFTER_NS:
            self._skip_lost(now_ns)
        position, due_ns = self._next_position, self._due_ns
        self.streamed = position
        frame, self.arm, velocities = trajectory.at(position)
        rate = self._clocks[0].rate
        if rate != 1.0:
            velocities = velocities * rate
        sample = self._last = Sample(due_ns, self.arm, velocities, position, frame, True)
        self.sent += 1
        self._schedule(self._tick + 1)
        spacing_ns = int(CATCH_UP_SPACING * SECOND / self._frame_rate)
        self.next_ns = max(self._due_ns, now_ns + spacing_ns)
        self.ended = position == self.end
        self.held = position == self.until
        return sample

    def set_standing_rate(self, now_ns: int, rate: float) -> None:
        """Repeat a standing pose at `rate` Hz (0: never); a pose that is due still leaves."""
        self._standing_ns = _period_ns(rate)
        if self._stands and (self.next_ns is None or self.next_ns > now_ns):
            self.next_ns = self._repetition(now_ns)

    def repeat(self, now_ns: int) -> None:
        """Let a standing pose leave at once, unless it is never repeated."""
        if self._stands and self._standing_ns is not None:
            self.next_ns = now_ns

    # inside ---------------------------------------------------------------------------------

    @property
    def _loaded(self) -> Trajectory:
        assert self.trajectory is not None
        return self.trajectory

    @property
    def _stands(self) -> bool:
        return self._motion is None and self.clock.rate == 0.0

    def _repetition(self, now_ns: int) -> int | None:
        return None if self._standing_ns is None else now_ns + self._standing_ns

    def _sample_off_trajectory(self, due_ns: int, velocities: Array, now_ns: int) -> Sample:
        # A late frame continues from the present: joint states off the trajectory are not counted.
        self.next_ns = max(due_ns, now_ns - self.period_ns) + self.period_ns
        return self._off_trajectory(due_ns, velocities)

    def _off_trajectory(self, due_ns: int, velocities: Array) -> Sample:
        self._last = Sample(due_ns, self.arm, velocities, self.clock.position, self.frame, False)
        return self._last

    def _begin_run(self) -> None:
        """Take what holds until the run's rate, end or trajectory changes."""
        self._run_begin = self.begin
        self._run_end = self.end if self.until is None else self.until
        self._frame_rate = self._loaded.frame_rate

    def _tick_at(self, position: float) -> float:
        """Return the number of the run's joint state at `position` (s)."""
        return (position - self._run_begin) * self._frame_rate / self._clocks[0].rate

    def _schedule_on(self) -> None:
        """Schedule the first joint state of a clock that goes on from another one.

        Neither its position nor its stamp goes back behind the last one that was sent.
        """
        clock = self._clocks[0]
        if self.streamed is None or self._last is None:
            self._schedule_from(clock.position, skip=False)
            return
        furthest = max if clock.rate > 0 else min
        reached = furthest(clock.at(self._last.due_ns), self.streamed)
        self._schedule_from(min(max(reached, 0.0), self._loaded.duration), skip=True)
        if self._due_ns <= self._last.due_ns:
            # It turned at its end, which it says once more.
            self._due_ns = self._last.due_ns + self.period_ns

    def _schedule_from(self, position: float, *, skip: bool) -> None:
        """Schedule the first joint state at (or, with skip, after) `position` (s)."""
        self._begin_run()
        tick = self._tick_at(position)
        self._schedule(math.floor(tick + ON_TICK) + 1 if skip else math.ceil(tick - ON_TICK))

    def _schedule(self, tick: int) -> None:
        """Make `tick` the next joint state; the last one is exactly at the end of the run.

        Where the next clock holds by then, it is the first one of that.
        """
        clock, frame_rate, end = self._clocks[0], self._frame_rate, self._run_end
        position = self._run_begin + tick * clock.rate / frame_rate
        left = end - position if clock.rate > 0 else position - end
        if left < ON_FRAME / frame_rate:
            position = end
        self._tick, self._next_position = tick, position
        self._due_ns = clock.due(position)
        if len(self._clocks) > 1 and self._due_ns > self._clocks[1].stamp_ns:
            self._clocks.popleft()
            self._schedule_on()

    def _skip_lost(self, now_ns: int) -> None:
        """Leave out the joint states whose successor is due too, and count them."""
        while len(self._clocks) > 1 and self._clocks[1].stamp_ns <= now_ns:
            if self._next_position == self._run_end:
                return
            clocks, tick = self._clocks.copy(), self._tick
            self._schedule(tick + 1)
            if self._due_ns > now_ns:
                self._clocks = clocks
                self._begin_run()
                self._schedule(tick)
                return
            self.lost += 1
        clock = self._clocks[0]
        nearest = min if clock.rate > 0 else max
        reached = nearest(clock.at(now_ns), self._run_end)
        newest = math.floor(self._tick_at(reached) + ON_FRAME)
        self.lost += max(newest - self._tick, 0)
        self._schedule(max(newest, self._tick))


def _period_ns(rate: float) -> int | None:
    return round(SECOND / rate) if rate > 0 else None
