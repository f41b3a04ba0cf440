"""Inflates what is compressed as a whole, with bounds, and notices where its end is missing."""

from __future__ import annotations

import gzip
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import zstandard

from mrlab_ros.adapters.diagnostics import (
    COMPRESSED_CUT_SHORT,
    COMPRESSED_DAMAGED,
    INFLATES_TOO_MUCH,
)
from mrlab_ros.core.base.errors import BadInput

GZIP, ZSTD = b"\x1f\x8b", b"\x28\xb5\x2f\xfd"
# A KiB of Zstandard can hold 32 MiB; that much may come beyond a limit before it is noticed.
PIECE = 1024
BLOCK = 1 << 20


class Incomplete(BadInput):
    """Compressed bytes that are damaged, or whose end is missing."""


def is_compressed(data: bytes) -> bool:
    """Return whether bytes begin as gzip or Zstandard does."""
    return data.startswith((GZIP, ZSTD))


def inflate_zstd(data: bytes | memoryview, limit: int) -> bytearray | None:
    """Return what Zstandard's frames hold, None where it is more than `limit` bytes.

    Raises Incomplete.
    """
    inflated = bytearray()
    for block in _frames(data[at : at + PIECE] for at in range(0, len(data), PIECE)):
        inflated += block
        if len(inflated) > limit:
            return None
    return inflated


def inflate_file(source: Path, target: BinaryIO, limit: int) -> None:
    """Write what a gzip or Zstandard file holds into `target`.

    Raises Incomplete, also where it is more than `limit` bytes, and OSError.
    """
    with open(source, "rb") as file:
        compressed = file.read(len(ZSTD))
        file.seek(0)
        blocks = _frames(iter(lambda: file.read(PIECE), b""))
        for block in blocks if compressed == ZSTD else _of_gzip(file):
            if target.tell() + len(block) > limit:
                raise Incomplete(INFLATES_TOO_MUCH(limit=limit))
            target.write(block)


def _of_gzip(file: BinaryIO) -> Iterator[bytes]:
    try:
        with gzip.open(file) as plain:
            while block := plain.read(BLOCK):
                yield block
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        raise Incomplete(COMPRESSED_DAMAGED(problem=str(error))) from None


def _frames(pieces: Iterator[bytes | memoryview]) -> Iterator[bytes]:
    """Yield the contents of one Zstandard frame after another."""
    frame = None
    try:
        for piece in pieces:
            rest: bytes | memoryview = piece
            while len(rest):
                if frame is None or frame.eof:
                    frame = zstandard.ZstdDecompressor().decompressobj()
                yield frame.decompress(rest)
                rest = frame.unused_data
    except zstandard.ZstdError as error:
        raise Incomplete(COMPRESSED_DAMAGED(problem=str(error))) from None
    if frame is None or not frame.eof:
        raise Incomplete(COMPRESSED_CUT_SHORT())
