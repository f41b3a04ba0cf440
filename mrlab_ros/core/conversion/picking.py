"""Picks a motion from a matrix: its pages, its transpose, and the columns that options name."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from typing import Any

from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import MATLAB_PATH, Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.diagnostics import (
    BAD_OPTION,
    DOUBTFUL_VALUES,
    NO_SUCH_COLUMN,
    NO_SUCH_VARIABLE,
    OTHER_LENGTH,
    ROWS_ALREADY,
    SQUEEZED,
    TOO_FEW_COLUMNS,
    VELOCITIES_OF,
    WHOLE_LIKE_POSES,
)
from mrlab_ros.core.conversion.evidence import relations
from mrlab_ros.core.conversion.evidence.headings import units_of
from mrlab_ros.core.conversion.evidence.joining import PART
from mrlab_ros.core.conversion.options import NO_GRIPPER, Options, parse_columns
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel


@dataclass(frozen=True, eq=False)
class Chosen:
    """The matrix that was chosen, as it is stored and as the options pick from it.

    picked: which columns of the stored matrix, from 0, after `transpose`. gripper: the values of
    the gripper where an option named them, else None; without_gripper: an option said that there
    is none.
    """

    stored: Variable
    variable: Variable
    picked: list[int]
    gripper: NDArray[Any] | None = None
    without_gripper: bool = False


def reshaped(workspace: Workspace, options: Options, robot: RobotModel) -> Workspace:
    """Return the workspace as it is once the options that change a shape were applied.

    Matrices that lack the columns are left out: they cannot be what was meant. Raises BadInput
    where no matrix has them.
    """
    if not (options.transpose or options.columns or _is_column(options.gripper)):
        return workspace
    laid_out, applied = [], False
    refused: BadInput | None = None
    for v in workspace.variables:
        if v.values is None or len(v.shape) != 2 or v.values.size == 1 or 1 in v.shape:
            laid_out.append(v)
            continue
        try:
            laid_out.append(pick(v, options, workspace, robot).variable)
            applied = True
        except BadInput as error:
            refused = _likelier(refused, error, robot)
    if refused is not None and not applied:
        raise refused
    return replace(workspace, variables=tuple(laid_out))


def _likelier(known: BadInput | None, new: BadInput, robot: RobotModel) -> BadInput:
    """Return the refusal of the matrix whose width is nearer to the robot's joints."""
    if known is None:
        return new

    def distance(refused: BadInput) -> float:
        return abs((refused.diagnostic.limit or 0.0) - len(robot.joints))

    return new if distance(new) < distance(known) else known


def _is_column(gripper: str) -> bool:
    return gripper.strip() == "end" or gripper.strip().isdigit() or gripper == NO_GRIPPER


def pick(variable: Variable, options: Options, workspace: Workspace, robot: RobotModel) -> Chosen:
    """Return the variable with `transpose`, `columns` and `gripper` applied to it."""
    values, names, given = variable.values, variable.columns, variable.units
    assert values is not None
    if options.transpose:
        joints = (len(robot.joints), len(robot.joints) + 1)
        if values.shape[1] in joints and values.shape[0] not in joints and not options.columns:
            why = ROWS_ALREADY(variable=variable.path, size=variable.size)
            raise BadInput(BAD_OPTION(option="transpose", found="true", why=why))
        values, names, given = values.T, (), given[:1] if len(set(given)) == 1 else ()
    if not given and names:
        each = units_of(variable, range(values.shape[1]))
        given = tuple("" if unit is None else unit.name for unit in each)
    stored = values
    width, size = values.shape[1], "x".join(str(n) for n in values.shape)
    picked = list(range(width))
    if options.columns:
        picked = parse_columns(options.columns, width, variable.path, size)
    column, without = _gripper_column(variable, options, workspace, values, picked, robot)
    if isinstance(column, int):
        picked = [c for c in picked if c != column]
    elif without and not options.columns and len(picked) == len(robot.joints) + 1:
        picked = picked[:-1]
    if options.columns or picked != list(range(width)):
        # numbers overrule headings; the joints of a message keep their names
        keeps = variable.is_message and names
        names = tuple(names[i] for i in picked) if keeps else ()
        given = tuple(given[i] for i in picked) if len(given) == width else given
        values = values[:, picked]
    held = None
    if isinstance(column, int):
        held = stored[:, column]
    elif column is not None:
        held = column
    laid_out = replace(variable, values=values, shape=values.shape, columns=names, units=given)
    return Chosen(variable, laid_out, picked, held, without)


def _gripper_column(
    variable: Variable,
    options: Options,
    workspace: Workspace,
    values: NDArray[Any],
    picked: list[int],
    robot: RobotModel,
) -> tuple[int | NDArray[Any] | None, bool]:
    """Return the column, from 0, or the vector that holds the gripper, and whether there is none.

    (None, False): no option says so.
    """
    text = options.gripper.strip()
    if not text:
        return None, False
    if text == NO_GRIPPER:
        return None, True
    if _is_column(text):
        return _gripper_index(text, variable, values.shape[1], picked, robot), False
    found = workspace.find(text)
    if found is None or found.values is None or found.values.size != len(values):
        why = NO_SUCH_VARIABLE(variable=text)
        if found is not None:
            length = len(values)
            why = OTHER_LENGTH(variable=text, size=found.size, other=variable.path, rows=length)
        raise BadInput(BAD_OPTION(option="gripper", found=text, why=why))
    return found.values.reshape(-1), False


