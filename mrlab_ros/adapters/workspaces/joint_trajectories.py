"""Reads and writes trajectory_msgs/JointTrajectory: in rosbag2 bags, and alone as CDR.

rosbags is imported for a file that needs it: no other one pays for it.
"""

from __future__ import annotations

import io
import os
import tempfile
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from mrlab_ros.adapters.sandbox.inflate import ZSTD, inflate_zstd
from mrlab_ros.adapters.workspaces.diagnostics import LIBRARY_FAILED
from mrlab_ros.adapters.workspaces.matlab.elements import Damaged, NotAWorkspace, TooLarge
from mrlab_ros.adapters.workspaces.recorded_states import RecordedStates
from mrlab_ros.adapters.workspaces.sinks import Found, Sink
from mrlab_ros.core.conversion.diagnostics import SHORT_POINT
from mrlab_ros.core.conversion.evidence.headings import GRIPPER
from mrlab_ros.core.conversion.workspace import JOINT_STATE, JOINT_TRAJECTORY
from mrlab_ros.core.trajectory.trajectory import Trajectory

TOPIC = "/joint_trajectory"
SUFFIXES = {"mcap": ".mcap", "sqlite3": ".db3"}


@cache
def _types() -> Any:
    from rosbags.typesys import Stores, get_typestore

    return get_typestore(Stores.ROS2_JAZZY)


class _InMemory:
    """A stand-in for a path that rosbags reads: bytes, with the suffix that tells their format."""

    def __init__(self, data: memoryview, suffix: str) -> None:
        self.data = data
        self.suffix = suffix
        self.st_size = len(data)

    def exists(self) -> bool:
        return True

    def is_dir(self) -> bool:
        return False

    def open(self, *_: Any, **__: Any) -> io.BytesIO:
        return io.BytesIO(self.data)

    def stat(self) -> _InMemory:
        return self


@cache
def _reader() -> Any:
    """Return the reader of bags in memory.

    SQLite makes the name of a database absolute by asking for the current folder and for links,
    which the sandbox forbids; a database in memory keeps its name.
    """
    from rosbags.rosbag2 import Reader, storage_sqlite3

    files = storage_sqlite3.make_vfs

    def in_memory(path: Any) -> Any:
        class Named(type(files(path))):  # type: ignore[misc]
            def xFullPathname(self, name: str) -> str:  # noqa: N802 - SQLite's name
                return name

        return Named()

    storage_sqlite3.make_vfs = in_memory  # type: ignore[assignment]
    return Reader


def read_bag(
    data: memoryview, form: str, sink: Sink, limit: int, joints: Sequence[str] = ()
) -> None:
    """Hand every JointTrajectory of a bag to the sink, and the names of its other topics.

    Joint states become a motion where they name the robot's `joints`. form: mcap or sqlite3.
    A topic with several of them gives topic(1), topic(2) and so on.
    """
    if len(data) > limit:
        raise TooLarge("bag", limit, len(data))
    types = _types()
    try:
        source: Any = _InMemory(data, SUFFIXES[form])
        with _reader()(source) as bag:
            wanted = [c for c in bag.connections if c.msgtype == JOINT_TRAJECTORY]
            recorded = [c for c in bag.connections if joints and c.msgtype == JOINT_STATE]
            for other in bag.connections:
                if other not in (*wanted, *recorded):
                    sink.add(Found(other.topic, other.msgtype, ()))
            states = {c.topic: RecordedStates() for c in recorded}
            for connection, time_ns, message in bag.messages(recorded) if recorded else ():
                state = types.deserialize_cdr(_plain(message, limit), JOINT_STATE)
                states[connection.topic].add(state, time_ns)
            found: dict[str, list[bytes]] = {c.topic: [] for c in wanted}
            for connection, _, message in bag.messages(wanted) if wanted else ():
                found[connection.topic].append(_plain(message, limit))
    except MemoryError:
        raise
    except Exception as error:
        # what damage makes the reader raise has no common base
        if form == "sqlite3":
            raise NotAWorkspace("sqlite", str(error)) from None
        raise Damaged(LIBRARY_FAILED(part="bag", error=str(error))) from None
    for topic, recording in states.items():
        recording.hand_over(topic, joints, sink)
    for topic, messages in found.items():
        if not messages:
            sink.add(Found(topic, JOINT_TRAJECTORY, ()))
        for number, message in enumerate(messages, 1):
            path = topic if len(messages) == 1 else f"{topic}({number})"
            hand_over(path, _decoded(message, types), sink)


