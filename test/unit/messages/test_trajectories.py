"""Messages carry core objects there and back without loss."""

from __future__ import annotations

import numpy as np
import pytest
from fakes import make_trajectory
from hypothesis import given
from hypothesis import strategies as st
from mrlab_msgs.msg import Trajectory as TrajectoryMessage
from rclpy.serialization import deserialize_message, serialize_message

from mrlab_ros.core.errors import BadInput
from mrlab_ros.messages import trajectories
from mrlab_ros.messages.poses import transform_to_pose_message


@given(
    st.integers(2, 40),
    st.booleans(),
    st.floats(1.0, 1000.0),
)
def test_a_trajectory_survives_the_wire(frames, gripper, rate):
    rng = np.random.default_rng(frames)
    trajectory = make_trajectory(
        rng.normal(size=(frames, 2)),
        frame_rate=rate,
        gripper=list(rng.random(frames) > 0.5) if gripper else None,
    )
    wire = serialize_message(trajectories.trajectory_to_message(trajectory))
    back = trajectories.trajectory_from_message(deserialize_message(wire, TrajectoryMessage))
    assert np.array_equal(back.positions, trajectory.positions)
    assert np.array_equal(back.channels.velocities, trajectory.channels.velocities)
    assert (back.gripper is None) == (not gripper)
    if gripper:
        assert np.array_equal(back.gripper, trajectory.gripper)
    for name in ("id", "robot_model", "end_effector", "joint_names", "frame_rate", "source"):
        assert getattr(back, name) == getattr(trajectory, name)


def test_a_message_with_a_missing_value_is_refused():
    message = trajectories.trajectory_to_message(make_trajectory())
    message.positions = message.positions[:-1]
    with pytest.raises(BadInput, match="expected at least 2 rows and 2 columns"):
        trajectories.trajectory_from_message(message)


@given(st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: np.linalg.norm(q) > 0.1))
def test_a_rotation_becomes_its_quaternion(q):
    x, y, z, w = np.array(q) / np.linalg.norm(q)
    transform = np.eye(4)
    transform[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    o = transform_to_pose_message(transform).orientation
    assert abs(np.dot([o.x, o.y, o.z, o.w], [x, y, z, w])) == pytest.approx(1.0, abs=1e-12)
