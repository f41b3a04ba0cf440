"""The recorded motion of a session: robots and objects over time."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from typing import Any


@dataclass
class Track:
    """Samples over time: values one row a time."""

    times: list[float] = field(default_factory=list)
    values: list[list[float]] = field(default_factory=list)

    def add(self, time: float, values: list[float]) -> None:
        self.times.append(time)
        self.values.append(values)


@dataclass
class RecordedRobot:
    """The record of a robot; joints: names in the order of track's values.

    there: from when to when the scene had it, s, the end None where it was there to the last;
    empty: nothing says.
    """

    urdf: str = ""
    model: str = ""
    end_effector: str = ""
    joints: list[str] = field(default_factory=list)
    track: Track = field(default_factory=Track)
    base: Track = field(default_factory=Track)
    there: list[tuple[float, float | None]] = field(default_factory=list)


@dataclass
class RecordedObject:
    """The record of an object. shape: the fields of SceneObject that are drawn."""

    shape: dict[str, Any]
    first: float
    last: float
    track: Track = field(default_factory=Track)
    # (time, robot), robot empty: free
    holders: list[tuple[float, str]] = field(default_factory=list)


@dataclass
class RecordedMotion:
    """Everything of a bag that moves."""

    robots: dict[str, RecordedRobot] = field(default_factory=dict)
    objects: dict[str, RecordedObject] = field(default_factory=dict)

    def robot(self, name: str) -> RecordedRobot:
        return self.robots.setdefault(name, RecordedRobot())

    def scene(self, time: float, names: Collection[str]) -> None:
        """Take note of which robots the scene has from a time on, s.

        Those that it had first were there from the beginning: the recorder heard of them late.
        """
        if not any(robot.there for robot in self.robots.values()):
            time = 0.0
        for name in names:
            there = self.robot(name).there
            if not there or there[-1][1] is not None:
                there.append((time, None))
        for name, robot in self.robots.items():
            if name not in names and robot.there and robot.there[-1][1] is None:
                robot.there[-1] = (robot.there[-1][0], time)
