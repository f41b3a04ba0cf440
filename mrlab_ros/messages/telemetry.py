"""Telemetry as CDR: past rclpy, which takes ten times as long.

Layout of a mrlab_msgs/Telemetry: as joint_states.py describes it up to the names; then

    uint32 count, zeros to a multiple of 8, float64 velocities
    uint32 count, zeros to a multiple of 8, float64 effort proxies
    uint32 frame, 4 zeros, float64 position, 2 booleans, 6 zeros, 7 float64 of the pose of tool0
    string held_object, zeros to a multiple of 8
    float64 mass, payload, slip margin, wrist moment, deadline error and its largest
    uint32 frames sent, uint32 frames lost
"""

from __future__ import annotations

import struct
from functools import lru_cache

from mrlab_msgs import msg

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import cdr
from mrlab_ros.messages.cdr import BODY, COUNT, DOUBLE_SIZE, STAMP

END = struct.Struct("<6d2I")
NO_GRASP = msg.Grasp()


@lru_cache(maxsize=64)
def _object(name: str) -> bytes:
    """Return the name of an object with the zeros up to the next number."""
    data = cdr.text(name)
    return data + bytes(-len(data) % DOUBLE_SIZE)


class TelemetryEncoder:
    """Writes the telemetry of one robot."""

    def __init__(self, robot: str, joint_names: tuple[str, ...]) -> None:
        self._head = bytearray(cdr.head(robot, joint_names))
        self._joints = joints = len(joint_names)
        begin = len(self._head)
        gap = cdr.doubles_at(begin, joints) - begin - COUNT.size
        self._values = struct.Struct(f"<I{gap}x{joints}dI4x{joints}dI4xd??6x7d")

    def encode(
        self,
        now_ns: int,
        trajectory: Trajectory,
        sample: Sample,
        tool0: Pose,
        grasp: msg.Grasp | None,
        *,
        sent: int,
        lost: int,
        error_ns: int,
        error_max_ns: int,
    ) -> bytes:
        """Return the CDR of the display values of a joint state.

        tool0: in the robot's base_link. grasp: what physics said last of the gripper; None: there
        is no physics. sent, lost: frames of this run. error_ns, error_max_ns: how late the last
        joint state was published, and the latest of the run.
        """
        closed = trajectory.gripper_at(sample.position)
        STAMP.pack_into(self._head, BODY, now_ns // SECOND, now_ns % SECOND)
        values = self._values.pack(
            self._joints,
            *sample.velocities.tolist(),
            self._joints,
            *trajectory.channels.effort_proxy[sample.frame].tolist(),
            sample.frame,
            sample.position,
            closed is not None,
            bool(closed),
            *tool0.position,
            *tool0.orientation,
        )
        bears = grasp or NO_GRASP
        end = END.pack(
            bears.mass,
            bears.payload,
            bears.slip_margin,
            bears.wrist_moment,
            error_ns * 1e-9,
            error_max_ns * 1e-9,
            sent,
            lost,
        )
        return b"".join((self._head, values, _object(bears.object), end))
