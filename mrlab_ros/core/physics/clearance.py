"""When an arm collides and when it is clear again: two states with hysteresis."""

from __future__ import annotations

from enum import Enum

from mrlab_ros.core.base.state_machine import Machine, Table


class Halt(Enum):
    """States of an arm's collisions."""

    CLEAR = "clear"
    COLLIDING = "colliding"


class HaltEvent(Enum):
    """Observations of an arm."""

    TOUCHED = "touch"
    LEFT = "keep clear"


TABLE: Table[Halt, HaltEvent] = Table(
    initial=Halt.CLEAR,
    transitions={
        (Halt.CLEAR, HaltEvent.TOUCHED): Halt.COLLIDING,
        (Halt.COLLIDING, HaltEvent.LEFT): Halt.CLEAR,
    },
    ignored={HaltEvent.TOUCHED: (Halt.COLLIDING,), HaltEvent.LEFT: (Halt.CLEAR,)},
    commands=(),
)


class Clearance:
    """A collision begins at the first touch and ends when the margin was kept for a while.

    margin: m; hold_ns: how long, without a break, the margin must be kept.
    """

    def __init__(self, margin: float, hold_ns: int) -> None:
        self._machine = Machine(TABLE)
        self._margin = margin
        self._hold_ns = hold_ns
        self._since_ns: int | None = None

    @property
    def state(self) -> Halt:
        """The state of the arm's collisions."""
        return self._machine.state

    def touched(self) -> bool:
        """Take a touch; return whether a collision begins with it."""
        self._since_ns = None
        return self._fire(HaltEvent.TOUCHED)

    def apart(self, now_ns: int, distance: float) -> bool:
        """Take that nothing is touched, at `distance` (m); return whether the collision ends."""
        if distance < self._margin:
            self._since_ns = None
            return False
        if self._since_ns is None:
            self._since_ns = now_ns
        if now_ns - self._since_ns < self._hold_ns:
            return False
        return self._fire(HaltEvent.LEFT)

    def _fire(self, event: HaltEvent) -> bool:
        """Fire an event; return whether it changed the state."""
        before = self._machine.state
        return self._machine.fire(event) is not before
