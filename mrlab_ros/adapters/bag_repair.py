"""Writes index, summary and metadata.yaml of a bag anew, from what can be read of it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mcap.writer import CompressionType, Writer

from mrlab_ros.adapters.bag_file import BagFile, open_file
from mrlab_ros.adapters.bag_reader import METADATA, Bag, files_of
from mrlab_ros.adapters.bag_writer import CHUNK_SIZE, RESERVE, metadata_text
from mrlab_ros.core.errors import BadInput

KEPT = ".original"


@dataclass
class Repaired:
    """What a repair did: the files written anew, and what had been wrong with them."""

    files: list[str]
    troubles: list[str]
    messages: int


def repair(folder: Path) -> Repaired:
    """Write the files without index anew, and metadata.yaml; keep the originals beside them.

    Raises BadInput where nothing can be read, or where an earlier original is in the way.
    """
    if not folder.is_dir():
        raise BadInput(f"{folder} is no folder; name the folder of a bag")
    metadata = folder / METADATA
    if metadata.exists():
        _keep(metadata)
    damaged = [file for file in map(open_file, files_of(folder)) if not file.indexed]
    for file in damaged:
        new = file.path.with_suffix(".repairing")
        _rewrite(file, new)
        _keep(file.path)
        new.replace(file.path)
    (folder / RESERVE).unlink(missing_ok=True)
    bag = Bag(folder)
    metadata.write_text(metadata_text(bag.facts()))
    return Repaired(
        [file.path.name for file in damaged],
        [file.trouble for file in damaged],
        bag.message_count,
    )


def _keep(path: Path) -> None:
    kept = path.with_name(path.name + KEPT)
    if kept.exists():
        raise BadInput(f"{kept} is there from an earlier repair; move it away, then repair again")
    path.rename(kept)


def _rewrite(file: BagFile, path: Path) -> None:
    """Write all that can be read of `file` to `path`, with an index."""
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
            for number, sequence, log_time_ns, publish_time_ns, data in file.raw_messages(chunk):
                writer.add_message(channels[number], log_time_ns, data, publish_time_ns, sequence)
        writer.finish()
