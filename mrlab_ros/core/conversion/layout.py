"""Lays the matrix that was chosen out as the robot's joints, by names and by what columns hold."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion import motion_checks
from mrlab_ros.core.conversion.candidates import matlab_name
from mrlab_ros.core.conversion.diagnostics import (
    COLUMNS_APPLIED,
    DOUBTFUL_VALUES,
    GRIPPER_APPLIED,
    GRIPPER_ASSUMED,
    GRIPPER_BESIDE,
    GRIPPER_BETWEEN,
    GRIPPER_CONSTANT,
    GRIPPER_OPENS,
    GRIPPER_OUT_OF_RANGE,
    GRIPPER_UNMOVED,
    INVERT_APPLIED,
    MAY_BE_TIME,
    NEVER_FILLED,
    REPEATED_COLUMNS,
    ROWS_NOT_FILLED,
    SEVEN_AXES,
    TRANSPOSE_APPLIED,
)
from mrlab_ros.core.conversion.evidence import other_columns as grippers
from mrlab_ros.core.conversion.evidence import statements
from mrlab_ros.core.conversion.evidence.assessment import Assessment, blocking_clocks
from mrlab_ros.core.conversion.evidence.glossary import Class
from mrlab_ros.core.conversion.evidence.headings import names_joints, order
from mrlab_ros.core.conversion.evidence.joining import first_path, rows_of
from mrlab_ros.core.conversion.evidence.names import described
from mrlab_ros.core.conversion.evidence.survey import Survey, fits
from mrlab_ros.core.conversion.explain import clocks_of, near_miss, time_finding, wrong_shape
from mrlab_ros.core.conversion.joint_units import in_radians
from mrlab_ros.core.conversion.options import NO_GRIPPER, Options, columns_text
from mrlab_ros.core.conversion.picking import Chosen
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

# a column that moves less does not move
ROUNDING = 1e-9
# Words of a heading under which 1 means open.
OPENING = frozenset(
    ("open", "opened", "opening", "offen", "geoeffnet", "oeffnung", "ouvert", "ouverte",
     "ouverture", "abierto", "abierta", "apertura", "aperto", "aperta", "aberto", "aberta", "acik")
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Layout:
    """The samples of a trajectory, K rows.

    arm: (K, J) rad, in the robot's order. gripper: (K,) true where closed, or None. times: the
    column that holds time, as MATLAB writes it and as stored, or None. source_columns: which
    columns of the variable, from 0, the joints were. scale: what the joints, or each of them, were
    multiplied by to be rad or m.
    """

    arm: Array
    gripper: NDArray[np.bool_] | None
    times: tuple[str, NDArray[Any]] | None
    source_columns: list[int]
    scale: float | Array = 1.0


def lay_out(chosen: Chosen, survey: Survey, options: Options, notes: list[Diagnostic]) -> Layout:
    """Return the samples of the chosen matrix, adding to `notes` what was done to them.

    Raises BadInput where they do not fit the robot.
    """
    robot = survey.robot
    variable, path, joints = chosen.variable, chosen.variable.path, len(robot.joints)
    values, times = variable.values, None
    if values is None or min(variable.shape) == 0 or len(variable.shape) != 2:
        raise BadInput(_misfit(variable, survey))
    if options.transpose:
        notes.append(TRANSPOSE_APPLIED(variable=path))
    if options.columns:
        times = _left_out_time(chosen, options, survey)
        notes.append(COLUMNS_APPLIED(variable=path, columns=options.columns))
        if len(set(chosen.picked)) < len(chosen.picked):
            why = REPEATED_COLUMNS(columns=options.columns)
            notes.append(DOUBTFUL_VALUES(variable=path, why=[why]))
    if chosen.gripper is not None:
        notes.append(GRIPPER_APPLIED(variable=path, gripper=options.gripper))
    named = names_joints(variable, robot)
    separate = chosen.gripper is not None and not named
    if not fits(variable, robot) or (separate and variable.shape[1] != joints):
        raise BadInput(_misfit(variable, survey))
    by_name, said = order(variable, robot)
    notes += said
    assessment = survey.of(variable)
    if not variable.is_message and not assessment.by_name:
        _refuse_unfilled(assessment, transposed=options.transpose)
    values = values[:, by_name]
    bad = motion_checks.non_finite(values, path)
    if bad is not None:
        raise BadInput(bad)
    _refuse_times(assessment, survey, notes)
    arm = np.array(values[:, :joints], dtype=np.float64, order="C")
    column = chosen.gripper
    if column is None and values.shape[1] > joints and not chosen.without_gripper:
        column = values[:, joints]
        if np.ptp(column) < ROUNDING:
            column = column.round(9) + 0.0  # no -0
        elif not (options.columns or options.gripper) and assessment.last_is_joint:
            raise BadInput(_seven_axes(values, robot, path))
        if len(variable.columns) == values.shape[1] and not (
            options.columns or options.gripper or options.invert
        ):
            column = _as_headed(variable.columns[by_name[joints]], column, notes)
    if column is None and not chosen.without_gripper:
        column = _gripper_beside(survey.workspace, path, len(arm), notes)
    held = None if column is None else _gripper(column, options, path, chosen, joints, notes)
    stated = statements.about(survey.workspace, first_path(path))
    arm, scale = in_radians(arm, options, assessment, robot, stated, notes, by_name[:joints])
    return Layout(arm, held, times, [chosen.picked[i] for i in by_name[:joints]], scale)


def _left_out_time(
    chosen: Chosen, options: Options, survey: Survey
) -> tuple[str, NDArray[Any]] | None:
    """Return the column of time among those that were not picked, or None."""
    stored = chosen.stored
    assert stored.values is not None
    if options.transpose:
        flipped = stored.values.T
        stored = replace(stored, values=flipped, shape=flipped.shape, columns=())
    clocks = [c for c in clocks_of(stored, survey) if c.index not in chosen.picked]
    if clocks:
        assert stored.values is not None
        column = clocks[0].index
        part = f"{column + 1}, :" if options.transpose else f":, {column + 1}"
        return f"{stored.path}({part})", np.asarray(stored.values[:, column])
    return None


def _refuse_times(assessment: Assessment, survey: Survey, notes: list[Diagnostic]) -> None:
    """Refuse columns of time among the joints; those that were asked for are a warning."""
    clocks = blocking_clocks(assessment, survey.robot)
    if clocks and not survey.columns_asked:
        raise BadInput(time_finding(assessment.variable, clocks, survey.robot))
    if clocks and not any(d.code == "doubtful_values" for d in notes):
        why = MAY_BE_TIME(column=clocks[0].index + 1, why=clocks[0].why)
        notes.append(DOUBTFUL_VALUES(variable=assessment.path, why=[why]))


def _refuse_unfilled(assessment: Assessment, *, transposed: bool) -> None:
    path, rows = assessment.path, assessment.rows
    if assessment.finite and not (assessment.low.any() or assessment.high.any()):
        size = assessment.variable.size
        raise BadInput(NEVER_FILLED(variable=path, size=size, last_row=rows))
    if assessment.unfilled is not None:
        first, last = assessment.unfilled
        begin, end = (last + 1, rows) if first == 1 else (1, first - 1)
        kept = f"{path}(:, {begin}:{end})" if transposed else rows_of(path, begin, end)
        raise BadInput(
            ROWS_NOT_FILLED(
                variable=path,
                first_row=first,
                last_row=last,
                value=0.0,
                count=last - first + 1,
                fixes=(Fix("variable", kept, f"q = {kept};"),),
            )
        )


def _misfit(variable: Variable, survey: Survey) -> Diagnostic:
    size = " ".join(filter(None, (variable.size, variable.kind)))
    return near_miss(variable, survey) or wrong_shape(variable, survey.robot, size=size)


def _seven_axes(values: NDArray[Any], robot: RobotModel, path: str) -> Diagnostic:
    joints = len(robot.joints)
    column, name = values[:, joints], matlab_name(path)
    found = grippers.meaning(column)
    switching = [c for c in range(joints) if _is_gripper(values[:, c])]
    alone = Fix("columns", f"1:{joints}", f"q = {name}(:, 1:{joints});")
    fixes: tuple[Fix, ...] = (alone, Fix(matlab=f"plot({name}(:, {joints + 1}))"))
    if len(switching) == 1:
        place = switching[0]
        others = columns_text([c for c in range(joints + 1) if c != place])
        line = f"q = [{name}(:, {others}) {name}(:, {place + 1})];"
        fixes = (Fix("gripper", str(place + 1), line),)
    elif found:
        line = (
            f"q = [{name}(:, 1:{joints}) {name}(:, end) > {(column.min() + column.max()) / 2:g}];"
        )
        fixes = (Fix("gripper", str(joints + 1), line), alone)
    return SEVEN_AXES(
        variable=path,
        first_row=1,
        last_row=len(column),
        column=joints + 1,
        first=float(column.min()),
        last=float(column.max()),
        levels=len(np.unique(column)),
        model=robot.id,
        joints=joints,
        meaning=found.meaning if found else "",
        fixes=fixes,
    )


def _as_headed(heading: str, column: NDArray[Any], notes: list[Diagnostic]) -> NDArray[Any]:
    """Return a gripper's column, turned round where its heading says that 1 is open."""
    words = described(heading)
    if OPENING & {w.text for w in words} and set(np.unique(column).tolist()) <= {0.0, 1.0}:
        notes.append(GRIPPER_OPENS(heading=heading, fixes=(Fix("invert", "true"),)))
        return 1.0 - column
    if not any(w.can_be(Class.GRIPPER) for w in words):
        notes.append(GRIPPER_ASSUMED(heading=heading, fixes=(Fix("gripper", NO_GRIPPER),)))
    return column


