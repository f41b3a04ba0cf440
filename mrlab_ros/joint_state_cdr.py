"""Reads the numbers of a serialised JointState past rclpy, which takes six times as long.

Layout: OMG CDR, version 1, little-endian: four bytes that say so, then each field at a multiple of
its own size, strings and sequences behind their length.
"""

from __future__ import annotations

import struct

from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState

from mrlab_ros.core.clock import SECOND
from mrlab_ros.core.errors import BadInput

BODY = 4
LITTLE_ENDIAN = b"\x00\x01"
COUNT = struct.Struct("<I")
STAMP = struct.Struct("<iI")

Numbers = tuple[float, ...]


def read(data: bytes) -> tuple[int, Numbers, Numbers]:
    """Return stamp (ns), positions and velocities, in the order of the message's joints.

    Raises BadInput where the bytes are no joint state.
    """
    if data[:2] != LITTLE_ENDIAN:
        return _read_slowly(data)
    try:
        seconds, nanoseconds = STAMP.unpack_from(data, BODY)
        at = _after_string(data, BODY + STAMP.size)
        (names,) = COUNT.unpack_from(data, at)
        at += COUNT.size
        for _ in range(names):
            at = _after_string(data, at)
        positions, at = _doubles(data, at)
        velocities, at = _doubles(data, at)
    except struct.error:
        raise BadInput(f"{len(data)} bytes end before the joint state they begin") from None
    return seconds * SECOND + nanoseconds, positions, velocities


def _after_string(data: bytes, at: int) -> int:
    (length,) = COUNT.unpack_from(data, at)
    at += COUNT.size + int(length)
    return at + -at % 4


def _doubles(data: bytes, at: int) -> tuple[Numbers, int]:
    (count,) = COUNT.unpack_from(data, at)
    at += COUNT.size
    if not count:
        return (), at
    at += -(at - BODY) % 8
    if at + 8 * count > len(data):
        raise struct.error
    return struct.unpack_from(f"<{count}d", data, at), at + 8 * count


def _read_slowly(data: bytes) -> tuple[int, Numbers, Numbers]:
    message = deserialize_message(data, JointState)
    stamp = message.header.stamp
    stamp_ns = int(stamp.sec) * SECOND + int(stamp.nanosec)
    return stamp_ns, tuple(message.position), tuple(message.velocity)
