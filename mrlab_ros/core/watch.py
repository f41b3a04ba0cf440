"""Which processes of the lab live: each gives a sign of life, and all watch each other."""

from __future__ import annotations

from dataclasses import dataclass

# Time between two signs of life, and after how long a silent process counts as dead, s.
PERIOD_S = 1.0
SILENT_AFTER_S = 3.0
# A process that has been silent for so long is not reported any more, s.
FORGOTTEN_AFTER_S = 60.0
# For so long after a restart a process says that it was restarted, s.
RESTART_SHOWN_S = 60.0


@dataclass(frozen=True)
class Sign:
    """What a process says of itself.

    restarts: how often it was started again. last_exit: how it ended before, such as SIGKILL.
    lost: what could not be brought back, a sentence each; None: that is not known yet. failed:
    what went wrong since, newest first.
    """

    process: str
    restarts: int = 0
    last_exit: str = ""
    lost: tuple[str, ...] | None = ()
    failed: tuple[str, ...] = ()

    def sentence(self, age: float) -> str:
        """Return what to show of a process that runs for `age` s; empty: nothing is amiss."""
        lost = "; ".join(self.lost or ())
        if self.restarts and age < RESTART_SHOWN_S:
            ended = f" ({self.last_exit})" if self.last_exit else ""
            said = f"lost: {lost}" if lost else "nothing was lost"
            if self.lost is None:
                said = "what was lost is being determined"
            lost = f"it died{ended} and was restarted {age:.0f} s ago; {said}"
        return "; ".join(text for text in (*self.failed, lost) if text)


class Watch:
    """Notes when each process gave its last sign of life. Times are monotonic, s."""

    def __init__(self, process: str) -> None:
        """process: the one that watches; it lives."""
        self._process = process
        self._heard: dict[str, float] = {}

    def hear(self, process: str, now: float) -> None:
        """Note a sign of life of `process`."""
        self._heard[process] = now

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
