"""Reads MATLAB's v7.3 workspaces, which are HDF5 files, with h5py.

HDF5 stores MATLAB's axes reversed, so a dataset's own order of bytes is MATLAB's column by
column. Only what lies in the file itself is followed: no external links, no virtual datasets; the
kernel keeps the libraries from opening anything else (`adapters/sandbox`). Every read of a
dataset or an attribute goes through `values_of` or `attribute`, which bound it.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import h5py
import numpy as np

from mrlab_ros.adapters.workspaces.diagnostics import (
    BAD_ATTRIBUTE,
    LIBRARY_FAILED,
    NESTED_TOO_DEEP,
    NO_REFERENCES,
    POINTS_NOWHERE,
    VALUES_ELSEWHERE,
)
from mrlab_ros.adapters.workspaces.matlab.elements import (
    Damaged,
    NotAWorkspace,
    TooLarge,
    index,
    is_vector,
)
from mrlab_ros.adapters.workspaces.matlab.mat5 import (
    DEEPEST,
    INTEGERS,
    LONGEST_TEXT,
    in_lines,
)
from mrlab_ros.adapters.workspaces.sinks import Found, Sink
from mrlab_ros.core.conversion.workspace import ATTRIBUTE

MOST_ATTRIBUTE = 4096  # bytes of an attribute that is read: MATLAB writes names and flags there
MOST_NOTES = 64  # attributes of one item that are handed on
# attributes that MATLAB and Python's libraries write for themselves
OF_WRITERS = ("MATLAB_", "H5PATH", "DIMENSION_", "CLASS", "TITLE", "VERSION", "FLAVOR", "_")
MOST_LENGTHS = 64  # of an array in an attribute


def read_hdf5(file: Any, sink: Sink, limit: int) -> None:
    """Hand every variable to the sink; `limit` bounds one variable's bytes."""
    with _opened(file) as root:
        reader = _Reader(root, sink, limit)
        if any("OCTAVE_NEW_FORMAT" in root[name].attrs for name in reader.names(root)):
            raise NotAWorkspace("octave")
        reader.notes(root, "")
        for name in reader.names(root):
            reader.item(root[name], name, 0)


def read_contents_of_objects(file: Any, sink: Sink, limit: int) -> None:
    """Hand the numbers inside objects to the sink, at their place in the file.

    Their paths are made up; a complex matrix is handed on as its two parts.
    """
    with _opened(file) as root:
        reader = _Reader(root, sink, limit, inside_objects=True)
        for part in root.get("#subsystem#", {}).values():
            reader.cell(part, "#", 0)


def values_of(item: Any, path: str, limit: int) -> Any:
    """Return the values of a dataset that lie in this very file and have `limit` bytes at most.

    Raises Damaged or TooLarge before anything of it is read.
    """
    if not isinstance(item, h5py.Dataset) or item.is_virtual or item.external:
        raise Damaged(VALUES_ELSEWHERE(variable=path))
    if item.nbytes > limit:
        raise TooLarge("variable", limit, item.nbytes)
    return item[()]


def attribute(item: Any, name: str) -> Any:
    """Return a small attribute, None where there is none; raise Damaged for a large one."""
    if name not in item.attrs:
        return None
    if item.attrs.get_id(name).get_storage_size() > MOST_ATTRIBUTE:
        raise Damaged(BAD_ATTRIBUTE(attribute=name, variable=item.name))
    return item.attrs[name]


@contextmanager
def _opened(file: Any) -> Iterator[Any]:
    """Give the root of an HDF5 file; what h5py raises on damage is Damaged."""
    try:
        with h5py.File(file, "r") as root:
            yield root
    except (Damaged, NotAWorkspace, TooLarge, MemoryError):
        raise
    except Exception as error:
        # what damage makes h5py raise goes from OSError to OverflowError, wherever it is met
        raise Damaged(LIBRARY_FAILED(part="hdf5", error=str(error))) from error


def _word(value: Any) -> str:
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def _holds_references(item: Any) -> bool:
    return isinstance(item, h5py.Dataset) and h5py.check_ref_dtype(item.dtype) is h5py.Reference


