"""Rewrites index, summary and metadata.yaml of a bag from its readable messages."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

import yaml
from mcap.writer import CompressionType, Writer

from mrlab_ros.adapters.bags.diagnostics import (
    BAG_BEING_RECORDED,
    BAG_DAMAGED,
    BAG_NOT_REPAIRED,
    BAG_UNREADABLE,
    BAG_WITHOUT_FILES,
    NO_BAG,
    ORIGINAL_IN_THE_WAY,
    REPAIR_RUNS,
)
from mrlab_ros.adapters.bags.mcap_file import DAMAGE, BagFile, open_file
from mrlab_ros.adapters.bags.reader import METADATA, Bag, mcap_files_in
from mrlab_ros.adapters.bags.writer import CHUNK_SIZE, RESERVE, is_being_written, metadata_text
from mrlab_ros.adapters.yaml_files import close_file
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.recording.diagnostics import ENDING, importing
from mrlab_ros.core.recording.metadata import ROOT

KEPT = ".original"
NEW = ".repairing"


@dataclass
class Repaired:
    """The result of a repair: the rewritten files, and their faults."""

    files: list[str]
    troubles: list[Diagnostic]
    messages: int


def repair(path: Path) -> Repaired:
    """Rewrite damaged files, files without an index, and metadata.yaml; keep the originals.

    path: the folder of a bag, or one of its files, which alone is rewritten then. Raises BadInput
    where nothing can be read, where an earlier original is in the way, or where the folder cannot
    be written; the bag is as it was then. Raises Misuse where it is recorded or repaired just now.
    """
    if not path.exists():
        raise BadInput(NO_BAG(path=str(path), close=close_file(path)))
    with _only_one(path):
        return _repair(path)


@contextmanager
def _only_one(path: Path) -> Iterator[None]:
    """Keep other repairs of the bag away; raise Misuse where one runs."""
    try:
        folder = os.open(path.parent if path.is_file() else path, os.O_RDONLY | os.O_CLOEXEC)
    except OSError as error:
        raise BadInput(BAG_UNREADABLE(path=str(path), problem=error.strerror)) from None
    try:
        # Some file systems have no locks.
        with suppress(OSError):
            try:
                fcntl.flock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise Misuse(REPAIR_RUNS(path=str(path))) from None
        yield
    finally:
        os.close(folder)


def _repair(path: Path) -> Repaired:
    alone = path.is_file()
    paths = [path] if alone else mcap_files_in(path)
    if not paths:
        raise BadInput(BAG_WITHOUT_FILES(path=str(path), fixes=importing(path)))
    if any(map(is_being_written, paths)):
        raise Misuse(BAG_BEING_RECORDED(path=str(path), fixes=ENDING))
    files = list(map(open_file, paths))
    damages = {file.path: damage for file in files if (damage := _damage(file))}
    metadata = path / METADATA
    stale = not alone and (bool(damages) or not _agrees(metadata, Bag(path, paths)))
    for replaced in [*damages, *[metadata] * stale]:
        _must_be_free(replaced)
    try:
        for file in files:
            if file.path in damages:
                _rewrite(file, file.path.with_suffix(NEW))
        for damaged in damages:
            _keep(damaged)
            damaged.with_suffix(NEW).replace(damaged)
        bag = Bag(path, paths)
        if stale:
            new = metadata.with_suffix(NEW)
            new.write_text(metadata_text(bag.facts()))
            if metadata.exists():
                _keep(metadata)
            new.replace(metadata)
        if not alone:
            (path / RESERVE).unlink(missing_ok=True)
    except OSError as error:
        raise BadInput(BAG_NOT_REPAIRED(path=str(path), problem=error.strerror)) from None
    finally:
        for written in (*damages, metadata):
            with suppress(OSError):
                written.with_suffix(NEW).unlink(missing_ok=True)
    names = [damaged.name for damaged in damages] + [METADATA] * stale
    return Repaired(names, list(damages.values()), bag.message_count)


def refresh_metadata(folder: Path) -> bool:
    """Write metadata.yaml anew where it is behind its files and nobody records; return that.

    The files stay as they are. Where the folder cannot be written, nothing is done.
    """
    paths = mcap_files_in(folder) if folder.is_dir() else []
    if not paths or any(map(is_being_written, paths)):
        return False
    bag = Bag(folder, paths)
    if _agrees(folder / METADATA, bag):
        return False
    new = folder / f"{METADATA}.new"
    try:
        new.write_text(metadata_text(bag.facts()))
        new.replace(folder / METADATA)
    except OSError:
        return False
    return True


def _damage(file: BagFile) -> Diagnostic | None:
    """Return what is wrong with a file, None where it is whole."""
    if file.trouble is not None:
        return file.trouble
    for chunk in file.chunks:
        try:
            file.records(chunk)
        except BadInput:
            return BAG_DAMAGED(file=file.path.name, offset=chunk.offset)
    return None


def _agrees(metadata: Path, bag: Bag) -> bool:
    """Return whether metadata.yaml names these files and as many messages."""
    try:
        facts = yaml.safe_load(metadata.read_text())[ROOT]
        recorded = (facts["relative_file_paths"], facts["message_count"])
    except (OSError, yaml.YAMLError, UnicodeDecodeError, TypeError, KeyError):
        return False
    return bool(recorded == ([file.path.name for file in bag.files], bag.message_count))


def _kept(path: Path) -> Path:
    return path.with_name(path.name + KEPT)


def _keep(path: Path) -> None:
    """Give a file its second name; the first one stays until another file takes its place."""
    _kept(path).unlink(missing_ok=True)
    try:
        os.link(path, _kept(path))
    except OSError:  # a file system without links
        path.rename(_kept(path))


def _must_be_free(path: Path) -> None:
    """Raise BadInput where an earlier original has that name; a killed repair leaves a link."""
    if _kept(path).exists() and not (path.exists() and _kept(path).samefile(path)):
        raise BadInput(ORIGINAL_IN_THE_WAY(path=str(_kept(path))))


def _rewrite(file: BagFile, path: Path) -> None:
    """Write all that can be read of `file` to `path`, with an index; a damaged chunk cannot."""
    with open(path, "wb") as target, open(file.path, "rb") as source:
        writer = Writer(target, chunk_size=CHUNK_SIZE, compression=CompressionType.ZSTD)
        writer.start("ros2", "mrlab_ros")
        for note in file.notes:
            writer.add_metadata(note.name, note.metadata)
        for attachment in file.read_attachments(source):
            writer.add_attachment(
                attachment.create_time,
                attachment.log_time,
                attachment.name,
                attachment.media_type,
                attachment.data,
            )
        schemas: dict[int, int] = {}
        channels: dict[int, int] = {}
        for number, channel in file.channels.items():
            if channel.schema_id not in schemas:
                schema = file.schemas[channel.schema_id]
                schemas[channel.schema_id] = writer.register_schema(
                    schema.name, schema.encoding, schema.data
                )
            channels[number] = writer.register_channel(
                channel.topic,
                channel.message_encoding,
                schemas[channel.schema_id],
                channel.metadata,
            )
        for chunk in file.chunks:
            try:
                messages = list(file.raw_messages(chunk))
            except (BadInput, *DAMAGE):
                continue
            for number, sequence, log_time_ns, publish_time_ns, data in messages:
                writer.add_message(channels[number], log_time_ns, data, publish_time_ns, sequence)
        writer.finish()
