"""The fixed grid of instants at which a world steps."""

from __future__ import annotations

from mrlab_ros.core.base.clock import SECOND

# Clearance and snapshots run every SLOW_STEPS steps; every ROOM_STEPS, a multiple of it, what has
# left the room is looked for.
SLOW_STEPS = 12
ROOM_STEPS = 60


class StepGrid:
    """Counts steps of `rate` a second, Hz, from an instant on. count: that of the last step."""

    def __init__(self, rate: float) -> None:
        self._rate = rate
        self._epoch_ns: int | None = None
        self.count = 0

    @property
    def started(self) -> bool:
        return self._epoch_ns is not None

    def start(self, now_ns: int) -> None:
        """Let step 0 be at `now_ns`."""
        self._epoch_ns = now_ns

    def shift(self, by_ns: int) -> None:
        """Move all instants by `by_ns`; the count goes on."""
        assert self._epoch_ns is not None
        self._epoch_ns += by_ns

    def stamp(self, count: int) -> int:
        """Return the instant of a step, ns."""
        assert self._epoch_ns is not None
        return self._epoch_ns + round(count * SECOND / self._rate)

    def next(self, *, resting: bool) -> int:
        """Return the count of the next step: a world at rest makes every SLOW_STEPS-th only."""
        if resting:
            return (self.count // SLOW_STEPS + 1) * SLOW_STEPS
        return self.count + 1
