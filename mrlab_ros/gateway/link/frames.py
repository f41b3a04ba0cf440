"""The binary frames of the socket, little-endian. docs/link.md describes every byte.

A payload begins at 4 mod 8 of its frame: CDR counts its alignment from behind a header of 4 bytes,
so that arrays of doubles lie on multiples of 8 and a browser can read them in place.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.gateway.link.diagnostics import (
    FRAME_KIND,
    FRAME_LENGTH,
    FRAME_SHORT,
    KEY_NOT_TEXT,
    KEY_TOO_LONG,
)

# kind, flags, count, number
HEAD = struct.Struct("<BBHI")
# topic or request, length, stamp in s since 1970 (NaN: unknown), sequence or kind of record
ENTRY = struct.Struct("<IIdI")
# kind, 0, length of the key, request, timeout in ms
CALL = struct.Struct("<BBHII")
# kind, 0, 0, 0, number
NUMBER = struct.Struct("<BBBBI")
LAST_FRAGMENT = 1
_PAD = tuple(bytes(size) for size in range(8))


class ToClient(IntEnum):
    """First byte of a frame to the client."""

    VALUES = 1
    FRAGMENT = 2


class ToGateway(IntEnum):
    """First byte of a frame to the gateway."""

    CALL = 1
    PUT = 2
    CREDIT = 3
    RECEIVED = 4


class RecordKind(IntEnum):
    """Kinds of records in the lossless channel."""

    MESSAGE = 1  # of a topic of which each message counts
    VALUE = 2  # of any other topic, too large for a batch
    RESPONSE = 3  # of a service
    ERROR = 4  # in place of a response: JSON with code, message, diagnostic


@dataclass(frozen=True, slots=True)
class Call:
    """A request of the client; a put has request and timeout 0."""

    put: bool
    key: str
    payload: bytes
    request: int
    timeout_s: float


@dataclass(frozen=True, slots=True)
class Credit:
    """The number of the last batch that the client will take."""

    batch: int


@dataclass(frozen=True, slots=True)
class Received:
    """The number of the last fragment that the client has."""

    fragment: int


def entry(topic: int, stamp: float, sequence: int, payload: bytes) -> bytes:
    """Return a message as it stands in a batch, padded to a multiple of 8 bytes.

    stamp: s since 1970, NaN where it is unknown. sequence: its lower 32 bits are kept.
    """
    head = ENTRY.pack(topic, len(payload), stamp, sequence & 0xFFFFFFFF)
    return b"".join((head, payload, _PAD[-(ENTRY.size + len(payload)) % 8]))


def batch(number: int, entries: Sequence[bytes]) -> bytes:
    """Return the frame of a batch."""
    head = HEAD.pack(ToClient.VALUES, 0, len(entries), number & 0xFFFFFFFF)
    return b"".join((head, *entries))


def record(kind: RecordKind, about: int, stamp: float, payload: bytes) -> bytes:
    """Return a record of the lossless channel; about: its topic, or its request."""
    return ENTRY.pack(about, len(payload), stamp, kind) + payload


def fragment(number: int, last: bool, data: bytes | memoryview) -> bytes:
    """Return the frame of a piece of a record."""
    flags = LAST_FRAGMENT if last else 0
    return b"".join((HEAD.pack(ToClient.FRAGMENT, flags, 0, number & 0xFFFFFFFF), data))


def from_client(frame: bytes) -> Call | Credit | Received:
    """Read a frame of the client. Raises BadInput where it is none."""
    kind = frame[0] if frame else 0
    if kind in (ToGateway.CREDIT, ToGateway.RECEIVED):
        if len(frame) != NUMBER.size:
            raise BadInput(FRAME_LENGTH(frame=kind, size=len(frame), expected=NUMBER.size))
        number = NUMBER.unpack(frame)[4]
        return Credit(number) if kind == ToGateway.CREDIT else Received(number)
    if kind not in (ToGateway.CALL, ToGateway.PUT):
        raise BadInput(FRAME_KIND(frame=kind))
    if len(frame) < CALL.size:
        raise BadInput(FRAME_SHORT(frame=kind, size=len(frame), least=CALL.size))
    _, _, length, request, timeout_ms = CALL.unpack_from(frame)
    behind = CALL.size + length
    if behind > len(frame):
        raise BadInput(KEY_TOO_LONG(length=length, size=len(frame)))
    try:
        key = frame[CALL.size : behind].decode()
    except UnicodeDecodeError as error:
        raise BadInput(KEY_NOT_TEXT(why=str(error))) from error
    return Call(kind == ToGateway.PUT, key, frame[behind:], request, timeout_ms / 1000)
