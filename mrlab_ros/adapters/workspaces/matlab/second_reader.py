"""Reads a matrix of a workspace again with scipy (v4 to v7) or h5py (v7.3) and compares.

Damage that one reader overlooks shows as a difference between two. scipy's parser is written in
Cython and can end the process on damaged bytes, so `verify` is called only in the sandboxed
process, after the own reader has checked every length and checksum of the file.
"""

from __future__ import annotations

import importlib
import io
import re
import warnings
from collections.abc import Iterator
from typing import Any, Literal

import h5py
import numpy as np
from numpy.typing import NDArray

from mrlab_ros.adapters.workspaces.diagnostics import (
    SECOND_CANNOT_READ,
    SECOND_FINDS,
    SECOND_FINDS_SIZE,
    SECOND_FINDS_TYPE,
)
from mrlab_ros.adapters.workspaces.matlab.mat73 import values_of
from mrlab_ros.adapters.workspaces.matlab.recognition import recognise
from mrlab_ros.adapters.workspaces.sinks import View
from mrlab_ros.core.base.diagnostic import Diagnostic

STEP = re.compile(r"\.(?P<field>[^.({]+)|\((?P<element>[\d,]+)\)|\{(?P<cell>[\d,]+)\}")
H5_FILE = "#file"  # no variable has this name
MOST_REFERENCES = 1 << 26  # bytes of those of one cell or field
BLOCK = 1 << 16  # elements that are compared at once
ROOT = re.compile(r"[^.({]+")


class _Opaque(Exception):
    """The path leads into a MATLAB object, whose contents `objects` has compared already."""


def disagreement(
    data: memoryview,
    path: str,
    values: NDArray[Any],
    loaded: dict[str, Any] | None = None,
) -> Diagnostic | None:
    """Read the matrix at `path` again; return what differs, or None.

    data: the whole file, not compressed with gzip. path: as the own reader gave it, such as
    `out.q.signals.values`. values: what the own reader found, of two dimensions or more, of
    any byte order and of the type that is stored. loaded: variables of v4 to v7 by their names,
    or the open file of v7.3, which calls for one file share. Formats with one reader only (CSV,
    npz, bags) pass. Raises MemoryError where the memory does not suffice.
    """
    form = recognise(data)
    if form not in ("mat4", "mat5", "hdf5"):
        return None
    second = "h5py" if form == "hdf5" else "scipy"
    try:
        found = (
            _with_h5py(data, path, 8 * values.size, loaded)
            if form == "hdf5"
            else _with_scipy(data, path, loaded)
        )
    except _Opaque:
        return None
    except MemoryError:
        raise
    except Exception as error:
        # what damage makes the libraries raise has no common base
        return SECOND_CANNOT_READ(reader=second, error=str(error) or type(error).__name__)
    return difference(values, found, second)


def difference(first: NDArray[Any], second: NDArray[Any], reader: str) -> Diagnostic | None:
    """Return how `second`, which `reader` found, differs from `first`; None: it does not.

    Both are compared as float64, bit for bit: a NaN equals itself, 0.0 does not equal -0.0.
    """
    if second.dtype.kind not in "fiu":
        return SECOND_FINDS_TYPE(reader=reader, found=str(second.dtype))
    if first.shape != second.shape:
        return SECOND_FINDS_SIZE(reader=reader, size="x".join(map(str, second.shape)))
    count, place = _first_difference(first, second)
    if place is None:
        return None
    return SECOND_FINDS(
        reader=reader,
        second=repr(float(second[place])),
        first=repr(float(first[place])),
        row=place[0] + 1,
        column=place[1] + 1,
        page=place[2] + 1 if len(place) > 2 else None,
        count=count,
        total=first.size,
    )


def _first_difference(
    first: NDArray[Any], second: NDArray[Any]
) -> tuple[int, tuple[int, ...] | None]:
    """Return how many elements of two arrays differ, and where the first of them is, or None.

    Blocks of one flat order are compared, so that no copy of the arrays is needed.
    """
    order: Literal["C", "F"] = "F" if first.flags.f_contiguous else "C"
    one, other = first.reshape(-1, order=order), second.reshape(-1, order=order)
    count, place = 0, None
    for begin in range(0, one.size, BLOCK):
        a, b = (np.asarray(x[begin : begin + BLOCK], "<f8").view(np.uint64) for x in (one, other))
        wrong = np.flatnonzero(a != b)
        if len(wrong) and place is None:
            at = np.unravel_index(begin + int(wrong[0]), first.shape, order=order)
            place = tuple(int(n) for n in at)
        count += len(wrong)
    return count, place


