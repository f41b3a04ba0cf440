"""Picks from a matrix what options name: its transpose, its columns, its gripper."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from numpy.typing import NDArray

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.diagnostics import (
    BAD_OPTION,
    NO_SUCH_COLUMN,
    NO_SUCH_VARIABLE,
    OTHER_LENGTH,
    ROWS_ALREADY,
    TOO_FEW_COLUMNS,
)
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
