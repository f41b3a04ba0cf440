"""Fetches trajectories from the lab's catalogue for other nodes."""

from __future__ import annotations

import weakref
from dataclasses import replace
from pathlib import Path
from typing import Any

from mrlab_msgs import srv
from rclpy.node import Node

from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.core.base.diagnostic import heard
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory.diagnostics import REPLACED_MEANWHILE
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import qos, trajectories
from mrlab_ros.ros.services import call

# Frames in one answer: 17 MB for seven joints, which takes about 0.2 s.
CHUNK = 100_000
TIMEOUT_S = 5.0


class CatalogueClient:
    """Calls /converter/get_any; `node` must be spun by another thread than the one that fetches.

    On the converter's machine the matrices are read from the file that the answer names: a
    million frames take 0.2 s, as a message more than 1 s. Elsewhere they come as messages.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._client = node.create_client(
            srv.GetTrajectory, "/converter/get_any", qos_profile=qos.SERVICES
        )
        # Robots that play the same trajectory share its matrices.
        self._loaded: weakref.WeakValueDictionary[str, Trajectory] = weakref.WeakValueDictionary()

    def close(self) -> None:
        self._node.destroy_client(self._client)

    def fetch(self, trajectory_id: str) -> Trajectory:
        """Return a trajectory; raise BadInput where there is none, NoAnswer without converter."""
        answer = self._ask(id=trajectory_id, file_only=True)
        key = repr(answer.trajectory.info)
        trajectory = self._loaded.get(key)
        if trajectory is None:
            trajectory = self._read(answer) or self._receive(answer)
            self._loaded[key] = trajectory
        return trajectory

    def _ask(self, **request: Any) -> Any:
        answer = call(self._client, srv.GetTrajectory.Request(**request), TIMEOUT_S)
        if not answer.success:
            raise BadInput(heard(answer))
        return answer

    def _read(self, answer: Any) -> Trajectory | None:
        """Return what the file holds; None where it is not here, or not what it should be."""
        path = Path(answer.file)
        if not answer.file or not path.is_file():
            return None
        try:
            read = npz_file.read(path)
        except (BadInput, OSError):
            return None  # the converter says what is wrong with it when it is asked for frames
        # The file does not say under which id, for whom and as which version it was published.
        info = answer.trajectory.info
        trajectory = replace(
            read, id=info.id, owner=info.owner, version=info.version, shared=info.shared
        )
        return trajectory if _same(trajectories.info_to_message(trajectory), info) else None

    def _receive(self, answer: Any) -> Trajectory:
        """Return what the answers of the converter hold."""
        message = answer.trajectory
        for begin in range(0, message.info.frame_count if answer.file else 0, CHUNK):
            part = self._ask(id=message.info.id, begin=begin, count=CHUNK).trajectory
            if not _same(part.info, message.info):
                raise BadInput(REPLACED_MEANWHILE(id=message.info.id))
            message.joint_names = part.joint_names
            for name in ("positions", "velocities", "effort_proxy", "gripper"):
                getattr(message, name).extend(getattr(part, name))
        return trajectories.trajectory_from_message(message)


def _same(one: Any, other: Any) -> bool:
    """Compare two infos as text: a warning without a number holds NaN, which equals nothing."""
    return repr(one) == repr(other)
