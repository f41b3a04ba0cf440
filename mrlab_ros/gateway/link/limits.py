"""Limits of one page, of all pages of one person, and of the number of pages.

How many batches a client may be sent: it says up to which number, after decoding.
"""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from pathlib import Path

from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.checks import Integer, Number, between
from mrlab_ros.core.base.records import field, read
from mrlab_ros.core.runtime.bucket import Bucket

# Numbers have 32 bits and begin anew.
_RANGE = 1 << 32


def ahead(number: int, of: int) -> int:
    """Return how far `number` is ahead of another, negative where it is behind."""
    return (number - of + _RANGE // 2) % _RANGE - _RANGE // 2


class Credit:
    """Counts the batches of one socket from 1. largest: batches under way at once, at most."""

    def __init__(self, largest: int) -> None:
        self._largest = largest
        self.sent = 0
        self._granted = 0

    @property
    def left(self) -> int:
        """How many batches may be sent now."""
        return max(0, min(ahead(self._granted, self.sent), self._largest))

    def grant(self, number: int) -> None:
        """Let batches up to `number` be sent; an older grant changes nothing."""
        if ahead(number, self._granted) > 0:
            self._granted = number

    def take(self) -> int:
        """Return the number of the next batch. There must be credit."""
        assert self.left
        self.sent = (self.sent + 1) % _RANGE
        return self.sent


KIB = 1024
# Calls that stop something: of one person, calls/s and calls.
URGENT_RATE, URGENT_BURST = 10.0, 30.0
# s that a page waits at most after a frame: it must not count as silent meanwhile.
LONGEST_WAIT_S = 2.0
LARGEST_BURST = 1024 * 1024 * KIB


@dataclass(frozen=True)
class LinkLimits:
    """Limits of the WebSocket /link, as the file of `--limits` names them."""

    pages: int = field(
        Integer(between(1, 100_000), "pages"),
        "Pages that may be connected; an instructor's come in beyond that.",
        500,
    )
    pages_each: int = field(
        Integer(between(1, 100_000), "pages"), "Pages that one person may have open.", 32
    )
    frame_rate: float = field(
        Number(between(1, 1e6), "frames/s"), "Frames a second that a page may send.", 2000.0
    )
    frame_burst: float = field(
        Number(between(1, 1e6), "frames"), "Frames that a page may send at once.", 4000.0
    )
    byte_rate: float = field(
        Number(between(1, 1e9), "B/s"),
        "Bytes a second that a page may send, as over zenoh (the bridge's guest_rate).",
        64.0 * KIB,
    )
    byte_burst: float = field(
        Number(between(1, LARGEST_BURST), "bytes"),
        "Bytes that a page may send at once.",
        2048.0 * KIB,
    )
    largest_frame: int = field(
        Integer(between(1, 4096 * KIB), "bytes"),
        "Largest frame of a page; files go by HTTP.",
        1024 * KIB,
    )
    call_rate: float = field(
        Number(between(0.1, 1e5), "calls/s"), "Calls a second that a page may make.", 50.0
    )
    call_burst: float = field(
        Number(between(1, 1e5), "calls"), "Calls that a page may make at once.", 100.0
    )
    calls_waiting: int = field(
        Integer(between(1, 10_000), "calls"), "Calls of a page that may wait for responses.", 32
    )

    person_pages: float = field(
        Number(between(1, 1000), "pages"),
        "What all pages and devices of one person may send together, in what one page may; they "
        "are slowed down beyond that.",
        4.0,
    )
    person_queue: int = field(
        Integer(between(KIB, LARGEST_BURST), "bytes"),
        "Bytes that may wait for all pages and devices of one person together.",
        16384 * KIB,
    )

    @property
    def frames(self) -> Bucket:
        return Bucket(self.frame_rate, self.frame_burst)

    @property
    def bytes(self) -> Bucket:
        return Bucket(self.byte_rate, self.byte_burst)

    @property
    def calls(self) -> Bucket:
        return Bucket(self.call_rate, self.call_burst)


class Budget:
    """What all pages and devices of one person use together. Times are s, monotonic."""

    def __init__(self, limits: LinkLimits) -> None:
        pages = limits.person_pages
        self._frames = Bucket(pages * limits.frame_rate, pages * limits.frame_burst)
        self._bytes = Bucket(pages * limits.byte_rate, pages * limits.byte_burst)
        self._calls = Bucket(pages * limits.call_rate, pages * limits.call_burst)
        self._urgent = Bucket(URGENT_RATE, URGENT_BURST)
        self._room = limits.person_queue
        # Bytes that wait.
        self.queued = 0
        # Held while a page of this person begins: its subscriptions take work of all.
        self.begins = asyncio.Lock()

    def wait(self, size: int, now: float) -> float:
        """Count a frame of `size` bytes; return how long the page has to wait for the next, s."""
        longest = max(self._frames.owe(1, now), self._bytes.owe(size, now))
        return min(longest, LONGEST_WAIT_S)

    def may_call(self, now: float) -> bool:
        """Count a call; return whether it is not one too many."""
        return self._calls.take(1, now)

    def may_stop(self, now: float) -> bool:
        """Count a call that stops something; return whether it is not one too many."""
        return self._urgent.take(1, now)

    def has_room(self, size: int) -> bool:
        """Return whether `size` bytes more may wait; a single message may be larger."""
        return not self.queued or self.queued + size <= self._room


def read_limits(path: Path | None) -> LinkLimits:
    """Read the file of `--limits`, the defaults without one; BadInput names all mistakes."""
    return LinkLimits() if path is None else read(LinkLimits, read_yaml(path), str(path))
