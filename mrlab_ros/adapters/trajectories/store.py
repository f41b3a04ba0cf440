"""Keeps trajectories as files of NumPy arrays in a folder: exact, checked, replaced as a whole.

A file is an uncompressed npz archive, which `numpy.load` reads: `head.json` (the metadata of the
trajectory file), `positions`, `velocities` and `effort_proxy`, each (N, J) float64 in rad, rad/s
and N*m nominal, and `gripper`, (N,) bool, for an arm with one. Positions are kept bit for bit.
The CRC-32 that a zip archive keeps of each part is the checksum.
"""

from __future__ import annotations

import contextlib
import os
import struct
import tempfile
import threading
import time
import zipfile
import zlib
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import orjson
from numpy.typing import NDArray

from mrlab_ros.adapters.set_aside import set_aside
from mrlab_ros.adapters.trajectories import json_file
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.naming import did_you_mean
from mrlab_ros.core.trajectory import document
from mrlab_ros.core.trajectory.document import Frames
from mrlab_ros.core.trajectory.trajectory import Channels, Trajectory

SUFFIX = ".npz"
JSON_SUFFIX = ".json"
FORMAT = 1
HEAD = "head.json"
UNITS = {"positions": "rad", "velocities": "rad/s", "effort_proxy": "N*m nominal"}
MATRICES = tuple(UNITS)
GRIPPER = "gripper"
# Folders inside the store for files that are no longer part of it.
DAMAGED, IMPORTED = "damaged", "imported"
TEMPORARY = ".writing-"
STALE_AFTER_S = 3600.0  # a temporary file this old belongs to a process that was killed
BLOCK = 1 << 20  # bytes read and summed at once: they stay in the processor's cache
# Bytes of a member's header in a zip archive, and where the lengths of name and extra field are.
LOCAL_HEADER, LENGTHS = 30, struct.Struct("<26xHH")
HEAD_TYPES = {
    "id": str,
    "robot_model": str,
    "end_effector": str | None,
    "source": dict,
    "created_ns": int,
    "frame_rate": int | float,
    "frame_count": int,
    "has_gripper": bool,
    "warnings": list,
    "joint_names": list,
}


class Damaged(BadInput):
    """A file of the store does not hold what was written into it."""


def write(trajectory: Trajectory, file: BinaryIO) -> None:
    """Write a trajectory into an open, empty, seekable file."""
    head = document.metadata(trajectory) | {"format": FORMAT, "units": UNITS}
    parts: dict[str, NDArray[Any]] = {
        "positions": trajectory.positions,
        "velocities": trajectory.channels.velocities,
        "effort_proxy": trajectory.channels.effort_proxy,
    }
    if trajectory.gripper is not None:
        parts[GRIPPER] = trajectory.gripper
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as archive:
        with archive.open(HEAD, "w") as part:
            part.write(orjson.dumps(head))
        for name, values in parts.items():
            kind = np.dtype(np.bool_ if name == GRIPPER else "<f8")
            rows = np.ascontiguousarray(values, dtype=kind)
            with archive.open(f"{name}.npy", "w", force_zip64=True) as part:
                np.lib.format.write_array_header_1_0(
                    part, np.lib.format.header_data_from_array_1_0(rows)
                )
                part.write(rows.reshape(-1).view(np.uint8).data)


