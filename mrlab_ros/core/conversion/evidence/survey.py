"""Assesses the matrices of a file, each once, for discovery, layout, frame_rate and explain.

Each is measured by itself, then compared with the others: derivatives, twins, tool paths.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.evidence import relations
from mrlab_ros.core.conversion.evidence import unit_range as units
from mrlab_ros.core.conversion.evidence.assessment import (
    FEW_ROWS,
    NAME_SCORES,
    NEAR_ZERO,
    NO_POSES,
    Assessment,
    blocking_clocks,
    judged,
)
from mrlab_ros.core.conversion.evidence.glossary import Class
from mrlab_ros.core.conversion.evidence.headings import misnamed, name_of, names_joints, units_of
from mrlab_ros.core.conversion.evidence.names import (
    Hint,
    Name,
    describe,
    leaf,
    parts,
    word_of,
    words,
)
from mrlab_ros.core.conversion.evidence.other_columns import (
    clocks_among,
    has_states,
    is_ramp,
    time_vectors,
)
from mrlab_ros.core.conversion.evidence.rate_scalars import sure_rates
from mrlab_ros.core.conversion.evidence.units import DEGREES
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array


@dataclass(frozen=True, eq=False)
class Survey:
    """A workspace and what its matrices are, for one robot.

    columns_asked: a person chose the columns, so that one that may be time is a doubt alone.
    """

    workspace: Workspace
    robot: RobotModel
    fitting: tuple[Assessment, ...]
    columns_asked: bool = False
    _known: dict[int, Assessment] = field(default_factory=dict)

    def of(self, variable: Variable) -> Assessment:
        """Return the assessment of a matrix that has values, with what its company says."""
        known = self._known.get(id(variable))
        if known is None:
            alone = measured(
                variable, self.name(variable), self.robot, self.time_vectors, self.rates
            )
            known = judged(alone, self.robot)
            self._known[id(variable)] = known
        return known

    @cached_property
    def rates(self) -> tuple[float, ...]:
        """The rates, Hz, that numbers of the file say for certain."""
        return sure_rates(self.workspace)

    @cached_property
    def time_vectors(self) -> dict[int, list[Variable]]:
        return time_vectors(self.workspace)

    def name(self, variable: Variable) -> Name:
        """Return what the name of a variable says: its path, label, headings and units."""
        return name_of(variable, self.workspace.file_format, self.robot)

    def ranked(self) -> list[Assessment]:
        """Return the matrices that could be taken as they are, likeliest first.

        Those with NaN come last. Of equal ones those that were measured come before the actions
        that were asked for.
        """
        found = [
            a for a in self.fitting if self.columns_asked or not blocking_clocks(a, self.robot)
        ]
        return sorted(found, key=lambda a: (not a.finite, -a.points, a.path.startswith("action")))


def survey(workspace: Workspace, robot: RobotModel, *, columns_asked: bool = False) -> Survey:
    """Assess the matrices of a workspace that fit the robot, each once, and one with another."""
    vectors = time_vectors(workspace)
    fitting = [v for v in workspace.variables if fits(v, robot)]
    form = workspace.file_format
    rates = sure_rates(workspace)
    found = {v.path: measured(v, name_of(v, form, robot), robot, vectors, rates) for v in fitting}
    relate(found, workspace, robot)
    assessed = {path: judged(a, robot) for path, a in found.items()}
    known = {id(v): assessed[v.path] for v in fitting}
    return Survey(workspace, robot, tuple(assessed.values()), columns_asked, known)


# Mean step between samples over the range of a motion; unordered samples have about 1/3.
ROUGH = 0.15
ENOUGH_ROWS = 20
SMOOTH_ROWS = 20_000
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
    stated = units_of(variable, range(joints))  # poses have no unit of angles in each column
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
        poses=relations.evidence(values, robot) if None in stated else NO_POSES,
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


# Two matrices are the same motion, measured and commanded, where they differ by less, rad.
SAME_MOTION = 0.15
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
    differ = [word_of(part) for part in a ^ b]
    return bool(differ) and all(word.can_be(Class.ROLE) for word in differ)


def _claims_poses(variable: Variable) -> bool:
    """Say whether a matrix is named as the path of the tool, or holds transforms named so."""
    if describe(variable.path).what == "poses":
        return True
    return variable.values is not None and (
        relations.is_transforms(variable.values)
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
