"""What the numbers and the name of one matrix say, before it is compared with others."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.evidence import cartesian, relations
from mrlab_ros.core.conversion.evidence import unit_range as units
from mrlab_ros.core.conversion.evidence.assessment import Assessment
from mrlab_ros.core.conversion.evidence.clock_columns import clocks_among
from mrlab_ros.core.conversion.evidence.names import Name
from mrlab_ros.core.conversion.evidence.units import DEGREES
from mrlab_ros.core.conversion.gripper import has_states, is_ramp
from mrlab_ros.core.conversion.named_columns import misnamed, names_joints
from mrlab_ros.core.conversion.workspace import Variable
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

# Mean step between samples over the range of a motion; unordered samples have about 1/3.
ROUGH = 0.15
ENOUGH_ROWS = 20
SMOOTH_ROWS = 20_000
NEAR_ZERO = 0.02  # of the range of a column
COARSE = 0.05  # rad from row to row: waypoints, not samples
# Rows of zeros at an end were never filled where the step to them is so large: rad, usual steps.
UNFILLED_LEAST, UNFILLED_FACTOR = 0.05, 5.0


def fits(variable: Variable, robot: RobotModel) -> bool:
    """Say whether the matrix has samples as rows and the robot's joints as columns.

    Columns that are named as joints count, in any order; their names have to be the robot's.
    """
    if variable.values is None or len(variable.shape) != 2 or variable.shape[0] < 2:
        return False
    if names_joints(variable, robot):
        return misnamed(variable, robot) is None
    return variable.shape[1] - len(robot.joints) in (0, 1)


def is_coarse(arm: NDArray[Any]) -> bool:
    """Say whether the rows of joint positions, (N, J) rad, are waypoints rather than samples."""
    near = arm[relations.busiest(arm, SMOOTH_ROWS)].astype(np.float64)
    steps = np.abs(np.diff(near, axis=0))[:, np.ptp(near, axis=0) > 1e-6]
    return bool(steps.size) and bool(np.median(steps, axis=0).max() > COARSE)


def measured(
    variable: Variable,
    name: Name,
    robot: RobotModel,
    vectors: dict[int, list[Variable]],
    rates: tuple[float, ...] = (),
) -> Assessment:
    """Return what the numbers and the name of one matrix say by themselves.

    rates: Hz, those that the file says for certain.
    """
    values = variable.values
    assert values is not None
    rows, columns = values.shape
    joints = len(robot.joints)
    with np.errstate(all="ignore"):
        low, high = (f(axis=0).astype(np.float64) for f in (values.min, values.max))
    finite = bool(np.isfinite(low).all() and np.isfinite(high).all())
    by_name = names_joints(variable, robot) and not variable.is_message
    does_fit = fits(variable, robot)
    base = Assessment(variable, name, low, high, finite, does_fit, by_name)
    if not finite or rows < 2:
        return base
    clocks = clocks_among(variable, robot, vectors, low, high, rates)
    base = replace(base, clocks=clocks)
    if not does_fit or by_name or variable.is_message:
        return base
    arm = values[:, :joints]
    steps = np.abs(np.diff(arm[relations.busiest(arm, SMOOTH_ROWS)].astype(np.float64), axis=0))
    span = high[:joints] - low[:joints]
    moving = span > 1e-6
    smooth = None
    if moving.any() and rows >= ENOUGH_ROWS:
        smooth = float((steps[:, moving].mean(axis=0) / span[moving]).mean()) <= ROUGH
    last_is_joint = False
    if columns > joints:
        last = values[:, joints]
        in_radians = float(np.abs([low[:joints], high[:joints]]).max()) <= units.LEAST_DEGREES
        last_is_joint = not (has_states(last) or (is_ramp(last) and in_radians))
    return replace(
        base,
        unit=units.evidence(
            arm, low[:joints], high[:joints], robot, "deg" if name.unit == DEGREES else ""
        ),
        unfilled=_unfilled(arm, steps),
        coarse=is_coarse(arm),
        still=not span.any(),
        smooth=smooth,
        between_zeros=_between_zeros(arm, span),
        last_is_joint=last_is_joint,
        poses=cartesian.evidence(values, robot),
    )


def _between_zeros(arm: NDArray[Any], span: Array) -> bool:
    """Say whether a matrix begins and ends near 0 in all of several columns that move."""
    moving = span > 1e-6
    if moving.sum() < 2 or len(arm) < ENOUGH_ROWS:
        return False
    ends = np.abs(arm[[0, -1]][:, moving].astype(np.float64)).max(axis=0)
    return bool((ends <= NEAR_ZERO * span[moving]).all() and not arm[0, ~moving].any())


def _unfilled(arm: NDArray[Any], steps: Array) -> tuple[int, int] | None:
    """Return the first and last row, from 1, of zeros at an end that the motion jumps to."""
    usual = float(np.quantile(steps.max(axis=1), 0.75)) if len(steps) else 0.0
    least = max(UNFILLED_LEAST, UNFILLED_FACTOR * usual)
    for backwards in (True, False):
        ordered = arm[::-1] if backwards else arm
        if ordered[0].any():
            continue
        filled = np.flatnonzero(ordered.any(axis=1))
        if not len(filled):
            return None
        zeros = int(filled[0])
        if zeros >= 2 and float(np.abs(ordered[zeros]).max()) > least:
            return (len(arm) - zeros + 1, len(arm)) if backwards else (1, zeros)
    return None
