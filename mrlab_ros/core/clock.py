"""The clock of a trajectory: one pair (stamp, position) and a rate.

position(t) = position0 + rate * (t - stamp0), held inside [0, duration]. Stamps are integer
nanoseconds of whatever clock the caller uses; positions are seconds from the first frame.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from mrlab_ros.core.base.diagnostics import BAD_POSITION, BAD_RATE
from mrlab_ros.core.errors import BadInput

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
