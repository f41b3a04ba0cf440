"""The parts of OMG CDR, version 1, little-endian, that the lab writes and reads without rclpy."""

from __future__ import annotations

import struct
from functools import lru_cache

ENCAPSULATION = b"\x00\x01\x00\x00"
BODY = len(ENCAPSULATION)
STAMP = struct.Struct("<iI")
COUNT = struct.Struct("<I")
DOUBLE_SIZE = 8


def aligned(offset: int, size: int) -> int:
    """Return the first offset from `offset` on that is a multiple of `size` within the body."""
    return offset + (BODY - offset) % size


def text(value: str) -> bytes:
    """Return a string as CDR, with the zeros up to the next count."""
    data = value.encode() + b"\0"
    return COUNT.pack(len(data)) + data + bytes(-len(data) % COUNT.size)


@lru_cache(maxsize=64)
def names(joints: tuple[str, ...]) -> bytes:
    """Return a sequence of strings as CDR."""
    return COUNT.pack(len(joints)) + b"".join(map(text, joints))


def head(frame_id: str, joints: tuple[str, ...]) -> bytes:
    """Return a message's beginning: its header, with stamp 0, and the joints' names."""
    return ENCAPSULATION + bytes(STAMP.size) + text(frame_id) + names(joints)


def doubles_at(offset: int, count: int) -> int:
    """Return where the numbers begin of a sequence whose count lies at `offset`."""
    offset += COUNT.size
    return aligned(offset, DOUBLE_SIZE) if count else offset
