"""Limits of rates: a bucket of tokens for what a client sends, and of repeated lines of a log.

What goes wrong again and again is counted by its cause, and said once a minute.

Time is an argument, s, monotonic.
"""

from __future__ import annotations

import re
from collections import OrderedDict
from dataclasses import dataclass, field


@dataclass
class Bucket:
    """Holds `burst` tokens at most and gets `rate` a second."""

    rate: float
    burst: float

    def __post_init__(self) -> None:
        self._tokens = self.burst
        self._at = 0.0

    def take(self, count: float, now: float) -> bool:
        """Take tokens where there are enough; return whether there were."""
        self._tokens = min(self.burst, self._tokens + (now - self._at) * self.rate)
        self._at = now
        if count > self._tokens:
            return False
        self._tokens -= count
        return True

    def owe(self, count: float, now: float) -> float:
        """Take tokens in any case; return the s until those that were missing have come."""
        self._tokens = min(self.burst, self._tokens + (now - self._at) * self.rate) - count
        self._at = now
        return max(0.0, -self._tokens / self.rate)


# Lines of one kind at once, and then one in so many seconds.
BURST = 10
PERIOD_S = 5.0
# Kinds that are remembered, the newest ones.
KINDS = 256
# Parts that differ between lines of one kind: numbers, addresses, identifiers.
DIFFERS = re.compile(r"[0-9a-f]{6,}|[0-9]+")


@dataclass
class _Kind:
    bucket: Bucket = field(default_factory=lambda: Bucket(1 / PERIOD_S, BURST))
    left_out: int = 0


class RepeatedLines:
    """Passes the first lines of each kind, then a few; each says how many were left out."""

    def __init__(self) -> None:
        self._kinds: OrderedDict[str, _Kind] = OrderedDict()

    def passed(self, line: str, now: float) -> str | None:
        """Return the line as it is to be shown, or None where it is to be left out."""
        name = DIFFERS.sub("#", line)
        kind = self._kinds.setdefault(name, _Kind())
        self._kinds.move_to_end(name)
        if len(self._kinds) > KINDS:
            self._kinds.popitem(last=False)
        if not kind.bucket.take(1, now):
            kind.left_out += 1
            return None
        left_out, kind.left_out = kind.left_out, 0
        return f"{line} ({left_out} lines like this one were left out)" if left_out else line


# A cause that goes on is said once in this time, s.
SAID_EVERY_S = 60.0
# Names a cause: the source, and what went wrong there.
Cause = tuple[str, ...]


@dataclass
class _Count:
    total: int = 0
    said: int = 0
    said_at: float = 0.0
    last: float = 0.0


class Occurrences:
    """Counts what goes wrong by its cause, of the newest KINDS causes; one thread at a time."""

    def __init__(self) -> None:
        self._counts: OrderedDict[Cause, _Count] = OrderedDict()

    def again(self, cause: Cause, now: float) -> int | None:
        """Count one; return how many came since this cause was said, None: it is not due.

        A cause is due when it comes first, and then once in SAID_EVERY_S.
        """
        count = self._counts.setdefault(cause, _Count())
        self._counts.move_to_end(cause)
        if len(self._counts) > KINDS:
            self._counts.popitem(last=False)
        count.total += 1
        count.last = now
        if count.said and now - count.said_at < SAID_EVERY_S:
            return None
        since, count.said, count.said_at = count.total - count.said, count.total, now
        return since

    def lately(self, now: float) -> dict[Cause, int]:
        """Return how often each cause came that came within the last SAID_EVERY_S."""
        return {
            cause: count.total
            for cause, count in self._counts.items()
            if now - count.last < SAID_EVERY_S
        }
