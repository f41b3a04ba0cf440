"""The port through which a robot system commands its members."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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


# Commands that move nothing, or stop what moves.
HALTING = frozenset({Command.RELEASE, Command.PAUSE, Command.STOP})


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
    """The trajectory of a member; an empty id: it has none. stamp_ns: when it was claimed.

    state, position (s on its trajectory): where it stood then.
    """

    trajectory_id: str
    duration: float
    frame_rate: float
    stamp_ns: int = 0
    state: State = State.READY
    position: float = 0.0


class Fleet(Protocol):
    """The members of one system. Every call reaches all robots at once, within one time-out.

    Where a member cannot be reached the methods raise Unreached, where one refuses another
    LabError, but for reach().
    """

    def claim(self, robots: Sequence[str]) -> list[Loaded]:
        """Make the robots members; from then on they accept commands of the system alone."""
        ...

    def release(self, robots: Sequence[str]) -> None:
        """Let the robots go, paused where they are; no effect for one that is no member."""
        ...

    def load(self, trajectories: Mapping[str, str]) -> None:
        """Load trajectories by robot, empty: unload; a robot loads only while it is no member."""
        ...

    def drive(self, orders: Sequence[Order]) -> list[Reply]:
        """Send all orders; return one reply for each, in their order."""
        ...

    def leave(self, orders: Sequence[Order]) -> None:
        """Send all orders and wait for no reply: a host that does not run finds them later."""
        ...

    def reach(self, orders: Sequence[Order], timeout: float | None = None) -> list[Reply | None]:
        """Send each order by itself; return the replies, None where a robot did not answer.

        One that refuses is no member any more, or has no trajectory: its reply says IDLE.
        timeout: s; None: that of drive().
        """
        ...