def steps(path: str) -> Iterator[tuple[str, Any]]:
    """Yield the variable that `path` begins with, and the steps from it to the matrix.

    They are ('variable', name), ('field', name), ('element' or 'cell', subscripts from 0). Raises
    ValueError where `path` goes on in a way that only objects have, such as `T{:,:}`.
    """
    root = ROOT.match(path)
    if root is None:
        raise ValueError(f"'{path}' begins with no name")
    yield "variable", root.group()
    at = root.end()
    while at < len(path):
        step = STEP.match(path, at)
        if step is None:
            raise ValueError(f"'{path}' cannot be followed after '{path[:at]}'")
        kind = str(step.lastgroup)
        text = step.group(kind)
        yield kind, text if kind == "field" else _subscripts(text)
        at = step.end()


def _subscripts(text: str) -> tuple[int, ...]:
    return tuple(int(number) - 1 for number in text.split(","))


def import_scipy() -> None:
    """Import scipy.io without the parts of numpy that only their names are copied from.

    scipy copies all that numpy lists, which imports f2py, testing and others: 0.1 s.
    """
    numpy = vars(np)
    before = {name: numpy[name] for name in ("__all__", "__dir__")}
    loaded = [name for name in np.__all__ if name in numpy]
    numpy.update({"__all__": loaded, "__dir__": lambda: list(numpy)})
    try:
        importlib.import_module("scipy.io")
    finally:
        numpy.update(before)


def _with_scipy(data: memoryview, path: str, loaded: dict[str, Any] | None = None) -> NDArray[Any]:
    import scipy.io
    from scipy.io.matlab import MatlabFunction, MatlabObject, MatlabOpaque

    value: Any = None
    known = {} if loaded is None else loaded
    followed = steps(path)
    while True:
        if isinstance(value, (MatlabOpaque, MatlabFunction, MatlabObject)):
            raise _Opaque
        step = next(followed, None)
        if step is None:
            break
        kind, where = step
        if kind == "variable":
            if where not in known:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    file = io.BufferedReader(View(data))
                    found = scipy.io.loadmat(file, variable_names=[where], chars_as_strings=False)
                known[where] = found[where]
            value = known[where]
        elif kind == "field":
            value = value[where]
            if isinstance(value, np.ndarray) and value.dtype == object and value.size == 1:
                value = value.item()
        elif len(where) == 1:
            value = value.reshape(-1, order="F")[where[0]]
        else:
            value = value[where]
    if not isinstance(value, np.ndarray):
        raise ValueError(f"a {type(value).__name__} is at '{path}'")
    return value


def _with_h5py(
    data: memoryview, path: str, most: int, loaded: dict[str, Any] | None = None
) -> NDArray[Any]:
    """Return the matrix at `path`, which has `most` bytes or fewer."""
    # many pieces of one file are read through one opening of it
    known = {} if loaded is None else loaded
    if H5_FILE not in known:
        known[H5_FILE] = h5py.File(io.BufferedReader(View(data)), "r")
    file = known[H5_FILE]
    try:
        item = file
        number: int | None = None
        followed = steps(path)
        while True:
            if "MATLAB_object_decode" in item.attrs:
                raise _Opaque
            step = next(followed, None)
            if step is None:
                break
            kind, where = step
            if kind == "element":
                number = _number(next(iter(item.values())).shape, where)
            elif kind in ("field", "variable"):
                item = item[where]
                if number is not None:
                    item, number = file[_references(item, known)[number]], None
            else:
                item = file[_references(item, known)[_number(item.shape, where)]]
        values = np.asarray(values_of(item, path, most)).T
        return values.reshape(values.shape + (1,) * (2 - values.ndim))
    finally:
        if loaded is None:
            file.close()


def _references(item: Any, known: dict[str, Any]) -> NDArray[Any]:
    """Return the references of a cell or a field; those of one item are read once."""
    key = f"#{item.name}"
    if key not in known:
        known[key] = values_of(item, str(item.name), MOST_REFERENCES).reshape(-1)
    found: NDArray[Any] = known[key]
    return found


def _number(shape: tuple[int, ...], where: tuple[int, ...]) -> int:
    """Return the place of MATLAB's subscripts in an HDF5 array, whose axes are reversed."""
    return where[0] if len(where) == 1 else int(np.ravel_multi_index(where[::-1], shape))
