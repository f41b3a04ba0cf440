"""What a run's motion amounts to: the way of its tool, its speed, and how near it came to a limit.

Only what was recorded while the robot played its trajectory counts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.recording.runs import Course, RunJoint

Array = NDArray[np.float64]
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
