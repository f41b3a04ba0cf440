"""Reads one MCAP file of a bag, also one whose writer was killed or whose end is lost."""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any, NamedTuple

from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.reader import SeekingReader
from mcap.records import Attachment, Channel, Chunk, Metadata, Schema
from mcap.stream_reader import get_chunk_data_stream
from mcap.writer import MCAP0_MAGIC
from zstandard import ZstdError

from mrlab_ros.adapters.bags.diagnostics import (
    BAG_COMPRESSED,
    BAG_CUT_SHORT,
    BAG_DAMAGED,
    BAG_EMPTY_FILE,
    BAG_GONE,
    BAG_NO_INDEX,
    BAG_NOT_BEGUN,
    BAG_UNREADABLE,
    MCAP_WITHOUT_CHUNKS,
    NOT_MCAP,
)
from mrlab_ros.adapters.sandbox.inflate import is_compressed
from mrlab_ros.core.base.diagnostic import ERROR, Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.recording.diagnostics import importing, repairing

RECORD = struct.Struct("<BQ")
MESSAGE = struct.Struct("<HIQQ")
FOOTER_SIZE = 8 + 8 + 4
# Errors of reading damaged records.
DAMAGE = (McapError, ZstdError, struct.error, ValueError, KeyError, OverflowError, MemoryError)


class Message(NamedTuple):
    """One message of a bag; times ns since the epoch; data is CDR."""

    log_time_ns: int
    topic: str
    data: bytes
    publish_time_ns: int


@dataclass
class ChunkRef:
    """A chunk: its place, the times of its messages (ns), and the channel ids in it."""

    offset: int
    start_ns: int
    end_ns: int
    channels: frozenset[int]


@dataclass
class BagFile:
    """One MCAP file of a bag."""

    path: Path
    schemas: dict[int, Schema] = field(default_factory=dict)
    channels: dict[int, Channel] = field(default_factory=dict)
    chunks: list[ChunkRef] = field(default_factory=list)
    counts: dict[int, int] = field(default_factory=dict)
    # offset of each attachment and metadata record
    attachments: dict[str, int] = field(default_factory=dict)
    notes: list[Metadata] = field(default_factory=list)
    indexed: bool = True
    # offset behind the last whole record of data, and what is wrong with the file after it
    data_end: int = 0
    trouble: Diagnostic | None = None

    @property
    def start_ns(self) -> int:
        return min((chunk.start_ns for chunk in self.chunks), default=0)

    @property
    def end_ns(self) -> int:
        return max((chunk.end_ns for chunk in self.chunks), default=0)

    def records(self, chunk: ChunkRef) -> bytes:
        """Return the chunk's records, decompressed and checked against their checksum."""
        try:
            with open(self.path, "rb") as file:
                file.seek(chunk.offset + RECORD.size)
                return _decompressed(Chunk.read(ReadDataStream(file)))
        except DAMAGE as error:
            raise BadInput(damaged(str(self.path), chunk.offset, str(error))) from None
        except OSError as error:
            raise BadInput(BAG_GONE(path=str(self.path), problem=error.strerror)) from None

    def messages(self, chunk: ChunkRef, topics: Collection[str] | None = None) -> list[Message]:
        """Return the chunk's messages of `topics`, None: of all, in the order of log time."""
        names = {
            number: channel.topic
            for number, channel in self.channels.items()
            if topics is None or channel.topic in topics
        }
        found = [
            Message(log_time_ns, names[channel], data, publish_time_ns)
            for channel, _, log_time_ns, publish_time_ns, data in self.raw_messages(chunk)
            if channel in names
        ]
        found.sort(key=lambda message: message.log_time_ns)
        return found

    def raw_messages(self, chunk: ChunkRef) -> Iterator[tuple[int, int, int, int, bytes]]:
        """Yield channel, sequence, log time (ns), publish time (ns) and CDR, as they lie there."""
        for code, body in _walk(self.records(chunk)):
            if code == Opcode.MESSAGE:
                yield (*MESSAGE.unpack_from(body), bytes(body[MESSAGE.size :]))

    def read_attachments(self, source: IO[bytes]) -> Iterator[Attachment]:
        """Yield the newest attachment of each name; `source` is the open file."""
        for offset in self.attachments.values():
            source.seek(offset + RECORD.size)
            yield Attachment.read(ReadDataStream(source))


def damaged(path: str, offset: int, problem: str) -> Diagnostic:
    """Return what is said of a file whose chunk at `offset` cannot be read."""
    return BAG_DAMAGED(
        file=path, offset=offset, problem=problem, severity=ERROR, fixes=repairing(path)
    )


