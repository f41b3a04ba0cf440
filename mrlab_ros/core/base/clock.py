"""The clock of a trajectory and the time of a lab.

A trajectory's clock is one pair (stamp, position) and a rate: position(t) = position0 + rate *
(t - stamp0), held inside [0, duration]. Stamps are integer nanoseconds of the caller's clock;
positions are seconds from the first frame.

The time of a lab follows the wall clock, which may be set while a robot plays. A node stores and
schedules by instants, which no set clock moves, and messages carry stamps, which follow the wall
clock: stamp = instant + shifted_ns. So no frame waits or hurries, and nothing that is stored has
to be moved when the clock is set.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from mrlab_ros.core.base.diagnostics import BAD_POSITION, BAD_RATE
from mrlab_ros.core.base.errors import BadInput

SECOND = 1_000_000_000
# Of the speed, either way.
RATE_RANGE = (0.1, 4.0)


def checked_rate(rate: float) -> float:
    """Return `rate` where its amount lies in RATE_RANGE; raise BadInput otherwise."""
    low, high = RATE_RANGE
    if not low <= abs(rate) <= high:
        raise BadInput(BAD_RATE(rate=rate, low=low, high=high))
    return rate


def checked_position(position: float, duration: float) -> float:
    """Return `position` (s) where it lies on the timeline; raise BadInput otherwise."""
    if not (math.isfinite(position) and 0 <= position <= duration):
        raise BadInput(BAD_POSITION(position=position, duration=duration))
    return position


@dataclass(frozen=True)
class PlaybackClock:
    """The pair and the rate; a change of either is a new clock.

    rate is negative while the clock runs backwards, and 0 while it stands. A stamp in the future
    means the clock starts then: until that instant the position is the pair's own.
    """

    stamp_ns: int = 0
    position: float = 0.0
    rate: float = 0.0

    def at(self, now_ns: int) -> float:
        """Return the position, s, at `now_ns`; it may lie past either end of the timeline."""
        if now_ns <= self.stamp_ns:
            return self.position
        return self.position + self.rate * ((now_ns - self.stamp_ns) / SECOND)

    def due(self, position: float) -> int:
        """Return the instant, ns, at which the clock shows `position`; rate must not be 0."""
        return self.stamp_ns + round((position - self.position) / self.rate * SECOND)


# A difference to the wall clock from which on the time is shifted at once, ns; a smaller one is
# slewed.
STEP_NS = SECOND // 10
# ns of correction for each ns: deadlines at 100 Hz then lie 50 us closer or further apart.
SLEW = 0.005
# A stamp is under way from one node to another for no longer, ns.
UNDER_WAY_NS = SECOND
# A difference that stays, ns: two clocks are never read at exactly one instant.
AGREED_NS = SECOND // 1000
# A step is rounded to a multiple of this, ns; the rest of it stays.
STEP_ROUNDING_NS = 2 * AGREED_NS


class LabTime:
    """Time in ns that advances steadily and agrees with its source. All arguments are ns.

    shifted_ns: the sum of all shifts: by how much stamps are ahead of instants.
    """

    def __init__(self, steady_ns: int, wall_ns: int) -> None:
        self.shifted_ns = 0
        # The sum before the newest shift, and the instant of that shift.
        self._shifted_before_ns, self._shift_ns = 0, 0
        self._offset_ns = wall_ns - steady_ns
        self._slewed_ns = steady_ns
        # The newest time that /clock gave; None: the wall clock is followed.
        self._simulated_ns: int | None = None

    @property
    def simulated(self) -> bool:
        """Return whether it follows /clock."""
        return self._simulated_ns is not None

    def follow_wall(self, steady_ns: int, wall_ns: int) -> int:
        """Return the time; a step of the wall clock shifts it."""
        if self._simulated_ns is not None:
            # use_sim_time was switched off.
            self._shift(self._simulated_ns, wall_ns)
            self._simulated_ns = None
            self._offset_ns, self._slewed_ns = wall_ns - steady_ns, steady_ns
        error_ns = wall_ns - steady_ns - self._offset_ns
        if abs(error_ns) >= STEP_NS:
            # Rounded: each process measures a little else, and their stamps are to agree.
            by_ns = round(error_ns / STEP_ROUNDING_NS) * STEP_ROUNDING_NS
            before_ns = steady_ns + self._offset_ns
            self._shift(before_ns, before_ns + by_ns)
            self._offset_ns += by_ns
            self._slewed_ns = steady_ns
        else:
            most_ns = int(SLEW * (steady_ns - self._slewed_ns))
            if most_ns > 0:
                excess_ns = error_ns - max(-AGREED_NS, min(AGREED_NS, error_ns))
                self._offset_ns += max(-most_ns, min(most_ns, excess_ns))
                self._slewed_ns = steady_ns
        return steady_ns + self._offset_ns

    def follow_clock(self, clock_ns: int, steady_ns: int) -> int:
        """Return the time of /clock; one that goes back shifts it, one that goes on is passed.

        clock_ns: 0 before the first message. Going on from 0, and from the wall clock, shifts too.
        """
        before_ns = self._simulated_ns
        if before_ns is None:
            before_ns = steady_ns + self._offset_ns
            self._shift(before_ns, clock_ns)
        elif clock_ns < before_ns or before_ns == 0:
            self._shift(before_ns, clock_ns)
        self._simulated_ns = clock_ns
        return clock_ns

    def instant(self, stamp_ns: int, now_ns: int) -> int:
        """Return the instant of a stamp that arrived at the instant `now_ns`.

        Just after the clock was set the stamp may have been made before: the nearer instant of
        the two is meant.
        """
        instant_ns = stamp_ns - self.shifted_ns
        if now_ns - self._shift_ns > UNDER_WAY_NS:
            return instant_ns
        former_ns = stamp_ns - self._shifted_before_ns
        return min(instant_ns, former_ns, key=lambda each: abs(each - now_ns))

    def _shift(self, before_ns: int, after_ns: int) -> None:
        """Let `after_ns` be the time at the instant at which it would be `before_ns`."""
        self._shift_ns = before_ns - self.shifted_ns
        self._shifted_before_ns = self.shifted_ns
        self.shifted_ns += after_ns - before_ns
