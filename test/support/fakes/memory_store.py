"""A store in memory for tests, which can be told to fail."""

from __future__ import annotations

import hashlib
import threading
import time
from collections.abc import Iterable
from pathlib import Path
from typing import BinaryIO

from mrlab_ros.adapters.store.diagnostics import NOT_IN_STORE, STORE_FAILED
from mrlab_ros.adapters.store.port import Entry, Missing, ObjectStore, StoreFailure


class MemoryStore(ObjectStore):
    """Objects in a dictionary. broken: why every call fails; empty: none does.

    writes_left: writes that still succeed; None: all.
    """

    place = "memory"

    def __init__(self) -> None:
        self.objects: dict[str, tuple[bytes, float]] = {}
        self.broken = ""
        self.writes_left: int | None = None
        self._lock = threading.Lock()

    def put(self, key: str, data: bytes) -> None:
        with self._lock:
            self._check(writes=True)
            self.objects[key] = bytes(data), time.time()

    def put_file(self, key: str, file: BinaryIO) -> None:
        file.seek(0)
        self.put(key, file.read())

    def get(self, key: str) -> bytes:
        with self._lock:
            self._check()
            if key not in self.objects:
                raise Missing(NOT_IN_STORE(key=key))
            return self.objects[key][0]

    def get_file(self, key: str, file: BinaryIO) -> int:
        return file.write(self.get(key))

    def size(self, key: str) -> int:
        return len(self.get(key))

    def list(self, prefix: str) -> list[Entry]:
        with self._lock:
            self._check()
            return [
                Entry(key, len(data), modified, hashlib.sha256(data).hexdigest())
                for key, (data, modified) in self.objects.items()
                if key.startswith(f"{prefix}/")
            ]

    def copy(self, source: str, target: str) -> None:
        self.put(target, self.get(source))

    def delete(self, keys: Iterable[str]) -> None:
        with self._lock:
            self._check(writes=True)
            for key in keys:
                self.objects.pop(key, None)

    def path(self, key: str) -> Path | None:
        return None

    def clear_interrupted(self, older_than: float) -> int:
        return 0

    def _check(self, *, writes: bool = False) -> None:
        if writes and self.writes_left is not None:
            if self.writes_left == 0:
                raise StoreFailure(STORE_FAILED(store=self.place, why="No space left on device"))
            self.writes_left -= 1
        if self.broken:
            raise StoreFailure(STORE_FAILED(store=self.place, why=self.broken))
