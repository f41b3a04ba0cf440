"""Reads bags that are no plain MCAP files through `rosbags`: sqlite3, and what is compressed.

Nothing is copied, but what is compressed as a whole. A type that the bag does not define has the
installed definition, or else that of ROS 2 Jazzy.
"""

from __future__ import annotations

import heapq
import tempfile
from collections.abc import Callable, Collection, Iterator
from contextlib import ExitStack, contextmanager
from operator import itemgetter
from pathlib import Path
from typing import Any

import yaml
from rosbags.rosbag2 import Reader
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore

from mrlab_ros.adapters.bags.diagnostics import (
    BAG_LACKS_FILES,
    DATABASE_DAMAGED,
    MESSAGE_TOO_LARGE,
    NOT_ROS_BAG,
)
from mrlab_ros.adapters.bags.mcap_file import Message
from mrlab_ros.adapters.bags.reader import METADATA, Bag, mcap_files_in, number_of
from mrlab_ros.adapters.sandbox.inflate import (
    ZSTD,
    Incomplete,
    inflate_file,
    inflate_zstd,
    is_compressed,
)
from mrlab_ros.adapters.yaml_files import Loader
from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.foreign_text import for_shell
from mrlab_ros.core.recording.metadata import (
    ROOT,
    BagFacts,
    FileInformation,
    QosProfile,
    Topic,
)

SQLITE = b"SQLi"
ENDINGS = {b"\x89MCA": ".mcap", SQLITE: ".db3"}
# Of one message that is compressed by itself.
# A file that is compressed as a whole may hold so many bytes, and so many for each of its own.
INFLATED, RATIO = 1 << 30, 100
MOST_BYTES = 1 << 30
# sqlite3's code of a damaged database.
SQLITE_CORRUPT = 11
# Messages of one batch.
BATCH = 500


def open_bag(path: Path, installed: Callable[[str], str]) -> Bag:
    """Open a bag of any kind for reading.

    installed: returns the text of an installed type. Raises BadInput where `path` is no bag.
    """
    for is_of_this_kind, opened_bag in READERS:
        if is_of_this_kind(path):
            return opened_bag(path, installed)
    return Bag(path)


class OtherBag(Bag):
    """A bag that `rosbags` reads: sqlite3, or compressed. It has no attachments."""

    def __init__(self, path: Path, installed: Callable[[str], str]) -> None:
        self.path = path
        self.files = []
        self.topics = {}
        self._kept = ExitStack()
        self._texts: dict[str, str] = {}
        self._sources = sources_of(path)
        known = get_typestore(Stores.ROS2_JAZZY)
        with readable(path):
            if path.is_file():
                self._sources = [self._kept.enter_context(plain_file(path))]
            with opened(self._sources) as readers:
                filled = [reader for reader in readers if reader.message_count]
                self.start_ns = min((reader.start_time for reader in filled), default=0)
                # rosbags names the instant after the last message.
                self.end_ns = max((reader.end_time - 1 for reader in filled), default=0)
                self.compressed = any(reader.compression_mode for reader in readers)
                for reader in readers:
                    for connection in reader.connections:
                        before = self.topics.get(connection.topic)
                        topic = topic_of(connection)
                        topic.messages = connection.msgcount + (before.messages if before else 0)
                        self.topics[topic.name] = topic
                        text = definition_of(connection, installed, known)
                        if text is not None:
                            self._texts[topic.type] = text

    @property
    def paths(self) -> list[Path]:
        if self.path.is_file():
            return [self.path]
        known = (".db3", ".mcap", ".zstd")
        return sorted((f for f in self.path.iterdir() if f.suffix in known), key=number_of)

    def facts(self) -> BagFacts:
        """Return what metadata.yaml should say."""
        part = FileInformation(self.paths[0].name, self.start_ns, self.end_ns, self.message_count)
        return BagFacts(list(self.topics.values()), [part])

    def batches(
        self, start_ns: int = 0, topics: Collection[str] | None = None
    ) -> Iterator[list[Message]]:
        """Yield the messages from `start_ns` on in the order of log time, some at a time."""
        return self._between(start_ns, None, topics)

    def newest_before(self, time_ns: int, topics: Collection[str]) -> list[Message]:
        """Return the newest message before `time_ns` of each topic that has one."""
        newest: dict[str, Message] = {}
        end_ns, length_ns = min(time_ns, self.end_ns + 1), SECOND
        missing = {name for name in topics if name in self.topics}
        # Backwards, in pieces that double: what is latched may have been said long before.
        while missing and end_ns > self.start_ns:
            begin_ns = max(end_ns - length_ns, self.start_ns)
            for batch in self._between(begin_ns, end_ns, missing):
                newest |= {message.topic: message for message in batch}
            missing -= newest.keys()
            end_ns, length_ns = begin_ns, 2 * length_ns
        return sorted(newest.values(), key=lambda message: message.log_time_ns)

    def definitions(self) -> dict[str, str]:
        """Return the full definition of every message type that is known."""
        return dict(self._texts)

    def _between(
        self, start_ns: int, end_ns: int | None, topics: Collection[str] | None
    ) -> Iterator[list[Message]]:
        with readable(self.path), opened(self._sources) as readers:
            batch: list[Message] = []
            for connection, time_ns, data in merged(readers, topics, start_ns, end_ns):
                batch.append(Message(time_ns, connection.topic, data, time_ns))
                if len(batch) == BATCH:
                    yield batch
                    batch = []
            if batch:
                yield batch


