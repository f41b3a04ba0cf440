"""Checks of a joint trajectory against a robot's limits; each finding names joint and frame."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.diagnostics import Diagnostic, finding
from mrlab_ros.core.robots.model import Joint

Array = NDArray[np.float64]

# rad; what a limit may be passed by, as its decimals in a data sheet are rounded
LIMIT_TOLERANCE = 1e-4
FULL_TURN = 2 * np.pi
# A jump is a step that is this many times what the joint could do between two frames,
JUMP_VELOCITY_FACTOR = 3.0
# and this many times the joint's own usual step (its 95th percentile),
JUMP_USUAL_FACTOR = 10.0
# and at least so large, rad.
JUMP_LEAST = 0.25
# A step of this many rad from a full turn is one (an arm moves on while its angle wraps).
TURN_TOLERANCE = 0.5


def counted(number: int, noun: str) -> str:
    """Return '1 value' or '3 values'."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def non_finite(values: NDArray[Any], variable: str) -> Diagnostic | None:
    """Return the finding where `values`, (N, d), hold NaN or Inf."""
    # The sum is finite unless something in it is not (or overflows, which the full look sorts
    # out), and needs no temporary of the matrix' size.
    with np.errstate(all="ignore"):
        if np.isfinite(values.sum(dtype=np.float64)):
            return None
    bad = np.argwhere(~np.isfinite(values))
    if not len(bad):
        return None
    row, column = bad[0] + 1
    where = f"row {row}, column {column}"
    return finding("non_finite", variable=variable, where=where, count=counted(len(bad), "value"))


def _place(frame: int, column: int) -> str:
    return f"row {frame + 1}, column {column + 1}"


def against_robot(
    positions: Array, frame_rate: float, joints: Sequence[Joint], variable: str, robot: str
) -> list[Diagnostic]:
    """Check positions, (N, J) rad in the order of `joints`, sampled at `frame_rate` Hz.

    One finding a joint and kind at most, of its worst frame; frames count from 0.
    """
    findings: list[Diagnostic] = []
    for column, joint in enumerate(joints):
        q = np.ascontiguousarray(positions[:, column])
        findings += _range(q, column, joint, frame_rate, variable)
        findings += _steps(q, column, joint, frame_rate, variable, robot)
    return findings


def _range(
    q: Array, column: int, joint: Joint, frame_rate: float, variable: str
) -> list[Diagnostic]:
    lower, upper = joint.lower - LIMIT_TOLERANCE, joint.upper + LIMIT_TOLERANCE
    low, high = float(q.min()), float(q.max())
    if lower <= low and high <= upper:
        return []
    frame = int(q.argmin() if lower - low > high - upper else q.argmax())
    outside = int(np.count_nonzero((q < lower) | (q > upper)))
    return [
        finding(
            "joint_limit",
            variable=variable,
            where=_place(frame, column),
            joint=joint.name,
            degrees=np.degrees(q[frame]),
            frame=frame,
            time=frame / frame_rate,
            lower=joint.lower,
            upper=joint.upper,
            count=counted(outside, "frame"),
            first_row=frame + 1,
            last_row=frame + 1,
            value=float(q[frame]),
            limit=joint.upper if q[frame] > upper else joint.lower,
            unit="rad",
        )
    ]


def _steps(
    q: Array, column: int, joint: Joint, frame_rate: float, variable: str, robot: str
) -> list[Diagnostic]:
    steps = np.abs(np.diff(q))
    reach = joint.max_velocity / frame_rate
    frame = int(steps.argmax())
    largest = float(steps[frame])
    if not largest > reach * 1.01:
        return []
    place: dict[str, Any] = {
        "variable": variable,
        "where": _place(frame, column),
        "joint": joint.name,
    }
    place |= {"frame": frame, "time": frame / frame_rate}
    usual = float(np.quantile(steps, 0.95))
    isolated = largest > max(reach * JUMP_VELOCITY_FACTOR, usual * JUMP_USUAL_FACTOR, JUMP_LEAST)
    if isolated and abs(largest - FULL_TURN) < TURN_TOLERANCE:
        return [finding("jump_2pi", value=largest, **place)]
    # A handful of waypoints has no usual step that one could stand out from.
    if isolated and len(steps) >= 10:
        return [finding("discontinuity", value=largest, usual=usual, **place)]
    return [
        finding(
            "velocity_limit",
            value=largest * frame_rate,
            limit=joint.max_velocity,
            rate=frame_rate,
            robot=robot,
            count=counted(int(np.count_nonzero(steps > reach * 1.01)), "step"),
            **place,
        )
    ]
