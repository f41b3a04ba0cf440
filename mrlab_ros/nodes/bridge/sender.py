"""Sends to clients in a separate thread, so that a slow client delays no other work."""

from __future__ import annotations

from collections.abc import Callable

from mrlab_ros.ros.worker import Worker

# Bytes in the queue; beyond it the oldest messages are dropped, so that the newest state arrives.
ROOM = 64 * 1024 * 1024
# Time that a stopped sender has to send its queue, s.
STOP_TIMEOUT_S = 2.0


class Sender(Worker):
    """A worker with a queue of at most `room` bytes.

    warn_once: logs a text, each text once.
    """

    def __init__(self, name: str, warn_once: Callable[[str], None], room: int = ROOM) -> None:
        def on_drop() -> None:
            warn_once(
                f"a client reads its messages too slowly: more than {room / 1e6:g} MB were "
                "queued, and the oldest messages were dropped; check the client's network"
            )

        def on_error(error: Exception) -> None:  # the client, or the topic, may have gone
            warn_once(f"a message was lost: {type(error).__name__}: {error}")

        super().__init__(name, capacity=room, on_drop=on_drop, on_error=on_error)

    def stop(self) -> None:
        """Send the queue, for STOP_TIMEOUT_S at most, and end."""
        self.close(STOP_TIMEOUT_S)
