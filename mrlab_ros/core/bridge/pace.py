"""When the bridge checks the graph: often while it changes, seldom otherwise."""

from __future__ import annotations

# How long after a change checks go on, s: the endpoints of a new node are matched one by one.
SETTLE_S = 1.0
# Time between two checks of a graph that does not change, s.
REST_S = 5.0


class Pace:
    """Times of the checks, s on any clock that never goes back; the first one is due at once.

    period: between two checks while the graph changes.
    """

    def __init__(self, period: float) -> None:
        self.period = period
        self._last = float("-inf")
        self._settle_until = float("-inf")
        self._settled = False

    def changed(self, now: float) -> None:
        """Note that the graph has changed."""
        self._settle_until = now + SETTLE_S
        self._settled = False

    def wait(self, now: float) -> float:
        """Return the time until the next check; 0: it is due."""
        return max(self._last + (REST_S if self._settled else self.period) - now, 0.0)

    def check(self, now: float) -> bool:
        """Note that a check begins; return whether it is to be thorough.

        That is the last one after a change, and each one without a change.
        """
        self._last = now
        if now >= self._settle_until:
            self._settled = True
        return self._settled
