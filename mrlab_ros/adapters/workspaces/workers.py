"""Makes the processes that read files; one can start before its reader's modules are imported.

Imports no numpy: a command begins a worker first, and both import at the same time.
"""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.sandbox.warm_process import WarmProcess

START_LIMIT = 30.0  # s for a worker to import what it needs, on a busy machine
_begun: list[WarmProcess] = []


def begin() -> None:
    """Start the worker that the next reader takes, and do not wait for it."""
    worker = _made()
    worker.begin()
    _begun.append(worker)


def take() -> WarmProcess:
    """Return a worker that was begun, else one that has not started."""
    return _begun.pop() if _begun else _made()


def _made() -> WarmProcess:
    return WarmProcess(
        "mrlab_ros.adapters.workspaces.worker", start_limit=START_LIMIT, folder=Path("/")
    )
