"""Reads the numbers of a serialised JointState past rclpy, which takes ten times as long.

Layout: OMG CDR, version 1, little-endian: four bytes that say so, then each field at a multiple of
its own size, strings and sequences behind their length.
"""

from __future__ import annotations

import struct
from functools import lru_cache

from builtin_interfaces.msg import Time
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.geometry import Array

BODY = 4
LITTLE_ENDIAN = b"\x00\x01"
COUNT = struct.Struct("<I")
# Seconds, nanoseconds, length of frame_id.
HEADER = struct.Struct("<iII")

Numbers = tuple[float, ...]


def read(data: bytes, joints: tuple[str, ...]) -> tuple[int, Numbers, Numbers]:
    """Return stamp (ns), positions and velocities, in order of `joints`.

    What has no velocities has none here. Raises BadInput where the bytes are no joint state, or
    one without these joints.
    """
    names = _names(joints)
    try:
        seconds, nanoseconds, length = HEADER.unpack_from(data, BODY)
        at = _aligned(BODY + HEADER.size + length, COUNT.size)
        if data[:2] != LITTLE_ENDIAN or not data.startswith(names, at):
            return _read_slowly(data, joints)
        positions, at = _doubles(data, at + len(names))
        velocities, at = _doubles(data, at)
    except struct.error:
        raise BadInput(f"{len(data)} bytes end before the joint state they begin") from None
    return seconds * SECOND + nanoseconds, positions, velocities


@lru_cache(maxsize=64)
def _names(joints: tuple[str, ...]) -> bytes:
    """Return the field `name` as it is between two that begin at multiples of 4."""
    field = COUNT.pack(len(joints))
    for joint in joints:
        text = joint.encode() + b"\0"
        field += COUNT.pack(len(text)) + text
        field += bytes(_aligned(len(field), COUNT.size) - len(field))
    return field


def _aligned(at: int, size: int) -> int:
    return at + -at % size


def _doubles(data: bytes, at: int) -> tuple[Numbers, int]:
    (count,) = COUNT.unpack_from(data, at)
    at += COUNT.size
    if not count:
        return (), at
    at = BODY + _aligned(at - BODY, 8)
    if at + 8 * count > len(data):
        raise struct.error
    return struct.unpack_from(f"<{count}d", data, at), at + 8 * count


def _read_slowly(data: bytes, joints: tuple[str, ...]) -> tuple[int, Numbers, Numbers]:
    """Read a joint state of another byte order, or with its joints in another one."""
    try:
        message = deserialize_message(data, JointState)
    except Exception as error:  # rclpy raises what its middleware happens to raise
        raise BadInput(f"{len(data)} bytes are no joint state: {error}") from None
    places = {name: i for i, name in enumerate(message.name)}
    missing = [joint for joint in joints if joint not in places]
    if missing:
        raise BadInput(
            f"a joint state has no joint {', '.join(missing)}; it has: {', '.join(places)}"
        )

    def ordered(values: Numbers) -> Numbers:
        if values and len(values) != len(message.name):
            raise BadInput(
                f"a joint state has {len(message.name)} names and {len(values)} positions or "
                "velocities; expected as many"
            )
        return tuple(values[places[joint]] for joint in joints) if values else ()

    stamp = message.header.stamp
    stamp_ns = int(stamp.sec) * SECOND + int(stamp.nanosec)
    return stamp_ns, ordered(tuple(message.position)), ordered(tuple(message.velocity))


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
