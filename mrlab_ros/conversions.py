"""ROS messages to core objects and back; nothing else in the lab knows both."""

from __future__ import annotations

import array
import struct
from typing import Any

import numpy as np
from builtin_interfaces.msg import Time
from geometry_msgs.msg import (
    Point,
    Pose,
    Quaternion,
    Transform,
    TransformStamped,
    Vector3,
)
from mrlab_msgs import msg
from numpy.typing import NDArray
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from mrlab_ros.core.clock import SECOND, PlaybackClock
from mrlab_ros.core.diagnostics import Diagnostic, Severity
from mrlab_ros.core.kinematics import Array
from mrlab_ros.core.playback import Snapshot
from mrlab_ros.core.scene import Pose as Place
from mrlab_ros.core.trajectory import Channels, Source, Trajectory


def stamp(ns: int) -> Time:
    """Return nanoseconds as a ROS time."""
    return Time(sec=ns // SECOND, nanosec=ns % SECOND)


def to_ns(time: Time) -> int:
    """Return a ROS time in nanoseconds."""
    return int(time.sec) * SECOND + int(time.nanosec)


def header(ns: int, frame_id: str = "") -> Header:
    return Header(stamp=stamp(ns), frame_id=frame_id)


def diagnostic_to_message(diagnostic: Diagnostic) -> msg.Diagnostic:
    return msg.Diagnostic(
        severity=int(diagnostic.severity),
        code=diagnostic.code,
        message=diagnostic.message,
        remedy=diagnostic.remedy,
        variable=diagnostic.variable,
        where=diagnostic.where,
    )


def diagnostic_from_message(message: msg.Diagnostic) -> Diagnostic:
    return Diagnostic(
        message.code,
        Severity(message.severity),
        message.message,
        message.remedy,
        message.variable,
        message.where,
    )


def info_to_message(trajectory: Trajectory) -> msg.TrajectoryInfo:
    return msg.TrajectoryInfo(
        id=trajectory.id,
        robot_model=trajectory.robot_model,
        end_effector=trajectory.end_effector or "",
        source_file=trajectory.source.file,
        source_variable=trajectory.source.variable,
        source_sha256=trajectory.source.sha256,
        created=stamp(trajectory.created_ns),
        frame_rate=trajectory.frame_rate,
        frame_count=trajectory.frame_count,
        duration=trajectory.duration,
        has_gripper=trajectory.gripper is not None,
        warnings=[diagnostic_to_message(d) for d in trajectory.warnings],
    )


def _doubles(matrix: Array) -> array.array[float]:
    return array.array("d", np.ascontiguousarray(matrix, dtype=np.float64).tobytes())


def trajectory_to_message(trajectory: Trajectory) -> msg.Trajectory:
    gripper = trajectory.gripper
    return msg.Trajectory(
        info=info_to_message(trajectory),
        joint_names=list(trajectory.joint_names),
        positions=_doubles(trajectory.positions),
        velocities=_doubles(trajectory.channels.velocities),
        effort_proxy=_doubles(trajectory.channels.effort_proxy),
        gripper=array.array("B", b"" if gripper is None else gripper.astype(np.uint8).tobytes()),
    )


def trajectory_from_message(message: msg.Trajectory) -> Trajectory:
    """Return the trajectory that the message carries; raise BadInput where it is none.

    Accelerations do not travel: they are zeros.
    """
    info, names = message.info, tuple(message.joint_names)

    def matrix(values: array.array[float]) -> Array:
        flat: NDArray[np.float64] = np.array(values, dtype=np.float64)
        return flat.reshape(-1, len(names)) if names and flat.size % len(names) == 0 else flat

    positions = matrix(message.positions)
    return Trajectory(
        id=info.id,
        robot_model=info.robot_model,
        end_effector=info.end_effector or None,
        joint_names=names,
        frame_rate=info.frame_rate,
        positions=positions,
        gripper=np.array(message.gripper, dtype=np.bool_) if info.has_gripper else None,
        channels=Channels(
            matrix(message.velocities), np.zeros_like(positions), matrix(message.effort_proxy)
        ),
        source=Source(info.source_file, info.source_variable, info.source_sha256),
        created_ns=to_ns(info.created),
        warnings=tuple(diagnostic_from_message(d) for d in info.warnings),
    )


def clock_to_message(clock: PlaybackClock) -> msg.PlaybackClock:
    return msg.PlaybackClock(stamp=stamp(clock.stamp_ns), position=clock.position, rate=clock.rate)


def snapshot_to_message(now_ns: int, robot: str, snapshot: Snapshot) -> msg.PlaybackState:
    trajectory = snapshot.trajectory
    return msg.PlaybackState(
        header=header(now_ns, robot),
        state=snapshot.state.value,
        label=snapshot.state.name,
        message=snapshot.message,
        trajectory_id=trajectory.id if trajectory else "",
        clock=clock_to_message(snapshot.clock),
        frame=snapshot.frame,
        frame_count=trajectory.frame_count if trajectory else 0,
        frame_rate=trajectory.frame_rate if trajectory else 0.0,
        duration=trajectory.duration if trajectory else 0.0,
        rate=snapshot.rate,
        loop=snapshot.loop,
        system=snapshot.system,
    )


def pose_to_message(transform: Array) -> Pose:
    """Return a 4 x 4 homogeneous transform as a pose: position in m, unit quaternion."""
    m = transform
    # Shepperd's method: divide by the largest of the four, so that nothing small divides.
    choices = np.array([m[0, 0], m[1, 1], m[2, 2], m[0, 0] + m[1, 1] + m[2, 2]])
    k = int(choices.argmax())
    q = np.empty(4)
    if k == 3:
        q[:] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 1 + choices[3]
    else:
        i, j = (k + 1) % 3, (k + 2) % 3
        q[k] = 1 + m[k, k] - m[i, i] - m[j, j]
        q[i], q[j] = m[i, k] + m[k, i], m[j, k] + m[k, j]
        q[3] = m[j, i] - m[i, j]
    q /= np.linalg.norm(q)
    x, y, z = (float(v) for v in m[:3, 3])
    return Pose(
        position=Point(x=x, y=y, z=z),
        orientation=Quaternion(x=float(q[0]), y=float(q[1]), z=float(q[2]), w=float(q[3])),
    )


def place_from_message(message: Pose) -> Place:
    """Return where something is; raise BadInput where the pose is none."""
    p, q = message.position, message.orientation
    return Place((p.x, p.y, p.z), (q.x, q.y, q.z, q.w))


def place_to_message(place: Place) -> Pose:
    (x, y, z), (qx, qy, qz, qw) = place.position, place.orientation
    return Pose(position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw))


