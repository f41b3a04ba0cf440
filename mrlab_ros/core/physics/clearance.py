"""When an arm collides and when it is clear again: two states with room between them."""

from __future__ import annotations

from enum import Enum


class Halt(Enum):
    CLEAR = "clear"
    COLLIDING = "colliding"


class HaltEvent(Enum):
    TOUCHED = "touch"
    LEFT = "keep clear"


TRANSITIONS: dict[tuple[Halt, HaltEvent], Halt] = {
    (Halt.CLEAR, HaltEvent.TOUCHED): Halt.COLLIDING,
    (Halt.CLEAR, HaltEvent.LEFT): Halt.CLEAR,
    (Halt.COLLIDING, HaltEvent.TOUCHED): Halt.COLLIDING,
    (Halt.COLLIDING, HaltEvent.LEFT): Halt.CLEAR,
}


class Clearance:
    """Raises a collision at the first touch; ends it when the margin was kept for a while.

    margin: m; hold_ns: how long, without a break, the margin must be kept.
    """

    def __init__(self, margin: float, hold_ns: int) -> None:
        self.state = Halt.CLEAR
        self._margin = margin
        self._hold_ns = hold_ns
        self._since_ns: int | None = None

    def touched(self) -> bool:
        """Note a touch; return whether a collision begins with it."""
        before = self.state
        self.state = TRANSITIONS[before, HaltEvent.TOUCHED]
        self._since_ns = None
        return before is not self.state

    def apart(self, now_ns: int, distance: float) -> bool:
        """Note a look without touch at `distance`, m; return whether the collision ends."""
        if self.state is Halt.CLEAR:
            return False
        if distance < self._margin:
            self._since_ns = None
            return False
        if self._since_ns is None:
            self._since_ns = now_ns
        if now_ns - self._since_ns < self._hold_ns:
            return False
        self.state = TRANSITIONS[self.state, HaltEvent.LEFT]
        return True
