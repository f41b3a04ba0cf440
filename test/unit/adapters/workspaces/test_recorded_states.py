"""Recorded joint states become the motion of the robot whose joints they name, in the sandbox."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.app.convert import convert_file
from mrlab_ros.core.conversion.convert import Outcome
from mrlab_ros.core.conversion.options import Options

TYPES = get_typestore(Stores.ROS2_JAZZY)
ROBOT = RobotLibrary(Path(__file__).parents[4] / "robots").model("ur5e")
JOINTS = list(ROBOT.joint_names)
STATE = "sensor_msgs/msg/JointState"
RATE, START_NS = 125, 1_700_000_000_000_000_000
U = np.linspace(0, 1, 400)[:, None]
Q = (10 * U**3 - 15 * U**4 + 6 * U**5) * np.linspace(0.2, 0.9, 6) - 0.1


def state(names, positions, ns):
    t = TYPES.types
    stamp = t["builtin_interfaces/msg/Time"](*divmod(ns, 1_000_000_000))
    header, nothing = t["std_msgs/msg/Header"](stamp, ""), np.zeros(0)
    message = t[STATE](header, names, np.array(positions, float), nothing, nothing)
    return TYPES.serialize_cdr(message, STATE)


def recorded(folder, topics, storage="mcap", late=lambda row: 0.0):
    """Return a bag; topics: name -> what yields the names and positions of a row's messages.

    late: s by which the stamp of a row is later than the time of its recording.
    """
    with Writer(folder, version=9, storage_plugin=StoragePlugin[storage.upper()]) as writer:
        for topic, messages in topics.items():
            connection = writer.add_connection(topic, STATE, typestore=TYPES)
            for row, q in enumerate(Q):
                ns = START_NS + round(row * 1e9 / RATE)
                for names, positions in messages(q):
                    stamped = ns + round(late(row) * 1e9)
                    writer.write(connection, ns + 100, state(names, positions, stamped))
    (path,) = (p for p in folder.iterdir() if p.suffix in (".mcap", ".db3"))
    return path


def shuffled(q):
    yield [*JOINTS[::-1], "finger_joint"], [*q[::-1], 0.02]


def in_parts(q):
    yield ["finger_joint"], [0.02]
    yield JOINTS[:2], q[:2]
    yield JOINTS[2:], q[2:]


def two_arms(q):
    yield [f"left_{j}" for j in JOINTS] + [f"right_{j}" for j in JOINTS], [*q, *-q]


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_joint_states_are_the_motion_by_the_names_of_the_joints(tmp_path, storage):
    path = recorded(tmp_path / "bag", {"/joint_states": shuffled}, storage)
    result = convert_file(path, ROBOT, Options(), None)
    assert result.outcome is Outcome.ACCEPTED, result.message
    assert (result.trajectory.frame_rate, result.trajectory.frame_count) == (RATE, len(Q))
    np.testing.assert_allclose(result.trajectory.positions, Q, rtol=0, atol=1e-9)


def test_messages_of_some_joints_are_merged(tmp_path):
    path = recorded(tmp_path / "bag", {"/joint_states": in_parts})
    result = convert_file(path, ROBOT, Options(frame_rate=RATE), None)
    assert result.outcome is Outcome.ACCEPTED, result.message
    assert abs(result.trajectory.frame_count - len(Q)) <= 1


def test_of_several_robots_one_is_chosen(tmp_path):
    path = recorded(tmp_path / "bag", {"/joint_states": two_arms, "/b/joint_states": shuffled})
    result = convert_file(path, ROBOT, Options(), None)
    assert result.outcome is Outcome.AMBIGUOUS
    paths = {c.path for c in result.candidates}
    assert paths == {"/joint_states/left", "/joint_states/right", "/b/joint_states"}
    right = convert_file(path, ROBOT, Options(variable="/joint_states/right"), None)
    np.testing.assert_allclose(right.trajectory.positions, -Q, rtol=0, atol=1e-9)


def test_joints_of_another_robot_are_named(tmp_path):
    path = recorded(tmp_path / "bag", {"/joint_states": lambda q: [(["a", "b"], q[:2])]})
    (finding,) = convert_file(path, ROBOT, Options(), None).diagnostics
    assert finding.code == "recorded_states"
    assert list(finding.values["found"]) == ["a", "b"]


def codes(path, **options):
    result = convert_file(path, ROBOT, Options(**options), None)
    return result, {d.code for d in result.diagnostics}


def test_a_gripper_beside_the_joints_is_named_and_can_be_taken(tmp_path):
    def gripping(q):
        yield [*JOINTS, "finger_joint"], [*q, float(q[0] > 0)]

    path = recorded(tmp_path / "bag", {"/joint_states": gripping})
    _, found = codes(path)
    assert "gripper_beside" in found
    taken, found = codes(path, gripper="/joint_states.finger_joint")
    assert taken.trajectory.gripper.any()
    assert "gripper_beside" not in found


@pytest.mark.parametrize(
    ("late", "code"),
    [
        (lambda row: 60.0 * (row > 200), "recording_pauses"),
        (lambda row: -0.05 * (row > 200), "stamps_back"),
    ],
)
def test_recordings_that_pause_or_go_back_are_warned_of(tmp_path, late, code):
    path = recorded(tmp_path / "bag", {"/joint_states": shuffled}, late=late)
    result, found = codes(path)
    assert result.outcome is Outcome.ACCEPTED
    assert code in found


def test_a_topic_called_as_another_quantity_is_asked_about(tmp_path):
    path = recorded(tmp_path / "bag", {"/joint_errors": shuffled})
    result, found = codes(path)
    assert result.outcome is Outcome.AMBIGUOUS
    assert found == {"ambiguous"}
    named, _ = codes(path, variable="/joint_errors")
    assert named.outcome is Outcome.ACCEPTED


def test_degrees_that_a_topic_says_are_obeyed(tmp_path):
    def in_degrees(q):
        yield JOINTS, np.degrees(q)

    path = recorded(tmp_path / "bag", {"/joint_states_deg": in_degrees})
    result, found = codes(path)
    assert "converted_unit" in found
    np.testing.assert_allclose(result.trajectory.positions, Q, rtol=0, atol=1e-9)
