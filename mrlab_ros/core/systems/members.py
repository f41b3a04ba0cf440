"""The robots of a system as the system reaches them: orders out, replies back."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

from mrlab_ros.core.playback.states import State


class Command(Enum):
    """The values are those of mrlab_msgs/DriveOrder."""

    STAGE = 2
    PLAY = 3
    PAUSE = 4
    STOP = 5
    SEEK = 6
    SET_RATE = 7
    HOLD = 8


@dataclass(frozen=True)
class Order:
    """One command to one member; position and until in s on its own trajectory."""

    robot: str
    command: Command
    stamp_ns: int = 0
    position: float = 0.0
    rate: float = 1.0
    until: float | None = None


@dataclass(frozen=True)
class Reply:
    """What a member says after an order; duration is how long its staging takes, s."""

    state: State
    position: float
    duration: float = 0.0


@dataclass(frozen=True)
class Loaded:
    """What a member has loaded."""

    trajectory_id: str
    duration: float
    frame_rate: float


class Fleet(Protocol):
    """The members, as the system reaches them."""

    def prepare(self, robot: str, trajectory_id: str) -> Loaded:
        """Claim the robot and load the trajectory (empty: what it has); raise LabError."""
        ...

    def drive(self, orders: Sequence[Order]) -> list[Reply]:
        """Give all orders at once; raise LabError where one is refused or unanswered."""
        ...
