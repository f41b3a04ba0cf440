"""A gripper's column: states, ramps between them, and what their range means."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
