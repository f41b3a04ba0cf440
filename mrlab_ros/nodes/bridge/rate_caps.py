"""Limits the rates of topics: a message that comes too early waits until it is due."""

from __future__ import annotations

import threading
import time

from mrlab_ros.core.bridge.rules import SECOND, RateCap
from mrlab_ros.ros.arrivals import OnMessage
from mrlab_ros.ros.worker import Worker

# A message's CDR and when it was published, ns since 1970.
Message = tuple[bytes, int]


class RateCaps:
    """Lets messages of each limited topic through at most at its rate, the newest each time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: dict[RateCap[Message], OnMessage] = {}
        self._worker = Worker("bridge_caps", self._emit_due, self._until_due)

    def stop(self) -> None:
        """Drop what waits, and end."""
        with self._lock:
            self._waiting.clear()
        self._worker.close()

    def limit(self, max_rate: float, emit: OnMessage) -> OnMessage:
        """Return a callback that calls `emit` at most at `max_rate`, Hz.

        `emit` must neither wait nor raise.
        """
        cap: RateCap[Message] = RateCap(max_rate)

        def limited(payload: bytes, published_ns: int) -> None:
            # Emitted under the lock, so that a newer message never overtakes an older one.
            with self._lock:
                passed = cap.offer((payload, published_ns), time.monotonic_ns())
                if passed is not None:
                    emit(*passed)
                    return
                if cap in self._waiting:
                    return
                self._waiting[cap] = emit
            # Wakes the worker, which then waits until the message is due.
            self._worker.send(self._emit_due)

        return limited

    def _until_due(self) -> float | None:
        """Return the time until the next message is due, s; None where none waits."""
        with self._lock:
            due = [cap.due_ns for cap in self._waiting if cap.due_ns is not None]
        return max(min(due) - time.monotonic_ns(), 0) / SECOND if due else None

    def _emit_due(self) -> None:
        with self._lock:
            now = time.monotonic_ns()
            for cap, emit in list(self._waiting.items()):
                message = cap.take(now)
                if message is not None:
                    emit(*message)
                if cap.due_ns is None:
                    del self._waiting[cap]
