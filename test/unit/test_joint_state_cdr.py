"""A joint state read from its bytes is what rclpy makes of them."""

from __future__ import annotations

import struct

import numpy as np
import pytest
from builtin_interfaces.msg import Time
from hypothesis import given
from hypothesis import strategies as st
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from mrlab_ros import joint_state_cdr
from mrlab_ros.conversions import JointStateEncoder
from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import BadInput

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
    assert joint_state_cdr.read(bytes(serialize_message(message))) == expected


def test_what_the_lab_writes_is_read_and_what_is_cut_off_is_refused():
    data = JointStateEncoder("ur5e_1", ("a", "joint_b")).encode(7, np.ones(2), np.zeros(2))
    assert joint_state_cdr.read(data) == (7, (1.0, 1.0), (0.0, 0.0))
    for size in range(4, len(data) - 8):
        with pytest.raises(BadInput, match="end before"):
            joint_state_cdr.read(data[:size])
    huge = data[:12] + struct.pack("<I", 0xFFFFFFFF) + data[16:]
    with pytest.raises(BadInput):
        joint_state_cdr.read(huge)
