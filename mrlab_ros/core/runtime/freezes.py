"""Requests that waited while a process did not run: their callers have given up since.

A process that was stopped, swapped out or suspended finds them in its queues when it runs again.
Carrying them out then would move robots long after somebody was told that the call failed.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.runtime.diagnostics import MAY_BE_OLD, WAITED_IN_FREEZE

# A process that did not run for longer was frozen, and a request that waited longer then is
# refused, s. It is below the shortest time that a caller waits, 2 s for orders of a system.
FROZEN_AFTER_S = 1.5
# A process that computed for a larger share of a gap was busy, or had to share its processors.
BUSY_SHARE = 0.1
# How often a process says that it runs, s, at least.
LOOK_PERIOD_S = 0.5
# Requests without a send time are stale for THAW_S after a freeze of LONG_S: they are read
# at once when the process runs again. Callers over zenoh and the web wait longer than LONG_S.
LONG_S = 3.0
THAW_S = 1.0


class Freezes:
    """Notes when this process did not run. Times are monotonic, s.

    process: its name, in refusals. computed: returns the processor time that it has used, s.
    """

    def __init__(self, process: str, computed: Callable[[], float]) -> None:
        self.process = process
        self._computed = computed
        self._watchers = 0
        self._looked, self._used = math.inf, 0.0
        # The last freeze.
        self._from = self._until = -math.inf

    def begin(self) -> None:
        """Register a watcher that calls look() every LOOK_PERIOD_S at least, until it calls end().

        Without a watcher nothing is a freeze.
        """
        self._watchers += 1

    def end(self) -> None:
        """Do without a watcher."""
        self._watchers -= 1
        if not self._watchers:
            self._looked = math.inf

    def look(self, now: float) -> None:
        """Note that this process runs; without a watcher nothing is noted."""
        if not self._watchers:
            return
        before, self._looked = self._looked, now
        used, self._used = self._used, self._computed()
        gap = now - before
        if gap > FROZEN_AFTER_S and self._used - used < BUSY_SHARE * gap:
            # Two freezes with a moment between them are one: the queues were not read yet.
            if before - self._until > THAW_S:
                self._from = before
            self._until = now

    def thawed(self, now: float) -> bool:
        """Note that this process runs; return whether a freeze ended just now."""
        self.look(now)
        return self._until == now

    def why_late(self, sent: float, now: float) -> Diagnostic | None:
        """Return why a request that was sent at `sent` is refused; None: it came in time.

        What was sent long before the freeze did not wait for its end: the clock of its sender
        differs, and nothing can be said of it.
        """
        self.look(now)
        waited = self._until - max(sent, self._from)
        if self._from - FROZEN_AFTER_S <= sent and waited > FROZEN_AFTER_S:
            return WAITED_IN_FREEZE(
                process=self.process, frozen=self._frozen, waited=round(waited)
            )
        return None

    def why_doubtful(self, now: float) -> Diagnostic | None:
        """Return why something is refused that does not say when it was sent; None: it is not."""
        self.look(now)
        if now - self._until < THAW_S and self._until - self._from > LONG_S:
            return MAY_BE_OLD(process=self.process, frozen=self._frozen)
        return None

    @property
    def _frozen(self) -> int:
        """How long the last freeze was, s."""
        return round(self._until - self._from)
