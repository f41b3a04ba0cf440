"""The files of versions on this machine: in the store's folder, or fetched from a service."""

from __future__ import annotations

import contextlib
import hashlib
import os
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from mrlab_ros.adapters.store.port import Missing, ObjectStore, StoreFailure
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.adapters.trajectories.npz_file import Damaged
from mrlab_ros.adapters.whole_file import TEMPORARY, replaced
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory.catalogue import Record, Version, head_of
from mrlab_ros.core.trajectory.derived_signals import ProxyCoefficients
from mrlab_ros.core.trajectory.diagnostics import NO_ROOM_FOR_COPY, VERSION_GONE, VERSION_REMOVED
from mrlab_ros.core.trajectory.document import Frames
from mrlab_ros.core.trajectory.trajectory import Trajectory

Value = TypeVar("Value")
MOST_BYTES = 4 << 30
STALE_AFTER_S = 3600.0  # a temporary file this old belongs to a process that was killed
MOST_VERIFIED = 10_000  # files that are known to be whole


class TrajectoryFiles:
    """Reads versions; safe from several threads and processes.

    folder: where files of a store that is no folder are kept, the least used removed beyond
    `most_bytes`. A version's file never changes, so what is there is never old.
    """

    def __init__(self, store: ObjectStore, folder: Path, most_bytes: int = MOST_BYTES) -> None:
        self._store = store
        self._folder, self._most_bytes = folder, most_bytes
        self._fetching: dict[str, threading.Lock] = {}
        self._lock = threading.Lock()
        # By key: identity of the file that was verified as a whole, so that parts of it can be
        # read without reading all of it each time.
        self._verified: dict[str, tuple[int, int, int]] = {}

    def path(self, version: Version) -> Path:
        """Return the version's file; raise BadInput where it is gone, StoreFailure."""
        path = self._store.path(version.key)
        if path is not None:
            if path.is_file():
                return path
            raise BadInput(VERSION_GONE(version=version.number, place=self._store.place))
        path = self._cached(version)
        with self._lock:
            lock = self._fetching.setdefault(version.key, threading.Lock())
        with lock:
            if path.is_file():
                with contextlib.suppress(OSError):
                    os.utime(path)
            else:
                self._fetch(version, path)
        return path

    def load(self, record: Record, version: Version) -> Trajectory:
        """Read a version, every checksum verified; raise as path(), and Damaged."""
        trajectory = self._whole(version, npz_file.read)
        return replace(
            trajectory,
            id=record.id,
            owner=record.owner,
            version=version.number,
            shared=record.shared,
        )

    def frames(self, record: Record, version: Version, begin: int, count: int) -> Frames:
        """Read `count` frames from `begin` on, as npz_file.read_frames() does."""

        def read(path: Path) -> Frames:
            status = path.stat()
            identity = (status.st_ino, status.st_mtime_ns, status.st_size)
            known = self._verified.get(version.key) == identity
            frames = npz_file.read_frames(path, begin, count, verified=known)
            if len(self._verified) >= MOST_VERIFIED:
                self._verified.clear()
            self._verified[version.key] = identity
            return frames

        return replace(self._whole(version, read), head=head_of(record, version))

    def _whole(self, version: Version, read: Callable[[Path], Value]) -> Value:
        """Read a file; what was fetched and is damaged is fetched once more."""
        try:
            return self._read(version, read)
        except Damaged:
            if self._store.path(version.key) is not None:
                raise
        self._cached(version).unlink(missing_ok=True)
        return self._read(version, read)

    def _read(self, version: Version, read: Callable[[Path], Value]) -> Value:
        try:
            return read(self.path(version))
        except FileNotFoundError:
            raise BadInput(VERSION_REMOVED(version=version.number)) from None

    def _cached(self, version: Version) -> Path:
        return self._folder / f"{hashlib.sha256(version.key.encode()).hexdigest()}.npz"

    def _fetch(self, version: Version, path: Path) -> None:
        try:
            self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            with replaced(path, 0o600) as file:
                self._store.get_file(version.key, file)
        except Missing:
            raise BadInput(VERSION_GONE(version=version.number, place=self._store.place)) from None
        except OSError as error:
            why = NO_ROOM_FOR_COPY(folder=str(self._folder), error=error.strerror)
            raise StoreFailure(why) from None
        self._make_room(path)

    def _make_room(self, keep: Path) -> None:
        """Remove the least used files beyond the bound, and what killed processes left."""
        files = []
        for path in self._folder.iterdir():
            with contextlib.suppress(OSError):
                status = path.stat()
                if not path.name.startswith(TEMPORARY):
                    files.append((status.st_mtime, status.st_size, path))
                elif status.st_mtime < time.time() - STALE_AFTER_S:
                    path.unlink()
        total = sum(size for _, size, _ in files)
        for _, size, path in sorted(files):
            if total <= self._most_bytes:
                return
            if path != keep:
                path.unlink(missing_ok=True)
                total -= size


def load_coefficients(path: Path) -> ProxyCoefficients:
    """Read config/torque_proxy.yaml; raise BadInput that names all its mistakes."""
    return ProxyCoefficients.from_mapping(read_yaml(path))
