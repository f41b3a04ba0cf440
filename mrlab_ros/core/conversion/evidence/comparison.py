"""What the matrices of a file say about one another: derivatives, twins, paths of the tool."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.evidence import cartesian, relations
from mrlab_ros.core.conversion.evidence.assessment import Assessment
from mrlab_ros.core.conversion.evidence.names import Hint, describe, leaf, parts, words
from mrlab_ros.core.conversion.evidence.scoring import FEW_ROWS, NAME_SCORES
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel

# Two matrices are the same motion, measured and commanded, where they differ by less, rad.
SAME_MOTION = 0.15
MEASURED_OR_COMMANDED = words(
    "actual act measured meas ist target desired des ref reference soll cmd command commanded "
    "current present set setpoint demand goal feedback fb"
)
# What 4 x 4 x N transforms of the tool are called, beside the names of poses.
TRANSFORM_NAMES = words("t ts tt te tee th tform tforms transform transforms htm fk fkine")
# How many matrices are compared with one another.
MOST_COMPARED, MOST_POSES = 8, 4


def relate(found: dict[str, Assessment], workspace: Workspace, robot: RobotModel) -> None:
    """Add to the assessments what the matrices say about one another."""
    joints = len(robot.joints)
    usable = [
        a
        for a in found.values()
        if a.finite and not a.variable.is_message and not a.still and a.rows >= FEW_ROWS
    ]
    usable.sort(key=lambda a: -NAME_SCORES[a.name.hint])
    compared = usable[:MOST_COMPARED]
    _relate_derivatives(found, compared, workspace, joints)
    _relate_twins(found, compared, joints)
    if robot.chain is not None:
        _relate_poses(found, compared, workspace, robot)


def _relate_derivatives(
    found: dict[str, Assessment], compared: list[Assessment], workspace: Workspace, joints: int
) -> None:
    shorter = [
        v
        for v in workspace.variables
        if v.values is not None
        and len(v.shape) == 2
        and v.shape[1] == joints
        and any(v.shape[0] == a.rows - 1 for a in compared)
    ][:MOST_COMPARED]
    derivatives: dict[tuple[str, str], float] = {}
    for rows in {a.rows for a in compared}:
        same = [a for a in compared if a.rows == rows]
        short = [v for v in shorter if v.shape[0] == rows - 1]
        if len(same) + len(short) < 2:
            continue
        part = relations.busiest(same[0].values)
        courses = {a.path: relations.course(a.values[:, :joints], part) for a in same}
        of_short = {v.path: relations.course(_matrix(v), part) for v in short}
        for path, first in courses.items():
            for other, course in (*courses.items(), *of_short.items()):
                if first is None or course is None or other == path:
                    continue
                rate = relations.derivative_rate(first, course, shorter=other in of_short)
                if rate is not None:
                    derivatives[path, other] = rate
    for (path, derivative), rate in derivatives.items():
        if (derivative, path) in derivatives:
            continue  # exponentials are derivatives of one another
        own = found[path]
        found[path] = replace(own, rates=(*own.rates, (derivative, rate)))
        if derivative in found:
            found[derivative] = replace(found[derivative], velocity_of=path)
    for path, own in found.items():
        if own.velocity_of and found[own.velocity_of].velocity_of:
            found[path] = replace(own, is_acceleration=True)


def _matrix(variable: Variable) -> NDArray[Any]:
    assert variable.values is not None
    return variable.values


def _relate_twins(found: dict[str, Assessment], compared: list[Assessment], joints: int) -> None:
    for i, a in enumerate(compared):
        for b in compared[i + 1 :]:
            if _are_equal(a, b):
                found[a.path] = replace(found[a.path], copies=(*found[a.path].copies, b.path))
                found[b.path] = replace(found[b.path], copies=(*found[b.path].copies, a.path))
                continue
            if a.rows != b.rows or found[b.path].twin or not _are_twins(a.path, b.path):
                continue
            rows = np.linspace(0, a.rows - 1, min(a.rows, 256)).astype(int)
            one, other = (m.values[rows, :joints].astype(np.float64) for m in (a, b))
            moves = float(np.ptp(one, axis=0).max())
            if float(np.abs(one - other).max()) <= min(SAME_MOTION, 0.25 * moves):
                found[b.path] = replace(found[b.path], twin=a.path)
                found[a.path] = replace(found[a.path], twin=b.path)


def _are_equal(a: Assessment, b: Assessment) -> bool:
    """Say whether two matrices, columns by columns, hold the same numbers in the same unit."""
    if a.values.shape != b.values.shape or a.variable.units != b.variable.units:
        return False
    rows = np.linspace(0, a.rows - 1, min(a.rows, 64)).astype(int)
    if not np.array_equal(a.values[rows], b.values[rows]):
        return False
    return bool(np.array_equal(a.values, b.values))


def _are_twins(one: str, other: str) -> bool:
    """Say whether two names differ in words for measured and commanded alone."""
    a, b = ({*parts(path)} for path in (one, other))
    return bool(a != b and (a ^ b) <= MEASURED_OR_COMMANDED)


def _claims_poses(variable: Variable) -> bool:
    """Say whether a matrix is named as the path of the tool, or holds transforms named so."""
    if describe(variable.path).what == "poses":
        return True
    return variable.values is not None and (
        cartesian.is_transforms(variable.values)
        and "".join(parts(leaf(variable.path))).rstrip("0123456789") in TRANSFORM_NAMES
    )


def _relate_poses(
    found: dict[str, Assessment],
    compared: list[Assessment],
    workspace: Workspace,
    robot: RobotModel,
) -> None:
    joints = len(robot.joints)
    lengths = {a.rows for a in compared}
    posed = []
    for v in workspace.variables:
        if v.values is None or 1 in v.shape:
            continue
        own = found.get(v.path)
        if own is not None and not (
            own.name.what == "poses" or own.poses.possible or own.poses.strong
        ):
            continue
        points = relations.tool_points(v.values)
        if points is not None and len(points) in lengths:
            posed.append((v, points))
    posed.sort(key=lambda pair: not _claims_poses(pair[0]))
    for a in compared[:MOST_POSES]:
        own = found[a.path]
        if own.velocity_of or own.unit.unit not in ("rad", "deg") or own.name.hint is Hint.AGAINST:
            continue
        rows = relations.rows_to_compare(a.rows)
        arm = a.values[rows, :joints].astype(np.float64)
        poses = robot.chain.tool0(np.radians(arm) if own.unit.unit == "deg" else arm)
        for v, points in posed[:MOST_POSES]:
            if v.path == a.path or len(points) != a.rows:
                continue
            match = relations.compare_poses(poses, points[rows])
            if match is None:
                continue
            if match.agrees:
                found[a.path] = own = replace(own, tool_path=v.path, other_tool_path=None)
                if v.path in found:
                    found[v.path] = replace(found[v.path], tool_of=a.path)
            elif match.differs and _claims_poses(v) and not own.tool_path:
                found[a.path] = own = replace(own, other_tool_path=(v.path, match))
