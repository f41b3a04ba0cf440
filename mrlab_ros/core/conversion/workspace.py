"""What a file holds, as MATLAB would name it; the readers fill it, discovery searches it."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic

JOINT_TRAJECTORY = "trajectory_msgs/msg/JointTrajectory"
MOST_SMALL = 64
# kinds of what a file says of its variables: lines above a table, attributes
COMMENT, ATTRIBUTE = "comment", "attribute"
# beside a recorded motion: how many stamps are earlier than the one before
EARLIER = "earlier_stamps"
JOINT_STATE = "sensor_msgs/msg/JointState"


@dataclass(frozen=True, eq=False)
class Variable:
    """One variable of a workspace, or one part of a struct, a cell, an object and so on.

    path: as MATLAB writes it, such as `out.q.signals.values`, `log{1}.Values.Data` or
    `map('q')`. kind: MATLAB's class, such as double; of an object its class name. shape: as
    MATLAB's size() gives it, empty if unknown. values: the numbers of a real double or single
    matrix in MATLAB's orientation, or of an array of more dimensions that is a matrix once those
    of one are left out, or 4 x 4 x N; else None. is_object: an object that could not be opened.
    note: why there are no values, such as complex or sparse.

    columns: their names, where the file names them: the headings of a table, the joints of a
    message. units: of each column, as the file writes them ('rad', 'deg', 'm/s', may be empty);
    one entry alone is that of every column; empty where the file gives none. time: the path of
    the variable, (N, 1) s, that holds the time of each row, where the file itself says so (a
    timeseries, a timetable); empty where it does not. label: the name that the signal carries in
    the file, such as that of a timeseries or of an element of a Dataset. text: of a char or a
    string, where it is one line of at most 200 characters; 'true' or 'false' of one logical.

    The samples of a timeseries are its rows, along whichever axis its time runs. Durations are in
    s; a datetime is in s since its first element.

    A message of the kind JOINT_TRAJECTORY has its positions as values; its times and velocities
    are the variables `path.time_from_start` (s) and, where every point has them,
    `path.velocities`.
    """

    path: str
    kind: str
    shape: tuple[int, ...] = ()
    values: NDArray[Any] | None = None
    is_object: bool = False
    note: Diagnostic | str = ""
    columns: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    time: str = ""
    label: str = ""
    text: str = ""

    @property
    def is_message(self) -> bool:
        """Say whether this is a JointTrajectory: points at times, of joints with names."""
        return self.kind == JOINT_TRAJECTORY

    @property
    def size(self) -> str:
        """Return the dimensions as MATLAB's whos writes them, such as 450x6."""
        return "x".join(str(n) for n in self.shape)


@dataclass(frozen=True, eq=False)
class Workspace:
    """The variables of a file in their order.

    omitted: how many more there are than listed. confirm: reads the variables at some paths a
    second time, with another reader, and raises BadInput unless both find the same bits; None
    where there is no second reader.
    """

    file_format: str
    variables: tuple[Variable, ...]
    omitted: int = 0
    sha256: str = ""
    confirm: Callable[[Sequence[str]], None] | None = None

    def find(self, path: str) -> Variable | None:
        """Return the variable with this path, or None."""
        return self._by_path.get(path)

    @cached_property
    def _by_path(self) -> dict[str, Variable]:
        # the first of equal paths counts
        return {v.path: v for v in reversed(self.variables)}

    @cached_property
    def count(self) -> int:
        """How many numbers the variables hold together."""
        return sum(v.values.size for v in self.variables if v.values is not None)

    @cached_property
    def small(self) -> dict[str, list[Variable]]:
        """The texts and the numbers, at most 64, by the struct that they lie in."""
        found: dict[str, list[Variable]] = {}
        for v in self.variables:
            if v.text or (v.values is not None and v.values.size <= MOST_SMALL):
                found.setdefault(outer(v.path), []).append(v)
        return found

    def scalar(self, variable: Variable) -> float | None:
        """Return the number that `variable` holds where it holds exactly one, else None."""
        if variable.values is None or variable.values.size != 1:
            return None
        return float(np.asarray(variable.values).reshape(-1)[0])


def outer(path: str) -> str:
    """Return the path of the struct that a variable, or an element of one, lies in."""
    return re.sub(r"\([\d,]+\)$|\{[\d,]+\}$", "", path).rpartition(".")[0]


def shortened(names: list[str], most: int = 8) -> list[str]:
    """Return at most `most` names, and dots where there are more."""
    return names if len(names) <= most else [*names[:most], "..."]
