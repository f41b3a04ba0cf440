"""When this process did not run, and which requests of services waited meanwhile."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.runtime.freezes import Freezes

# Every thread that spins a node says that the process runs.
PROCESS = Freezes("lab", time.process_time)
LOCK = threading.Lock()


def look() -> None:
    """Note that this process runs."""
    with LOCK:
        PROCESS.look(time.monotonic())


@contextmanager
def watching() -> Iterator[None]:
    """Say that this thread calls look() again and again."""
    with LOCK:
        PROCESS.begin()
    try:
        yield
    finally:
        with LOCK:
            PROCESS.end()


def why_late(header: Any) -> Diagnostic | None:
    """Return why a request is refused that came with `header`; None: it came in time.

    Its age is by the wall clock, as its sender stamps it.
    """
    age_s = (time.time_ns() - header.source_timestamp) / SECOND
    with LOCK:
        now = time.monotonic()
        return PROCESS.why_late(now - age_s, now)


def why_doubtful() -> Diagnostic | None:
    """Return why something without a stamp of its sender is refused; None: it is not."""
    with LOCK:
        return PROCESS.why_doubtful(time.monotonic())
