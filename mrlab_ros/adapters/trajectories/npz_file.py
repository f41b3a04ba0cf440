"""A trajectory as a file of NumPy arrays: exact, and every part checked when it is read.

It is an uncompressed npz archive, which `numpy.load` reads: `head.json` (the metadata of the
trajectory file), `positions`, `velocities` and `effort_proxy`, each (N, J) float64 in rad, rad/s
and N*m nominal, and `gripper`, (N,) bool, for an arm with one. Positions are kept bit for bit.
The CRC-32 that a zip archive keeps of each part is the checksum.
"""

from __future__ import annotations

import contextlib
import struct
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import orjson
from numpy.typing import NDArray

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory import document
from mrlab_ros.core.trajectory.diagnostics import DAMAGED_TRAJECTORY, NEWER_FORMAT, NO_SUCH_FRAME
from mrlab_ros.core.trajectory.document import Frames
from mrlab_ros.core.trajectory.trajectory import Channels, Trajectory

SUFFIX = ".npz"
FORMAT = 1
HEAD = "head.json"
UNITS = {"positions": "rad", "velocities": "rad/s", "effort_proxy": "N*m nominal"}
MATRICES = tuple(UNITS)
GRIPPER = "gripper"
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
    """A file does not hold what was written into it."""


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
    """An open file."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file
        self._zip = zipfile.ZipFile(file)

    def head(self) -> dict[str, Any]:
        """Return the metadata; raise BadInput where another version wrote the file."""
        head: dict[str, Any] = orjson.loads(self._zip.read(HEAD))
        if head["format"] != FORMAT:
            raise BadInput(NEWER_FORMAT(id=head["id"], found=head["format"], known=FORMAT))
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
    """Open a file; raise Damaged for whatever is wrong inside it."""
    with path.open("rb", buffering=0) as file:
        try:
            yield _Archive(file), file  # type: ignore[arg-type, misc]
        except (BadInput, MemoryError):
            raise
        except Exception as error:  # zipfile, numpy and orjson raise many kinds
            raise Damaged(DAMAGED_TRAJECTORY(file=path.name, error=str(error))) from error


def read_head(path: Path) -> dict[str, Any]:
    """Return the metadata in a file; raise Damaged, or OSError without one."""
    with _opened(path) as (archive, _):
        head = archive.head()
        for name, shape in _shapes(head).items():
            archive._array(name, shape)
        return head


def read(path: Path) -> Trajectory:
    """Read a file, every checksum verified; raise Damaged, or OSError without one."""
    with _opened(path) as (archive, _):
        head = archive.head()
        count = head["frame_count"]
        parts = {n: archive.read(n, shape, 0, count) for n, shape in _shapes(head).items()}
        channels = Channels(parts["velocities"], parts["effort_proxy"])
        return document.build(head, parts["positions"], parts.get(GRIPPER), channels)


def read_frames(path: Path, begin: int, count: int, *, verified: bool = False) -> Frames:
    """Read `count` frames from `begin` on, fewer at the end; count 0: all from there on.

    verified: the whole file is known to be as it was written; else it is read once more where
    only a part is wanted. Raises BadInput where there is no frame `begin`, and as read().
    """
    with _opened(path) as (archive, _):
        head = archive.head()
        total = head["frame_count"]
        if not 0 <= begin < total:
            raise BadInput(NO_SUCH_FRAME(id=head["id"], frame=begin, last=total - 1))
        end = min(total, begin + count) if count else total
        shapes = _shapes(head)
        if end - begin < total and not verified:
            for name, shape in shapes.items():
                archive.verify(name, shape)
        parts = {n: archive.read(n, shape, begin, end) for n, shape in shapes.items()}
        return Frames(head, **parts)
