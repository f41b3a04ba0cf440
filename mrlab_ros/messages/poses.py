"""Poses and transforms as geometry_msgs and back.

Transforms as messages, and as CDR past rclpy: fixed names, and numbers that change.

A tf2_msgs/TFMessage of thirteen robots holds a hundred transforms. rclpy takes 5 ms to fill and
serialise one; here the numbers are written into a buffer that holds the rest, as
`messages.joint_states` does. The layout (OMG CDR, version 1, little-endian): four bytes that say
so, the count, then for each transform

    int32 seconds, uint32 nanoseconds, string frame_id, string child_frame_id,
    zeros to a multiple of 8, float64 x y z, float64 quaternion x y z w
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from geometry_msgs.msg import Point, Quaternion, Transform, TransformStamped, Vector3
from geometry_msgs.msg import Pose as PoseMessage
from tf2_msgs.msg import TFMessage

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.geometry import Array, Pose, pose_from_transform
from mrlab_ros.messages import cdr
from mrlab_ros.messages.cdr import BODY, COUNT, ENCAPSULATION
from mrlab_ros.messages.time import make_header


def pose_from_message(message: PoseMessage) -> Pose:
    """Return the pose; raise BadInput where it is not finite or not a unit quaternion."""
    p, q = message.position, message.orientation
    return Pose((p.x, p.y, p.z), (q.x, q.y, q.z, q.w))


def pose_to_message(pose: Pose) -> PoseMessage:
    """Return the pose as a message: position in m, unit quaternion."""
    # rosidl sends another number where a whole one stands in a decimal field.
    x, y, z, qx, qy, qz, qw = map(float, pose.position + pose.orientation)
    return PoseMessage(
        position=Point(x=x, y=y, z=z), orientation=Quaternion(x=qx, y=qy, z=qz, w=qw)
    )


def transform_to_pose_message(transform: Array) -> PoseMessage:
    """Return a (4, 4) homogeneous transform as a pose message."""
    return pose_to_message(pose_from_transform(transform))


# Numbers of a transform.
NUMBERS = 7


class TransformsEncoder:
    """Writes the transforms between the same frames again and again.

    frames: (parent, child) of each.
    """

    def __init__(self, frames: Sequence[tuple[str, str]]) -> None:
        body = bytearray(COUNT.pack(len(frames)))
        stamps, values = [], []
        for parent, child in frames:
            stamps.append(len(body))
            body += bytes(8) + cdr.text(parent) + cdr.text(child)
            body += bytes(-len(body) % 8)
            values.append(len(body))
            body += bytes(8 * NUMBERS)
        self._buffer = bytearray(ENCAPSULATION) + body
        # Views of the body in words of either size, and the places in them.
        whole = np.frombuffer(self._buffer, dtype=np.uint8)[BODY:]
        self._doubles = whole[: len(whole) // 8 * 8].view("<f8")
        self._words = whole[: len(whole) // 4 * 4].view("<u4")
        self._values = np.array(values, dtype=np.intp)[:, None] // 8 + np.arange(NUMBERS)
        self._stamps = np.array(stamps, dtype=np.intp)[:, None] // 4 + np.arange(2)

    def encode(self, stamps_ns: Array, transforms: Array) -> bytes:
        """Return the CDR: stamps (M,) ns, int64; transforms (M, 7), x y z and x y z w."""
        self._words[self._stamps] = np.stack(
            [stamps_ns // SECOND, stamps_ns % SECOND], axis=1
        ).astype(np.uint32)
        self._doubles[self._values] = transforms
        return bytes(self._buffer)


def transforms_to_message(now_ns: int, transforms: Iterable[tuple[str, str, Pose]]) -> TFMessage:
    """Return transforms, (parent, child, T_parent_child) each, as one message."""
    return TFMessage(
        transforms=[
            TransformStamped(
                header=make_header(now_ns, parent),
                child_frame_id=child,
                transform=Transform(
                    translation=Vector3(**dict(zip("xyz", pose.position, strict=True))),
                    rotation=Quaternion(**dict(zip("xyzw", pose.orientation, strict=True))),
                ),
            )
            for parent, child, pose in transforms
        ]
    )
