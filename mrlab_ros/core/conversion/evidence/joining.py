"""Matrices that a file keeps in pieces: series such as q1 to q6, parts, and their joining."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.diagnostics import (
    BAD_OPTION,
    BAD_PART,
    COUNTS_DOWN,
    NO_MATRIX,
    ONE_PIECE,
    PIECES_DIFFER,
    ROWS_LEFT_OUT,
    SIZES_DIFFER,
    UNKNOWN_VARIABLE,
)
from mrlab_ros.core.conversion.evidence.names import Hint, hint
from mrlab_ros.core.conversion.options import indices
from mrlab_ros.core.conversion.workspace import Variable, Workspace, shortened

NUMBER = re.compile(r"\d+(?=\D*$)")
MOST_PIECES = 50_000
COUNTED = re.compile(r"(?P<begin>\d+)\s*:\s*(?:(?P<step>\d+)\s*:\s*)?(?:\d+|end)")
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
    """Return the paths of 'q1..q6', 'theta1..6' or 'a, b'; raise BadInput where they are none."""
    paths: list[str] = []
    for term in re.split(r"[,;\s]+(?![^({]*[)}])", text.strip().strip("[]")):
        first, dots, last = term.partition("..")
        if not dots:
            paths.append(first)
            continue
        begin, end = NUMBER.search(first), NUMBER.search(last)
        if begin is None or end is None or not 0 < int(end[0]) - int(begin[0]) < MOST_PIECES:
            raise _unjoinable(text, COUNTS_DOWN(term=term))
        width = len(begin[0])
        paths += [
            f"{first[: begin.start()]}{n:0{width}d}{first[begin.end() :]}"
            for n in range(int(begin[0]), int(end[0]) + 1)
        ]
    return [p for p in paths if p]


def joined(
    workspace: Workspace, text: str, joints: int, contents: dict[str, Any], file: str
) -> Variable:
    """Return the variables that `text` names as one, called `text`.

    Vectors of equal length stand side by side, one a joint, unless each holds one configuration;
    matrices with equally many columns stand below one another. Raises BadInput otherwise.
    contents: what the file holds, for a refusal.
    """
    pieces = []
    for path in expanded(text):
        found = workspace.find(path)
        if found is None:
            raise BadInput(UNKNOWN_VARIABLE(file=file, variable=path, **contents))
        if found.values is None or len(found.shape) != 2:
            raise _unjoinable(text, NO_MATRIX(variable=path))
        pieces.append(found)
    if len(pieces) < 2:
        raise _unjoinable(text, ONE_PIECE())
    arrays = [np.asarray(p.values) for p in pieces]
    whole = _put_together(arrays, joints)
    if whole is None and all(min(a.shape) == 1 for a in arrays):
        raise BadInput(unequal(pieces))
    if whole is None:
        sizes = [f"{p.path} ({p.size})" for p in pieces[:8]]
        raise _unjoinable(text, SIZES_DIFFER(sizes=sizes))
    units = pieces[0].units if len({p.units for p in pieces}) == 1 else ()
    units = units if len(units) == 1 else ()
    return Variable(text.strip(), pieces[0].kind, whole.shape, whole, units=units)


def _unjoinable(text: str, why: Diagnostic) -> BadInput:
    return BadInput(BAD_OPTION(option="join", found=text, why=why))


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
    if vectors and joints > 1:
        return None
    if len({a.shape[1] for a in arrays}) == 1:
        return np.vstack(arrays)
    if len({a.shape[0] for a in arrays}) == 1:
        return np.hstack(arrays)
    return None


def unequal(pieces: list[Variable]) -> Diagnostic:
    """Return the finding of vectors, one a joint, that differ in length."""
    lengths = {p.path: max(p.shape) for p in pieces}
    usual = Counter(lengths.values()).most_common(1)[0][0]
    others = [f"{path} ({n})" for path, n in lengths.items() if n != usual]
    rows = min(lengths.values())
    cut = "; ".join(f"{path}(1:{rows})" for path in lengths)
    line = f"q = reshape([{cut}], {rows}, []); save('traj.mat', 'q', '-v7')"
    if any(p.shape[0] == 1 for p in pieces):
        line = line.replace("; ", ", ", len(pieces) - 1)
    return PIECES_DIFFER(
        variable=pieces[0].path,
        usual=usual,
        others=shortened(others),
        rows=rows,
        value=float(rows),
        limit=float(max(lengths.values())),
        fixes=(Fix(matlab=line),),
    )


def unequal_series(workspace: Workspace, joints: int) -> list[Variable]:
    """Return vectors such as q1 to q6, as many as joints, that differ in length; or none."""
    groups: dict[tuple[str, str], dict[int, Variable]] = {}
    for v in workspace.variables:
        number = NUMBER.search(v.path)
        if number and v.values is not None and len(v.shape) == 2 and min(v.shape) == 1:
            key = (v.path[: number.start()], v.path[number.end() :])
            groups.setdefault(key, {})[int(number[0])] = v
    for members in groups.values():
        numbers = sorted(members)
        found = [members[n] for n in numbers]
        counts_up = numbers == list(range(numbers[0], numbers[0] + len(numbers)))
        long = all(max(v.shape) > joints for v in found)
        differ = len(found) == joints and len({v.shape for v in found}) > 1
        said = hint(f"{found[0].path}..{found[-1].path}")
        if counts_up and long and differ and said.of_joints:
            return found
    return []


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
    order = {
        Hint.POSITIONS: 0,
        Hint.PARTLY: 0,
        Hint.TWO_FACED: 1,
        Hint.NEUTRAL: 2,
        Hint.DOUBTFUL: 3,
    }
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
    return sources(part["path"], join) if part else [path]


def part_of(workspace: Workspace, text: str) -> Workspace | None:
    """Return the workspace with the part `text` of a matrix, such as q(1:200, :), or None.

    Everything that has as many rows as the matrix is cut to the same rows, so that times and
    velocities stay those of the part. Raises BadInput where rows or columns are not there.
    """
    match = PART.fullmatch(text.strip())
    if match is None:
        return None
    if workspace.find(match["path"]) is None:
        workspace = part_of(workspace, match["path"]) or workspace
    whole = workspace.find(match["path"])
    if whole is None or whole.values is None or len(whole.shape) != 2:
        return None
    rows = _indices(match["rows"], 0, text, whole)
    columns = _indices(match["columns"], 1, text, whole)
    names = tuple(whole.columns[i] for i in columns) if whole.columns else ()
    values = whole.values[np.ix_(rows, columns)]
    kept = replace(whole, path=text, values=values, shape=values.shape, columns=names)
    others = (_same_rows(v, whole.shape[0], rows) for v in workspace.variables)
    return replace(workspace, variables=(kept, *others))


def rows_left_out(workspace: Workspace, text: str, *, transposed: bool) -> list[Diagnostic]:
    """Return the warning of rows with numbers that the part `text` of a matrix leaves out.

    Rows of zeros, and those that are not finite, are no loss.
    """
    match = PART.fullmatch(text.strip())
    whole = match and workspace.find(match["path"])
    if not match or not whole or whole.values is None or len(whole.shape) != 2:
        return []
    axis = 1 if transposed else 0
    taken = _indices(match["columns" if transposed else "rows"], axis, text, whole)
    rest = np.delete(whole.values, taken, axis=axis)
    lost = np.isfinite(rest).all(axis=1 - axis) & rest.any(axis=1 - axis)
    count, rows = int(np.count_nonzero(lost)), whole.shape[axis]
    if not count:
        return []
    fixes = (Fix("variable", whole.path),)
    return [ROWS_LEFT_OUT(variable=text, count=count, rows=rows, other=whole.path, fixes=fixes)]


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


def _indices(text: str, axis: int, part: str, whole: Variable) -> NDArray[np.intp]:
    """Return the rows (axis 0) or columns, from 0, of a part; raise BadInput if not there."""
    if text.strip() == ":":
        return np.arange(whole.shape[axis])
    try:
        found = indices(text, whole.shape[axis], ("row", "column")[axis])
        return np.array(found, dtype=np.intp)
    except BadInput as error:
        fixes = (Fix("variable", whole.path, f"size({whole.path})"),)
        raise BadInput(
            BAD_PART(variable=part, other=whole.path, size=whole.size, why=error, fixes=fixes)
        ) from None


def picked_rows(part: str, whole: Variable) -> NDArray[np.intp]:
    """Return the rows, from 0, that the path of a part takes; raise BadInput if not there."""
    match = PART.fullmatch(part)
    return np.arange(whole.shape[0]) if match is None else _indices(match["rows"], 0, part, whole)


def rows_of(path: str, first: int, last: int) -> str:
    """Return the path of rows of a matrix, from 1; of a part, the same rows of its matrix."""
    match = PART.fullmatch(path)
    counted = match and COUNTED.fullmatch(match["rows"].strip())
    if match is None or (counted is None and match["rows"].strip() != ":"):
        return f"{path}({first}:{last}, :)"
    begin, step = (int(counted["begin"]), int(counted["step"] or 1)) if counted else (1, 1)
    first, last = begin + (first - 1) * step, begin + (last - 1) * step
    middle = f":{step}" if step > 1 else ""
    return f"{match['path']}({first}{middle}:{last}, {match['columns'].strip()})"


def rows_but(path: str, runs: Iterable[tuple[int, int]], count: int) -> str:
    """Return the path of the `count` rows of a matrix without runs of frames, each from 0."""
    ends = [0, *(place for first, last in runs for place in (first, last + 1)), count]
    pieces = [(a + 1, b) for a, b in zip(ends[::2], ends[1::2], strict=True) if b > a]
    kept = " ".join(f"{a}:{b}" if b > a else str(b) for a, b in pieces)
    match = PART.fullmatch(path)
    if match is None or match["rows"].strip() != ":":
        return f"{path}([{kept}], :)"
    return f"{match['path']}([{kept}], {match['columns'].strip()})"


def first_path(path: str) -> str:
    """Return the path of the first piece of a joined variable, or of the matrix of a part."""
    first = re.split(r"[,;\s]+(?![^({]*[)}])", path.strip().strip("[]"))[0].partition("..")[0]
    match = PART.fullmatch(path)
    return match["path"] if match else first
