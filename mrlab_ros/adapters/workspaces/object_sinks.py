"""Sinks for files with objects: one keeps closed objects back, one remembers matrices."""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.adapters.workspaces.mat5 import Sink


class ObjectSink:
    """Passes variables on, and keeps those that are closed objects back for `open_objects`."""

    def __init__(self, sink: Sink) -> None:
        self.sink = sink
        self.closed: dict[str, str] = {}

    def add(
        self,
        path: str,
        kind: str,
        shape: tuple[int, ...],
        data: memoryview | bytes | None = None,
        dtype: str = "",
        *,
        is_object: bool = False,
        **facts: Any,
    ) -> None:
        """Take one variable; see `Sink`."""
        if is_object and kind != "function_handle":
            self.closed[path] = kind
        else:
            self.sink.add(path, kind, shape, data, dtype, is_object=is_object, **facts)


class WithinObjects:
    """Passes variables on as such that lie in objects."""

    def __init__(self, sink: Sink) -> None:
        self.sink = sink

    def add(self, path: str, kind: str, shape: tuple[int, ...], *data: Any, **facts: Any) -> None:
        """Take one variable; see `Sink`."""
        self.sink.add(path, kind, shape, *data, within_object=True, **facts)


class Digests:
    """A sink that remembers which matrices it was given, without keeping them."""

    def __init__(self) -> None:
        self._seen: set[bytes] = set()

    def add(
        self,
        path: str,
        kind: str,
        shape: tuple[int, ...],
        data: memoryview | bytes | None = None,
        dtype: str = "",
        **_: Any,
    ) -> None:
        """Remember one matrix; see `Sink`."""
        if data is not None and len(data):
            self._seen.add(digest(np.frombuffer(data, dtype).reshape(shape, order="F")))

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
