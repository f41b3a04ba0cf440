"""Arrays of more than two dimensions: which of them are one motion, and how MATLAB takes it."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from typing import Any

from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.diagnostics import SQUEEZED
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.robots.model import RobotModel


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
    return [_with_line(n, squeezed[n.variable]) if n.variable in squeezed else n for n in notes]


def _with_line(note: Diagnostic, was: Squeezed) -> Diagnostic:
    name = re.compile(rf"(?<![\w.']){re.escape(note.variable)}(?![\w'])")
    fixes = []
    for fix in note.fixes:
        rest = name.sub("q", fix.matlab).removeprefix("q = q; ")
        fixes.append(replace(fix, matlab=f"{was.line} {rest}") if rest else fix)
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