def _is_gripper(column: NDArray[Any]) -> bool:
    """Say whether a column switches between the two ends of a gripper's range."""
    return len(np.unique(column)) == 2 and grippers.meaning(column) is not None


def _gripper(
    column: NDArray[Any],
    options: Options,
    path: str,
    chosen: Chosen,
    joints: int,
    notes: list[Diagnostic],
) -> NDArray[np.bool_]:
    """Return true where closed: above the middle of the column's range, open if it is constant.

    With the option invert, closed is below the middle.
    """
    if not np.isfinite(column).all():
        bad = motion_checks.non_finite(column.reshape(-1, 1), options.gripper or path)
        assert bad is not None
        raise BadInput(bad)
    low, high = float(column.min()), float(column.max())
    if options.invert:
        notes.append(INVERT_APPLIED(variable=path))
    if low == high:
        code = GRIPPER_UNMOVED if low else GRIPPER_CONSTANT
        alone = Fix("gripper", NO_GRIPPER, f"q = {matlab_name(path)}(:, 1:{joints});")
        notes.append(code(variable=path, value=low, fixes=(alone,) if low else ()))
        return np.zeros(len(column), dtype=np.bool_)
    threshold = (low + high) / 2
    above = np.asarray(column > threshold)
    closed = ~above if options.invert else above
    side = "below" if options.invert else "above"
    numbers: dict[str, Any] = {"first": low, "last": high, "threshold": threshold, "side": side}
    numbers["variable"] = path
    name = matlab_name(path)
    if (low, high) != (0.0, 1.0):
        found = grippers.meaning(column)
        invert = Fix(
            "invert",
            "false" if options.invert else "true",
            f"{name}(:, end) = 1 - {name}(:, end);",
        )
        states = Fix(matlab=f"{name}(:, end) = {name}(:, end) > {threshold:g};")
        if not (options.invert and found):
            fixes = (invert, states) if found and found.opens else (states, invert)
            meaning = found.meaning if found else ""
            notes.append(GRIPPER_OUT_OF_RANGE(meaning=meaning, value=high, fixes=fixes, **numbers))
    between = grippers.between_ends(column)
    if between:
        rows = len(column)
        states = Fix(matlab=f"{name}(:, end) = {name}(:, end) > {threshold:g};")
        notes.append(GRIPPER_BETWEEN(count=between, rows=rows, fixes=(states,), **numbers))
    return closed


