"""Rate caps at work: what came too early waits in a thread of its own until it is due."""

from __future__ import annotations

import threading
import time

from mrlab_ros.core.bridge.rules import SECOND, RateCap
from mrlab_ros.ros.raw_callback import OnMessage

# A message's CDR and when it was published, ns since 1970.
Message = tuple[bytes, int]


class Caps:
    """Lets messages through at most as often as each one's cap allows, the newest each time."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._keeping: dict[RateCap[Message], OnMessage] = {}
        self._stopped = False
        self._thread = threading.Thread(target=self._run, name="bridge_caps", daemon=True)
        self._thread.start()

    def stop(self) -> None:
        """Forget what waits, and end."""
        with self._changed:
            self._stopped = True
            self._changed.notify()
        self._thread.join()

    def limit(self, max_rate: float, emit: OnMessage) -> OnMessage:
        """Return what emits at most at `max_rate`, Hz. `emit` must neither wait nor raise."""
        cap: RateCap[Message] = RateCap(max_rate)

        def limited(payload: bytes, published_ns: int) -> None:
            # Emitted under the lock, so that a newer message never overtakes.
            with self._changed:
                passed = cap.offer((payload, published_ns), time.monotonic_ns())
                if passed is not None:
                    emit(*passed)
                elif cap not in self._keeping:
                    self._keeping[cap] = emit
                    self._changed.notify()

        return limited

    def _run(self) -> None:
        with self._changed:
            while not self._stopped:
                patience = self._send_due()
                self._changed.wait(None if patience is None else patience / SECOND)

    def _send_due(self) -> int | None:
        """Send what is due; return ns until the next is, or None. The lock must be held."""
        now, soonest = time.monotonic_ns(), None
        for cap, emit in list(self._keeping.items()):
            message = cap.take(now)
            if message is not None:
                emit(*message)
            due = cap.due_ns
            if due is None:
                del self._keeping[cap]
            elif soonest is None or due < soonest:
                soonest = due
        return None if soonest is None else soonest - now
