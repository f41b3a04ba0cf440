"""How many batches a client may be sent: it says up to which number, after decoding."""

from __future__ import annotations

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
