"""What waits for a client: of each topic the newest message, the most urgent topics first."""

from __future__ import annotations

from collections.abc import Hashable

# zenoh's priorities are 1 (first) to 7.
PRIORITIES = 7


class Newest:
    """Encoded messages, one a topic or a part of one: a newer one replaces the one that waits.

    Of equal priority the topic that has waited longest goes first, so that none starves.
    """

    def __init__(self) -> None:
        self._waiting: tuple[dict[Hashable, bytes], ...] = tuple({} for _ in range(PRIORITIES))
        self.replaced = 0

    def __bool__(self) -> bool:
        return any(self._waiting)

    def __len__(self) -> int:
        return sum(map(len, self._waiting))

    def offer(self, topic: Hashable, priority: int, entry: bytes) -> None:
        """Let `entry` wait. priority: 1 (first) to 7."""
        waiting = self._waiting[priority - 1]
        if topic in waiting:
            self.replaced += 1
        waiting[topic] = entry

    def forget(self, topic: Hashable) -> None:
        """Drop what waits of a topic."""
        for waiting in self._waiting:
            waiting.pop(topic, None)

    def take(self, limit: int) -> list[bytes]:
        """Take entries of together at most `limit` bytes, but at least one where any waits."""
        taken: list[bytes] = []
        size = 0
        for waiting in self._waiting:
            if size + sum(map(len, waiting.values())) <= limit:
                taken += waiting.values()
                size += sum(map(len, waiting.values()))
                waiting.clear()
                continue
            for topic in list(waiting):
                if taken and size + len(waiting[topic]) > limit:
                    return taken
                size += len(waiting[topic])
                taken.append(waiting.pop(topic))
        return taken
