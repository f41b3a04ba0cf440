"""Matrices that a file keeps in pieces: series such as q1 to q6, parts, and their joining."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.options import parse_columns
from mrlab_ros.core.conversion.variable_names import Hint, hint
from mrlab_ros.core.conversion.workspace import Variable, Workspace
from mrlab_ros.core.diagnostics import Refused, finding

NUMBER = re.compile(r"\d+(?=\D*$)")
MOST_PIECES = 20_000
PART = re.compile(r"(?P<path>.+)\((?P<rows>[^(),]+),(?P<columns>[^(),]+)\)$")


@dataclass(frozen=True, eq=False)
class Series:
    """Variables whose paths differ in one number: their paths in order, and how they join.

    beside: one is a joint's course, so they stand side by side; else they are rows or segments.
    """

    paths: tuple[str, ...]
    beside: bool

    @property
    def text(self) -> str:
        """Return the series as the option join takes it, such as q1..q6."""
        return f"{self.paths[0]}..{self.paths[-1]}"


def expanded(text: str) -> list[str]:
    """Return the paths of 'q1..q6', 'theta1..6' or 'a, b'; raise Refused where they are none."""
    paths: list[str] = []
    for term in re.split(r"[,;\s]+(?![^({]*[)}])", text.strip().strip("[]")):
        first, dots, last = term.partition("..")
        if not dots:
            paths.append(first)
            continue
        begin, end = NUMBER.search(first), NUMBER.search(last)
        if begin is None or end is None or not 0 < int(end[0]) - int(begin[0]) < MOST_PIECES:
            problem = f"'{term}' does not count upwards from one number to another"
            raise Refused(finding("bad_option", option="join", found=text, problem=problem))
        width = len(begin[0])
        paths += [
            f"{first[: begin.start()]}{n:0{width}d}{first[begin.end() :]}"
            for n in range(int(begin[0]), int(end[0]) + 1)
        ]
    return [p for p in paths if p]


def joined(workspace: Workspace, text: str, joints: int, contents: str, file: str) -> Variable:
    """Return the variables that `text` names as one, called `text`.

    Vectors of equal length stand side by side, one a joint, unless each holds one configuration;
    matrices with equally many columns stand below one another. Raises Refused otherwise.
    """
    pieces = []
    for path in expanded(text):
        found = workspace.find(path)
        if found is None:
            words = {"file": file, "variable": path, "found": contents}
            raise Refused(finding("unknown_variable", **words))
        if found.values is None or len(found.shape) != 2:
            problem = f"'{path}' is no matrix of numbers"
            raise Refused(finding("bad_option", option="join", found=text, problem=problem))
        pieces.append(found)
    if len(pieces) < 2:
        problem = "it names one variable, and joining takes two or more"
        raise Refused(finding("bad_option", option="join", found=text, problem=problem))
    arrays = [np.asarray(p.values) for p in pieces]
    whole = _put_together(arrays, joints)
    if whole is None:
        sizes = ", ".join(f"{p.path} is {p.size}" for p in pieces[:8])
        problem = f"they differ in size: {sizes}"
        raise Refused(finding("bad_option", option="join", found=text, problem=problem))
    units = pieces[0].units if len({p.units for p in pieces}) == 1 else ()
    units = units if len(units) == 1 else ()
    return Variable(text.strip(), pieces[0].kind, whole.shape, whole, units=units)


def _put_together(arrays: list[NDArray[Any]], joints: int) -> NDArray[Any] | None:
    sizes = {a.size for a in arrays}
    vectors = all(min(a.shape) == 1 for a in arrays)
    if vectors and len(sizes) == 1:
        one_each = sizes.pop()
        configurations = one_each in (joints, joints + 1) and len(arrays) not in (
            joints,
            joints + 1,
        )
        flat = [a.reshape(-1) for a in arrays]
        return np.vstack(flat) if configurations or one_each == 1 else np.column_stack(flat)
    if len({a.shape[1] for a in arrays}) == 1:
        return np.vstack(arrays)
    if len({a.shape[0] for a in arrays}) == 1:
        return np.hstack(arrays)
    return None


def series(workspace: Workspace, joints: int) -> list[Series]:
    """Return the series in a workspace that could be the joints, the samples or the segments.

    Likeliest first: names of joints before others.
    """
    groups: dict[tuple[str, str, tuple[int, ...]], list[tuple[int, Variable]]] = {}
    for v in workspace.variables:
        number = NUMBER.search(v.path)
        if (
            v.values is None
            or len(v.shape) != 2
            or v.is_message
            or not v.values.size
            or not number
        ):
            continue
        size: tuple[int, ...] = (v.values.size,) if min(v.shape) == 1 else (0, v.shape[1])
        key = (v.path[: number.start()], v.path[number.end() :], size)
        groups.setdefault(key, []).append((int(number[0]), v))
    found = []
    for (_, _, shape), members in groups.items():
        members.sort(key=lambda pair: pair[0])
        numbers = [n for n, _ in members]
        if len(numbers) < 2 or numbers != list(range(numbers[0], numbers[0] + len(numbers))):
            continue
        paths = tuple(v.path for _, v in members)
        length = shape[0]
        if len(shape) == 1 and len(paths) in (joints, joints + 1) and length > 1:
            found.append(Series(paths, beside=True))
        elif shape in ((joints,), (joints + 1,), (0, joints), (0, joints + 1)):
            found.append(Series(paths, beside=False))
    order = {Hint.POSITIONS: 0, Hint.TWO_FACED: 1, Hint.NEUTRAL: 2, Hint.DOUBTFUL: 3}
    ranked = [(order.get(hint(s.text), 9), not s.beside, s) for s in found]
    ranked = [r for r in ranked if r[0] < 9]
    ranked.sort(key=lambda r: r[:2])
    return [s for _, _, s in ranked]


def sources(path: str, join: str) -> list[str]:
    """Return the paths in the file of what became the matrix `path`.

    join: the option of that name. A part such as q(1:200, :) comes from q.
    """
    if join and path == join.strip():
        return expanded(join)
    part = PART.fullmatch(path)
    return [part["path"]] if part else [path]


def part_of(workspace: Workspace, text: str) -> Workspace | None:
    """Return the workspace with the part `text` of a matrix, such as q(1:200, :), or None.

    Everything that has as many rows as the matrix is cut to the same rows, so that times and
    velocities stay those of the part. Raises Refused where rows or columns are not there.
    """
    match = PART.fullmatch(text.strip())
    if match is None:
        return None
    whole = workspace.find(match["path"])
    if whole is None or whole.values is None or len(whole.shape) != 2:
        return None
    rows = _indices(match["rows"], whole.shape[0], whole)
    columns = _indices(match["columns"], whole.shape[1], whole)
    names = tuple(whole.columns[i] for i in columns) if whole.columns else ()
    values = whole.values[np.ix_(rows, columns)]
    kept = replace(whole, path=text, values=values, shape=values.shape, columns=names)
    others = (_same_rows(v, whole.shape[0], rows) for v in workspace.variables)
    return replace(workspace, variables=(kept, *others))


def _same_rows(variable: Variable, count: int, rows: NDArray[np.intp]) -> Variable:
    values = variable.values
    if values is None or values.size == 1:
        return variable
    if values.shape[0] == count:
        values = values[rows]
    elif values.ndim == 2 and values.shape == (1, count):
        values = values[:, rows]
    else:
        return variable
    return replace(variable, values=values, shape=values.shape)


def _indices(text: str, count: int, variable: Variable) -> NDArray[np.intp]:
    if text.strip() == ":":
        return np.arange(count)
    return np.array(parse_columns(text, count, variable.path, variable.size), dtype=np.intp)


def first_path(path: str) -> str:
    """Return the path of the first piece of a joined variable, or of the matrix of a part."""
    first = re.split(r"[,;\s]+(?![^({]*[)}])", path.strip().strip("[]"))[0].partition("..")[0]
    match = PART.fullmatch(path)
    return match["path"] if match else first
