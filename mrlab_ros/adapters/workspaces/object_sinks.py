"""Sinks for files with objects: one keeps closed objects back, one remembers matrices."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.adapters.workspaces.sink import Found, Sink


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
