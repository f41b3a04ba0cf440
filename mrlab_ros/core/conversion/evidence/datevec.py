"""Matrices of dates as clock and datevec give them: year, month, day, hour, minute, second."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.workspace import Workspace
from mrlab_ros.core.trajectory.trajectory import Array

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
