"""Sends to clients in a thread of its own, so that a slow client holds up nobody else."""

from __future__ import annotations

from collections.abc import Callable

from mrlab_ros.ros.worker import Worker

# The most bytes that wait; beyond it the oldest are dropped, so that the newest state arrives.
ROOM = 64 * 1024 * 1024
# How long a stopped sender may take to send what waits, s.
STOP_TIMEOUT_S = 2.0


class Sender(Worker):
    """A worker whose waiting work holds at most `room` bytes.

    warn_once: logs a text, each text once.
    """

    def __init__(self, name: str, warn_once: Callable[[str], None], room: int = ROOM) -> None:
        def on_drop() -> None:
            warn_once(
                f"a client takes its messages too slowly: more than {room / 1e6:g} MB waited, "
                "and the oldest were lost; check the client's network"
            )

        def on_error(error: Exception) -> None:  # the client, or the topic, may have gone
            warn_once(f"a message was lost: {type(error).__name__}: {error}")

        super().__init__(name, capacity=room, on_drop=on_drop, on_error=on_error)

    def stop(self) -> None:
        """Send what waits, for STOP_TIMEOUT_S at most, and end."""
        self.close(STOP_TIMEOUT_S)
