"""The port through which a robot system commands its members."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

from mrlab_ros.core.playback.states import State


class Command(Enum):
    """The values are those of mrlab_msgs/DriveOrder."""

    CLAIM = 0
    RELEASE = 1
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
    """The state of a member after an order.

    duration: how long its staging takes, s. stamp_ns: when the order was carried out.
    """

    state: State
    position: float
    duration: float = 0.0
    stamp_ns: int = 0


@dataclass(frozen=True)
class Loaded:
    """The trajectory of a member; an empty id: it has none. stamp_ns: when it was claimed."""

    trajectory_id: str
    duration: float
    frame_rate: float
    stamp_ns: int = 0


class Fleet(Protocol):
    """The members of one system. Every method raises LabError where a member cannot be reached
    or refuses."""

    def claim(self, robot: str) -> Loaded:
        """Make the robot a member; from then on it accepts commands of the system alone."""
        ...

    def release(self, robot: str) -> None:
        """Let the robot go, paused where it is."""
        ...

    def load(self, robot: str, trajectory_id: str) -> None:
        """Load a trajectory; a robot loads only while it is no member."""
        ...

    def drive(self, orders: Sequence[Order]) -> list[Reply]:
        """Send all orders at once; return one reply for each, in their order."""
        ...