def _plain(message: bytes, limit: int) -> bytes:
    """Return a message whose bag may have compressed it by itself."""
    if not message.startswith(ZSTD):
        return message
    inflated = inflate_zstd(message, limit)
    if inflated is None:
        raise ValueError(f"a message inflates to more than {limit / 2**20:.0f} MiB")
    return bytes(inflated)


def read_cdr(data: memoryview, path: str, sink: Sink) -> None:
    """Hand one serialized JointTrajectory to the sink, called `path`."""
    hand_over(path, _decoded(bytes(data), _types()), sink)


def _decoded(data: bytes, types: Any) -> Any:
    try:
        return types.deserialize_cdr(data, JOINT_TRAJECTORY)
    except MemoryError:
        raise
    except Exception as error:
        raise Damaged(LIBRARY_FAILED(part="message", error=str(error))) from None


def hand_over(path: str, message: Any, sink: Sink) -> None:
    """Hand a message to the sink as the matrix `path`, with its times and velocities beside."""
    names, points = tuple(message.joint_names), message.points
    shape = (len(points), len(names))
    for number, point in enumerate(points, 1):
        if len(point.positions) != len(names):
            note = SHORT_POINT(point=number, count=len(point.positions), joints=len(names))
            sink.add(Found(path, JOINT_TRAJECTORY, shape, note=note, columns=names))
            return
    # bytes in the order of MATLAB's columns
    positions = np.array([p.positions for p in points], "<f8").reshape(shape)
    sink.add(Found(path, JOINT_TRAJECTORY, shape, positions.tobytes("F"), "<f8", columns=names))
    times = np.array([_seconds(p.time_from_start) for p in points], "<f8")
    sink.add(Found(f"{path}.time_from_start", "double", (len(points), 1), times.tobytes(), "<f8"))
    if points and all(len(p.velocities) == len(names) for p in points):
        velocities = np.array([p.velocities for p in points], "<f8")
        sink.add(Found(f"{path}.velocities", "double", shape, velocities.tobytes("F"), "<f8"))


def _seconds(duration: Any) -> float:
    return float(duration.sec + duration.nanosec * 1e-9)


def _points(trajectory: Trajectory, known: Any) -> Iterator[Any]:
    point = known["trajectory_msgs/msg/JointTrajectoryPoint"]
    duration = known["builtin_interfaces/msg/Duration"]
    nothing = np.empty(0)
    rows = trajectory.positions
    if trajectory.gripper is not None:
        rows = np.column_stack([rows, trajectory.gripper])
    for frame, row in enumerate(rows):
        seconds, rest = divmod(round(frame * 1e9 / trajectory.frame_rate), 1_000_000_000)
        yield point(row, nothing, nothing, nothing, duration(seconds, rest))


def serialized(trajectory: Trajectory) -> bytes:
    """Return the trajectory as the CDR of a JointTrajectory, a point a frame, positions in rad.

    Velocities are left out: a controller then goes straight from frame to frame, as playback
    does. A gripper is one more joint, 0 open and 1 closed.
    """
    types = _types()
    known = types.types
    names = [*trajectory.joint_names, *([GRIPPER] if trajectory.gripper is not None else [])]
    header = known["std_msgs/msg/Header"](known["builtin_interfaces/msg/Time"](0, 0), "")
    message = known[JOINT_TRAJECTORY](header, names, list(_points(trajectory, known)))
    return bytes(types.serialize_cdr(message, JOINT_TRAJECTORY))


def write_bag(trajectory: Trajectory, path: Path) -> None:
    """Write an MCAP bag, one file, with the trajectory as its only message."""
    from rosbags.rosbag2 import StoragePlugin, Writer

    with tempfile.TemporaryDirectory(dir=path.parent, prefix=".writing-") as folder:
        bag = Path(folder, "bag")
        with Writer(bag, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
            connection = writer.add_connection(TOPIC, JOINT_TRAJECTORY, typestore=_types())
            writer.write(connection, trajectory.created_ns, serialized(trajectory))
        os.replace(bag / "bag.mcap", path)
