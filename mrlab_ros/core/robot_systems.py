"""Robots that play as one: a system's members, states and timeline."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import Enum

from mrlab_ros.core.clock import PlaybackClock
from mrlab_ros.core.errors import BadInput, IllegalEvent, Misuse
from mrlab_ros.core.scene import checked_name


class SystemState(Enum):
    """The values are those of mrlab_msgs/RobotSystem."""

    READY = 1
    STAGING = 2
    PLAYING = 3
    PAUSED = 4
    COLLISION_HALT = 5
    COMPLETE = 6


class SystemEvent(Enum):
    STAGE = "play"
    ABORT = "give up staging"
    START = "start"
    PAUSE = "pause"
    RESUME = "play on"
    STOP = "stop"
    FINISH = "finish"
    REARM = "be ready again"
    COLLIDE = "collide"
    CLEAR = "be clear again"


S, E = SystemState, SystemEvent
TRANSITIONS: dict[tuple[SystemState, SystemEvent], SystemState] = {
    (S.READY, E.STAGE): S.STAGING,
    (S.READY, E.STOP): S.READY,
    (S.STAGING, E.START): S.PLAYING,
    (S.STAGING, E.ABORT): S.READY,
    (S.STAGING, E.STOP): S.READY,
    (S.STAGING, E.COLLIDE): S.COLLISION_HALT,
    (S.PLAYING, E.PAUSE): S.PAUSED,
    (S.PLAYING, E.STOP): S.READY,
    (S.PLAYING, E.FINISH): S.COMPLETE,
    (S.PLAYING, E.COLLIDE): S.COLLISION_HALT,
    (S.PAUSED, E.RESUME): S.PLAYING,
    (S.PAUSED, E.PAUSE): S.PAUSED,
    (S.PAUSED, E.STOP): S.READY,
    (S.COLLISION_HALT, E.CLEAR): S.PAUSED,
    (S.COMPLETE, E.REARM): S.READY,
}
COMMANDS = (E.STAGE, E.PAUSE, E.RESUME, E.STOP)
del S, E


def after(state: SystemState, event: SystemEvent) -> SystemState:
    """Return the state that `event` leads to; raise IllegalEvent where the table has none."""
    try:
        return TRANSITIONS[state, event]
    except KeyError:
        allowed = ", ".join(e.value for e in COMMANDS if (state, e) in TRANSITIONS)
        raise IllegalEvent(
            f"cannot {event.value} in {state.name}; possible now: {allowed or 'only waiting'}"
        ) from None


@dataclass
class Member:
    """One robot of a system. duration: s of its trajectory; state: a PlaybackState value."""

    robot: str
    trajectory_id: str = ""
    duration: float = 0.0
    state: int = 0


@dataclass
class RobotSystem:
    """A system in parallel mode: all members begin at one stamp, the longest ends it."""

    name: str
    members: dict[str, Member]
    state: SystemState = SystemState.READY
    message: str = ""
    clock: PlaybackClock = field(default_factory=PlaybackClock)

    @property
    def duration(self) -> float:
        """Length of the timeline, s."""
        return max(member.duration for member in self.members.values())

    def fire(self, event: SystemEvent, message: str = "") -> None:
        """Take the transition; raise IllegalEvent, and change nothing, where there is none."""
        self.state = after(self.state, event)
        self.message = message


class Systems:
    """All systems; a robot is in at most one."""

    def __init__(self) -> None:
        self._systems: dict[str, RobotSystem] = {}

    def __iter__(self) -> Iterator[RobotSystem]:
        return iter(tuple(self._systems.values()))

    def get(self, name: str) -> RobotSystem:
        """Return the system called `name`; raise Misuse where there is none."""
        try:
            return self._systems[name]
        except KeyError:
            known = ", ".join(self._systems) or "none"
            raise Misuse(f"there is no system '{name}'; there are: {known}") from None

    def of(self, robot: str) -> RobotSystem | None:
        """Return the system that `robot` is a member of."""
        return next((s for s in self if robot in s.members), None)

    def create(self, name: str, members: list[Member], robots: frozenset[str]) -> RobotSystem:
        """Make a system of `members`; `robots` are the names of all robots in the scene."""
        if not members:
            raise BadInput("a system needs at least one member; name the robots it shall drive")
        names = [member.robot for member in members]
        for robot in names:
            if robot not in robots:
                raise BadInput(
                    f"no robot '{robot}' is in the scene; there are: "
                    f"{', '.join(sorted(robots)) or 'none'}"
                )
            if names.count(robot) > 1:
                raise BadInput(f"'{robot}' is named {names.count(robot)} times; name it once")
            if (other := self.of(robot)) is not None:
                raise Misuse(
                    f"'{robot}' is a member of system '{other.name}' already; dissolve that first"
                )
        number = 1
        while not name and f"system_{number}" in self._systems:
            number += 1
        name = checked_name(
            name or f"system_{number}", robots | frozenset(self._systems), "system"
        )
        self._systems[name] = RobotSystem(name, {m.robot: m for m in members})
        return self._systems[name]

    def dissolve(self, name: str) -> RobotSystem:
        self.get(name)
        return self._systems.pop(name)
