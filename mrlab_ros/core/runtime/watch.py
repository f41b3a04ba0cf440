"""Which processes of the lab live: each gives a sign of life, and all watch each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.runtime import diagnostics as say

# Time between two signs of life, and after how long a silent process counts as dead, s.
PERIOD_S = 1.0
SILENT_AFTER_S = 3.0
# A process that has been silent for so long is not reported any more, s.
FORGOTTEN_AFTER_S = 60.0
# For so long a process says that it was restarted, or that it did not run, s.
RESTART_SHOWN_S = 60.0
FREEZE_SHOWN_S = 60.0


@dataclass(frozen=True)
class Freeze:
    """How long a process did not run, to within half of PERIOD_S, and how long ago that was, s."""

    duration: float
    ago: float


@dataclass(frozen=True)
class Sign:
    """The report of a process about itself.

    restarts: how often it was started again. last_exit: the signal that ended it before, such as
    SIGKILL, or its exit code.
    lost: what could not be brought back; None: that is not known yet. failed: what went wrong
    since, newest first. noticed: what came from outside and had no effect. freeze: the last one,
    of a minute.
    """

    process: str
    restarts: int = 0
    last_exit: str = ""
    lost: tuple[Diagnostic, ...] | None = ()
    failed: tuple[Diagnostic, ...] = ()
    noticed: tuple[Diagnostic, ...] = ()
    freeze: Freeze | None = None

    def restarted(self, age: float) -> bool:
        """Return whether a process that runs for `age` s was started again lately."""
        return self.restarts > 0 and age < RESTART_SHOWN_S

    def trouble(self, age: float) -> Diagnostic | None:
        """Return what to say of a process that runs for `age` s; None: nothing is amiss."""
        said = [*self.failed, *self.noticed]
        if self.freeze is not None:
            frozen, ago = round(self.freeze.duration), round(self.freeze.ago)
            said.append(say.DID_NOT_RUN(frozen=frozen, ago=ago))
        lost = joined(self.lost or ())
        if self.restarted(age):
            died = say.DIED_AND_LOOKS if self.lost is None else say.DIED
            if lost is not None:
                died = say.DIED_AND_LOST
            exit_code = int(self.last_exit) if self.last_exit.isdecimal() else None
            how = self.last_exit if exit_code is None else say.EXITED(exit_code=exit_code)
            lost = died(last_exit=how, ago=round(age), lost=lost)
        return joined([*said, lost] if lost else said)


def silence(seconds: float) -> Diagnostic:
    """Return what to say of a process that has been silent for so long."""
    return say.PROCESS_SILENT(silent=round(seconds))


def joined(said: Sequence[Diagnostic]) -> Diagnostic | None:
    """Return several diagnostics as one, which is an error where one of them is; None: none."""
    if len(said) < 2:
        return said[0] if said else None
    worst = max(each.severity for each in said)
    return say.AND_ALSO(first=said[0], then=joined(said[1:]), severity=worst)


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