def _gripper_beside(
    workspace: Workspace, path: str, rows: int, notes: list[Diagnostic]
) -> NDArray[Any] | None:
    """Return a vector of states, 0 and 1, whose name says a gripper and nothing else, or None.

    Another vector that may be the gripper is said in `notes`.
    """
    for v in workspace.variables:
        if v.values is None or v.values.size != rows or min(v.shape) != 1:
            continue
        words = described(v.label or v.path)
        opens = bool(OPENING & {w.text for w in words}) and len(np.unique(v.values)) == 2
        if not (opens or any(word.can_be(Class.GRIPPER) for word in words)):
            continue
        plain = all(w.can_be(Class.GRIPPER, Class.KEPT, Class.PLACE) for w in words) and not opens
        if plain and set(np.unique(v.values).tolist()) == {0.0, 1.0}:
            notes.append(GRIPPER_APPLIED(variable=path, gripper=v.path))
            return v.values.reshape(-1)
        column = f"{'1 - ' if opens else ''}{matlab_name(v.path)}(:)"
        line = f"q = [{matlab_name(path)} {column}]; save('traj.mat', 'q', '-v7')"
        fix = Fix(matlab=line) if opens else Fix("gripper", v.path, line)
        notes.append(GRIPPER_BESIDE(variable=v.path, size=v.size, fixes=(fix,)))
        return None
    return None
