"""Latency of messages: the stamps attached to them, and percentiles of their delays per window.

Pure: every time is an argument, ns since 1970.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass

SECOND = 1_000_000_000
# Delays stored per topic and window; beyond it every second one is stored, then every fourth.
SAMPLES = 1024
# Topics in a report: those with the largest p95.
TOPICS = 64
_STAMPS = struct.Struct("<qqq")
_CLOCK = struct.Struct("<qq")


@dataclass(frozen=True)
class Stamps:
    """The bridge's attachment of a message.

    sequence: counts the messages of a key from 1. published_ns: when it was published in the
    graph. bridged_ns: when the bridge published it over zenoh.
    """

    sequence: int
    published_ns: int
    bridged_ns: int

    def __bytes__(self) -> bytes:
        """Return the 24 bytes of the attachment."""
        return attachment(self.sequence, self.published_ns, self.bridged_ns)


def attachment(sequence: int, published_ns: int, bridged_ns: int) -> bytes:
    """Return the three values as int64, little-endian, in this order."""
    return _STAMPS.pack(sequence, published_ns, bridged_ns)


def stamps(data: bytes) -> Stamps | None:
    """Read an attachment; None where it is shorter. Further fields may follow."""
    return Stamps(*_STAMPS.unpack_from(data)) if len(data) >= _STAMPS.size else None


def clock_answer(asked_ns: int, answered_ns: int) -> bytes:
    """Return the reply to a query for the time: when it was received, when it is answered."""
    return _CLOCK.pack(asked_ns, answered_ns)


@dataclass(frozen=True)
class Delays:
    """Percentiles of the delays, s, of one topic in one window; topic "": of all topics."""

    topic: str
    count: int
    p50: float
    p95: float
    max: float


class _Batch:
    """Delays since the last report, ns, thinned evenly: each stored one stands for `stride`."""

    __slots__ = ("count", "kept", "max_ns", "skip", "stride")

    def __init__(self) -> None:
        self.kept: list[int] = []
        self.count = 0
        self.max_ns = 0
        self.stride = 1
        self.skip = 1

    def add(self, delay_ns: int) -> None:
        self.count += 1
        if delay_ns > self.max_ns:
            self.max_ns = delay_ns
        self.skip -= 1
        if self.skip:
            return
        self.skip = self.stride
        self.kept.append(delay_ns)
        if len(self.kept) == SAMPLES:
            del self.kept[::2]
            self.stride *= 2
            self.skip = self.stride


class Window:
    """Collects the delays of one topic between two reports. `add` takes well under 1 us."""

    def __init__(self) -> None:
        self._batch = _Batch()

    def add(self, delay_ns: int) -> None:
        """Record a delay, ns; it is negative where the publisher's clock is ahead of ours."""
        self._batch.add(delay_ns)

    def take(self) -> _Batch:
        """Return the collected delays and start a new window; another thread may add meanwhile."""
        batch, self._batch = self._batch, _Batch()
        return batch


class Ledger:
    """The windows of all topics."""

    def __init__(self) -> None:
        self._windows: dict[str, Window] = {}

    def window(self, topic: str) -> Window:
        """Return the window of a topic, a new one where there is none."""
        return self._windows.setdefault(topic, Window())

    def forget(self, topic: str) -> None:
        self._windows.pop(topic, None)

    def report(self, give_way: Callable[[], None] = lambda: None) -> list[Delays]:
        """Return the delays since the last report: of all topics together, then of the slowest.

        give_way: called between two topics.
        Only topics with messages are in it, at most TOPICS of them; empty without any message.
        Percentiles are by nearest rank; those of all topics weigh each stored delay by the number
        it stands for.
        """
        batches = [(topic, window.take()) for topic, window in list(self._windows.items())]
        moved = [(topic, batch) for topic, batch in batches if batch.kept]
        if not moved:
            return []
        each = []
        for topic, batch in moved:
            each.append(_delays(topic, [batch]))
            give_way()
        each.sort(key=lambda delays: -delays.p95)
        return [_delays("", [batch for _, batch in moved]), *each[:TOPICS]]


def _delays(topic: str, batches: Sequence[_Batch]) -> Delays:
    # By hand: numpy takes ten times as long for so few numbers, and no message moves meanwhile.
    # Copied first: another thread may still be adding.
    weighed = sorted((value, batch.stride) for batch in batches for value in tuple(batch.kept))
    total = sum(weight for _, weight in weighed)
    return Delays(
        topic,
        sum(batch.count for batch in batches),
        _at(0.5 * total, weighed) / SECOND,
        _at(0.95 * total, weighed) / SECOND,
        max(batch.max_ns for batch in batches) / SECOND,
    )


def _at(rank: float, weighed: Sequence[tuple[int, int]]) -> int:
    """Return the value up to which the weights reach `rank`."""
    reached = 0
    for value, weight in weighed:
        reached += weight
        if reached >= rank:
            return value
    return weighed[-1][0]
