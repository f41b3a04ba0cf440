"""The processes of a lab as their supervisor sees them, and those that ended or froze.

An end is an event: the supervisor publishes it at once, with the instant by the monotonic clock,
which all processes of a machine share. Whoever depends on a process acts on it and does not wait
until its absence is noticed.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum

# The name of the process that serves the pages; it holds no node.
GATEWAY = "web"


class Phase(Enum):
    """The phase of a supervised process, in the order of the constants of LabProcess.msg."""

    STARTING = "starting"
    RUNNING = "running"
    WAITING = "waiting to restart"
    REFUSED = "wrong configuration"
    STOPPED = "stopped"
    FROZEN = "stopped by a signal"


@dataclass(frozen=True)
class ProcessState:
    """One supervised process.

    phase: the value of a Phase. since: when it began, s of wall time. last_exit, exit_code: how
    the process ended last, in words and as a number, negative: of the signal. nodes: those that
    it holds. down, down_steady_ns: when it ended or froze last, s of wall time and ns of the
    monotonic clock; 0: never. restart_in: from its end to its next start, s.
    """

    name: str
    phase: str
    pid: int | None
    restarts: int
    since: float
    last_exit: str
    exit_code: int = 0
    nodes: tuple[str, ...] = ()
    down: float = 0.0
    down_steady_ns: int = 0
    restart_in: float = 0.0

    @property
    def frozen(self) -> bool:
        """Return whether it lives but does not run: what was sent to it waits for it."""
        return self.phase == Phase.FROZEN.value

    def holds(self, node: str) -> bool:
        """Return whether a node is one of its own; node: its full name, or one below that."""
        return any(f"{node}/".startswith(f"/{held}/") for held in self.nodes)


class Deaths:
    """Finds in reports on all processes those that ended or froze since the last report.

    since_ns: by the monotonic clock; what was before concerns nobody.
    """

    def __init__(self, since_ns: int) -> None:
        self._since_ns = since_ns
        self._known: dict[str, int] = {}

    def new(self, states: Iterable[ProcessState]) -> list[ProcessState]:
        """Return the processes that went down after what was reported of them before."""
        found = []
        for state in states:
            if state.down_steady_ns > self._known.get(state.name, self._since_ns):
                self._known[state.name] = state.down_steady_ns
                found.append(state)
        return found


class Thaws:
    """Finds in reports on all processes those that run again after a freeze."""

    def __init__(self) -> None:
        self._frozen: set[str] = set()

    def new(self, states: Sequence[ProcessState]) -> list[ProcessState]:
        """Return the processes that were frozen in the last report and run in this one."""
        found = [s for s in states if s.name in self._frozen and s.phase == Phase.RUNNING.value]
        self._frozen = {state.name for state in states if state.frozen}
        return found
