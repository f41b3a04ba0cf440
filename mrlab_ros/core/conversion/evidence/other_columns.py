"""Columns that are no joints: times, dates and grippers.

Times are found by how they rise and by the time vectors of the file, dates by their six columns
as clock and datevec give them, grippers by states and ramps.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.diagnostics import CLOCK
from mrlab_ros.core.conversion.evidence.time_vectors import (
    counts_rows,
    is_even,
    is_irregular,
    is_regular,
    is_time_name,
)
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

# A column that counts time and leaves the joint limits by this factor is no joint.
BEYOND = 1.2
UNITS_S = (1.0, 1e-3, 1e-6, 1e-9)


@dataclass(frozen=True, eq=False)
class ClockColumn:
    """A column, from 0, that counts time.

    certain: no joint could have these values. likely: few joints move so; where it is neither, a
    joint at constant speed looks the same, and the column is a doubt alone.
    """

    index: int
    certain: bool
    first: float
    last: float
    why: Diagnostic
    likely: bool = True


def time_column_names(variable: Variable, index: int) -> bool:
    """Say whether the heading of a column, from 0, says time."""
    return index < len(variable.columns) and is_time_name(variable.columns[index])


def clocks_among(
    variable: Variable,
    robot: RobotModel,
    vectors: dict[int, list[Variable]],
    low: Array,
    high: Array,
    rates: tuple[float, ...] = (),
) -> tuple[ClockColumn, ...]:
    """Return the columns of a finite matrix that count time.

    rates: Hz, those that the file says for certain; a column that contradicts all of them, and
    that nothing else shows to be time, is none.
    """
    values = variable.values
    assert values is not None
    rows, columns = values.shape
    if rows < 3 or columns > 200:
        return ()
    moves = high > low
    chosen = np.linspace(0, rows - 1, min(rows, 33)).astype(int)
    coarse = np.diff(values[chosen], axis=0)
    one_way = (coarse > 0).all(axis=0) | (coarse < 0).all(axis=0)
    steady = [
        int(c)
        for c in np.flatnonzero(one_way)
        if is_regular(values[:, c], falling=True) or is_irregular(values[:, c])
    ]
    farthest = max((max(abs(j.lower), abs(j.upper)) for j in robot.joints), default=np.pi)
    found = []
    for c in steady:
        column = values[:, c]
        if column[-1] <= column[0]:
            continue
        headed = time_column_names(variable, c)
        first, last = float(column[0]), float(column[-1])
        others = [i for i in range(columns) if i != c and moves[i]]
        why = None
        if headed:
            why = CLOCK(heading=variable.columns[c])
        else:
            # where most columns are ramps, each may be the time and none need be
            if not others or 2 * sum(i in steady for i in others) >= len(others):
                continue
            twin = next((v for v in vectors.get(rows, ()) if _same_course(column, v)), None)
            if twin is not None:
                why = CLOCK(other=twin.path)
        if why is not None:
            found.append(ClockColumn(c, True, first, last, why))
            continue
        if rates and not _is_at(rates, (last - first) / (rows - 1)):
            continue
        largest = max(abs(first), abs(last))
        within = sum(max(abs(low[i]), abs(high[i])) <= BEYOND * farthest for i in others)
        if largest > BEYOND * farthest and within >= 0.7 * len(others):
            found.append(ClockColumn(c, True, first, last, CLOCK(rises="far")))
        elif _begins_like_a_clock(column) and _is_round(column):
            found.append(ClockColumn(c, False, first, last, CLOCK(rises="round")))
        elif is_irregular(column):
            found.append(ClockColumn(c, False, first, last, CLOCK(rises="irregular")))
        elif is_even(column) and len(others) >= 2:
            why = CLOCK(rises="even")
            found.append(ClockColumn(c, False, first, last, why, likely=False))
    return tuple(found)


def _is_at(rates: tuple[float, ...], step: float) -> bool:
    """Say whether a step is that of one of the rates, Hz, in s, ms, us or ns."""
    return any(abs(step * unit * rate - 1) < 0.1 for rate in rates for unit in UNITS_S)


def _begins_like_a_clock(column: NDArray[Any]) -> bool:
    step = (float(column[-1]) - float(column[0])) / (len(column) - 1)
    return abs(float(column[0])) <= 1.5 * step or counts_rows(column)


def _is_round(column: NDArray[Any]) -> bool:
    """Say whether the steps of a column, or its end, are round decimals or rates."""
    step = (float(column[-1]) - float(column[0])) / (len(column) - 1)

    def is_short(number: float) -> bool:
        digits = float(f"{number:.3g}")
        return abs(number - digits) <= 1e-6 * abs(number)

    jitters = float(np.abs(np.diff(column.astype(np.float64)) - step).max()) > 1e-3 * step
    rate = 1 / step
    return (
        is_short(step)
        or is_short(float(column[-1]))
        or (rate >= 1 and abs(rate - round(rate)) <= 1e-4 * rate)
        or jitters
    )


def _same_course(column: NDArray[Any], vector: Variable) -> bool:
    """Say whether a column rises as a vector does, in any unit and from any start."""
    assert vector.values is not None
    other = vector.values.reshape(-1)
    chosen = np.linspace(0, len(column) - 1, min(len(column), 64)).astype(int)
    a, b = column[chosen].astype(np.float64), other[chosen].astype(np.float64)
    if not np.isfinite(b).all() or b[-1] <= b[0]:
        return False
    a, b = (a - a[0]) / (a[-1] - a[0]), (b - b[0]) / (b[-1] - b[0])
    scale = float(column[-1] - column[0]) / float(other[-1] - other[0])
    known = [1.0, 1e-3, 1e3, 1e-6, 1e6, 1e9, 1e-9, 86_400.0, 1 / 86_400]
    return bool(np.abs(a - b).max() <= 1e-6 and any(abs(scale / k - 1) <= 1e-3 for k in known))


def time_vectors(workspace: Workspace) -> dict[int, list[Variable]]:
    """Return the vectors whose names say time, by the number of their elements."""
    found: dict[int, list[Variable]] = {}
    for v in workspace.variables:
        if (
            v.values is not None
            and len(v.shape) == 2
            and min(v.shape) == 1
            and v.values.size >= 3
            and is_time_name(v.path)
        ):
            found.setdefault(v.values.size, []).append(v)
    return found


WIDTH = 6
LOWEST = np.array([1970.0, 1, 1, 0, 0, 0])
HIGHEST = np.array([2100.0, 12, 31, 23, 59, 60])
DAY_S = 86_400.0


def is_datevec(values: NDArray[Any]) -> bool:
    """Say whether the first six columns of a matrix are dates."""
    if values.ndim != 2 or values.shape[1] < WIDTH or not len(values):
        return False
    if not LOWEST[0] <= float(values[0, 0]) <= HIGHEST[0]:
        return False
    part = values[:, :WIDTH]
    whole = part[:, : WIDTH - 1]
    with np.errstate(all="ignore"):
        return bool(
            (whole == np.rint(whole)).all() and (part >= LOWEST).all() and (part <= HIGHEST).all()
        )


def seconds(values: NDArray[Any]) -> Array:
    """Return the times, (N, 1) s since the first, of dates, (N, 6)."""
    # months count from 1970 on, and a month begins at the day that numpy says
    months = ((values[:, 0] - 1970) * 12 + values[:, 1] - 1).astype(np.int64)
    begin = months.astype("datetime64[M]").astype("datetime64[D]").astype(np.int64)
    days = begin - begin[0] + values[:, 2]
    times = days * DAY_S + values[:, 3:6] @ np.array([3600.0, 60.0, 1.0])
    return np.asarray(times - times[0], dtype=np.float64)[:, np.newaxis]


def with_times(workspace: Workspace) -> Workspace:
    """Return the workspace with each matrix of dates as a vector of times, s since the first."""
    variables = tuple(
        replace(v, values=(times := seconds(v.values)), shape=times.shape, units=("s",))
        if v.values is not None and v.values.shape[1:] == (WIDTH,) and is_datevec(v.values)
        else v
        for v in workspace.variables
    )
    changed = any(a is not b for a, b in zip(variables, workspace.variables, strict=True))
    return replace(workspace, variables=variables) if changed else workspace


# Share of a gripper's samples that may be on their way, and of its range that counts as an end.
ON_ITS_WAY, AN_END = 0.2, 0.02
WIDEST_M, WIDEST_MM = 0.2, 200.0  # how far grippers open
NARROWEST_M, NARROWEST_MM = 0.01, 15.0


@dataclass(frozen=True)
class GripperRange:
    """What the range of a gripper's values is, a name; opens: larger means open."""

    meaning: str
    opens: bool


