"""The encoder of telemetry against rclpy."""

from __future__ import annotations

import numpy as np
import pytest
from fakes import make_trajectory
from mrlab_msgs import msg
from rclpy.serialization import deserialize_message

from mrlab_ros.core.base.geometry import Pose
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.messages.playback import TelemetryEncoder
from mrlab_ros.messages.poses import pose_from_message

NOW_NS = 12_345_678_901
TIP = Pose((0.1, -0.2, 0.3), (0.0, 0.6, 0.0, 0.8))


@pytest.mark.parametrize("robot", ["a", "ur5e_1", "kuka_kr6_r900_sixx_12"])
@pytest.mark.parametrize("joints", [1, 2, 6, 7])
@pytest.mark.parametrize("gripper", [None, [False, True, True]])
def test_rclpy_reads_what_was_written(robot, joints, gripper):
    names = tuple(f"joint_{'x' * i}" for i in range(joints))
    positions = np.arange(3.0 * joints).reshape(3, joints)
    trajectory = make_trajectory(positions, joint_names=names, gripper=gripper)
    velocities = np.linspace(-1, 1, joints)
    sample = Sample(7, positions[1], velocities, 0.01, 1, True)
    encoder = TelemetryEncoder(robot, names)
    held = msg.Grasp(object="cube_1", mass=0.2, payload=3.9, slip_margin=-0.1, wrist_moment=0.3)
    for sent, grasp in ((1, None), (2**32 - 1, held)):
        data = encoder.encode(
            NOW_NS,
            trajectory,
            sample,
            TIP,
            grasp,
            sent=sent,
            lost=3,
            error_ns=250_000,
            error_max_ns=10**9,
        )
        found = deserialize_message(data, msg.Telemetry)
        assert found.header.frame_id == robot
        assert (found.header.stamp.sec, found.header.stamp.nanosec) == (12, 345_678_901)
        assert tuple(found.joint_names) == names
        assert list(found.velocities) == velocities.tolist()
        assert list(found.effort_proxy) == trajectory.channels.effort_proxy[1].tolist()
        assert (found.frame, found.position) == (1, 0.01)
        assert (found.has_gripper, found.gripper_closed) == (gripper is not None, bool(gripper))
        assert pose_from_message(found.tool0) == TIP
        assert (found.deadline_error, found.deadline_error_max) == pytest.approx((0.00025, 1.0))
        assert (found.frames_sent, found.frames_lost) == (sent, 3)
        bears = grasp or msg.Grasp()
        assert (found.held_object, found.held_mass) == (bears.object, bears.mass)
        assert (found.payload, found.slip_margin) == (bears.payload, bears.slip_margin)
        assert found.wrist_moment == bears.wrist_moment
