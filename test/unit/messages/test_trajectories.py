"""Messages carry core objects there and back without loss."""

from __future__ import annotations

import numpy as np
import pytest
from fakes import make_trajectory
from hypothesis import given
from hypothesis import strategies as st
from mrlab_msgs.msg import Diagnostic as DiagnosticMessage
from mrlab_msgs.msg import Trajectory as TrajectoryMessage
from rclpy.serialization import deserialize_message, serialize_message
from refusals import refused

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, Severity
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.candidates import preview
from mrlab_ros.core.conversion.workspace import Variable
from mrlab_ros.core.trajectory.diagnostics import POSITIONS_SHAPE
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
    with refused(POSITIONS_SHAPE, BadInput):
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


@pytest.mark.parametrize("numbers", [{}, {"value": 3.5, "limit": 0.0, "unit": "rad"}])
def test_a_finding_survives_the_wire(numbers):
    found = Diagnostic(
        "joint_limit",
        Severity.ERROR,
        "too far",
        "less",
        {
            "variable": "q",
            "where": "row 3, column 2",
            "first_row": 3,
            "last_row": 9,
            "joint": "joint_2",
            **numbers,
        },
        (Fix("columns", "1:6", "q = q(:, 1:6)"), Fix(matlab="q = unwrap(q)")),
    )
    wire = serialize_message(trajectories.diagnostic_to_message(found))
    message = deserialize_message(wire, DiagnosticMessage)
    assert trajectories.diagnostic_from_message(message) == found


def test_a_preview_is_bounded_and_holds_the_marked_rows():
    values = np.arange(2000 * 40, dtype=np.float64).reshape(2000, 40)
    values[10, 3] = np.inf
    shown = preview(Variable("q", "double", values.shape, values), marked=[11, 5, 9999])
    message = trajectories.preview_to_message(shown)
    assert (message.variable, message.columns) == ("q", 32)
    rows = list(message.rows)
    assert rows == sorted(set(rows))
    assert len(rows) <= 400
    assert {1, 5, 11, 2000} <= set(rows)
    back = np.array(message.values).reshape(len(rows), 32)
    assert np.isnan(back[rows.index(11), 3])
    np.testing.assert_array_equal(back[rows.index(5)], values[4, :32].astype(np.float32))
