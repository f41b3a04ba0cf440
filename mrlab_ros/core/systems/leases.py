"""Claims as leases: a robot belongs to a system as long as somebody keeps the system."""

from __future__ import annotations

from collections.abc import Iterable

# The coordinator names its systems once a second; one that it has not named for this long is
# kept by nobody, s.
LEASE_S = 4.0


class Leases:
    """When each system was named last. Times are s of any clock that never goes back."""

    def __init__(self, lease: float = LEASE_S) -> None:
        self._lease = lease
        self._renewed: dict[str, float] = {}

    def renew(self, systems: Iterable[str], now: float) -> None:
        """Note that these systems are kept at `now`."""
        self._renewed |= dict.fromkeys(systems, now)

    def expired(self, claimed: Iterable[str], now: float) -> list[str]:
        """Return those of the claimed systems that nobody keeps; forget all others.

        One that is seen here first has just been made, and gets its time.
        """
        self._renewed = {name: self._renewed.get(name, now) for name in claimed}
        return [name for name, renewed in self._renewed.items() if now - renewed >= self._lease]
