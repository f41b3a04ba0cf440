"""Keeps the lab's processes running, and stops all at once.

No process outlives the lab. On a wanted stop every process group gets SIGINT and, after a
grace, SIGKILL.
"""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Callable, Iterable
from types import TracebackType

from mrlab_ros.core.runtime.process_states import ProcessState
from mrlab_ros.processes.child_process import Child, Emit, ProcessSpec, RestartPolicy
from mrlab_ros.processes.zygote import Zygote

# From SIGINT to SIGKILL, s; a clean stop of a process takes well under 1 s.
STOP_TIMEOUT_S = 1.5


class Supervisor:
    """Keeps a set of processes; use it as a context manager, so that all of them end.

    `emit(name, line)` gets every line of output, from several threads; `changed(states)` the
    state of all processes whenever one changes. zygote: forks what it can; it ends with the first
    stop.
    """

    def __init__(
        self,
        specs: Iterable[ProcessSpec],
        emit: Emit,
        changed: Callable[[list[ProcessState]], None] = lambda states: None,
        policy: Callable[[], RestartPolicy] = RestartPolicy,
        zygote: Zygote | None = None,
    ) -> None:
        self._report = changed
        self._reporting = threading.Lock()
        self._zygote = zygote
        self.children = [Child(spec, policy(), emit, self._on_change, zygote) for spec in specs]

    @property
    def states(self) -> list[ProcessState]:
        return [child.state for child in self.children]

    def start(self) -> None:
        for child in self.children:
            child.start()

    def restart(self, name: str) -> None:
        """End one process and start it again."""
        for child in self.children:
            if child.spec.name == name:
                child.restart()

    def stop(self, grace: float = STOP_TIMEOUT_S) -> None:
        """Stop everything: SIGINT at once to all, SIGKILL to what is left after `grace` s."""
        deadline = time.monotonic() + grace
        if self._zygote is not None:
            self._zygote.kill()
        for child in self.children:
            child.stop(signal.SIGINT)
        for child in self.children:
            if not child.join(deadline - time.monotonic()):
                child.stop(signal.SIGKILL)
        for child in self.children:
            child.join(grace)

    def __enter__(self) -> Supervisor:
        self.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop()

    def _on_change(self) -> None:
        with self._reporting:
            self._report(self.states)
