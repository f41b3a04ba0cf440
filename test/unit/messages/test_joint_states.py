"""The codec of joint states against itself and against rclpy."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from hypothesis import given
from hypothesis import strategies as st
from rclpy.serialization import deserialize_message, serialize_message
from refusals import refused
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostics import JOINT_STATE_UNEVEN, JOINT_STATE_WITHOUT
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.messages import joint_states
from mrlab_ros.messages.joint_states import JointStateEncoder

NUMBERS = st.lists(st.floats(allow_nan=False), max_size=9)
TEXT = st.text(st.characters(codec="ascii", exclude_characters="\0"), max_size=9)


@given(
    st.integers(0, 2**31 - 1),
    st.integers(0, SECOND - 1),
    TEXT,
    st.lists(TEXT, max_size=8),
    NUMBERS,
    NUMBERS,
)
def test_what_is_read_is_what_was_written(sec, nanosec, frame_id, names, positions, velocities):
    header = Header(frame_id=frame_id, stamp=Time(sec=sec, nanosec=nanosec))
    message = JointState(header=header, name=names, position=positions, velocity=velocities)
    expected = (sec * SECOND + nanosec, tuple(positions), tuple(velocities))
    data = unpadded(bytes(serialize_message(message)), frame_id, names)
    assert joint_states.read(data, tuple(names)) == expected


@given(
    st.integers(0, 2**31 * SECOND - 1),
    st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=9),
    st.lists(
        st.tuples(
            st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=9),
            st.floats(width=64),
            st.floats(width=64),
        ),
        max_size=9,
    ),
)
def test_what_is_encoded_is_decoded_by_ours_and_by_rclpy(ns, frame_id, joints):
    names = tuple(name for name, _, _ in joints)
    positions = np.array([position for _, position, _ in joints], dtype=np.float64)
    velocities = np.array([velocity for _, _, velocity in joints], dtype=np.float64)
    data = JointStateEncoder(frame_id, names).encode(ns, positions, velocities)
    stamp, *found = joint_states.read(data, names)
    assert stamp == ns
    for values, expected in zip(found, (positions, velocities), strict=True):
        np.testing.assert_array_equal(values, expected)
    message = deserialize_message(data, JointState)
    assert message.header.frame_id == frame_id
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == divmod(ns, SECOND)
    assert tuple(message.name) == names
    np.testing.assert_array_equal(message.position, positions)
    np.testing.assert_array_equal(message.velocity, velocities)
    assert len(message.effort) == 0


def test_an_encoder_writes_one_state_after_another():
    encoder = JointStateEncoder("ur5e_1", ("a", "joint_b"))
    first = encoder.encode(7, np.ones(2), np.zeros(2))
    encoder.encode(8, np.zeros(2), np.ones(2))
    assert encoder.encode(7, np.ones(2), np.zeros(2)) == first


def unpadded(data: bytes, frame_id: str, names: list[str]) -> bytes:
    """Return the message with nothing but zeros between its strings: Fast CDR leaves there what
    its memory held."""
    written, at = bytearray(data), 12
    for i, text in enumerate((frame_id, *names)):
        at += 4 if i != 1 else 8
        end = at + len(text) + 1
        at = end + -end % 4
        written[end:at] = bytes(at - end)
    return bytes(written)


def test_joints_in_another_order_find_their_place_and_wrong_ones_are_refused():
    message = JointState(name=["b", "x", "a"], position=[2.0, 0.0, 1.0])
    data = bytes(serialize_message(message))
    assert joint_states.read(data, ("a", "b")) == (0, (1.0, 2.0), ())
    with refused(JOINT_STATE_WITHOUT, BadInput, missing=["c"], found=["b", "x", "a"]):
        joint_states.read(data, ("a", "c"))
    message.velocity = [1.0]
    with refused(JOINT_STATE_UNEVEN, BadInput):
        joint_states.read(bytes(serialize_message(message)), ("a", "b"))


def big_endian(stamp: int, names: tuple[str, ...], positions: tuple[float, ...]) -> bytes:
    data = struct.pack(">iI", stamp, 0) + struct.pack(">I", 1) + bytes(4)
    data += struct.pack(">I", len(names))
    for name in names:
        text = name.encode() + b"\0"
        data += struct.pack(">I", len(text)) + text + bytes(-len(text) % 4)
    data += struct.pack(">I", len(positions))
    data += bytes(-len(data) % 8) + struct.pack(f">{len(positions)}d", *positions)
    return b"\0\0\0\0" + data + struct.pack(">II", 0, 0)


def test_the_other_byte_order_is_read_too_and_what_is_no_message_is_refused():
    data = big_endian(7, ("a", "joint_b"), (1.0, 2.0))
    assert joint_states.read(data, ("a", "joint_b")) == (7 * SECOND, (1.0, 2.0), ())
    for broken in (b"", data[:30], b"\0\x01" + bytes(20), b"\0\x03" + data[2:]):
        with pytest.raises(BadInput):
            joint_states.read(broken, ("a", "joint_b"))


def test_what_the_lab_writes_is_read_and_what_is_cut_off_is_refused():
    data = JointStateEncoder("ur5e_1", ("a", "joint_b")).encode(7, np.ones(2), np.zeros(2))
    joints = ("a", "joint_b")
    assert joint_states.read(data, joints) == (7, (1.0, 1.0), (0.0, 0.0))
    for size in range(4, len(data) - 8):
        with pytest.raises(BadInput):
            joint_states.read(data[:size], joints)
    huge = data[:12] + struct.pack("<I", 0xFFFFFFFF) + data[16:]
    with pytest.raises(BadInput):
        joint_states.read(huge, joints)
