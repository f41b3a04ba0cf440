"""Lays the matrix that was chosen out as the robot's joints: what `Options` ask for, and names."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion import limits as conversion_limits
from mrlab_ros.core.conversion.candidates import (
    between_ends,
    fits,
    is_gripper,
    is_time,
)
from mrlab_ros.core.conversion.explain import near_miss
from mrlab_ros.core.conversion.named_columns import order
from mrlab_ros.core.conversion.options import Options, parse_columns
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.diagnostics import Diagnostic, Refused, finding
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

# Two turns: radians that went astray by a full turn stay below it, degrees of a motion do not.
LEAST_DEGREES = 4 * np.pi


@dataclass(frozen=True, eq=False)
class Layout:
    """The samples of a trajectory, K rows.

    arm: (K, J) rad, in the robot's order. gripper: (K,) true where closed, or None. times: the
    column that holds time, s, or None. source_columns: which columns of the variable, from 0,
    the joints were.
    """

    arm: Array
    gripper: NDArray[np.bool_] | None
    times: NDArray[Any] | None
    source_columns: list[int]


def reshaped(workspace: Workspace, options: Options) -> Workspace:
    """Return the workspace as it is once the options that change a shape were applied.

    Matrices that lack the columns are left out: they cannot be what was meant.
    """
    if not (options.transpose or options.columns):
        return workspace
    laid_out = []
    for v in workspace.variables:
        if v.values is None or v.values.size == 1 or 1 in v.shape:
            laid_out.append(v)
            continue
        try:
            laid_out.append(_reshaped(v, options)[0])
        except Refused:
            continue
    return replace(workspace, variables=tuple(laid_out))


def _reshaped(variable: Variable, options: Options) -> tuple[Variable, list[int]]:
    """Return the variable after `transpose` and `columns`, and which columns those were."""
    values, names = variable.values, variable.columns
    assert values is not None
    if options.transpose:
        values, names = values.T, ()
    picked = list(range(values.shape[1]))
    if options.columns:
        picked = parse_columns(options.columns, values.shape[1], variable.path, variable.size)
        values = values[:, picked]
        # numbers overrule headings; the joints of a message keep their names
        names = tuple(names[i] for i in picked) if variable.is_message and names else ()
    return replace(variable, values=values, shape=values.shape, columns=names), picked


def lay_out(
    variable: Variable, options: Options, robot: RobotModel, notes: list[Diagnostic]
) -> Layout:
    """Return the samples in `variable`, saying in `notes` what was done to them.

    Raises Refused where they do not fit the robot.
    """
    path, joints = variable.path, len(robot.joints)
    if variable.values is None or min(variable.shape) == 0:
        raise Refused(_misfit(variable, robot))
    laid_out, picked = _reshaped(variable, options)
    values, times = laid_out.values, None
    assert values is not None
    if options.transpose:
        notes.append(finding("option_applied", variable=path, what=f"'{path}' was transposed"))
    if options.columns:
        first = (variable.values.T if options.transpose else variable.values)[:, 0]
        if 0 not in picked and is_time(first):
            times = first
        what = f"columns {options.columns} of '{path}' were taken"
        notes.append(finding("option_applied", variable=path, what=what))
    if not fits(laid_out, robot):
        raise Refused(_misfit(laid_out, robot))
    by_name, said = order(laid_out, robot)
    notes += said
    values = values[:, by_name]
    bad = conversion_limits.non_finite(values, path)
    if bad is not None:
        raise Refused(bad)
    if not options.columns:
        miss = near_miss(laid_out, robot)
        if miss is not None and miss.code == "time_column":
            raise Refused(miss)
    arm = np.array(values[:, :joints], dtype=np.float64, order="C")
    gripper = None
    if values.shape[1] > joints:
        gripper = _gripper(values[:, joints], options, robot, path, notes)
    arm = _in_radians(arm, options, robot, path, notes)
    return Layout(arm, gripper, times, [picked[i] for i in by_name[:joints]])


def _misfit(variable: Variable, robot: RobotModel) -> Diagnostic:
    joints = len(robot.joints)
    return near_miss(variable, robot) or finding(
        "wrong_shape",
        variable=variable.path,
        size=" ".join(filter(None, (variable.size, variable.kind))),
        robot=robot.id,
        joints=joints,
        more=joints + 1,
        hint="",
    )


def _gripper(
    column: NDArray[Any], options: Options, robot: RobotModel, path: str, notes: list[Diagnostic]
) -> NDArray[np.bool_]:
    """Return true where closed: above the middle of the column's range, open if it is constant."""
    low, high = float(column.min()), float(column.max())
    joints = len(robot.joints)
    place = {"variable": path, "where": f"column {joints + 1}"}
    if low == high:
        notes.append(finding("gripper_constant", first=low, **place))
        return np.zeros(len(column), dtype=np.bool_)
    if not options.columns and not is_gripper(column):
        levels = f"{len(np.unique(column))} values"
        words: dict[str, Any] = {"first": float(column[0]), "last": float(column[-1])}
        words |= {"levels": levels, "robot": robot.id, "joints": joints, "column": joints + 1}
        raise Refused(finding("seven_axes", **place, **words))
    threshold = (low + high) / 2
    words = {"first": low, "last": high, "threshold": threshold}
    if (low, high) != (0.0, 1.0):
        notes.append(finding("gripper_range", **place, **words))
    between = between_ends(column)
    if between:
        count = conversion_limits.counted(between, "sample")
        notes.append(finding("gripper_between", count=count, rows=len(column), **place, **words))
    return np.asarray(column > threshold)


def _in_radians(
    arm: Array, options: Options, robot: RobotModel, path: str, notes: list[Diagnostic]
) -> Array:
    """Apply the options that change values; raise Refused where degrees were not declared."""
    limits = np.array([(j.lower, j.upper) for j in robot.joints])
    if options.degrees:
        np.radians(arm, out=arm)
        what = f"'{path}' was taken as degrees"
        notes.append(finding("option_applied", variable=path, what=what))
    else:
        ends = np.array([arm.min(axis=0), arm.max(axis=0)])
        low, high = np.radians(ends)
        inside = (low >= limits[:, 0]).all() and (high <= limits[:, 1]).all()
        largest = float(np.abs(ends).max())
        if inside and largest > max(LEAST_DEGREES, 2 * float(np.abs(limits).max())):
            raise Refused(finding("degrees", variable=path, value=largest, robot=robot.id))
    if options.unwrap:
        arm = np.unwrap(arm, axis=0)
        what = f"jumps of 2*pi in '{path}' were removed"
        notes.append(finding("option_applied", variable=path, what=what))
    return arm
