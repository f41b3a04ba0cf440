"""Writes a bag: MCAP files as rosbag2 makes them, whole at every moment, and metadata.yaml.

After each chunk the file ends with an end-of-data record and a footer, which the next chunk
overwrites. So a file whose writer was killed is a valid MCAP file without an index.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import yaml
from mcap.opcode import Opcode
from mcap.writer import MCAP0_MAGIC, CompressionType, Writer

from mrlab_ros.adapters.bags.diagnostics import (
    BAG_DISK_FULL,
    BAG_EXISTS,
    BAG_FOLDER_NOT_MADE,
    BAG_MOVED,
    BAG_NOT_WRITTEN,
)
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.base.machine import lack
from mrlab_ros.core.recording.metadata import (
    ROOT,
    BagFacts,
    FileInformation,
    Topic,
)

METADATA = "metadata.yaml"
# End of data without a checksum, a footer that names no summary, and the closing magic.
TAIL = struct.pack("<BQI", Opcode.DATA_END, 4, 0) + (
    struct.pack("<BQQQI", Opcode.FOOTER, 20, 0, 0, 0) + MCAP0_MAGIC
)
CHUNK_SIZE = 1 << 20
# Kept free beside a bag, so that on a full disk its last chunk and its index still fit.
RESERVE = ".reserve"
RESERVE_SIZE = 8 << 20


def is_being_written(path: Path) -> bool:
    """Return whether a writer that lives has a bag's file open."""
    try:
        with open(path, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False
    return False


class DiskTrouble(LabError):
    """The bag cannot be written any more; what is in it stays readable."""


class WholeFile:
    """A file to which whole records are added; at every moment it is a valid MCAP file.

    What is written waits in memory until flush(). Where flush() fails, the file keeps what it
    held, and what was to be added waits on.
    """

    def __init__(self, path: Path, pwrite: Callable[[int, Any, int], int] = os.pwrite) -> None:
        self._pwrite = pwrite
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC
        self._path = path
        self._descriptor: int | None = os.open(path, flags, 0o644)
        with contextlib.suppress(OSError):  # some file systems have no locks
            # The kernel releases it with the writer: so a live bag is told from a killed one.
            fcntl.flock(self._descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        self._end = 0
        self._waiting = bytearray()

    def write(self, data: bytes) -> int:
        self._waiting += data
        return len(data)

    def tell(self) -> int:
        return self._end + len(self._waiting)

    def flush(self) -> None:
        if self._waiting:
            self._put(bytes(self._waiting) + TAIL)
            self._end += len(self._waiting)
            self._waiting.clear()

    def is_in_place(self) -> bool:
        """Return whether the file is still where it was made."""
        if self._descriptor is None:
            return True
        try:
            there = os.stat(self._path)
        except OSError:
            return False
        return os.path.samestat(there, os.fstat(self._descriptor))

    def complete(self) -> None:
        """Add what waits as the file's end: it holds footer and magic itself."""
        if not self._waiting:
            return
        self._put(bytes(self._waiting))
        self._end += len(self._waiting)
        self._waiting.clear()

    def close(self) -> None:
        """Close the file as it is on disk; what still waits is given up."""
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None

    def _put(self, data: bytes) -> None:
        assert self._descriptor is not None
        view, done = memoryview(data), 0
        try:
            while done < len(data):
                done += self._pwrite(self._descriptor, view[done:], self._end + done)
        except OSError:
            with contextlib.suppress(OSError):
                # Back to the last whole record; before the first there is nothing to keep.
                os.ftruncate(self._descriptor, self._end)
                if self._end:
                    self._pwrite(self._descriptor, TAIL, self._end)
            raise


class BagWriter:
    """One bag, written by one thread at a time.

    `definition` returns the full text of a message type. Raises BadInput where the folder cannot
    be made, DiskTrouble where it cannot be written on.
    """

    def __init__(
        self,
        folder: Path,
        definition: Callable[[str], str],
        custom: dict[str, str] | None = None,
        open_file: Callable[[Path], WholeFile] = WholeFile,
        after: BagFacts | None = None,
    ) -> None:
        """after: what the folder holds already; the bag goes on in a new file of it."""
        self.folder = folder
        self.facts = after or BagFacts(custom=dict(custom or {}))
        self._definition = definition
        self._open_file = open_file
        self._topics = {topic.name: topic for topic in self.facts.topics}
        self._channels: dict[str, int] = {}
        self._earlier_bytes = 0
        self._reserve: int | None = None
        self._last_ns = self.facts.end_ns
        try:
            folder.mkdir(parents=True, exist_ok=after is not None)
        except FileExistsError:
            raise BadInput(BAG_EXISTS(folder=str(folder))) from None
        except OSError as error:
            raise BadInput(
                BAG_FOLDER_NOT_MADE(folder=str(folder), problem=error.strerror)
            ) from None
        try:
            for part in self.facts.parts:
                self._earlier_bytes += (folder / part.path).stat().st_size
            self._keep_reserve()
            self._begin_part()
        except (OSError, DiskTrouble) as error:
            trouble = _trouble(self.folder, error) if isinstance(error, OSError) else error
            self._give_up_reserve()
            if after is None:
                self._remove()
            raise trouble from None

    # what goes in ---------------------------------------------------------------------------

    @property
    def size(self) -> int:
        """Bytes of the bag's files."""
        return self._earlier_bytes + (0 if self._ended else self._file.tell())

    @property
    def part_size(self) -> int:
        """Bytes of the present file."""
        return self._file.tell()

    def add_topic(self, topic: Topic) -> None:
        """Accept messages of `topic`; a known topic keeps its count, and its record is updated.

        Raises BadInput where the text of its type is not to be had.
        """
        self._definition(topic.type)
        known = self._topics.get(topic.name)
        if known is not None:
            topic.messages = known.messages
            self.facts.topics.remove(known)
        self._topics[topic.name] = topic
        self.facts.topics.append(topic)
        self._channels.pop(topic.name, None)

    def write(
        self, topic: str, log_time_ns: int, data: bytes, publish_time_ns: int, sequence: int = 0
    ) -> None:
        """Add a message. Log times never go back: readers of files without index rely on it."""
        channel = self._channels.get(topic)
        if channel is None:
            channel = self._open_channel(self._topics[topic])
        self._last_ns = log_time_ns = max(log_time_ns, self._last_ns)
        self._writer.add_message(channel, log_time_ns, data, publish_time_ns, sequence)
        self._topics[topic].messages += 1
        self._part.count(log_time_ns)

    def attach(self, name: str, media_type: str, data: bytes, time_ns: int) -> None:
        """Put a file into the bag."""
        self._writer.add_attachment(time_ns, time_ns, name, media_type, data)

    def note(self, name: str, facts: dict[str, str]) -> None:
        """Put a record of facts into the bag."""
        self._writer.add_metadata(name, facts)

    def flush(self) -> None:
        """Bring to the file what came since: a kill of this process loses nothing of it."""
        try:
            self._writer.flush()
        except OSError as error:
            raise _trouble(self.folder, error) from None
        if not self._file.is_in_place():
            raise DiskTrouble(BAG_MOVED(folder=str(self.folder)))

    def write_metadata(self) -> None:
        """Write metadata.yaml as things are; a reader sees all of it or the one before."""
        write_metadata(self.folder, self.facts)

    # files ----------------------------------------------------------------------------------

    def split(self) -> None:
        """Go on in a new file."""
        self._end_part()
        try:
            self._begin_part()
        except OSError as error:
            raise _trouble(self.folder, error) from None
        self.write_metadata()

    def close(self) -> None:
        """Write index and metadata. Where the disk is full, the reserve is used for that."""
        self._give_up_reserve()
        try:
            self._end_part()
            self.write_metadata()
        finally:
            self._file.close()

    def _keep_reserve(self) -> None:
        path = self.folder / RESERVE
        path.unlink(missing_ok=True)
        self._reserve = os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o600)
        # Without a name its space is free again when this process ends, however it does.
        path.unlink()
        try:
            os.posix_fallocate(self._reserve, 0, RESERVE_SIZE)
        except OSError as error:
            found = lack(error)
            if found is not None and found.is_room:
                raise
            # Some file systems cannot keep space for a file; there the bag has no reserve.

    def _give_up_reserve(self) -> None:
        if self._reserve is not None:
            os.close(self._reserve)
            self._reserve = None

    def _begin_part(self) -> None:
        name = f"{self.folder.name}_{len(self.facts.parts)}.mcap"
        self._file = self._open_file(self.folder / name)
        self._ended = False
        stream: Any = self._file
        self._writer = Writer(stream, chunk_size=CHUNK_SIZE, compression=CompressionType.ZSTD)
        self._writer.start("ros2", "mrlab_ros")
        self._part = FileInformation(name)
        self.facts.parts.append(self._part)
        self._channels.clear()
        self._schemas: dict[str, int] = {}
        self.flush()

    def _end_part(self) -> None:
        """Write the file's end. Where the disk refuses it, this can be tried again."""
        if not self._ended:
            self._ended = True
            facts = yaml.dump(self.facts.document()[ROOT], Dumper=_DUMPER, sort_keys=False)
            self._writer.add_metadata("rosbag2", {"serialized_metadata": facts})
            self._writer.finish()
            self._earlier_bytes += self._file.tell()
        try:
            self._file.complete()
        except OSError as error:
            raise _trouble(self.folder, error) from None
        self._file.close()

    def _open_channel(self, topic: Topic) -> int:
        schema = self._schemas.get(topic.type)
        if schema is None:
            text = self._definition(topic.type).encode()
            schema = self._writer.register_schema(topic.type, "ros2msg", text)
            self._schemas[topic.type] = schema
        qualities = [quality.document() for quality in topic.qualities]
        metadata = {
            "offered_qos_profiles": yaml.dump(qualities, Dumper=_DUMPER, sort_keys=False).strip(),
            "topic_type_hash": topic.type_hash,
        }
        channel = self._writer.register_channel(topic.name, "cdr", schema, metadata)
        self._channels[topic.name] = channel
        return channel

    def _remove(self) -> None:
        """Take away what a bag has left that could not be begun."""
        with contextlib.suppress(OSError):
            for file in self.folder.iterdir():
                file.unlink()
            self.folder.rmdir()


_DUMPER: Any = getattr(yaml, "CSafeDumper", yaml.SafeDumper)


def metadata_text(facts: BagFacts) -> str:
    """Return metadata.yaml."""
    return str(yaml.dump(facts.document(), Dumper=_DUMPER, sort_keys=False))


def write_metadata(folder: Path, facts: BagFacts) -> None:
    """Write the metadata.yaml of a bag; a reader sees all of it or the one before."""
    new = folder / f"{METADATA}.new"
    try:
        new.write_text(metadata_text(facts))
        new.replace(folder / METADATA)
    except OSError as error:
        raise _trouble(folder, error) from None


def _trouble(folder: Path, error: OSError) -> DiskTrouble:
    found = lack(error)
    if found is None or not found.is_room:
        return DiskTrouble(BAG_NOT_WRITTEN(folder=str(folder), problem=error.strerror))
    free = size = None
    with contextlib.suppress(OSError):
        disk = os.statvfs(folder)
        free, size = disk.f_bavail * disk.f_frsize, disk.f_blocks * disk.f_frsize
    return DiskTrouble(
        BAG_DISK_FULL(
            folder=str(folder),
            cause=found.value,
            free=free,
            size=size,
            needed=RESERVE_SIZE + CHUNK_SIZE,
        )
    )
