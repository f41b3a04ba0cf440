"""Reads bags: folders with MCAP files, also those whose writer was killed or whose end is lost.

Which bags lie in a folder.

Removes what a recorder left that was killed before it had written any message.
"""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import yaml
from mcap.data_stream import ReadDataStream
from mcap.records import Attachment

from mrlab_ros.adapters.bags.diagnostics import (
    BAG_GONE,
    BAG_LACKS_FILES,
    BAG_WITHOUT_FILES,
    METADATA_NOT_YAML,
    NO_ATTACHMENT,
    NO_BAG,
)
from mrlab_ros.adapters.bags.mcap_file import (
    RECORD,
    BagFile,
    Message,
    open_file,
)
from mrlab_ros.adapters.bags.writer import RESERVE, TAIL, is_being_written
from mrlab_ros.adapters.yaml_files import Loader, close_file
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput, LabError
from mrlab_ros.core.recording.diagnostics import importing, repairing
from mrlab_ros.core.recording.metadata import (
    GAP,
    BagFacts,
    FileInformation,
    Gap,
    Topic,
    paths_in,
    quality_from,
)

METADATA = "metadata.yaml"


class Bag:
    """A bag that is open for reading.

    `files` are its MCAP files, if not those that files_of() finds. Raises BadInput where `path`
    is no bag, or one that this lab cannot read.
    """

    def __init__(self, path: Path, files: Sequence[Path] | None = None) -> None:
        self.path = path
        self.files = [open_file(file) for file in (files_of(path) if files is None else files)]
        self.topics = _topics(self.files)
        if not any(file.chunks for file in self.files):
            self.start_ns = self.end_ns = 0
        else:
            filled = [file for file in self.files if file.chunks]
            self.start_ns = min(file.start_ns for file in filled)
            self.end_ns = max(file.end_ns for file in filled)

    @property
    def duration(self) -> float:
        """Time between the first and the last message, s."""
        return (self.end_ns - self.start_ns) / 1e9

    @property
    def message_count(self) -> int:
        return sum(topic.messages for topic in self.topics.values())

    @property
    def paths(self) -> list[Path]:
        """Its files, oldest first."""
        return [file.path for file in self.files]

    @property
    def size(self) -> int:
        """Bytes of all its files."""
        return sum(path.stat().st_size for path in self.paths)

    @property
    def live(self) -> bool:
        """Return whether a recorder that lives writes into it."""
        return any(is_being_written(file.path) for file in self.files)

    @property
    def troubles(self) -> list[Diagnostic]:
        """Return the faults of its files; while it is recorded, there are none."""
        found = [file.trouble for file in self.files if file.trouble and not self.live]
        return [replace(trouble, fixes=repairing(self.path)) for trouble in found]

    def facts(self) -> BagFacts:
        """Return what metadata.yaml should say."""
        parts = [
            FileInformation(file.path.name, file.start_ns, file.end_ns, sum(file.counts.values()))
            if file.chunks
            else FileInformation(file.path.name)
            for file in self.files
        ]
        return BagFacts(list(self.topics.values()), parts, self.versions())

    def versions(self) -> dict[str, str]:
        """Return what was recorded about the lab that made it."""
        for file in self.files:
            for note in file.notes:
                if note.name == "mrlab":
                    return dict(note.metadata)
        return {}

    def gaps(self) -> list[Gap]:
        """Return when the recorder did not run, oldest first."""
        return [
            Gap.read(note.metadata)
            for file in self.files
            for note in file.notes
            if note.name == GAP
        ]

    def batches(
        self, start_ns: int = 0, topics: Collection[str] | None = None
    ) -> Iterator[list[Message]]:
        """Yield the messages from `start_ns` on in the order of log time, some at a time."""
        for file in self.files:
            held: list[Message] = []
            chunks = [chunk for chunk in file.chunks if chunk.end_ns >= start_ns]
            wanted = _channels_of(file, topics)
            chunks = [chunk for chunk in chunks if topics is None or chunk.channels & wanted]
            for number, chunk in enumerate(chunks):
                held += file.messages(chunk, topics)
                held.sort(key=lambda message: message.log_time_ns)
                # Chunks may overlap: what a later one may still precede is held back.
                later = min((c.start_ns for c in chunks[number + 1 : number + 9]), default=None)
                end = len(held)
                if later is not None:
                    end = next(
                        (i for i, m in enumerate(held) if m.log_time_ns >= later), len(held)
                    )
                ready, held = held[:end], held[end:]
                if ready and ready[0].log_time_ns < start_ns:
                    ready = [message for message in ready if message.log_time_ns >= start_ns]
                if ready:
                    yield ready

    def messages(
        self, start_ns: int = 0, topics: Collection[str] | None = None
    ) -> Iterator[Message]:
        """Yield the messages from `start_ns` on in the order of log time."""
        for batch in self.batches(start_ns, topics):
            yield from batch

    def newest_before(self, time_ns: int, topics: Collection[str]) -> list[Message]:
        """Return the newest message before `time_ns` of each topic that has one."""
        newest: dict[str, Message] = {}
        for file in reversed(self.files):
            ids = {n: c.topic for n, c in file.channels.items() if c.topic in topics}
            for chunk in sorted(file.chunks, key=lambda c: c.end_ns, reverse=True):
                missing = {topic for n, topic in ids.items() if topic not in newest}
                present = {ids[n] for n in chunk.channels if n in ids}
                if chunk.start_ns >= time_ns or not missing & present:
                    continue
                for message in file.messages(chunk, missing):
                    if message.log_time_ns < time_ns:
                        newest[message.topic] = message
        return sorted(newest.values(), key=lambda message: message.log_time_ns)

    def attachments(self) -> dict[str, int]:
        """Return the names of all attachments with their sizes, bytes."""
        return {
            name: len(self.attachment(name).data)
            for file in self.files
            for name in file.attachments
        }

    def attachment(self, name: str) -> Attachment:
        """Return an attachment; the newest of that name. Raises BadInput where there is none."""
        for file in reversed(self.files):
            if name in file.attachments:
                try:
                    with open(file.path, "rb") as source:
                        source.seek(file.attachments[name] + RECORD.size)
                        found: Attachment = Attachment.read(ReadDataStream(source))
                        return found
                except OSError as error:
                    raise BadInput(BAG_GONE(path=str(file.path), problem=error.strerror)) from None
        known = sorted(n for file in self.files for n in file.attachments)
        raise BadInput(NO_ATTACHMENT(path=str(self.path), attachment=name, known=known))

    def definitions(self) -> dict[str, str]:
        """Return the full definition of every message type in it."""
        return {
            schema.name: schema.data.decode()
            for file in self.files
            for schema in file.schemas.values()
        }


