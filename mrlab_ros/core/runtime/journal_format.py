"""The format of a journal: what a process has to know again after it was killed.

A journal is one mapping in a file of two slots of equal size, which are written in turn. A slot is
a header (magic, number of the write, length and CRC-32 of the content), then the content as JSON.
A write that is torn by a kill leaves the other slot as it was, and none needs new space on the
disk while the content fits.
"""

from __future__ import annotations

import json
import struct
import zlib
from collections.abc import Mapping
from typing import Any

HEADER = struct.Struct("<8sQII")
MAGIC = b"mrlab.j1"
# The smallest slot, bytes; a larger content doubles it.
SMALLEST = 4096


def pack(number: int, content: Mapping[str, Any]) -> bytes:
    """Return a slot with `content`, the write of that number."""
    data = json.dumps(content, separators=(",", ":")).encode()
    return HEADER.pack(MAGIC, number, len(data), _checksum(number, data)) + data


def unpack(slot: bytes) -> tuple[int, dict[str, Any]] | None:
    """Return the number and the content of a slot; None where it was not written completely."""
    if len(slot) < HEADER.size:
        return None
    magic, number, length, checksum = HEADER.unpack_from(slot)
    data = slot[HEADER.size : HEADER.size + length]
    # Zeros after a torn header must not pass for an empty content.
    if magic != MAGIC or not data or len(data) != length or _checksum(number, data) != checksum:
        return None
    content = json.loads(data)
    return (number, content) if isinstance(content, dict) else None


def _checksum(number: int, data: bytes) -> int:
    return zlib.crc32(data, number & 0xFFFFFFFF)


def slot_size(length: int) -> int:
    """Return the size of a slot that holds `length` bytes and may grow a little."""
    size = SMALLEST
    while size < length:
        size *= 2
    return size


def newest(file: bytes) -> tuple[int, dict[str, Any]] | None:
    """Return the number and the content of the last complete write; None: there is none."""
    half = len(file) // 2
    found = [slot for slot in map(unpack, (file[:half], file[half:])) if slot is not None]
    return max(found, key=lambda slot: slot[0], default=None)