def _gripper_index(
    text: str, variable: Variable, width: int, picked: list[int], robot: RobotModel
) -> int:
    """Return the column of the gripper, from 0, among `width`; raise BadInput where it is none."""
    joints = len(robot.joints)
    column = width - 1 if text == "end" else int(text) - 1
    left = len([c for c in picked if c != column])
    path = variable.path
    if not 0 <= column < width:
        why = NO_SUCH_COLUMN(variable=path, width=width)
    elif left < joints:
        why = TOO_FEW_COLUMNS(
            variable=path,
            width=width,
            column=column + 1,
            left=left,
            joints=joints,
            model=robot.id,
        )
    else:
        return column
    raise BadInput(
        BAD_OPTION(option="gripper", found=text, why=why, variable=path, limit=float(width))
    )


MOST_COLUMNS = 64


def doubts(chosen: Chosen, robot: RobotModel) -> list[Diagnostic]:
    """Return a warning where the whole matrix shows that its part is no joint positions."""
    whole, joints = chosen.stored.values, len(robot.joints)
    if whole is None or whole.ndim != 2 or len(chosen.picked) < joints:
        return []
    width = whole.shape[1]
    if width <= joints or width > MOST_COLUMNS or max(chosen.picked) >= width:
        return []
    path = chosen.variable.path
    poses = relations.evidence(whole, robot)
    if poses.strong is not None:
        return [DOUBTFUL_VALUES(variable=path, why=[WHOLE_LIKE_POSES(why=poses.strong)])]
    picked = chosen.picked[:joints]
    part = relations.busiest(whole[:, picked])
    taken = relations.course(whole[:, picked], part)
    for first in range(width - joints + 1):
        block = list(range(first, first + joints))
        if taken is None or block == picked:
            continue
        other = relations.course(whole[:, block], part)
        if other is not None and relations.derivative_rate(other, taken) is not None:
            why = VELOCITIES_OF(columns=f"{first + 1}:{first + joints}")
            return [DOUBTFUL_VALUES(variable=path, why=[why])]
    return []


@dataclass(frozen=True)
class Squeezed:
    """What an array became. size: as MATLAB's whos writes the array; line: what MATLAB does."""

    size: str
    line: str


def is_motion(shape: tuple[int, ...]) -> bool:
    """Say whether an array of this shape is a matrix once dimensions of one are left out."""
    return len([n for n in shape if n > 1]) <= 2


def flattened(workspace: Workspace, robot: RobotModel) -> tuple[Workspace, dict[str, Squeezed]]:
    """Return the workspace with such arrays as matrices, rows are samples; and which they were.

    Simulink logs a signal of 6 x 1 as 6 x 1 x N: the last dimension counts the samples, unless it
    alone counts the robot's joints.
    """
    joints = len(robot.joints)
    squeezed: dict[str, Squeezed] = {}
    variables: list[Variable] = []
    for v in workspace.variables:
        if v.values is None or len(v.shape) < 3 or not is_motion(v.shape):
            variables.append(v)
            continue
        values, transposed = _matrix(v.values, (joints, joints + 1))
        line = f"q = squeeze({v.path}){'.' + chr(39) if transposed else ''};"
        squeezed[v.path] = Squeezed(v.size, line)
        variables.append(replace(v, values=values, shape=values.shape))
    if not squeezed:
        return workspace, squeezed
    return replace(workspace, variables=tuple(variables)), squeezed


def _matrix(values: NDArray[Any], widths: tuple[int, int]) -> tuple[NDArray[Any], bool]:
    """Return an array with at most two dimensions above one as a matrix, and if it was turned."""
    shape = list(values.shape)
    while len(shape) > 2 and shape[-1] == 1:
        shape.pop()
    if len(shape) == 2:
        return values.reshape(tuple(shape), order="F"), False
    columns, rows = math.prod(shape[:-1]), shape[-1]
    flat = values.reshape((columns, rows), order="F")
    if columns not in widths and rows in widths and columns > 1:
        return flat, False
    return flat.T, columns > 1


def squeezed_finding(path: str, was: Squeezed, variable: Variable) -> Diagnostic:
    """Return the finding that says how an array was taken."""
    return SQUEEZED(variable=path, size=was.size, taken=variable.size, line=was.line)


def with_lines(notes: list[Diagnostic], squeezed: dict[str, Squeezed]) -> list[Diagnostic]:
    """Return findings whose lines of MATLAB begin with the one that makes the matrix."""
    lines = {path: was.line for path, was in squeezed.items()}
    parts = {n.variable for n in notes if PART.fullmatch(n.variable)}
    lines |= {path: f"q = {path};" for path in parts if MATLAB_PATH.fullmatch(path)}
    return [_with_line(n, lines[n.variable]) if n.variable in lines else n for n in notes]


def _with_line(note: Diagnostic, line: str) -> Diagnostic:
    name = re.compile(rf"(?<![\w.']){re.escape(note.variable)}(?![\w'])")
    fixes = []
    for fix in note.fixes:
        changed, count = name.subn("q", fix.matlab)
        changed = changed.removeprefix("q = q; ")
        fixes.append(replace(fix, matlab=f"{line} {changed}") if count and changed else fix)
    return replace(note, fixes=tuple(fixes))


def page_line(shape: tuple[int, ...], name: str, joints: int) -> str:
    """Return the line of MATLAB that takes the first page of an array with one row a sample.

    shape: more than two dimensions above one, among them the joints or one more.
    """
    axis = shape.index(joints) if joints in shape else shape.index(joints + 1)
    others = [i for i in range(len(shape)) if i != axis]
    samples = max(others, key=lambda i: shape[i])
    picked = ", ".join(":" if i in (axis, samples) else "1" for i in range(len(shape)))
    page = f"{name}({picked})"
    if {axis, samples} != {0, 1}:
        page = f"squeeze({page})"
    return f"q = {page}{'.' + chr(39) if samples > axis else ''};"
