"""The runs of a session: from when a robot begins to play a trajectory until that ends.

Pauses, collision halts and changes of the speed are within a run. Times are s from the bag's first
message; places are m in the frame world.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Result(Enum):
    """How a run ended."""

    COMPLETED = "completed"
    STOPPED = "stopped"
    HALTED = "halted by a collision"
    OPEN = "still going on"


class Deed(Enum):
    """What a robot did in a run."""

    GRASPED = "grasped"
    RELEASED = "released"
    LOST = "lost"
    MISSED = "missed"
    REMARK = "remark"
    HIT = "hit"


@dataclass(frozen=True)
class Action:
    """Something that a robot did. target: where the trajectory puts what was released.

    detail: figures that belong to it, such as the mass of what was grasped.
    """

    time: float
    deed: Deed
    text: str
    object: str = ""
    link: str = ""
    place: tuple[float, float, float] | None = None
    target: tuple[float, float, float] | None = None
    detail: str = ""

    @property
    def off(self) -> float | None:
        """How far from its target the object lies, m."""
        if self.place is None or self.target is None:
            return None
        return math.dist(self.place, self.target)

    def facts(self) -> dict[str, Any]:
        return {
            "time": self.time,
            "deed": self.deed.value,
            "text": self.text,
            "detail": self.detail,
            "object": self.object,
            "link": self.link,
            "place": self.place,
            "target": self.target,
            "distance": self.off,
        }


# How grave a deed is; the others: info.
SEVERITY = {
    Deed.HIT: "error",
    Deed.LOST: "warning",
    Deed.MISSED: "warning",
    Deed.REMARK: "warning",
}


def severity(action: Action) -> str:
    """Return how grave an action is: error, warning or info."""
    return SEVERITY.get(action.deed, "info")


@dataclass(frozen=True)
class RunJoint:
    """A joint with its limits, rad or m; None: no limit, or not known."""

    name: str
    prismatic: bool = False
    lower: float | None = None
    upper: float | None = None


@dataclass(frozen=True)
class Deviation:
    """How far recorded joints were from a reference: rad (m where prismatic), tool m."""

    reference: str
    most: float
    mean: float
    joint: str
    time: float
    tool: float | None = None


@dataclass
class Course:
    """What was recorded of a run's motion. (N,) s of the session; (N, J) rad or m; (N, 3) m.

    positions: s of the trajectory, NaN where the robot did not play. expected: (N, J) of the
    reference at these positions, NaN where it has none.
    """

    times: Array
    positions: Array
    joints: Array
    expected: Array
    tool: Array | None = None
    expected_tool: Array | None = None

    def deviation(self, reference: str, joints: Sequence[RunJoint]) -> Deviation | None:
        """Return how far the joints were from the reference, None where there is none."""
        off = np.abs(self.joints - self.expected)
        if np.isnan(off).all():
            return None
        row, joint = (int(i) for i in np.unravel_index(int(np.nanargmax(off)), off.shape))
        tool = None
        if self.tool is not None and self.expected_tool is not None:
            tool = float(np.nanmax(np.linalg.norm(self.tool - self.expected_tool, axis=1)))
        mean = float(np.sqrt(np.nanmean(off**2)))
        most = float(off[row, joint])
        return Deviation(reference, most, mean, joints[joint].name, float(self.times[row]), tool)


@dataclass
class Run:
    """One run. speeds: as they were set, in order.

    position: s of the trajectory up to which it played; an arm that was taken back stands before.
    """

    robot: str
    model: str
    trajectory: str
    version: int
    system: str
    start: float
    end: float
    length: float
    number: int = 0
    result: Result = Result.OPEN
    position: float = 0.0
    halts: int = 0
    loops: int = 0
    speeds: list[float] = field(default_factory=list)
    actions: list[Action] = field(default_factory=list)
    joints: tuple[RunJoint, ...] = ()
    course: Course | None = None
    deviation: Deviation | None = None

    @property
    def duration(self) -> float:
        return self.end - self.start

    @property
    def hit(self) -> bool:
        return any(action.deed is Deed.HIT for action in self.actions)

    def outcome(self) -> str:
        """Return the result, for a person."""
        where = f" at {self.position:.2f} of {self.length:.2f} s" if self.length else ""
        if self.result is Result.COMPLETED:
            again = f", {self.loops + 1} times" if self.loops else ""
            halted = " after a collision" if self.halts else ""
            return f"completed{again}{halted}"
        if self.result is Result.STOPPED:
            return f"stopped{' after a collision' if self.halts else ''}{where}"
        return f"{self.result.value}{where} when the recording ended"

    def facts(self) -> dict[str, Any]:
        """Return everything, ready for JSON: SI units."""
        return {
            "number": self.number,
            "robot": self.robot,
            "model": self.model,
            "system": self.system,
            "trajectory": self.trajectory,
            "version": self.version,
            "start": self.start,
            "end": self.end,
            "result": self.result.name.lower(),
            "message": self.outcome(),
            "position": self.position,
            "length": self.length,
            "loops": self.loops,
            "speeds": self.speeds,
            "halts": self.halts,
            "actions": [action.facts() for action in self.actions],
            "deviation": None if self.deviation is None else vars(self.deviation),
        }