def default_folder() -> Path:
    """Return where bags lie that are named without a folder."""
    return Path.home() / ".local" / "share" / "mrlab" / "bags"


def files_of(path: Path) -> list[Path]:
    """Return the MCAP files of a bag, oldest first; `path` is its folder or one MCAP file.

    Files are found also where metadata.yaml is missing or knows only some of them: it is written
    last, and its writer may have been killed.
    """
    if path.is_file():
        return [path]
    if not path.is_dir():
        raise BadInput(NO_BAG(path=str(path), close=close_file(path)))
    listed: list[str] = []
    metadata = path / METADATA
    if metadata.exists():
        try:
            document = yaml.load(metadata.read_text(), Loader=Loader)
        except (yaml.YAMLError, UnicodeDecodeError) as error:
            problem = getattr(error, "problem", None) or str(error)
            raise BadInput(
                METADATA_NOT_YAML(file=str(metadata), problem=problem, fixes=repairing(path))
            ) from None
        listed = [Path(name).name for name in paths_in(document, str(metadata))]
    missing = [name for name in listed if not (path / name).is_file()]
    if missing:
        raise BadInput(BAG_LACKS_FILES(path=str(path), files=missing, fixes=repairing(path)))
    files = [path / name for name in listed]
    files += [file for file in mcap_files_in(path) if file.name not in listed]
    if not files:
        raise BadInput(BAG_WITHOUT_FILES(path=str(path), fixes=importing(path)))
    return files