class _Archive:
    """An open file of the store."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._zip = zipfile.ZipFile(file)

    def head(self) -> dict[str, Any]:
        """Return the metadata; raise BadInput where another version wrote the file."""
        head: dict[str, Any] = orjson.loads(self._zip.read(HEAD))
        if head["format"] != FORMAT:
            raise BadInput(
                f"trajectory '{head['id']}' is kept in format {head['format']}; this MR-Lab reads "
                f"format {FORMAT}: update it, or convert the workspace again"
            )
        for name, kind in HEAD_TYPES.items():
            if not isinstance(head[name], kind):
                raise TypeError(f"'{name}' in its {HEAD} is {head[name]!r}")
        document.warnings_of(head)
        return head

    def read(self, name: str, shape: tuple[int, ...], begin: int, end: int) -> NDArray[Any]:
        """Return the rows `begin` to `end` of an array of that shape.

        The checksum is verified where these are all rows.
        """
        header, at = self._array(name, shape)
        kind = np.dtype(np.bool_ if name == GRIPPER else "<f8")
        rows = np.empty((end - begin, *shape[1:]), dtype=kind)
        row = kind.itemsize * (shape[1] if len(shape) > 1 else 1)
        self._file.seek(at + begin * row)
        total = zlib.crc32(header)
        for block in _blocks(rows.reshape(-1).view(np.uint8).data):
            if self._file.readinto(block) != len(block):  # type: ignore[attr-defined]
                raise EOFError(f"'{name}' ends early")
            total = zlib.crc32(block, total)
        if end - begin == shape[0] and total != self._zip.getinfo(f"{name}.npy").CRC:
            raise ValueError(f"'{name}' has another checksum than when it was written")
        return rows

    def verify(self, name: str, shape: tuple[int, ...]) -> None:
        """Pass where all bytes of an array are as they were written."""
        header, at = self._array(name, shape)
        info = self._zip.getinfo(f"{name}.npy")
        left, total = info.file_size - len(header), zlib.crc32(header)
        block = memoryview(bytearray(BLOCK))
        self._file.seek(at)
        while left:
            count = self._file.readinto(block[: min(left, BLOCK)])  # type: ignore[attr-defined]
            if not count:
                raise EOFError(f"'{name}' ends early")
            total, left = zlib.crc32(block[:count], total), left - count
        if total != info.CRC:
            raise ValueError(f"'{name}' has another checksum than when it was written")

    def _array(self, name: str, shape: tuple[int, ...]) -> tuple[bytes, int]:
        """Return the header of an array of that shape, and where its numbers begin."""
        info = self._zip.getinfo(f"{name}.npy")
        self._file.seek(info.header_offset)
        at = LOCAL_HEADER + sum(LENGTHS.unpack(self._file.read(LOCAL_HEADER)))
        at += info.header_offset
        self._file.seek(at)
        version = np.lib.format.read_magic(self._file)
        found, by_column, kind = np.lib.format.read_array_header_1_0(self._file)
        end = self._file.tell()
        expected = np.dtype(np.bool_ if name == GRIPPER else "<f8")
        size = end - at + expected.itemsize * int(np.prod(shape, dtype=np.int64))
        if (
            version != (1, 0)
            or info.compress_type != zipfile.ZIP_STORED
            or (found, by_column, kind) != (shape, False, expected)
            or info.file_size != size
        ):
            raise ValueError(f"'{name}' is {found} {kind}; expected {shape} {expected}")
        self._file.seek(at)
        return self._file.read(end - at), end


def _blocks(data: memoryview) -> Iterator[memoryview]:
    for begin in range(0, len(data), BLOCK):
        yield data[begin : begin + BLOCK]


def _shapes(head: Mapping[str, Any]) -> dict[str, tuple[int, ...]]:
    count, joints = int(head["frame_count"]), len(head["joint_names"])
    shapes: dict[str, tuple[int, ...]] = dict.fromkeys(MATRICES, (count, joints))
    if head["has_gripper"]:
        shapes[GRIPPER] = (count,)
    return shapes


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[tuple[_Archive, BinaryIO]]:
    """Open a file of the store; raise Damaged for whatever is wrong inside it."""
    with path.open("rb", buffering=0) as file:
        try:
            yield _Archive(file), file  # type: ignore[arg-type, misc]
        except (BadInput, MemoryError):
            raise
        except Exception as error:  # zipfile, numpy and orjson raise many kinds
            raise Damaged(
                f"'{path.name}' is damaged ({error}); convert the workspace again"
            ) from error


def read_head(path: Path) -> dict[str, Any]:
    """Return the metadata in a file of the store; raise Damaged, or OSError without one."""
    with _opened(path) as (archive, _):
        head = archive.head()
        for name, shape in _shapes(head).items():
            archive._array(name, shape)
        return head


def read(path: Path) -> Trajectory:
    """Read a file of the store, every checksum verified; raise Damaged, or OSError without one."""
    with _opened(path) as (archive, _):
        head = archive.head()
        count = head["frame_count"]
        parts = {n: archive.read(n, shape, 0, count) for n, shape in _shapes(head).items()}
        channels = Channels(parts["velocities"], parts["effort_proxy"])
        return document.build(head, parts["positions"], parts.get(GRIPPER), channels)


class TrajectoryStore:
    """Trajectories in one folder, a file each; safe from several threads and processes.

    Writing replaces a file as a whole. A damaged file is moved to the folder `damaged` when it is
    met, and the error names it; the others stay as they are. A trajectory file of
    trajectory.schema.json in the folder, as earlier versions kept them, belongs to the catalogue
    too: it becomes an npz when it is first read, and the JSON is moved to the folder `imported`.
    """

    def __init__(self, folder: Path, log: Callable[[str], None] = lambda text: None) -> None:
        """Make the folder; what is there in its place is renamed, and `log` takes a sentence.

        Raises BadInput where the folder cannot be made.
        """
        self.folder = folder
        self._lock = threading.Lock()
        # What was verified as a whole, by path: identity of the file, so that parts of it can be
        # read without reading all of it each time.
        self._verified: dict[Path, tuple[int, int, int]] = {}
        if os.path.lexists(folder) and not folder.is_dir():
            log(f"{folder} is no folder; expected the folder of the trajectories. "
                f"{set_aside(folder)}; the catalogue starts empty")  # fmt: skip
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise BadInput(
                f"the folder {folder} cannot be made: {error.strerror}; choose another state_dir"
            ) from None
        for path in folder.glob(f"{TEMPORARY}*"):
            with contextlib.suppress(OSError):
                if path.stat().st_mtime < time.time() - STALE_AFTER_S:
                    path.unlink()

    def path(self, trajectory_id: str) -> Path:
        """Return where the trajectory is kept, or would be."""
        return self.folder / f"{trajectory_id}{SUFFIX}"

    def ids(self) -> list[str]:
        """Return the ids of all trajectories, in order."""
        names = (p.name for p in self.folder.iterdir() if not p.name.startswith("."))
        suffixes = (SUFFIX, JSON_SUFFIX)
        return sorted({Path(n).stem for n in names if n.endswith(suffixes)})

    def save(self, trajectory: Trajectory) -> Path:
        """Write the trajectory, replacing one with the same id; readers see the old or the new."""
        with self.new_file() as (file, commit):
            write(trajectory, file)
            commit(trajectory.id)
        return self.path(trajectory.id)

    @contextlib.contextmanager
    def new_file(self) -> Iterator[tuple[BinaryIO, Callable[[str], None]]]:
        """Open a temporary file for `write`; `commit(id)` makes it the trajectory of that id.

        Without commit it is removed at the end.
        """
        descriptor, name = tempfile.mkstemp(dir=self.folder, prefix=TEMPORARY)

        def commit(trajectory_id: str) -> None:
            file.flush()
            if self.path(trajectory_id).is_dir():
                self._move_away(self.path(trajectory_id))
            os.replace(name, self.path(trajectory_id))
            self._json_path(trajectory_id).unlink(missing_ok=True)

        with os.fdopen(descriptor, "w+b") as file:
            os.chmod(descriptor, 0o644)
            try:
                yield file, commit
            finally:
                with contextlib.suppress(FileNotFoundError):
                    os.unlink(name)

    def load(self, trajectory_id: str) -> Trajectory:
        """Read a trajectory; raise BadInput where there is none, Damaged where it is damaged."""
        path = self.file(trajectory_id)
        with self._set_aside(path):
            return read(path)

    def frames(self, trajectory_id: str, begin: int, count: int) -> Frames:
        """Read `count` frames from `begin` on, fewer at the end; count 0: all from there on.

        Raises BadInput where there is no such trajectory or it has no frame `begin`.
        """
        path = self.file(trajectory_id)
        with self._set_aside(path), _opened(path) as (archive, file):
            head = archive.head()
            total = head["frame_count"]
            if not 0 <= begin < total:
                raise BadInput(
                    f"'{trajectory_id}' has no frame {begin}; expected 0 to {total - 1}"
                )
            end = min(total, begin + count) if count else total
            shapes = _shapes(head)
            status = os.fstat(file.fileno())
            identity = (status.st_ino, status.st_mtime_ns, status.st_size)
            if end - begin < total and self._verified.get(path) != identity:
                for name, shape in shapes.items():
                    archive.verify(name, shape)
            parts = {n: archive.read(n, shape, begin, end) for n, shape in shapes.items()}
            self._verified[path] = identity
            return Frames(head, **parts)

    def head(self, trajectory_id: str) -> dict[str, Any]:
        """Return the metadata alone; raise BadInput where there is none, or Damaged."""
        path = self._existing(trajectory_id)
        with self._set_aside(path):
            head = json_file.head(path) if path.suffix == JSON_SUFFIX else read_head(path)
        if head["id"] != trajectory_id:
            raise BadInput(
                f"'{path.name}' holds the trajectory '{head['id']}'; name it "
                f"{head['id']}{path.suffix}"
            )
        return head

    def file(self, trajectory_id: str) -> Path:
        """Return the npz of a trajectory, importing its JSON first where only that is there."""
        path = self._existing(trajectory_id)
        if path.suffix == SUFFIX:
            return path
        with self._lock:
            path = self._existing(trajectory_id)
            if path.suffix == JSON_SUFFIX:
                with self._set_aside(path):
                    trajectory = json_file.parse(path.read_bytes(), path.name)
                folder = self.folder / IMPORTED
                folder.mkdir(exist_ok=True)
                os.link(path, _unused(folder / path.name))
                self.save(trajectory)
        return self.path(trajectory_id)

    def delete(self, trajectory_id: str) -> None:
        """Remove a trajectory; raise BadInput where there is none."""
        self._existing(trajectory_id)
        for path in (self.path(trajectory_id), self._json_path(trajectory_id)):
            path.unlink(missing_ok=True)

    def _json_path(self, trajectory_id: str) -> Path:
        return self.folder / f"{trajectory_id}{JSON_SUFFIX}"

    def _existing(self, trajectory_id: str) -> Path:
        if "/" not in trajectory_id and not trajectory_id.startswith("."):
            for path in (self.path(trajectory_id), self._json_path(trajectory_id)):
                if path.is_file():
                    return path
                if os.path.lexists(path):
                    aside = self._move_away(path)
                    what = "a folder" if aside.is_dir() else "no file"
                    raise Damaged(
                        f"'{path.name}' is {what}, not a trajectory; it was moved to {aside}"
                    )
        ids = self.ids()
        raise BadInput(
            f"there is no trajectory '{trajectory_id}'; there are: "
            f"{', '.join(ids[:10]) or 'none'}; convert a file or take one of these"
            f"{did_you_mean(trajectory_id, ids)}"
        )

    @contextlib.contextmanager
    def _set_aside(self, path: Path) -> Iterator[None]:
        """Move the file away where it turns out to be damaged."""
        try:
            yield
        except FileNotFoundError:
            raise BadInput(f"'{path.name}' was deleted meanwhile; convert it again") from None
        except BadInput as error:
            if not isinstance(error, Damaged) and path.suffix != JSON_SUFFIX:
                raise
            raise Damaged(f"{error}; it was moved to {self._move_away(path)}") from error

    def _move_away(self, path: Path) -> Path:
        """Move a path into the folder of damaged files; return where it is then."""
        folder = self.folder / DAMAGED
        folder.mkdir(exist_ok=True)
        aside = _unused(folder / path.name)
        with contextlib.suppress(FileNotFoundError):
            os.replace(path, aside)
        return aside


def _unused(path: Path) -> Path:
    """Return `path`, numbered where there is such a file already."""
    unused, number = path, 1
    while unused.exists():
        number += 1
        unused = path.with_name(f"{path.stem}-{number}{path.suffix}")
    return unused
