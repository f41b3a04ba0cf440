"""Which processes of the lab live: each gives a sign of life, and all watch each other."""

from __future__ import annotations

import math
from dataclasses import dataclass

# Time between two signs of life, and after how long a silent process counts as dead, s.
PERIOD_S = 1.0
SILENT_AFTER_S = 3.0
# A process that has been silent for so long is not reported any more, s.
FORGOTTEN_AFTER_S = 60.0
# For so long a process says that it was restarted, or that it did not run, s.
RESTART_SHOWN_S = 60.0
FREEZE_SHOWN_S = 60.0
# Is in what a process says of its restart.


@dataclass(frozen=True)
class Freeze:
    """How long a process did not run, to within half of PERIOD_S, and how long ago that was, s."""

    duration: float
    ago: float


@dataclass(frozen=True)
class Sign:
    """What a process says of itself.

    restarts: how often it was started again. last_exit: how it ended before, such as SIGKILL.
    lost: what could not be brought back, a sentence each; None: that is not known yet. failed:
    what went wrong since, newest first. freeze: the last one, of a minute.
    """

    process: str
    restarts: int = 0
    last_exit: str = ""
    lost: tuple[str, ...] | None = ()
    failed: tuple[str, ...] = ()
    freeze: Freeze | None = None

    def restarted(self, age: float) -> bool:
        """Return whether a process that runs for `age` s was started again lately."""
        return self.restarts > 0 and age < RESTART_SHOWN_S

    def sentence(self, age: float) -> str:
        """Return what to show of a process that runs for `age` s; empty: nothing is amiss."""
        lost = "; ".join(self.lost or ())
        if self.restarted(age):
            ended = f" ({self.last_exit})" if self.last_exit else ""
            said = f"lost: {lost}" if lost else "nothing was lost"
            if self.lost is None:
                said = "what was lost is being determined"
            lost = f"it died{ended} and was restarted {age:.0f} s ago; {said}"
        frozen = ""
        if self.freeze is not None:
            duration, ago = self.freeze.duration, self.freeze.ago
            frozen = f"it did not run for about {duration:.0f} s, until {ago:.0f} s ago"
        return "; ".join(text for text in (*self.failed, frozen, lost) if text)


class Watch:
    """Notes when each process gave its last sign of life. Times are monotonic, s."""

    def __init__(self, process: str) -> None:
        """process: the one that watches; it lives."""
        self._process = process
        self._heard: dict[str, float] = {}
        self._looked: float | None = None
        # How long this process did not run, and until when, s.
        self._frozen = (0.0, -math.inf)

    def hear(self, process: str, now: float) -> None:
        """Note a sign of life of `process`."""
        self._heard[process] = now

    def look(self, now: float) -> None:
        """Note that this process runs; call it every PERIOD_S.

        Others are not silent for the time in which it did not: it has missed what they said.
        """
        gap = 0.0 if self._looked is None else now - self._looked
        self._looked = now
        if gap <= 2 * PERIOD_S:
            return
        missed = gap - PERIOD_S / 2
        self._heard = {name: min(heard + missed, now) for name, heard in self._heard.items()}
        if gap >= SILENT_AFTER_S:
            self._frozen = (missed, now)

    def freeze(self, now: float) -> Freeze | None:
        """Return when this process did not run; None: not lately."""
        duration, until = self._frozen
        return Freeze(duration, now - until) if now - until < FREEZE_SHOWN_S else None

    def silent(self, now: float) -> dict[str, float]:
        """Return for how long each silent process has been so, s, where this one reports them.

        That is the first of the living by name, so that one process reports what all notice.
        """
        ages = {name: now - heard for name, heard in self._heard.items() if name != self._process}
        living = [name for name, age in ages.items() if age < SILENT_AFTER_S]
        if any(name < self._process for name in living):
            return {}
        return {
            name: age for name, age in ages.items() if SILENT_AFTER_S <= age < FORGOTTEN_AFTER_S
        }
