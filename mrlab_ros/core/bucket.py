"""A bucket of tokens: how much a client may send. Time is an argument, s, monotonic."""

from __future__ import annotations

from dataclasses import dataclass


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