class _Reader:
    def __init__(self, root: Any, sink: Sink, limit: int, *, inside_objects: bool = False) -> None:
        self.inside_objects = inside_objects
        self.root = root
        self.sink = sink
        self.limit = limit

    def names(self, group: Any) -> list[str]:
        """Return the names of what lies in this very file, without HDF5's own rooms."""
        return [
            name
            for name in group
            if not name.startswith("#")
            and isinstance(group.get(name, getlink=True), h5py.HardLink)
        ]

    def item(self, item: Any, path: str, depth: int) -> None:
        if depth > DEEPEST:
            raise Damaged(NESTED_TOO_DEEP(variable=path, most=DEEPEST))
        kind = _word(attribute(item, "MATLAB_class") or "")
        if "MATLAB_object_decode" in item.attrs:
            self.sink.add(Found(path, kind or "object", is_object=True, shape=()))
        elif "MATLAB_sparse" in item.attrs:
            self.sink.add(Found(path, "sparse", (int(attribute(item, "MATLAB_sparse")), 0)))
        elif isinstance(item, h5py.Group):
            self._struct(item, path, depth)
        elif kind == "cell":
            self.cell(item, path, depth)
        else:
            self._numbers(item, path, kind)

    def _shape(self, item: Any, path: str) -> tuple[int, ...]:
        if "MATLAB_empty" in item.attrs:
            lengths = values_of(item, path, 8 * MOST_LENGTHS).reshape(-1)
            return tuple(int(n) for n in lengths[:8])
        shape = tuple(int(n) for n in reversed(item.shape))
        return shape + (1,) * (2 - len(shape))

    def _struct(self, group: Any, path: str, depth: int) -> None:
        names = self.names(group)
        arrays = [n for n in names if self._is_references(group[n])]
        if not arrays:
            self.sink.add(Found(path, "struct", (1, 1)))
            if not self.inside_objects:
                self.notes(group, path)
            for name in names:
                self.item(group[name], f"{path}.{name}", depth + 1)
            return
        shape = self._shape(group[arrays[0]], path)
        self.sink.add(Found(path, "struct", shape))
        columns = {name: self._references(group[name], path) for name in arrays}
        for number in range(min(len(c) for c in columns.values())):
            for name, column in columns.items():
                part = f"{path}({index(shape, number)}).{name}"
                self._follow(column[number], part, depth)

    def _is_references(self, item: Any) -> bool:
        """Say whether `item` is one field of a struct array: references and no class."""
        return _holds_references(item) and "MATLAB_class" not in item.attrs

    def _references(self, item: Any, path: str) -> Any:
        if not _holds_references(item):
            raise Damaged(NO_REFERENCES(variable=path))
        return values_of(item, path, self.limit).reshape(-1)

    def cell(self, item: Any, path: str, depth: int) -> None:
        shape = self._shape(item, path)
        self.sink.add(Found(path, "cell", shape))
        if "MATLAB_empty" in item.attrs:
            return
        for number, reference in enumerate(self._references(item, path)):
            self._follow(reference, f"{path}{{{index(shape, number)}}}", depth)

    def _follow(self, reference: Any, path: str, depth: int) -> None:
        if not reference:
            raise Damaged(POINTS_NOWHERE(variable=path))
        self.item(self.root[reference], path, depth + 1)

    def _text(self, item: Any, path: str, shape: tuple[int, ...]) -> str:
        """Return a short text, one line a row, else an empty one."""
        if len(shape) != 2 or item.size > LONGEST_TEXT or item.dtype.kind != "u":
            return ""
        codes = bytes(values_of(item, path, 8 * LONGEST_TEXT).astype("<u2"))
        return in_lines(codes.decode("utf-16-le", "replace"), shape[0])

    def notes(self, item: Any, path: str) -> None:
        """Hand on what attributes say of `item`, but those that the writer keeps for itself."""
        for name in itertools.islice(item.attrs, MOST_NOTES):
            if name.upper() == name or name.startswith(OF_WRITERS):
                continue
            value = attribute(item, name)
            part = f"{path}.{name}" if path else name
            if isinstance(value, bytes | str | np.bytes_):
                self.sink.add(Found(part, ATTRIBUTE, text=_word(value)[:LONGEST_TEXT]))
            elif isinstance(value, np.bool_):
                self.sink.add(Found(part, ATTRIBUTE, text="true" if value else "false"))
            elif np.size(value) == 1 and np.asarray(value).dtype.kind in "fiu":
                number = np.asarray(value, dtype="<f8").reshape(1, 1)
                self.sink.add(Found(part, ATTRIBUTE, (1, 1), _bytes_of(number), "<f8"))

    def _numbers(self, item: Any, path: str, kind: str) -> None:
        shape = self._shape(item, path)
        if item.dtype.names:
            self.sink.add(Found(path, kind or "double", shape, note="complex"))
            if self.inside_objects and "MATLAB_empty" not in item.attrs:
                both = values_of(item, path, self.limit)
                for name in item.dtype.names:
                    values = both[name].copy()
                    data = _bytes_of(values)
                    self.sink.add(Found(path, "double", shape, data, values.dtype.str))
            return
        kind = kind or {"f": "double", "i": "int64", "u": "uint64"}.get(item.dtype.kind, "unknown")
        if kind == "char" and "MATLAB_empty" not in item.attrs:
            self.sink.add(Found(path, kind, shape, text=self._text(item, path, shape)))
            return
        if kind == "logical" and item.size == 1 and not self.inside_objects:
            truth = "MATLAB_empty" not in item.attrs and bool(np.any(values_of(item, path, 64)))
            self.sink.add(Found(path, kind, shape, text="true" if truth else "false"))
            return
        wanted = kind in ("double", "single") or (self.inside_objects and kind != "char")
        wanted = wanted or (kind in (*INTEGERS, "logical") and is_vector(shape))
        if not wanted or item.dtype.kind not in "fiu":
            self.sink.add(Found(path, kind, shape))
            return
        if "MATLAB_empty" in item.attrs:
            self.sink.add(Found(path, kind, shape))
            return
        values = values_of(item, path, self.limit)
        self.sink.add(Found(path, kind, shape, _bytes_of(values), values.dtype.str))
        if not self.inside_objects:
            self.notes(item, path)


def _bytes_of(values: Any) -> memoryview:
    return memoryview(values).cast("B") if values.size else memoryview(b"")
