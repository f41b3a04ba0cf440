"""Says what keeps a workspace or one of its variables from being the trajectory."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from mrlab_ros.core.base.diagnostic import Code, Diagnostic, Fix
from mrlab_ros.core.conversion.candidates import (
    MOST_INSIDE,
    OBJECT_CODE,
    OPENED,
    contents,
    matlab_name,
    saving,
)
from mrlab_ros.core.conversion.diagnostics import (
    BAD_MESSAGE,
    CANDIDATE,
    EMPTY,
    FUNCTION_HANDLE,
    INSIDE_CONTAINER,
    LOOKS_LIKE,
    NEVER_FILLED,
    NO_TRAJECTORY,
    NOT_REAL,
    RECORDED_STATES,
    SINGLE_SAMPLE,
    TIME_COLUMN,
    TRANSFORMS,
    TRANSPOSED,
    UNKNOWN_CLASS,
    UNSUPPORTED_OBJECT,
    WRONG_CLASS,
    WRONG_SHAPE,
)
from mrlab_ros.core.conversion.evidence import relations
from mrlab_ros.core.conversion.evidence.assessment import FEW_ROWS, Assessment, blocking_clocks
from mrlab_ros.core.conversion.evidence.headings import misnamed
from mrlab_ros.core.conversion.evidence.joining import Series, series, unequal, unequal_series
from mrlab_ros.core.conversion.evidence.names import Hint
from mrlab_ros.core.conversion.evidence.other_columns import (
    ClockColumn,
    clocks_among,
    has_states,
    is_datevec,
)
from mrlab_ros.core.conversion.evidence.relations import is_transforms
from mrlab_ros.core.conversion.evidence.survey import Survey
from mrlab_ros.core.conversion.options import columns_text
from mrlab_ros.core.conversion.picking import page_line
from mrlab_ros.core.conversion.workspace import (
    JOINT_STATE,
    Variable,
    Workspace,
    shortened,
)
from mrlab_ros.core.robots.model import RobotModel

MOST_MISSES = 200
MOST_SHOWN = 5


def holds_samples(variable: Variable, hint: Hint) -> bool:
    """Say whether the object is of a class made to hold numbers, or is named like positions."""
    kind = variable.kind
    if kind in OBJECT_CODE or kind.startswith(("Simulink.", "timeseries", "tscollection")):
        return True
    return hint.of_joints and not re.search(
        r"link|robot|tree|quaternion|^se[23]$|^so[23]$|camera", kind, re.I
    )


def object_finding(code: Code, objects: list[Variable], file: str) -> Diagnostic:
    """Return a finding that lists objects by name and class, with the MATLAB line for one."""
    ordered = sorted(objects, key=lambda v: (v.kind not in OBJECT_CODE, v.path))
    listed = shortened([f"{v.path} ({v.kind})" for v in ordered], MOST_INSIDE)
    first = ordered[0]
    line = OBJECT_CODE.get(first.kind, "q = ...; save('traj.mat', 'q', '-v7')").format(
        name=matlab_name(first.path)
    )
    is_function = first.kind == "function_handle"
    why = first.note or (FUNCTION_HANDLE() if is_function else UNKNOWN_CLASS())
    fixes = (Fix(matlab=line),)
    return code(variable=first.path, file=file, objects=listed, why=why, fixes=fixes)


def refusal(survey: Survey, file: str) -> Diagnostic:
    """Say why nothing in the workspace could be the trajectory, by the nearest miss."""
    workspace, robot = survey.workspace, survey.robot
    joints = len(robot.joints)
    ranks = {Hint.POSITIONS: 0, Hint.PARTLY: 0, Hint.TWO_FACED: 1, Hint.NEUTRAL: 1}
    misses: list[tuple[int, Diagnostic]] = []
    for v in workspace.variables:
        rank = ranks.get(survey.name(v).hint, 9)
        if (
            rank == 9
            or v.kind == JOINT_STATE
            or not (v.is_message or not re.search(r"[({]\d", v.path))
        ):
            continue
        miss = near_miss(v, survey)
        if miss is not None:
            misses.append((rank, miss))
        if len(misses) >= MOST_MISSES:
            break
    misses.sort(key=lambda pair: pair[0])
    opaque = [
        v for v in workspace.variables if v.is_object and holds_samples(v, survey.name(v).hint)
    ]
    named = [miss for rank, miss in misses if rank == 0 and miss.code != "wrong_shape"]
    if named:
        return named[0]
    pieces = series(workspace, joints)
    if pieces:
        return _in_pieces(pieces[0], workspace)
    differing = unequal_series(workspace, joints)
    if differing:
        return unequal(differing)
    named = [miss for rank, miss in misses if rank == 0]
    if named:
        return named[0]
    if opaque and (any(survey.name(v).hint.of_joints for v in opaque) or not misses):
        return object_finding(UNSUPPORTED_OBJECT, opaque, file)
    if misses:
        return misses[0][1]
    states = _states(survey)
    if states is not None:
        return states
    poses = next((v for v in workspace.variables if is_transforms(v.values)), None)
    if poses is not None and not survey.fitting:
        return _transforms(poses)
    recorded = next((v for v in workspace.variables if v.kind == JOINT_STATE), None)
    if recorded is not None and not survey.fitting:
        return _recorded(recorded, survey)
    return no_trajectory(survey, file)


def _recorded(variable: Variable, survey: Survey) -> Diagnostic:
    return RECORDED_STATES(
        variable=variable.path,
        model=survey.robot.id,
        found=shortened(list(variable.columns)),
        fixes=(Fix(command="mrlab robots list"),),
    )


def _states(survey: Survey) -> Diagnostic | None:
    """Return the finding of a matrix of states, such as X = [t q qd], or None."""
    joints = len(survey.robot.joints)
    for v in survey.workspace.variables:
        if v.values is None or len(v.shape) != 2 or survey.name(v).hint is not Hint.DOUBTFUL:
            continue
        if joints + 1 < v.shape[1] <= 64 and v.shape[0] >= max(FEW_ROWS, v.shape[1]):
            return near_miss(v, survey)
    return None


def no_trajectory(survey: Survey, file: str) -> Diagnostic:
    """Return the finding that lists what is there and says what the matrices look like."""
    robot, joints = survey.robot, len(survey.robot.joints)
    others = [a for a in survey.fitting if a.finite][:MOST_SHOWN]
    return NO_TRAJECTORY(
        file=file,
        variable=others[0].path if others else "",
        model=robot.id,
        joints=joints,
        looks=[described(a, _looks(a)) for a in others],
        **contents(survey.workspace),
        fixes=tuple(dict.fromkeys(map(_naming, others)))
        or (Fix(matlab="save('traj.mat', 'q', '-v7')"),),
    )


def _naming(a: Assessment) -> Fix:
    """Return what takes a matrix all the same; nothing calls q what is known to be no positions.

    Who follows commands or lines one after the other would see velocities played as a motion.
    """
    if a.name.hint is Hint.AGAINST or a.velocity_of:
        return Fix(matlab=f"plot({matlab_name(a.path)})")
    return Fix("variable", a.path, saving(a.path))


def _looks(a: Assessment) -> tuple[Diagnostic, ...]:
    """Return why a matrix that would fit was not taken."""
    if a.objections:
        return a.objections[:1]
    return (a.name.why,) if a.name.hint in (Hint.AGAINST, Hint.DOUBTFUL) else a.reasons


def described(a: Assessment, reasons: tuple[Diagnostic, ...]) -> Diagnostic:
    """Return what is said of one matrix among others."""
    return CANDIDATE(variable=a.path, size=a.variable.size, reasons=reasons)


def near_miss(variable: Variable, survey: Survey) -> Diagnostic | None:
    """Say what keeps a variable from being the trajectory, or None where it is far from one."""
    robot = survey.robot
    joints = len(robot.joints)
    widths = (joints, joints + 1)
    shape, path = variable.shape, variable.path
    sized: dict[str, Any] = {"variable": path, "size": variable.size}
    named = survey.name(variable).hint.of_joints
    if variable.is_message and variable.note:
        return BAD_MESSAGE(variable=path, why=variable.note)
    if variable.kind == JOINT_STATE:
        return _recorded(variable, survey)
    if variable.values is not None and (wrong := misnamed(variable, robot)) is not None:
        return wrong
    if len(shape) < 2 or variable.is_object or variable.kind in ("struct", "cell", "char"):
        return None
    if variable.values is None and variable.kind in OPENED:
        return None
    if len(shape) > 2:
        return _many_dimensions(variable, robot)
    if 0 in shape:
        return EMPTY(**sized) if max(shape) in (0, *widths) else None
    matching = shape[1] in widths or shape[0] in widths
    if matching and max(shape) > 1 and variable.note == "complex":
        return NOT_REAL(variable=path)
    if variable.values is None:
        if matching and min(shape) > 1:
            made, name = "full" if variable.kind == "sparse" else "double", matlab_name(path)
            fix = Fix(matlab=f"{name} = {made}({name});")
            return WRONG_CLASS(variable=path, kind=variable.kind, fixes=(fix,))
        return None
    if min(shape) == 1:
        if max(shape) in widths:
            return SINGLE_SAMPLE(**sized)
        return wrong_shape(variable, robot) if named and max(shape) > 1 else None
    if shape[1] in widths and shape[0] >= 2:
        a = survey.of(variable)
        clocks = blocking_clocks(a, robot)
        if clocks:
            return time_finding(variable, clocks, robot)
        return _looks_like(a) if a.objections and a.name.hint is not Hint.AGAINST else None
    flipped = Variable(path, variable.kind, shape[::-1], variable.values.T)
    long_enough = shape[1] >= FEW_ROWS or named
    if shape[1] not in widths and shape[0] in (*widths, joints + 2):
        clocks = clocks_of(flipped, survey)
        if long_enough if shape[0] in widths else clocks:
            row = clocks[0].index + 1 if clocks else None
            return TRANSPOSED(model=robot.id, time_row=row, **sized)
    plausible = 3 <= shape[1] <= 64 and shape[0] >= FEW_ROWS
    if shape[0] > shape[1] and (named or plausible):
        return wide(variable, survey)
    return None


def clocks_of(variable: Variable, survey: Survey) -> tuple[ClockColumn, ...]:
    """Return the columns of any matrix with values that count time."""
    values = variable.values
    if values is None or min(values.shape) < 2:
        return ()
    with np.errstate(all="ignore"):
        low, high = values.min(axis=0).astype(float), values.max(axis=0).astype(float)
    if not (np.isfinite(low).all() and np.isfinite(high).all()):
        return ()
    return clocks_among(variable, survey.robot, survey.time_vectors, low, high, survey.rates)


def time_finding(
    variable: Variable, clocks: tuple[ClockColumn, ...], robot: RobotModel
) -> Diagnostic:
    """Return the finding of a column of time, with the columns that are left."""
    joints = len(robot.joints)
    clock = clocks[0]
    taken = {c.index for c in clocks}
    left = [c for c in range(variable.shape[1]) if c not in taken]
    fixes: tuple[Fix, ...] = ()
    name = matlab_name(variable.path)
    if len(left) >= joints:
        text = columns_text(left[: joints + 1])
        fixes = (
            Fix("columns", text, f"t = {name}(:, {clock.index + 1}); q = {name}(:, {text});"),
        )
        if len(left) == joints == clock.index and (clock.first, clock.last) == (0.0, 1.0):
            # a gripper that closes evenly looks like a second of time
            line = f"q = [{name}(:, 1:{joints}) {name}(:, end) > 0.5];"
            fixes = (Fix("gripper", str(joints + 1), line), *fixes)
        rest: dict[str, Any] = {"columns": text}
    else:
        rest = {"left": len(left), "model": robot.id, "joints": joints}
        fixes = (
            Fix(matlab=f"t = {name}(:, {clock.index + 1}); {name}(:, {clock.index + 1}) = [];"),
        )
    return TIME_COLUMN(
        variable=variable.path,
        first_row=1,
        last_row=variable.shape[0],
        column=clock.index + 1,
        first=clock.first,
        last=clock.last,
        why=clock.why,
        fixes=fixes,
        **rest,
    )


def _looks_like(a: Assessment) -> Diagnostic:
    if not (a.low.any() or a.high.any()):
        return NEVER_FILLED(variable=a.path, size=a.variable.size, last_row=a.rows)
    return LOOKS_LIKE(
        variable=a.path,
        size=a.variable.size,
        why=a.objections[0],
        fixes=(Fix("variable", a.path, _look(a.path)),),
    )


def _look(path: str) -> str:
    """Return the line of MATLAB that shows what moves like a point in space."""
    name = matlab_name(path)
    return f"plot3({name}(:, 1), {name}(:, 2), {name}(:, 3))"


def _many_dimensions(variable: Variable, robot: RobotModel) -> Diagnostic | None:
    shape, name, joints = variable.shape, matlab_name(variable.path), len(robot.joints)
    if is_transforms(variable.values):
        return _transforms(variable)
    long = [n for n in shape if n > 1]
    flip = ".'" if long and long[0] in (joints, joints + 1) else ""
    if joints not in shape and joints + 1 not in shape:
        return None
    line = page_line(shape, name, joints) if len(long) > 2 else f"q = squeeze({name}){flip};"
    fixes = (Fix(matlab=line),)
    return wrong_shape(variable, robot, dimensions=len(shape), fixes=fixes)


def _transforms(variable: Variable) -> Diagnostic:
    return TRANSFORMS(variable=variable.path, size=variable.size)


def wrong_shape(variable: Variable, robot: RobotModel, **hints: Any) -> Diagnostic:
    """Return the finding of a matrix that does not fit the robot."""
    joints = len(robot.joints)
    words = {"size": variable.size, "model": robot.id, "joints": joints, "more": joints + 1}
    return WRONG_SHAPE(variable=variable.path, **{**words, **hints})


def wide(variable: Variable, survey: Survey) -> Diagnostic:
    """Return the finding of a matrix with too many columns, or too few, with those to take."""
    joints = len(survey.robot.joints)
    clocks = clocks_of(variable, survey)
    taken = {c.index for c in clocks}
    dated = variable.values is not None and is_datevec(variable.values)
    if dated:
        taken |= set(range(6))
    left = [c for c in range(variable.shape[1]) if c not in taken]
    hints: dict[str, Any] = {"dates": 6} if dated else {}
    if clocks:
        hints = {"time_column": clocks[0].index + 1, "beside": len(left)}
    if len(left) < joints:
        meant = len(left) if len(left) > 1 else None
        return wrong_shape(variable, survey.robot, meant=meant, **hints)
    block = _block_of_joints(variable, left, survey)
    if block is None:
        return wrong_shape(variable, survey.robot, **hints)
    text = columns_text(block)
    line = f"q = {matlab_name(variable.path)}(:, {text}); save('traj.mat', 'q', '-v7')"
    fixes = (Fix("columns", text, line),)
    return wrong_shape(variable, survey.robot, columns=text, fixes=fixes, **hints)


def _block_of_joints(variable: Variable, left: list[int], survey: Survey) -> list[int] | None:
    """Return the columns, from 0, of a wide matrix that are likeliest the joints, or None.

    Blocks of as many columns as there are joints: the one whose derivative another one is, else
    the first, with a gripper where one column is left behind it. None where columns are left
    over that nothing explains, such as those of a mobile base.
    """
    joints = len(survey.robot.joints)
    values = variable.values
    assert values is not None
    blocks = [left[i : i + joints] for i in range(0, len(left) - joints + 1, joints)][:8]
    if len(blocks) > 1:
        part = relations.busiest(values)
        courses = [relations.course(values[:, block], part) for block in blocks]
        pairs = [
            (i, j)
            for i, own in enumerate(courses)
            for j, other in enumerate(courses)
            if i != j
            and own is not None
            and other is not None
            and relations.derivative_rate(own, other) is not None
        ]
        derived = {j for _, j in pairs}
        for i, _ in pairs:
            if i not in derived:
                return blocks[i]
    if len(left) == joints + 1:
        return left if has_states(values[:, left[-1]]) else None
    return blocks[0] if len(left) == joints or len(blocks) > 1 else None


def _in_pieces(found: Series, workspace: Workspace) -> Diagnostic:
    """Return the finding of a trajectory kept in pieces, with what joins them."""
    first = workspace.find(found.paths[0])
    assert first is not None
    row = first.shape[0] == 1
    paths = found.paths
    if "{" in paths[0] or "(" in paths[0]:
        pattern = re.sub(r"\d+(?=\D*$)", ":", paths[0])
        inner = pattern.replace("(:)", "")
        one_by_one = inner
    else:
        one_by_one = ", ".join(paths[:8]) + (", ..." if len(paths) > 8 else "")
    if found.beside:
        flip = ".'" if row else ""
        code = f"q = {'vertcat' if row else 'horzcat'}({one_by_one}){flip};"
        pieces = "joints"
    else:
        down = row or (first.shape[0] != 1 and min(first.shape) > 1)
        flip = "" if down else ".'"
        code = f"q = {'vertcat' if down else 'horzcat'}({one_by_one}){flip};"
        pieces = "segments" if min(first.shape) > 1 else "samples"
    code += " save('traj.mat', 'q', '-v7')"
    fixes = (Fix("join", found.text, code),)
    if workspace.omitted:
        # joining what is listed would leave the end of the motion out
        fixes = (Fix(matlab=code),)
    return INSIDE_CONTAINER(
        variable=paths[0],
        last=paths[-1],
        pieces=pieces,
        more=workspace.omitted or None,
        value=float(len(paths)),
        fixes=fixes,
    )
