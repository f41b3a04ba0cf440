"""The unit that joint positions are in, by their range against a robot's limits and by name."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.diagnostics import UNIT_NAMED, UNIT_REACHES
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

# Two turns: radians that went astray by a full turn stay below it, degrees of a motion do not.
LEAST_DEGREES = 4 * np.pi
TOLERANCE = 1e-3  # rad
# degrees may pass a limit by this much of it and still be meant as degrees
LOOSELY = 1.5
CENTIDEGREES, MILLIDEGREES = 36_000, 360_000  # counts a turn
MILLIRADIANS = 2000 * np.pi  # a turn
LEAST_REACH = 0.25  # rad; a unit in which a motion stays below is not meant
LEAST_COUNTS = 1000.0
COUNTS = tuple(2**n for n in range(9, 25))


@dataclass(frozen=True)
class UnitEvidence:
    """The unit that values are likely in.

    unit: rad, deg, counts, or empty where none fits. counts: of a turn, else 0. alone: no other
    number of counts fits. why: what speaks for a unit that has to be named; None for rad.
    """

    unit: str
    counts: int = 0
    alone: bool = True
    why: Diagnostic | None = None


def limits_of(robot: RobotModel) -> Array:
    """Return the limits of the joints, (J, 2) rad."""
    return np.array([(j.lower, j.upper) for j in robot.joints])


def inside(low: Array, high: Array, limits: Array, tolerance: float = TOLERANCE) -> bool:
    """Say whether columns from low to high, (J,), are within limits, (J, 2)."""
    return bool(
        (low >= limits[:, 0] - tolerance).all() and (high <= limits[:, 1] + tolerance).all()
    )


def evidence(
    arm: NDArray[Any], low: Array, high: Array, robot: RobotModel, named: str
) -> UnitEvidence:
    """Say which unit finite values, (N, J) from low to high, are likely in.

    named: deg where the name says degrees, else empty.
    """
    limits = limits_of(robot)
    largest = float(max(np.abs(low).max(), np.abs(high).max()))
    in_radians = inside(low, high, limits)
    if named == "deg" and largest > 0:
        return UnitEvidence("deg", why=UNIT_NAMED())
    farthest = float(np.abs(limits).max())
    least = max(LEAST_DEGREES, 2 * farthest)
    if in_radians or largest <= least:
        return UnitEvidence("rad" if in_radians else "")
    if inside(np.radians(low), np.radians(high), limits):
        why = UNIT_REACHES(largest=largest, model=robot.id, fits="degrees")
        return UnitEvidence("deg", why=why)
    if largest <= LOOSELY * np.degrees(farthest):
        return UnitEvidence("deg", why=UNIT_REACHES(largest=largest, beyond=robot.id))
    for per_turn, name in ((CENTIDEGREES, "hundredths"), (MILLIDEGREES, "thousandths")):
        scale = 2 * np.pi / per_turn
        if inside(low * scale, high * scale, limits):
            why = UNIT_REACHES(largest=largest, model=robot.id, fits=name)
            meant = largest * scale >= LEAST_REACH and _fits_once(arm, low, high, limits)
            return UnitEvidence("counts", per_turn, meant, why)
    if largest >= LEAST_COUNTS and _is_whole(arm):
        for per_turn in COUNTS:
            scale = 2 * np.pi / per_turn
            if inside(low * scale, high * scale, limits):
                why = UNIT_REACHES(largest=largest, counted="counts")
                return UnitEvidence("counts", per_turn, False, why)
    return UnitEvidence("")


def _fits_once(arm: NDArray[Any], low: Array, high: Array, limits: Array) -> bool:
    """Say whether values are within the limits in one unit alone of those that are in use."""
    per_turn = [CENTIDEGREES, MILLIDEGREES, MILLIRADIANS, *(COUNTS if _is_whole(arm) else ())]
    largest = float(max(np.abs(low).max(), np.abs(high).max()))
    scales = [2 * np.pi / n for n in per_turn if largest * 2 * np.pi / n >= LEAST_REACH]
    return sum(inside(low * k, high * k, limits) for k in scales) == 1


def _is_whole(values: NDArray[Any]) -> bool:
    part = values[:: max(1, len(values) // 4096)]
    return bool((part == np.rint(part)).all())
