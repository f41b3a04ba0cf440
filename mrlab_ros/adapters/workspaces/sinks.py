"""Findings of a reader, and their takers.

Sinks for files with objects: one keeps closed objects back, one remembers matrices.

Bytes in memory as an open file, for libraries that want one.
"""

from __future__ import annotations

import hashlib
import io
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic


@dataclass(frozen=True, eq=False)
class Found:
    """One variable as a reader finds it.

    The fields are those of `core.conversion.workspace.Variable`, with the numbers as bytes: data
    is column by column, of numpy type `dtype`, None where the numbers are of no use.
    within_object: it lies in a MATLAB object, so two readers have been compared already.
    """

    path: str
    kind: str
    shape: tuple[int, ...] = ()
    data: memoryview | bytes | None = None
    dtype: str = ""
    is_object: bool = False
    note: Diagnostic | str = ""
    columns: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    time: str = ""
    label: str = ""
    text: str = ""
    within_object: bool = False


class Sink(Protocol):
    """Takes what a reader finds, in the order of the file."""

    def add(self, found: Found) -> None: ...


class ObjectSink:
    """Passes variables on, and keeps those that are closed objects back for `open_objects`."""

    def __init__(self, sink: Sink) -> None:
        self.sink = sink
        self.closed: dict[str, str] = {}

    def add(self, found: Found) -> None:
        """Take one variable."""
        if found.is_object and found.kind != "function_handle":
            self.closed[found.path] = found.kind
        else:
            self.sink.add(found)


class WithinObjects:
    """Passes variables on as such that lie in objects."""

    def __init__(self, sink: Sink) -> None:
        self.sink = sink

    def add(self, found: Found) -> None:
        """Take one variable."""
        self.sink.add(replace(found, within_object=True))


class Digests:
    """A sink that remembers which matrices it was given, without keeping them."""

    def __init__(self) -> None:
        self._seen: set[bytes] = set()

    def add(self, found: Found) -> None:
        """Remember one matrix."""
        if found.data is not None and len(found.data):
            values = np.frombuffer(found.data, found.dtype).reshape(found.shape, order="F")
            self._seen.add(digest(values))

    def __contains__(self, values: NDArray[Any]) -> bool:
        if not values.size:
            return True
        if values.dtype.kind == "c":
            return values.real in self and values.imag in self
        return digest(values) in self._seen


def digest(values: NDArray[Any]) -> bytes:
    """Return a hash of a matrix: of its shape and of its numbers as float64."""
    numbers = np.asarray(values, "<f8").tobytes(order="F")
    shape = repr(tuple(int(n) for n in values.shape)).encode()
    return hashlib.blake2b(numbers, digest_size=16, key=shape[:64]).digest()


class View(io.RawIOBase):
    """A file opened for reading on bytes that are in memory already; nothing is copied."""

    def __init__(self, data: memoryview) -> None:
        super().__init__()
        self._data = data
        self._at = 0

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        base = {io.SEEK_SET: 0, io.SEEK_CUR: self._at, io.SEEK_END: len(self._data)}[whence]
        self._at = max(base + offset, 0)
        return self._at

    def tell(self) -> int:
        return self._at

    def readinto(self, buffer: Any) -> int:
        part = self._data[self._at : self._at + len(buffer)]
        buffer[: len(part)] = part
        self._at += len(part)
        return len(part)
