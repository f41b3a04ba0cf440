"""The queue of a client: of each topic the newest message, the most urgent topics first.

The lossless channel to a client: ordered, acknowledged, bounded, resumed after a reconnect.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.gateway.link.diagnostics import TOO_MUCH_WAITS
from mrlab_ros.gateway.link.frames import fragment
from mrlab_ros.gateway.link.limits import Budget, LinkLimits, ahead

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


# Bytes of a record in one frame: behind it on a slow link other frames wait.
FRAGMENT = 8 * 1024
# Bytes under way that are not acknowledged.
WINDOW = 16 * 1024
# Bytes and records that wait for a client, together with those under way.
LARGEST = 8 * 1024 * 1024
MOST = 2048


class Overflow(LabError):
    """More waits for a client than it is given room for."""


class ReliableSender:
    """Records for one client, cut into numbered fragments; the first has number 1.

    A record larger than LARGEST passes where nothing else waits. budget: the person's, which
    counts what waits for all clients of that person.
    """

    def __init__(self, budget: Budget | None = None) -> None:
        self._budget = budget or Budget(LinkLimits())
        self._waiting: deque[bytes] = deque()
        self._offset = 0
        self._unacknowledged: deque[tuple[int, bytes]] = deque()
        # How many of these were sent on the present socket, and their bytes.
        self._sent = 0
        self._under_way = 0
        self._number = 0
        self._size = 0

    @property
    def size(self) -> int:
        """Bytes that wait or are not acknowledged."""
        return self._size

    @property
    def idle(self) -> bool:
        """Return whether everything was sent."""
        return not self._waiting and self._sent == len(self._unacknowledged)

    def push(self, record: bytes) -> None:
        """Append a record. Raises Overflow where too much waits; nothing is appended then."""
        records = len(self._waiting) + len(self._unacknowledged)
        full = records and (records >= MOST or self._size + len(record) > LARGEST)
        if full or not self._budget.has_room(len(record)):
            raise Overflow(TOO_MUCH_WAITS(count=records, size=self._size))
        self._waiting.append(record)
        self._grow(len(record))

    def close(self) -> None:
        """Drop everything."""
        self._waiting.clear()
        self._unacknowledged.clear()
        self._grow(-self._size)

    def next(self) -> bytes | None:
        """Return the next frame to send, None where there is none or the window is full."""
        if self._under_way >= WINDOW:
            return None
        if self._sent < len(self._unacknowledged):
            _, frame = self._unacknowledged[self._sent]
        elif self._waiting:
            frame = self._cut()
        else:
            return None
        self._sent += 1
        self._under_way += len(frame)
        return frame

    def acknowledge(self, number: int) -> None:
        """Drop the fragments up to `number`; one that was never sent changes nothing."""
        if ahead(number, self._number) > 0:
            return
        kept = self._unacknowledged
        while kept and ahead(number, kept[0][0]) >= 0:
            _, frame = kept.popleft()
            self._grow(-len(frame))
            if self._sent:
                self._sent -= 1
                self._under_way -= len(frame)

    def rewind(self, number: int) -> None:
        """Begin on a new socket: the client has everything up to `number`."""
        self.acknowledge(number)
        self._sent = 0
        self._under_way = 0

    def _grow(self, size: int) -> None:
        self._size += size
        self._budget.queued += size

    def _cut(self) -> bytes:
        record = self._waiting[0]
        piece = memoryview(record)[self._offset : self._offset + FRAGMENT]
        self._offset += len(piece)
        last = self._offset == len(record)
        if last:
            self._waiting.popleft()
            self._offset = 0
        self._number = (self._number + 1) % (1 << 32)
        frame = fragment(self._number, last, piece)
        self._grow(len(frame) - len(piece))
        self._unacknowledged.append((self._number, frame))
        return frame
