"""A robot system's timeline: each member's share of it and its waits."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum

from mrlab_ros.core.playback.states import State
from mrlab_ros.core.systems.waits import Wait

# A member's own end and the timeline's are the same within this, s.
SAME_INSTANT = 1e-6


class Mode(Enum):
    PARALLEL = 0
    SEQUENTIAL = 1


@dataclass
class Member:
    """One robot and its share of the timeline, which begins at `start` (s)."""

    robot: str
    trajectory_id: str = ""
    dwell: float = 0.0
    waits: tuple[Wait, ...] = ()
    duration: float = 0.0
    frame_rate: float = 0.0
    start: float = 0.0
    state: State = State.IDLE
    position: float = 0.0
    ordered: bool = False
    done: bool = False
    met: set[Wait] = field(default_factory=set)

    @property
    def end(self) -> float:
        return self.start + self.duration

    def open_waits(self, frame: int | None = None) -> list[Wait]:
        """Return the waits not yet met, at one frame or anywhere, in order of frame."""
        waits = [w for w in self.waits if w not in self.met and frame in (None, w.frame)]
        return sorted(waits, key=lambda w: w.frame)

    def place(self, wait: Wait) -> float:
        """Return where on the trajectory `wait` holds the member, s."""
        return min(wait.frame / self.frame_rate, self.duration)

    @property
    def held_by(self) -> Wait | None:
        """The wait that holds the member where it stands."""
        if self.ordered or self.done:
            return None
        return next(
            (w for w in self.open_waits() if self.place(w) <= self.position + SAME_INSTANT), None
        )