def between_ends(column: NDArray[Any]) -> int:
    """Return how many samples of a finite column are at neither end of its range."""
    low, high = float(column.min()), float(column.max())
    margin = AN_END * (high - low)
    return int(np.count_nonzero((column > low + margin) & (column < high - margin)))


def has_states(column: NDArray[Any]) -> bool:
    """Say whether a column is mostly at one of its two ends, or never changes, as a gripper is."""
    return between_ends(column) <= ON_ITS_WAY * len(column)


def meaning(column: NDArray[Any]) -> GripperRange | None:
    """Return what the range of a column says of a gripper, or None where it is no known one."""
    low, high = float(column.min()), float(column.max())
    if (low, high) == (0.0, 1.0):
        return GripperRange("states", opens=False)
    if low < -1e-3 * high:
        return None
    if 250 <= high <= 255 and low <= 10:
        return GripperRange("position", opens=False)
    if NARROWEST_M <= high <= WIDEST_M:
        return GripperRange("width_m", opens=True)
    if abs(high - 100) <= 0.5 and low <= 5:
        return GripperRange("percent", opens=False)
    if NARROWEST_MM <= high <= WIDEST_MM:
        return GripperRange("width_mm", opens=True)
    return None


def is_ramp(column: NDArray[Any]) -> bool:
    """Say whether a column that is long on its way has a range that only a gripper has.

    0 to 255, 0 to 100 and the widths of grippers; 0 to 1 is a joint's range as well.
    """
    found = meaning(column)
    low, high = float(column.min()), float(column.max())
    rests = np.count_nonzero(np.abs(np.diff(column.astype(np.float64))) <= 1e-9 * (high - low))
    at_ends = len(column) - between_ends(column)
    return bool(
        found is not None
        and high != 1.0
        and low <= AN_END * high
        and (high > 10 or (at_ends >= 0.3 * len(column) and rests >= 0.25 * len(column)))
    )
