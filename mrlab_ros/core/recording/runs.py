"""The runs of a session: from the start of a trajectory's playback to its end.

Pauses, collision halts and changes of the speed are within a run. Times are s from the bag's first
message; places are m in the frame world. The figures of a run count only the time in which the
robot played its trajectory.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.recording.diagnostics import (
    RUN_COMPLETED,
    RUN_DEVIATED,
    RUN_FOLLOWED,
    RUN_HALTED,
    RUN_OPEN,
    RUN_STOPPED,
)

Array = NDArray[np.float64]
# Beyond this a run did not follow its reference, rad or m: rounding is far below.
FOLLOWED = 1e-4


class Result(Enum):
    """How a run ended. OPEN: it had not ended when the recording did."""

    COMPLETED = "completed"
    STOPPED = "stopped"
    HALTED = "halted"
    OPEN = "open"


class Deed(Enum):
    """Events of a robot in a run."""

    GRASPED = "grasped"
    RELEASED = "released"
    HANDED_OVER = "handed_over"
    LOST = "lost"
    MISSED = "missed"
    REMARK = "remark"
    HIT = "hit"


@dataclass(frozen=True)
class Action:
    """Something that a robot did, s of the session; said has its values, such as the object."""

    time: float
    deed: Deed
    said: Diagnostic

    def facts(self) -> dict[str, Any]:
        return {"time": self.time, "deed": self.deed.value, "said": plain(self.said)}


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
    prismatic: bool = False

    @property
    def said(self) -> Diagnostic:
        """The deviation, for a person."""
        if self.most < FOLLOWED:
            return RUN_FOLLOWED(reference=self.reference)
        return RUN_DEVIATED(
            angle=None if self.prismatic else self.most,
            distance=self.most if self.prismatic else None,
            reference=self.reference,
            joint=self.joint,
            time=self.time,
            tool=self.tool,
        )

    def facts(self) -> dict[str, Any]:
        return {**vars(self), "said": plain(self.said)}


@dataclass
class Course:
    """The recorded motion of a run. (N,) s of the session; (N, J) rad or m; (N, 3) m.

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
        worst = joints[joint]
        time = float(self.times[row])
        return Deviation(reference, most, mean, worst.name, time, tool, worst.prismatic)


OUTCOMES = {Result.STOPPED: RUN_STOPPED, Result.HALTED: RUN_HALTED, Result.OPEN: RUN_OPEN}


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
    def outcome(self) -> Diagnostic:
        """The result, for a person."""
        if self.result is Result.COMPLETED:
            rounds = self.loops + 1 if self.loops else None
            return RUN_COMPLETED(robot=self.robot, rounds=rounds, halts=self.halts or None)
        return OUTCOMES[self.result](
            robot=self.robot,
            position=self.position if self.length else None,
            length=self.length or None,
            halts=self.halts or None,
        )

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
            "result": self.result.value,
            "outcome": plain(self.outcome),
            "position": self.position,
            "length": self.length,
            "loops": self.loops,
            "speeds": self.speeds,
            "halts": self.halts,
            "actions": [action.facts() for action in self.actions],
            "deviation": None if self.deviation is None else self.deviation.facts(),
            "joints": [vars(joint) for joint in self.joints],
        }


# s: speeds are means of such a time, so the jitter of stamps does not count.
WINDOW = 0.05
# s: two joint states that are further apart have something unknown in between.
GAP = 0.5


@dataclass(frozen=True)
class NearLimit:
    """The joint that came nearest to one of its limits; room: rad or m, negative beyond it."""

    joint: str
    prismatic: bool
    room: float
    time: float


@dataclass(frozen=True)
class RunFigures:
    """Of the tool m and m/s, None where its way is not known; times s of the session."""

    way: float | None = None
    fastest: float | None = None
    fastest_at: float | None = None
    near: NearLimit | None = None

    def facts(self) -> dict[str, Any]:
        return {**vars(self), "near": None if self.near is None else vars(self.near)}


def figures_of(course: Course, joints: Sequence[RunJoint]) -> RunFigures:
    """Return the figures of a course whose columns are `joints`."""
    played = np.isfinite(course.positions)
    near = _nearest(course, joints, played)
    if course.tool is None:
        return RunFigures(near=near)
    known = played & np.isfinite(course.tool).all(axis=1)
    times, tool = course.times[known], course.tool[known]
    if len(times) < 2:
        return RunFigures(near=near)
    steps, lengths = np.diff(times), np.linalg.norm(np.diff(tool, axis=0), axis=1)
    joined = steps <= GAP
    way = float(lengths[joined].sum())
    grid = np.arange(times[0], times[-1] + WINDOW / 2, WINDOW)
    if len(grid) < 2:
        return RunFigures(way, near=near)
    placed = np.column_stack([np.interp(grid, times, axis) for axis in tool.T])
    speeds = np.linalg.norm(np.diff(placed, axis=0), axis=1) / WINDOW
    # The steps in which each window begins and ends.
    first = np.clip(np.searchsorted(times, grid[:-1], side="right") - 1, 0, len(steps) - 1)
    last = np.clip(np.searchsorted(times, grid[1:], side="left") - 1, 0, len(steps) - 1)
    speeds[~(joined[first] & joined[last])] = 0.0
    most = int(speeds.argmax())
    return RunFigures(way, float(speeds[most]), float(grid[most] + WINDOW / 2), near)


def _nearest(course: Course, joints: Sequence[RunJoint], played: Array) -> NearLimit | None:
    found: NearLimit | None = None
    for column, joint in enumerate(joints):
        values = np.where(played, course.joints[:, column], np.nan)
        for limit, sign in ((joint.lower, 1.0), (joint.upper, -1.0)):
            room = None if limit is None else (values - limit) * sign
            if room is None or np.isnan(room).all():
                continue
            row = int(np.nanargmin(room))
            if found is None or room[row] < found.room:
                found = NearLimit(
                    joint.name, joint.prismatic, float(room[row]), float(course.times[row])
                )
    return found
