"""Poses and transforms as geometry_msgs and back."""

from __future__ import annotations

from geometry_msgs.msg import Point, Quaternion
from geometry_msgs.msg import Pose as PoseMessage

from mrlab_ros.core.base.geometry import Array, Pose, pose_from_transform


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
