"""The trajectory file: a trajectory as the document of trajectory.schema.json, and back.

Degrees appear here and nowhere else. A document is plain data, but its matrices are numpy arrays,
so that no adapter has to build a million Python numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic, from_plain, plain
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory.diagnostics import COLUMN_NOT_FINITE, COLUMN_OF_TIME, COLUMN_SHAPE
from mrlab_ros.core.trajectory.trajectory import Array, Channels, Source, Trajectory, size_of

SCHEMA_VERSION = "1.0"
UNITS = {"q": "deg", "dq": "deg/s", "tau_proxy": "N*m nominal", "t": "s"}


def metadata(trajectory: Trajectory) -> dict[str, Any]:
    """Return everything of the document but its frames."""
    return {
        "schema_version": SCHEMA_VERSION,
        "id": trajectory.id,
        "robot_model": trajectory.robot_model,
        "end_effector": trajectory.end_effector,
        "source": asdict(trajectory.source),
        "created_ns": trajectory.created_ns,
        "frame_rate": trajectory.frame_rate,
        "frame_count": trajectory.frame_count,
        "has_gripper": trajectory.gripper is not None,
        "units": UNITS,
        "warnings": [plain(warning) for warning in trajectory.warnings],
        "joint_names": list(trajectory.joint_names),
    }


def frames(
    trajectory: Trajectory, begin: int, end: int, names: tuple[str, ...] = ()
) -> dict[str, Any]:
    """Return the columns of the frames `begin` to `end` (excluded), in the document's units.

    names: only those columns; empty: all.
    """
    part = slice(begin, min(end, trajectory.frame_count))
    gripper, channels = trajectory.gripper, trajectory.channels
    columns: dict[str, Callable[[], Any]] = {
        "t": lambda: np.arange(part.start, part.stop) / trajectory.frame_rate,
        "q": lambda: np.degrees(trajectory.positions[part]),
        "dq": lambda: np.degrees(channels.velocities[part]),
        "tau_proxy": lambda: channels.effort_proxy[part],
    }
    if gripper is not None:
        columns["gripper"] = lambda: gripper[part].view(np.uint8)
    return {name: columns[name]() for name in names or columns}


def document(trajectory: Trajectory) -> dict[str, Any]:
    """Return the whole document: q in deg, dq in deg/s, t_i = i / frame_rate in s."""
    return {**metadata(trajectory), "frames": frames(trajectory, 0, trajectory.frame_count)}


def warnings_of(head: Mapping[str, Any]) -> tuple[Diagnostic, ...]:
    """Return the warnings in a document's metadata."""
    return tuple(from_plain(warning) for warning in head["warnings"])


def _matrix(columns: Mapping[str, Any], name: str, shape: tuple[int, ...]) -> Array:
    try:
        values = np.asarray(columns[name], dtype=np.float64)
    except (TypeError, ValueError):
        values = np.empty(0)
    if values.shape != shape:
        raise BadInput(
            COLUMN_SHAPE(column=name, size=size_of(values.shape), expected=size_of(shape))
        )
    if not np.isfinite(values).all():
        raise BadInput(COLUMN_NOT_FINITE(column=name))
    return values


def build(
    head: Mapping[str, Any],
    positions: Array,
    gripper: NDArray[np.bool_] | None,
    channels: Channels,
) -> Trajectory:
    """Build a trajectory from a document's metadata and its matrices, rad and rad/s."""
    return Trajectory(
        id=head["id"],
        robot_model=head["robot_model"],
        end_effector=head["end_effector"],
        joint_names=tuple(head["joint_names"]),
        frame_rate=float(head["frame_rate"]),
        positions=positions,
        gripper=gripper,
        channels=channels,
        source=Source(**head["source"]),
        created_ns=head["created_ns"],
        warnings=warnings_of(head),
        owner=head.get("owner", ""),
        version=head.get("version", 1),
        shared=head.get("shared", True),
    )


@dataclass(frozen=True, eq=False)
class Frames:
    """Some consecutive frames of a trajectory that is kept elsewhere.

    head: the metadata of the whole trajectory; positions, velocities, effort_proxy: (n, J) in
    rad, rad/s and N*m nominal; gripper: (n,) bool, or None for an arm without one.
    """

    head: Mapping[str, Any]
    positions: Array
    velocities: Array
    effort_proxy: Array
    gripper: NDArray[np.bool_] | None = None


def trajectory(document: Mapping[str, Any]) -> Trajectory:
    """Build the trajectory of a document that agrees with the schema's types.

    Checks every number (finite, right shape, t_i = i / frame_rate within 1e-9 s relative); the
    positions are the workspace's radians within 1e-12. Raises BadInput where the document
    contradicts itself.
    """
    columns = document["frames"]
    names = tuple(document["joint_names"])
    count, rate = document["frame_count"], float(document["frame_rate"])
    shape = (count, len(names))
    t = _matrix(columns, "t", (count,))
    if not np.allclose(t, np.arange(count) / rate, rtol=1e-9, atol=1e-12):
        raise BadInput(COLUMN_OF_TIME(rate=rate))
    velocities = np.radians(_matrix(columns, "dq", shape))
    gripper = None
    if document["has_gripper"]:
        gripper = _matrix(columns, "gripper", (count,)) > 0.5
    positions = np.radians(_matrix(columns, "q", shape))
    channels = Channels(velocities, _matrix(columns, "tau_proxy", shape))
    return build(document, positions, gripper, channels)
