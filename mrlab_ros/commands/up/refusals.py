"""Processes that refuse their configuration."""

from __future__ import annotations

import threading
from collections.abc import Iterable

from mrlab_ros.commands.diagnostics import PROCESSES_REFUSE
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.runtime.process_states import Phase, ProcessState


class Refusals:
    """The processes that refuse their configuration at their first start; they set `stop`.

    One that refuses after a restart does not end a lab that runs.
    """

    def __init__(self, stop: threading.Event) -> None:
        self._stop = stop
        self._names: set[str] = set()

    def check(self, states: Iterable[ProcessState]) -> None:
        first = (s for s in states if s.phase == Phase.REFUSED.value and not s.restarts)
        self._names |= {s.name for s in first}
        if self._names:
            self._stop.set()

    def raise_any(self) -> None:
        """Raise BadInput where a process refused."""
        if self._names:
            raise BadInput(PROCESSES_REFUSE(processes=sorted(self._names)))