def transforms_to_message(now_ns: int, kind: type[Any], robots: list[msg.Robot]) -> Any:
    """Return the robots' base transforms, T_world_base, as a message of `kind` (TFMessage)."""
    transforms = []
    for robot in robots:
        p = robot.pose.position
        transforms.append(
            TransformStamped(
                header=header(now_ns, "world"),
                child_frame_id=f"{robot.name}/base_link",
                transform=Transform(
                    translation=Vector3(x=p.x, y=p.y, z=p.z), rotation=robot.pose.orientation
                ),
            )
        )
    return kind(transforms=transforms)


class JointStateEncoder:
    """Serialises the joint states of one robot by filling in a template.

    The layout of a JointState with fixed names never changes, so the stamp and the two arrays
    are written into a message that was serialised once. That takes a sixth of the time of
    filling and serialising a message, and the bytes are those that publishing it would send.
    """

    def __init__(self, frame_id: str, joint_names: tuple[str, ...]) -> None:
        count = len(joint_names)
        # Values that no other field holds, to find the arrays in the serialised message.
        marks = [1.0e300 + 1.0e290 * i for i in range(2 * count)]
        template = JointState(
            header=Header(frame_id=frame_id, stamp=Time(sec=0x5A5A5A5A, nanosec=0x3C3C3C3C)),
            name=list(joint_names),
            position=marks[:count],
            velocity=marks[count:],
        )
        self._buffer = bytearray(serialize_message(template))
        self._size = 8 * count
        self._stamp = self._offset(struct.pack("<iI", 0x5A5A5A5A, 0x3C3C3C3C))
        self._position = self._offset(struct.pack(f"<{count}d", *marks[:count]))
        self._velocity = self._offset(struct.pack(f"<{count}d", *marks[count:]))
        # The length of the empty efforts ends the message. rclpy's serialiser adds the gap before
        # a double that never comes; readers of CDR other than ROS's own refuse such a message.
        del self._buffer[self._velocity + self._size + 4 :]

    def _offset(self, mark: bytes) -> int:
        return self._buffer.index(mark)

    def encode(self, ns: int, positions: Array, velocities: Array) -> bytes:
        """Return the CDR of a joint state: stamp in ns, (J,) rad, (J,) rad/s."""
        buffer, size = self._buffer, self._size
        struct.pack_into("<iI", buffer, self._stamp, ns // SECOND, ns % SECOND)
        buffer[self._position : self._position + size] = positions.tobytes()
        buffer[self._velocity : self._velocity + size] = velocities.tobytes()
        return bytes(buffer)