def open_file(path: Path) -> BagFile:
    """Read what a file holds, by its index where it has one, record by record otherwise."""
    try:
        with open(path, "rb") as file:
            beginning = file.read(len(MCAP0_MAGIC))
            if len(beginning) < len(MCAP0_MAGIC) and MCAP0_MAGIC.startswith(beginning):
                if path.suffix != ".mcap":
                    raise BadInput(BAG_EMPTY_FILE(path=str(path)))
                return BagFile(path, indexed=False, trouble=BAG_NOT_BEGUN(file=path.name))
            if is_compressed(beginning):
                raise BadInput(BAG_COMPRESSED(path=str(path), fixes=importing(path)))
            if beginning != MCAP0_MAGIC:
                raise BadInput(NOT_MCAP(path=str(path), fixes=importing(path)))
            found = _by_index(path, file)
            return found if found is not None else _by_records(path, file)
    except OSError as error:
        raise BadInput(BAG_UNREADABLE(path=str(path), problem=error.strerror)) from None


def _by_index(path: Path, file: Any) -> BagFile | None:
    size = file.seek(0, io.SEEK_END)
    ending = RECORD.size + FOOTER_SIZE + len(MCAP0_MAGIC)
    file.seek(max(size - ending, 0))
    footer = file.read()
    if len(footer) < ending or footer[-len(MCAP0_MAGIC) :] != MCAP0_MAGIC:
        return None
    summary_start, _, checksum = struct.unpack_from("<QQI", footer, RECORD.size)
    if footer[0] != Opcode.FOOTER or not 0 < summary_start < size:
        return None
    file.seek(summary_start)
    summed = file.read(size - summary_start - len(MCAP0_MAGIC) - 4)
    if checksum and zlib.crc32(summed) != checksum:
        return None
    file.seek(0)
    try:
        summary = SeekingReader(file).get_summary()
        if summary is None or summary.statistics is None:
            return None
        if summary.statistics.message_count and not summary.chunk_indexes:
            return None
        notes = []
        for index in summary.metadata_indexes:
            file.seek(index.offset + RECORD.size)
            notes.append(Metadata.read(ReadDataStream(file)))
    except DAMAGE:
        return None
    return BagFile(
        path,
        dict(summary.schemas),
        dict(summary.channels),
        [
            ChunkRef(
                index.chunk_start_offset,
                index.message_start_time,
                index.message_end_time,
                frozenset(index.message_index_offsets),
            )
            for index in summary.chunk_indexes
        ],
        dict(summary.statistics.channel_message_counts),
        {index.name: index.offset for index in summary.attachment_indexes},
        notes,
        data_end=summary_start,
    )


def _by_records(path: Path, file: Any) -> BagFile:
    """Read a file without index as far as its records are whole."""
    found = BagFile(path, indexed=False)
    size = file.seek(0, io.SEEK_END)
    offset = len(MCAP0_MAGIC)
    whole = False
    while offset + RECORD.size <= size:
        file.seek(offset)
        code, length = RECORD.unpack(file.read(RECORD.size))
        if code in (Opcode.DATA_END, Opcode.FOOTER):
            whole = True
            break
        if offset + RECORD.size + length > size:
            break
        try:
            if code == Opcode.CHUNK:
                _take_chunk(found, Chunk.read(ReadDataStream(file)), offset)
            elif code == Opcode.ATTACHMENT:
                found.attachments[Attachment.read(ReadDataStream(file)).name] = offset
            elif code == Opcode.METADATA:
                found.notes.append(Metadata.read(ReadDataStream(file)))
            elif code in (Opcode.SCHEMA, Opcode.CHANNEL):
                _take_record(found, code, memoryview(file.read(length)))
            elif code == Opcode.MESSAGE:
                raise BadInput(MCAP_WITHOUT_CHUNKS(path=str(path), fixes=importing(path)))
        except DAMAGE as error:
            found.trouble = BAG_DAMAGED(file=path.name, offset=offset, problem=str(error))
            break
        offset += RECORD.size + length
    found.data_end = offset
    if found.trouble is None:
        found.trouble = (
            BAG_NO_INDEX(file=path.name) if whole else BAG_CUT_SHORT(file=path.name, offset=offset)
        )
    return found


def _take_chunk(found: BagFile, chunk: Chunk, offset: int) -> None:
    channels: set[int] = set()
    for code, body in _walk(_decompressed(chunk)):
        if code == Opcode.MESSAGE:
            channel = MESSAGE.unpack_from(body)[0]
            channels.add(channel)
            found.counts[channel] = found.counts.get(channel, 0) + 1
        else:
            _take_record(found, code, body)
    found.chunks.append(
        ChunkRef(offset, chunk.message_start_time, chunk.message_end_time, frozenset(channels))
    )


def _take_record(found: BagFile, code: int, body: memoryview) -> None:
    stream = ReadDataStream(io.BytesIO(body))
    if code == Opcode.SCHEMA:
        schema = Schema.read(stream)
        found.schemas[schema.id] = schema
    elif code == Opcode.CHANNEL:
        channel = Channel.read(stream)
        found.channels[channel.id] = channel


def _decompressed(chunk: Chunk) -> bytes:
    stream, length = get_chunk_data_stream(chunk, validate_crc=True)
    return stream.read(length)


def _walk(records: bytes) -> Iterator[tuple[int, memoryview]]:
    """Yield code and body of each record."""
    view, offset = memoryview(records), 0
    while offset < len(view):
        code, length = RECORD.unpack_from(view, offset)
        offset += RECORD.size
        yield code, view[offset : offset + length]
        offset += length
