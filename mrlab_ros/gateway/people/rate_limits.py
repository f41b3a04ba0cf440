"""How often somebody may try: buckets of tokens, one a subject. Pure; time is an argument."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass

from mrlab_ros.gateway.diagnostics import TOO_MANY_REQUESTS
from mrlab_ros.gateway.errors import TooMany


@dataclass(frozen=True)
class Limit:
    """`burst` attempts at once, then one every `period` s. what: a word of the code."""

    what: str
    burst: int
    period: float


class RateLimit:
    """Counts attempts by subject, such as an address or a name.

    It remembers at most `subjects` of them, the latest ones, so that it cannot be filled.
    """

    def __init__(self, limit: Limit, subjects: int = 10_000) -> None:
        self._limit = limit
        self._subjects = subjects
        # When the bucket of a subject is full again, s.
        self._full_at: OrderedDict[str, float] = OrderedDict()

    def check(self, subject: str, now: float) -> None:
        """Count an attempt at `now` (s, monotonic); raises TooMany where it is one too many."""
        limit = self._limit
        full_at = max(self._full_at.pop(subject, now), now)
        wait = full_at + limit.period - limit.period * limit.burst - now
        if wait > 0:
            self._full_at[subject] = full_at
            raise TooMany(TOO_MANY_REQUESTS(what=limit.what, wait=wait), wait)
        self._full_at[subject] = full_at + limit.period
        while len(self._full_at) > self._subjects:
            self._full_at.popitem(last=False)
