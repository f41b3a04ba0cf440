"""Joint states as CDR and back, past rclpy, which takes six to ten times as long.

Layout of a sensor_msgs/JointState: OMG CDR, version 1, little-endian. Four bytes say so; then
follow stamp, frame_id, names, positions, velocities and efforts. Strings and sequences have their
length before them, and each number lies at a multiple of its own size, counted from the end of
the four bytes. Encoder and decoder both use this description:

    offset  field
    0       00 01 00 00
    4       int32 seconds, uint32 nanoseconds
    12      string frame_id, with its closing zero; then zeros to a multiple of 4
            uint32 count, then each joint's name as a string with zeros to a multiple of 4
            uint32 count, zeros to a multiple of 8, float64 positions
            uint32 count, zeros to a multiple of 8, float64 velocities
            uint32 count of the efforts, which the lab leaves empty
"""

from __future__ import annotations

import struct

from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import of_text
from mrlab_ros.core.base.diagnostics import (
    JOINT_STATE_CUT,
    JOINT_STATE_UNEVEN,
    JOINT_STATE_WITHOUT,
    NO_JOINT_STATE,
)
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.messages import cdr
from mrlab_ros.messages.cdr import BODY, COUNT, DOUBLE_SIZE, ENCAPSULATION, STAMP

Numbers = tuple[float, ...]


class JointStateEncoder:
    """Writes the joint states of one robot.

    The layout of a JointState with fixed names never changes, so the stamp and the two arrays are
    written into a buffer that holds the rest.
    """

    def __init__(self, frame_id: str, joint_names: tuple[str, ...]) -> None:
        count = len(joint_names)
        begin = cdr.head(frame_id, joint_names)
        position_count = len(begin)
        self._position = cdr.doubles_at(position_count, count)
        self._position_end = velocity_count = self._position + DOUBLE_SIZE * count
        self._velocity = cdr.doubles_at(velocity_count, count)
        self._velocity_end = effort_count = self._velocity + DOUBLE_SIZE * count
        # rclpy's serialiser adds the gap before a double after the count of the empty efforts;
        # readers of CDR other than ROS's own refuse such a message.
        self._buffer = bytearray(effort_count + COUNT.size)
        self._buffer[:position_count] = begin
        COUNT.pack_into(self._buffer, position_count, count)
        COUNT.pack_into(self._buffer, velocity_count, count)

    def encode(self, ns: int, positions: Array, velocities: Array) -> bytes:
        """Return the CDR of a joint state: stamp in ns, (J,) rad, (J,) rad/s."""
        buffer = self._buffer
        STAMP.pack_into(buffer, BODY, ns // SECOND, ns % SECOND)
        buffer[self._position : self._position_end] = positions.tobytes()
        buffer[self._velocity : self._velocity_end] = velocities.tobytes()
        return bytes(buffer)


def stamp_of(data: bytes) -> int:
    """Return the stamp of a joint state, ns; raise BadInput where the bytes are none."""
    try:
        seconds, nanoseconds = STAMP.unpack_from(data, BODY)
    except struct.error:
        raise BadInput(JOINT_STATE_CUT(size=len(data))) from None
    return int(seconds) * SECOND + int(nanoseconds)


def read(data: bytes, joints: tuple[str, ...]) -> tuple[int, Numbers, Numbers]:
    """Return stamp (ns), positions (rad) and velocities (rad/s), in order of `joints`.

    A message without velocities gives none here. Raises BadInput where the bytes are no joint
    state, or one without these joints.
    """
    names = cdr.names(joints)
    try:
        seconds, nanoseconds = STAMP.unpack_from(data, BODY)
        (length,) = COUNT.unpack_from(data, BODY + STAMP.size)
        offset = cdr.aligned(BODY + STAMP.size + COUNT.size + length, COUNT.size)
        if data[:2] != ENCAPSULATION[:2] or not data.startswith(names, offset):
            return _read_slowly(data, joints)
        positions, offset = _doubles(data, offset + len(names))
        velocities, _ = _doubles(data, offset)
    except struct.error:
        raise BadInput(JOINT_STATE_CUT(size=len(data))) from None
    return seconds * SECOND + nanoseconds, positions, velocities


def _doubles(data: bytes, offset: int) -> tuple[Numbers, int]:
    """Return the sequence whose count lies at `offset`, and the offset after it."""
    (count,) = COUNT.unpack_from(data, offset)
    begin = cdr.doubles_at(offset, count)
    end = begin + DOUBLE_SIZE * count
    if end > len(data):
        raise struct.error
    return struct.unpack_from(f"<{count}d", data, begin), end


def _read_slowly(data: bytes, joints: tuple[str, ...]) -> tuple[int, Numbers, Numbers]:
    """Read a joint state of another byte order, or with its joints in another order."""
    try:
        message = deserialize_message(data, JointState)
    except Exception as error:  # rclpy raises what its middleware happens to raise
        raise BadInput(NO_JOINT_STATE(size=len(data), why=of_text(str(error)))) from None
    places = {name: i for i, name in enumerate(message.name)}
    missing = [joint for joint in joints if joint not in places]
    if missing:
        raise BadInput(JOINT_STATE_WITHOUT(missing=missing, found=list(places)))

    def ordered(values: Numbers) -> Numbers:
        if values and len(values) != len(message.name):
            raise BadInput(JOINT_STATE_UNEVEN(names=len(message.name), values=len(values)))
        return tuple(values[places[joint]] for joint in joints) if values else ()

    stamp = message.header.stamp
    stamp_ns = int(stamp.sec) * SECOND + int(stamp.nanosec)
    return stamp_ns, ordered(tuple(message.position)), ordered(tuple(message.velocity))