def merged(
    readers: list[Reader],
    topics: Collection[str] | None,
    start_ns: int | None = None,
    end_ns: int | None = None,
) -> Iterator[tuple[Any, int, bytes]]:
    """Yield connection, time (ns) and CDR of the messages of `topics`, None: of all, in order."""
    streams = []
    for reader in readers:
        wanted = [c for c in reader.connections if topics is None or c.topic in topics]
        if wanted:
            streams.append(reader.messages(wanted, start_ns, end_ns))
    for connection, time_ns, data in heapq.merge(*streams, key=itemgetter(1)):
        # rosbags inflates only where metadata.yaml says so.
        plain = inflate_zstd(data, MOST_BYTES) if data.startswith(ZSTD) else data
        if plain is None:
            raise BadInput(MESSAGE_TOO_LARGE(topic=connection.topic, limit=MOST_BYTES))
        yield connection, time_ns, bytes(plain)


def sources_of(path: Path) -> list[Path]:
    """Return what rosbags opens: a bag, or its files where its recorder wrote no metadata.yaml."""
    if path.is_file() or (path / METADATA).exists():
        return [path]
    return sorted(path.glob("*.db3"), key=number_of) or [path]


@contextmanager
def opened(sources: Collection[Path]) -> Iterator[list[Reader]]:
    """Yield a reader of each source."""
    with ExitStack() as stack:
        yield [stack.enter_context(Reader(source)) for source in sources]


@contextmanager
def readable(path: Path) -> Iterator[None]:
    """Raise BadInput where what is read through rosbags is no ROS 2 bag, or damaged."""
    try:
        yield
    except Incomplete as error:
        raise BadInput(NOT_ROS_BAG(path=str(path), why=error)) from None
    except (BadInput, OSError):
        raise
    except Exception as error:  # what damage makes rosbags raise has no common base
        if type(error).__module__.startswith("mrlab_ros") or isinstance(error, AssertionError):
            raise
        found = _lacking(path) or NOT_ROS_BAG(path=str(path), why=str(error))
        # Of apsw's errors, which rosbags may wrap; the lower byte is the kind.
        if getattr(error.__cause__ or error, "extendedresult", 0) & 0xFF == SQLITE_CORRUPT:
            found = DATABASE_DAMAGED(
                path=str(path), problem=str(error), fixes=(Fix(command=_rescue(path)),)
            )
        raise BadInput(found) from None


