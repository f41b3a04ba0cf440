"""Tells whether the tool passes given points, in order, within a tolerance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array, Vector
from mrlab_ros.core.checking.diagnostics import (
    MISSES_POINT,
    POINT_COUNT,
    POINT_NOT_NUMBERS,
    POINT_OUT_OF_ORDER,
    POINT_TOO_FAR,
)

HEADINGS = ("x", "y", "z")
MOST_POINTS = 1000
FARTHEST = 100.0  # m from the origin of the world, along each axis


@dataclass(frozen=True)
class Passed:
    """A point, m in world, from 1. distance: the least, m, at `time`, s; in_order: that lies
    behind the point before it."""

    number: int
    point: Vector
    distance: float
    time: float
    in_order: bool = True

    def within(self, tolerance: float) -> bool:
        return self.in_order and self.distance <= tolerance


def passed(tool: Array, times: Array, points: Sequence[Vector], tolerance: float) -> list[Passed]:
    """Return when the tool, (N, 3) m at (N,) s, passes each point, one after the other.

    It moves straight between two samples. A point is looked for behind the one before it: the
    first pass within `tolerance`, m, counts, at its nearest instant; without one the nearest.
    """
    found: list[Passed] = []
    after = 0.0
    for number, point in enumerate(points, 1):
        distances, instants = segments(tool, times, np.asarray(point))
        later = np.flatnonzero(instants >= after)
        near = later[distances[later] <= tolerance]
        if len(near):
            ends = np.flatnonzero(np.diff(near) > 1)
            first = near[: ends[0] + 1] if len(ends) else near
            at = int(first[distances[first].argmin()])
            after = float(instants[at])
            found.append(Passed(number, point, float(distances[at]), after))
            continue
        at = int(distances.argmin())
        early = bool(distances[at] <= tolerance)
        if not early and len(later):
            at = int(later[distances[later].argmin()])
        found.append(Passed(number, point, float(distances[at]), float(instants[at]), not early))
    return found


def segments(tool: Array, times: Array, point: Array) -> tuple[Array, Array]:
    """Return the least distance of each straight piece to a point, m, and its instant, s."""
    start, way = tool[:-1], np.diff(tool, axis=0)
    length = np.maximum((way**2).sum(axis=1), 1e-18)
    share = np.clip(((point - start) * way).sum(axis=1) / length, 0.0, 1.0)
    distances = np.linalg.norm(start + share[:, None] * way - point, axis=1)
    return distances, times[:-1] + share * np.diff(times)


def findings_of(points: Sequence[Passed], tolerance: float, robot: str) -> list[Diagnostic]:
    """Return a finding for each point that the tool does not pass in order."""
    found = []
    for one in points:
        if one.within(tolerance):
            continue
        at: dict[str, Any] = {
            "robot": robot,
            "link": "tool0",
            "time": one.time,
            "number": one.number,
            "point": one.point,
            "value": one.distance,
            "limit": tolerance,
            "unit": "m",
        }
        found.append(
            MISSES_POINT(**at) if one.in_order else POINT_OUT_OF_ORDER(**at, before=one.number - 1)
        )
    return found


def points_from_rows(rows: Sequence[Sequence[str]], origin: str) -> tuple[Vector, ...]:
    """Return the points of a table, m, in the frame world; its first row may be x, y, z.

    Raises BadInput that names the line.
    """
    points: list[Vector] = []
    for line, row in enumerate(rows, 1):
        cells = [cell.strip() for cell in row]
        if not any(cells) or cells[0].startswith("#"):
            continue
        if not points and tuple(cell.lower() for cell in cells) == HEADINGS:
            continue
        try:
            x, y, z = map(float, cells)
        except ValueError:
            raise BadInput(POINT_NOT_NUMBERS(file=origin, line=line, found=cells)) from None
        if not np.isfinite([x, y, z]).all() or max(abs(x), abs(y), abs(z)) > FARTHEST:
            raise BadInput(POINT_TOO_FAR(file=origin, line=line, point=(x, y, z), most=FARTHEST))
        points.append((x, y, z))
    if not points or len(points) > MOST_POINTS:
        raise BadInput(POINT_COUNT(file=origin, count=len(points), most=MOST_POINTS))
    return tuple(points)