def mcap_files_in(folder: Path) -> list[Path]:
    """Return the MCAP files of a folder in the order in which they were written."""
    return sorted(folder.glob("*.mcap"), key=number_of)


def _topics(files: Sequence[BagFile]) -> dict[str, Topic]:
    """Return the topics of all files by name, in order of appearance."""
    topics: dict[str, Topic] = {}
    for file in files:
        for number, channel in file.channels.items():
            text = channel.metadata.get("offered_qos_profiles", "")
            listed = yaml.load(text, Loader=Loader) if text else []
            schema = file.schemas.get(channel.schema_id)
            before = topics.get(channel.topic)
            topics[channel.topic] = Topic(
                channel.topic,
                schema.name if schema else "",
                tuple(quality_from(entry) for entry in listed or ()),
                channel.metadata.get("topic_type_hash", ""),
                file.counts.get(number, 0) + (before.messages if before else 0),
            )
    return topics


def _channels_of(file: BagFile, topics: Collection[str] | None) -> frozenset[int]:
    return frozenset(
        number
        for number, channel in file.channels.items()
        if topics is None or channel.topic in topics
    )


def number_of(path: Path) -> tuple[int, str]:
    """Return what sorts a bag's files as they were written."""
    last = path.stem.rpartition("_")[2]
    return (int(last) if last.isdecimal() else 0, path.name)


# Names that an answer holds: a lab records for years.
MOST = 200


def bags_in(folder: Path, most: int = MOST) -> list[str]:
    """Return the names of the newest bags in a folder, newest first; [] without the folder."""
    found: list[tuple[float, str]] = []
    try:
        entries = list(folder.iterdir())
    except OSError:
        return []
    for entry in entries:
        try:
            files = list(entry.iterdir()) if entry.is_dir() else [entry]
            files = [file for file in files if file.suffix in (".mcap", ".db3")]
            if files and "\n" not in entry.name:
                found.append((max(file.stat().st_mtime for file in files), entry.name))
        except OSError:
            continue  # it was removed meanwhile, or is not ours to read
    return [name for _, name in sorted(found, reverse=True)[:most]]


def list_in(folder: Path, bag: Path) -> None:
    """Have a bag that lies elsewhere listed in a folder, by a link, where one can be made.

    Links to bags that are gone are removed.
    """
    if bag.parent.resolve() == folder.resolve():
        return
    with contextlib.suppress(OSError):
        folder.mkdir(parents=True, exist_ok=True)
        for link in folder.iterdir():
            if link.is_symlink() and (not link.exists() or link.readlink() == bag):
                link.unlink()
        names = (f"{bag.name}_{n}" if n > 1 else bag.name for n in itertools.count(1))
        (folder / next(n for n in names if not (folder / n).exists())).symlink_to(bag)


def remove_empty(folder: Path) -> bool:
    """Remove the folder of a bag without messages, or an empty one; return whether it is gone.

    It stays where anything else is in it, where a file may hold more than can be read, and while
    it is being written.
    """
    if not folder.is_dir() or folder.is_symlink():
        return False
    try:
        files = mcap_files_in(folder)
        known = {METADATA, f"{METADATA}.new", RESERVE, *(file.name for file in files)}
        entries = list(folder.iterdir())
        if any(entry.name not in known or not entry.is_file() for entry in entries):
            return False
        if not all(map(_is_empty, files)):
            return False
        for entry in entries:
            entry.unlink()
        folder.rmdir()
    except (OSError, LabError):
        return False
    return True


def _is_empty(path: Path) -> bool:
    if is_being_written(path):
        return False
    found = open_file(path)
    if found.chunks or any(found.counts.values()):
        return False
    return found.indexed or path.stat().st_size - found.data_end <= len(TAIL)