def _lacking(path: Path) -> Diagnostic | None:
    """Return what to do about files of a bag that were renamed or removed; None: none were."""
    try:
        facts = yaml.load((path / METADATA).read_text(), Loader=Loader)[ROOT]
        listed = [Path(name).name for name in facts["relative_file_paths"]]
    except (OSError, yaml.YAMLError, UnicodeDecodeError, TypeError, KeyError, AttributeError):
        return None
    missing = [name for name in listed if not (path / name).is_file()]
    if not missing:
        return None
    others = [f for f in sorted(path.glob("*.db3"), key=number_of) if f.name not in listed]
    alone = tuple(Fix(command=f"mrlab bag info {for_shell([str(other)])}") for other in others[:1])
    return BAG_LACKS_FILES(path=str(path), files=missing, fixes=alone)


def _rescue(path: Path) -> str:
    """Return the command that copies what can be read of a damaged database to a new one.

    sqlite3's own .recover finds nothing in a file that was cut off; .dump takes its changes back
    where it met damage, so that ROLLBACK becomes COMMIT.
    """
    files = [path] if path.is_file() else sorted(path.glob("*.db3"), key=number_of)
    name = for_shell([str(files[0])]) if len(files) == 1 else "FILE.db3"
    return f"sqlite3 {name} .dump | sed 's/^ROLLBACK.*/COMMIT;/' | sqlite3 NEW.db3"


@contextmanager
def plain_file(source: Path) -> Iterator[Path]:
    """Yield `source`, or, of a file that is compressed as a whole, what it holds."""
    if not source.is_file() or not is_compressed(_beginning(source)):
        yield source
        return
    with tempfile.TemporaryDirectory(prefix="mrlab-bag-") as folder:
        plain = Path(folder) / "bag"
        with open(plain, "wb") as target:
            inflate_file(source, target, INFLATED + RATIO * source.stat().st_size)
        # rosbags knows a file by its ending
        yield plain.rename(plain.with_suffix(ENDINGS.get(_beginning(plain), "")))


def definition_of(
    connection: Any, installed: Callable[[str], str], known: Typestore
) -> str | None:
    """Return the text of a topic's type, the bag's own first; None: nobody has it."""
    kind = connection.msgtype
    given = connection.msgdef
    if given.data and given.format.name == "MSG":
        return str(given.data)
    try:
        return installed(kind)
    except BadInput:
        if kind not in known.fielddefs:
            return None
        return str(known.generate_msgdef(kind, ros_version=2)[0])


def topic_of(connection: Any) -> Topic:
    """Return a topic of a foreign bag, without its count."""
    qualities = tuple(
        QosProfile(
            history=quality.history.name.lower(),
            depth=quality.depth,
            reliability=quality.reliability.name.lower(),
            durability=quality.durability.name.lower(),
        )
        for quality in connection.ext.offered_qos_profiles
    )
    return Topic(connection.topic, connection.msgtype, qualities, connection.digest or "")


def _is_other(path: Path) -> bool:
    if path.is_file():
        try:
            beginning = _beginning(path)
        except OSError:
            return False
        return beginning == SQLITE or is_compressed(beginning)
    if not path.is_dir():
        return False
    try:
        facts = yaml.load((path / METADATA).read_text(), Loader=Loader)[ROOT]
        return facts["storage_identifier"] == "sqlite3" or bool(facts.get("compression_format"))
    except FileNotFoundError:
        return bool(list(path.glob("*.db3"))) and not mcap_files_in(path)
    except (OSError, yaml.YAMLError, UnicodeDecodeError, TypeError, KeyError, AttributeError):
        return False


def _beginning(file: Path) -> bytes:
    with open(file, "rb") as opened_file:
        return opened_file.read(4)


# Kinds of bags beside plain MCAP files: whether a path is one, and its reader.
READERS: list[tuple[Callable[[Path], bool], Callable[[Path, Callable[[str], str]], Bag]]] = [
    (_is_other, OtherBag)
]
