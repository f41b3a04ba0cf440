"""Bags on disk: written, read by others, cut short, mended."""

from __future__ import annotations

import errno
import fcntl
import os
import shlex
import shutil
import subprocess
from contextlib import suppress
from pathlib import Path
from typing import Any

import mcap.reader
import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.writer import Writer
from refusals import refused
from rosbags.highlevel import AnyReader
from sqlite_bag import as_sqlite

from mrlab_ros.adapters.bags.diagnostics import (
    BAG_BEING_RECORDED,
    BAG_DAMAGED,
    BAG_DISK_FULL,
    BAG_EMPTY_FILE,
    BAG_EXISTS,
    BAG_FOLDER_NOT_MADE,
    BAG_GONE,
    BAG_LACKS_FILES,
    BAG_MOVED,
    BAG_NO_INDEX,
    BAG_NOT_BEGUN,
    BAG_NOT_REPAIRED,
    BAG_NOT_WRITTEN,
    BAG_WITHOUT_FILES,
    DATABASE_DAMAGED,
    METADATA_NOT_YAML,
    NO_BAG,
    NOT_MCAP,
    ORIGINAL_IN_THE_WAY,
    REPAIR_RUNS,
)
from mrlab_ros.adapters.bags.other import open_bag
from mrlab_ros.adapters.bags.reader import Bag, bags_in, list_in, remove_empty
from mrlab_ros.adapters.bags.repair import refresh_metadata, repair
from mrlab_ros.adapters.bags.writer import (
    RESERVE_SIZE,
    BagWriter,
    DiskTrouble,
    WholeFile,
    is_being_written,
)
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.recording.diagnostics import METADATA_TOO_NEW, repairing
from mrlab_ros.core.recording.metadata import QosProfile, Topic

MAGIC = b"\x89MCAP0\r\n"
START_NS = 1_700_000_000_000_000_000
DEFINITION = "string data\n"
LATCHED = QosProfile(durability="transient_local")
# std_msgs/msg/String in Jazzy.
HASH = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"


def text(word: str) -> bytes:
    data = word.encode() + b"\0"
    return b"\0\1\0\0" + len(data).to_bytes(4, "little") + data


def begin(folder: Path, **options) -> BagWriter:
    writer = BagWriter(folder, lambda kind: DEFINITION, {"mrlab_ros": "1"}, **options)
    writer.add_topic(Topic("/state", "std_msgs/msg/String", (LATCHED,), HASH))
    writer.add_topic(Topic("/events", "std_msgs/msg/String", (QosProfile(),), HASH))
    return writer


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "class"


@pytest.fixture
def writer(folder: Path) -> BagWriter:
    return begin(folder)


def killed(writer: BagWriter) -> None:
    """Leave a bag as the kernel does of a process that is killed."""
    writer.flush()
    writer._file.close()


def fill(writer: BagWriter, count: int, first: int = 0) -> list[tuple[int, str, bytes]]:
    """Write messages 10 ms apart; every tenth is a state."""
    messages = []
    for number in range(first, first + count):
        topic = "/state" if number % 10 == 0 else "/events"
        message = (START_NS + number * 10_000_000, topic, text(f"message {number}"))
        writer.write(topic, message[0], message[2], message[0] - 1000, number)
        messages.append(message)
    return messages


def read(folder: Path) -> list[tuple[int, str, bytes]]:
    return [(m.log_time_ns, m.topic, m.data) for m in Bag(folder).messages()]


def read_by_rosbags(folder: Path) -> list[tuple[int, str, bytes]]:
    with AnyReader([folder]) as reader:
        return [(time, c.topic, bytes(data)) for c, time, data in reader.messages()]


def read_by_mcap(path: Path) -> list[tuple[int, str, bytes]]:
    """Read as from a pipe: without index, without going back."""
    with open(path, "rb") as file:
        found = mcap.reader.NonSeekingReader(file, validate_crcs=True).iter_messages()
        return [(m.log_time, c.topic, m.data) for _, c, m in found]


def test_a_bag_opens_everywhere_and_every_byte_is_there(folder, writer):
    writer.note("mrlab", {"mrlab_ros": "1"})
    writer.attach("robots/a.urdf", "model/urdf+xml", b"<robot/>", START_NS)
    messages = fill(writer, 500)
    writer.flush()
    messages += fill(writer, 500, 500)
    writer.close()
    assert read(folder) == read_by_rosbags(folder) == messages
    assert read_by_mcap(folder / "class_0.mcap") == messages
    with AnyReader([folder]) as reader:
        state = next(c for c in reader.connections if c.topic == "/state")
        assert (state.msgtype, state.msgcount, state.digest) == ("std_msgs/msg/String", 100, HASH)
        assert state.ext.offered_qos_profiles[0].durability.name == "TRANSIENT_LOCAL"
        _, _, data = next(reader.messages([state]))
        assert reader.deserialize(data, state.msgtype).data == "message 0"
    bag = Bag(folder)
    assert bag.troubles == []
    assert bag.attachment("robots/a.urdf").data == b"<robot/>"
    assert bag.attachments() == {"robots/a.urdf": 8}
    assert bag.versions() == {"mrlab_ros": "1"}
    assert bag.duration == pytest.approx(9.99)
    assert (bag.message_count, bag.topics["/events"].messages) == (1000, 900)
    assert sorted(p.name for p in folder.iterdir()) == ["class_0.mcap", "metadata.yaml"]


def test_the_metadata_is_what_the_files_say(folder, writer):
    fill(writer, 20)
    writer.split()
    fill(writer, 20, 20)
    writer.close()
    written = yaml.safe_load((folder / "metadata.yaml").read_text())
    told = Bag(folder).facts()
    told.custom = {"mrlab_ros": "1"}
    by_name = {"key": lambda entry: entry["topic_metadata"]["name"]}
    for document in (written, told_document := told.document()):
        facts = document["rosbag2_bagfile_information"]
        facts["topics_with_message_count"].sort(**by_name)
    assert written == told_document


def test_a_split_bag_is_one_session(folder, writer):
    messages = fill(writer, 50)
    writer.split()
    messages += fill(writer, 50, 50)
    writer.close()
    assert read(folder) == read_by_rosbags(folder) == messages
    assert [file.path.name for file in Bag(folder).files] == ["class_0.mcap", "class_1.mcap"]


def test_a_sqlite3_bag_is_read_from_anywhere_as_an_mcap_bag_is(tmp_path, folder, writer):
    messages = fill(writer, 1000)
    writer.close()
    other = open_bag(as_sqlite(Bag(folder), tmp_path / "other"), lambda _: DEFINITION)
    assert (other.start_ns, other.end_ns) == (messages[0][0], messages[-1][0])
    assert other.topics["/state"].latched
    assert not other.topics["/events"].latched
    for at_ns in (START_NS, START_NS + 3_333_333_333, messages[-1][0]):
        read_on = [(m.log_time_ns, m.topic, m.data) for m in other.messages(at_ns)]
        assert read_on == [each for each in messages if each[0] >= at_ns]
    assert [
        m.data for m in other.newest_before(START_NS + 5_001_000_000, ["/state", "/none"])
    ] == [text("message 500")]
    assert other.newest_before(START_NS, ["/state"]) == []
    far = other.newest_before(START_NS + 10**18, ["/state", "/events"])
    assert [m.data for m in far] == [text("message 990"), text("message 999")]


@pytest.mark.skipif(shutil.which("sqlite3") is None, reason="needs the sqlite3 command")
def test_what_is_left_of_a_sqlite3_bag_is_read_by_the_command_that_its_message_names(tmp_path):
    writer = begin(tmp_path / "class")
    messages = fill(writer, 1000)
    writer.close()
    folder = as_sqlite(Bag(tmp_path / "class"), tmp_path / "last week")
    (database,) = folder.glob("*.db3")
    os.truncate(database, database.stat().st_size // 2)
    with refused(DATABASE_DAMAGED, BadInput) as caught:
        open_bag(folder, lambda _: DEFINITION)
    command = caught.value.diagnostic.fixes[0].command
    subprocess.run(command, shell=True, check=True, cwd=tmp_path, capture_output=True)
    left = list(open_bag(tmp_path / "NEW.db3", lambda _: DEFINITION).messages())
    assert 100 < len(left) < len(messages)
    assert [m.data for m in left] == [data for _, _, data in messages[: len(left)]]


def test_the_newest_state_before_a_place_is_found_in_any_file(folder, writer):
    for part in range(3):
        fill(writer, 25, part * 40)
        writer.flush()
        fill(writer, 15, part * 40 + 25)
        writer.split()
    writer.close()
    bag = Bag(folder)
    for number, newest in ((0, None), (1, 0), (10, 0), (11, 10), (81, 80), (999, 110)):
        found = bag.newest_before(START_NS + number * 10_000_000, {"/state"})
        expected = [] if newest is None else [text(f"message {newest}")]
        assert [m.data for m in found] == expected, number


@pytest.mark.parametrize("start", [0, 1, 250, 499, 500])
def test_reading_begins_anywhere(folder, writer, start):
    messages = fill(writer, 250)
    writer.flush()
    messages += fill(writer, 250, 250)
    writer.close()
    found = Bag(folder).messages(START_NS + start * 10_000_000, {"/state", "/events"})
    assert [m.data for m in found] == [m[2] for m in messages[start:]]


def test_a_log_time_that_goes_back_is_held(folder, writer):
    writer.write("/events", START_NS + 5, text("a"), 0)
    writer.write("/events", START_NS, text("b"), 0)
    writer.close()
    assert [m[0] for m in read(folder)] == [START_NS + 5] * 2


def test_what_was_flushed_is_there_at_once_for_everybody(folder, writer):
    """As after a kill: nothing more is written. No repair, no index."""
    writer.attach("scene.json", "application/json", b"[]", START_NS)
    messages = fill(writer, 300)
    writer.flush()
    messages += fill(writer, 300, 300)
    writer.write_metadata()
    writer.flush()
    fill(writer, 5, 600)
    assert read(folder) == read_by_rosbags(folder) == messages
    assert read_by_mcap(folder / "class_0.mcap") == messages
    bag = Bag(folder)
    assert bag.files[0].trouble == BAG_NO_INDEX(file="class_0.mcap")
    assert bag.attachment("scene.json").data == b"[]"
    assert bag.message_count == 600
    (folder / "metadata.yaml").unlink()
    assert read(folder) == messages


def test_a_repair_brings_index_and_metadata_and_keeps_the_originals(folder, writer):
    writer.attach("scene.json", "application/json", b"[]", START_NS)
    writer.note("mrlab", {"mrlab_ros": "1"})
    messages = fill(writer, 300)
    killed(writer)
    original = (folder / "class_0.mcap").read_bytes()
    done = repair(folder)
    assert (done.files, done.messages) == (["class_0.mcap", "metadata.yaml"], 300)
    bag = Bag(folder)
    assert bag.troubles == []
    assert bag.attachment("scene.json").data == b"[]"
    assert bag.versions() == {"mrlab_ros": "1"}
    assert read(folder) == read_by_rosbags(folder) == messages
    assert (folder / "class_0.mcap.original").read_bytes() == original
    assert not (folder / ".reserve").exists()
    (folder / "class_0.mcap").write_bytes(original)
    (folder / "metadata.yaml").unlink()
    with refused(ORIGINAL_IN_THE_WAY, BadInput):
        repair(folder)


def test_a_kill_at_the_beginning_of_a_next_file_costs_nothing(folder, writer):
    messages = fill(writer, 20)
    writer.close()
    (folder / "class_1.mcap").write_bytes(MAGIC[:3])
    bag = Bag(folder)
    assert read(folder) == messages
    assert bag.troubles == [BAG_NOT_BEGUN(file="class_1.mcap", fixes=repairing(folder))]
    assert repair(folder).messages == 20
    assert Bag(folder).troubles == []
    assert read(folder) == read_by_rosbags(folder) == messages


@pytest.mark.parametrize("content", [b"", MAGIC[:3]])
def test_an_empty_file_of_another_kind_is_refused_and_stays(tmp_path, content):
    file = tmp_path / "class.db3"
    file.write_bytes(content)
    for use in (repair, Bag):
        with refused(BAG_EMPTY_FILE, BadInput, path=str(file)):
            use(file)
    assert [(each.name, each.read_bytes()) for each in tmp_path.iterdir()] == [
        ("class.db3", content)
    ]


def test_a_renamed_database_is_opened_by_the_command_that_its_message_names(tmp_path):
    writer = begin(tmp_path / "class")
    messages = fill(writer, 20)
    writer.close()
    folder = as_sqlite(Bag(tmp_path / "class"), tmp_path / "last week")
    (database,) = folder.glob("*.db3")
    renamed = database.rename(folder / "monday.db3")
    with refused(BAG_LACKS_FILES, BadInput, files=[database.name]) as caught:
        open_bag(folder, lambda _: DEFINITION)
    (fix,) = caught.value.diagnostic.fixes
    *command, path = shlex.split(fix.command)
    assert (command, path) == (["mrlab", "bag", "info"], str(renamed))
    assert open_bag(Path(path), lambda _: DEFINITION).message_count == len(messages)
    renamed.unlink()
    with refused(BAG_LACKS_FILES, BadInput) as caught:
        open_bag(folder, lambda _: DEFINITION)
    assert caught.value.diagnostic.fixes == ()


def test_a_file_alone_is_mended_and_nothing_beside_it(tmp_path, folder, writer):
    messages = fill(writer, 20)
    killed(writer)
    (folder / "metadata.yaml").write_text("as it was")
    file = (folder / "class_0.mcap").rename(tmp_path / "class_0.mcap")
    (tmp_path / "metadata.yaml").write_text("as it was")
    done = repair(file)
    assert (done.files, done.messages) == (["class_0.mcap"], len(messages))
    assert read(file) == messages
    assert (tmp_path / "metadata.yaml").read_text() == "as it was"
    assert repair(file).files == []


def test_a_repair_that_fails_leaves_the_bag_as_it_was(folder, writer, monkeypatch):
    messages = fill(writer, 20)
    writer.write_metadata()
    killed(writer)
    before = {path.name: path.read_bytes() for path in folder.iterdir()}

    def refuse(*_: Any) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(Writer, "finish", refuse)
        with refused(BAG_NOT_REPAIRED, BadInput, problem=os.strerror(errno.ENOSPC)):
            repair(folder)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before
    assert repair(folder).messages == 20
    assert read(folder) == messages


def test_a_repair_that_ends_between_two_steps_leaves_a_bag_that_opens(folder, writer, monkeypatch):
    messages = fill(writer, 20)
    killed(writer)

    def refuse(*_: Any) -> None:
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    with monkeypatch.context() as patch:
        patch.setattr(Path, "replace", refuse)
        with refused(BAG_NOT_REPAIRED, BadInput):
            repair(folder)
    assert read(folder) == messages
    assert repair(folder).messages == 20
    assert read(folder) == read_by_rosbags(folder) == messages


def test_two_repairs_at_once_do_not_meet(folder, writer):
    messages = fill(writer, 20)
    killed(writer)
    other = os.open(folder, os.O_RDONLY)
    fcntl.flock(other, fcntl.LOCK_EX)
    for path in (folder, folder / "class_0.mcap"):
        with refused(REPAIR_RUNS, Misuse, path=str(path)):
            repair(path)
    os.close(other)
    assert repair(folder).messages == len(messages)


def test_a_repair_of_what_is_well_changes_nothing(folder, writer):
    fill(writer, 20)
    writer.close()
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    for _ in range(2):
        assert repair(folder).files == []
        assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def test_a_repair_leaves_out_a_damaged_chunk_and_keeps_what_follows(folder, writer):
    messages = []
    for part in range(3):
        messages += fill(writer, 100, part * 100)
        writer.flush()
    writer.close()
    path = folder / "class_0.mcap"
    data = bytearray(path.read_bytes())
    data[Bag(folder).files[0].chunks[1].offset + 200] ^= 0xFF
    path.write_bytes(data)
    with refused(BAG_DAMAGED, BadInput):
        read(folder)
    done = repair(folder)
    assert done.files == ["class_0.mcap", "metadata.yaml"]
    assert [trouble.code for trouble in done.troubles] == ["bag_damaged"]
    assert read(folder) == read_by_rosbags(folder) == messages[:100] + messages[200:]


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> tuple[bytes, list[tuple[int, str, bytes]], list[int]]:
    """A closed file of chunks with 20 messages each, its messages, where each chunk begins."""
    folder = tmp_path_factory.mktemp("bags") / "class"
    writer = begin(folder)
    messages = []
    for part in range(5):
        messages += fill(writer, 20, part * 20)
        writer.flush()
    writer.close()
    begins = [chunk.offset for chunk in Bag(folder).files[0].chunks]
    return (folder / "class_0.mcap").read_bytes(), messages, begins


@settings(max_examples=60)
@given(share=st.floats(0, 1))
def test_a_file_cut_anywhere_gives_what_is_before_the_cut(tmp_path_factory, whole, share):
    data, messages, begins = whole
    path = tmp_path_factory.mktemp("cut") / "class_0.mcap"
    cut = round(share * (len(data) - 1))
    path.write_bytes(data[:cut])
    bag = Bag(path)
    found = [(m.log_time_ns, m.topic, m.data) for m in bag.messages()]
    assert found == messages[: len(found)]
    begun = sum(begin < cut for begin in begins)
    assert len(found) in (20 * begun, max(0, 20 * (begun - 1)))
    assert bag.troubles


@settings(max_examples=60)
@given(share=st.floats(0, 1), bit=st.integers(0, 7))
def test_a_flipped_bit_never_brings_a_wrong_message(tmp_path_factory, whole, share, bit):
    data, messages, begins = whole
    path = tmp_path_factory.mktemp("flip") / "class_0.mcap"
    broken = bytearray(data)
    place = round(share * (len(data) - 1))
    broken[place] ^= 1 << bit
    path.write_bytes(broken)
    found = []
    with suppress(BadInput):
        for m in Bag(path).messages():
            found.append((m.log_time_ns, m.topic, m.data))
    assert set(found) <= set(messages)
    before = sum(begin <= place for begin in begins) - 1
    if 0 <= before < len(begins) - 1:
        assert found[: 20 * before] == messages[: 20 * before]


@pytest.mark.parametrize(
    ("make", "code"),
    [
        (lambda folder: None, NO_BAG),
        (lambda folder: folder.mkdir(), BAG_WITHOUT_FILES),
        (lambda folder: folder.write_bytes(b"not a bag"), NOT_MCAP),
    ],
)
def test_what_is_no_bag_is_said_so(tmp_path, make, code):
    folder = tmp_path / "x"
    make(folder)
    with refused(code, BadInput, path=str(folder)):
        Bag(folder)


def test_missing_files_and_strange_metadata_are_named(folder, writer):
    fill(writer, 5)
    writer.close()
    metadata = folder / "metadata.yaml"
    known = metadata.read_text()
    metadata.write_text(known.replace("version: 9", "version: 99"))
    with refused(METADATA_TOO_NEW, BadInput, version="99", known=9):
        Bag(folder)
    metadata.write_text("{")
    with refused(METADATA_NOT_YAML, BadInput):
        Bag(folder)
    metadata.write_text(known)
    (folder / "class_0.mcap").unlink()
    with refused(BAG_LACKS_FILES, BadInput, files=["class_0.mcap"]):
        Bag(folder)


class FullDisk:
    """Lets so many bytes be written; the last write is cut, as on a real disk."""

    def __init__(self, room: int, error: int = errno.ENOSPC) -> None:
        self.room = room
        self.error = error

    def __call__(self, descriptor: int, data: memoryview, offset: int) -> int:
        end = offset + len(data)
        if offset >= self.room:
            raise OSError(self.error, os.strerror(self.error))
        return os.pwrite(descriptor, data[: len(data) - max(end - self.room, 0)], offset)


def fill_disk(writer: BagWriter) -> tuple[list[Any], list[Any]]:
    """Write until the disk is full; return what was flushed by then, and what was not."""
    messages: list[Any] = []
    for part in range(100):
        wanted = fill(writer, 100, part * 100)
        try:
            writer.flush()
        except DiskTrouble as error:
            found = error.diagnostic
            break
        messages += wanted
    assert (found.code, found.values["cause"]) == (BAG_DISK_FULL.code, "disk")
    assert 0 < found.values["free"] < found.values["size"]
    assert found.values["needed"] > RESERVE_SIZE
    return messages, wanted


@pytest.mark.parametrize("room", [4_000, 6_000, 9_000])
def test_a_full_disk_is_told_and_what_was_written_stays_readable(folder, room):
    disk = FullDisk(room)
    writer = begin(folder, open_file=lambda path: WholeFile(path, disk))
    messages = fill_disk(writer)[0]
    assert messages
    with pytest.raises(DiskTrouble):
        writer.close()
    assert read(folder) == read_by_mcap(folder / "class_0.mcap") == messages
    assert repair(folder).messages == len(messages)


def test_the_reserve_lets_a_bag_end_well_on_a_full_disk(folder):
    disk = FullDisk(6_000)
    writer = begin(folder, open_file=lambda path: WholeFile(path, disk))
    flushed, unflushed = fill_disk(writer)
    messages = flushed + unflushed
    assert os.fstat(writer._reserve).st_size == RESERVE_SIZE
    disk.room += RESERVE_SIZE
    writer.close()
    assert Bag(folder).troubles == []
    assert read(folder) == read_by_rosbags(folder) == messages
    assert not (folder / ".reserve").exists()


@pytest.mark.parametrize("room", [1_400, 2_500, 4_300])
def test_a_disk_that_is_full_at_a_split_costs_nothing_either(folder, room):
    disk = FullDisk(room)
    writer = begin(folder, open_file=lambda path: WholeFile(path, disk))
    messages = fill(writer, 100)
    with pytest.raises(DiskTrouble):
        writer.split()
    disk.room += RESERVE_SIZE
    writer.close()
    assert Bag(folder).troubles == []
    assert read(folder) == read_by_rosbags(folder) == messages


def test_a_next_file_that_cannot_be_opened_costs_nothing_either(folder):

    def open_one(path: Path) -> WholeFile:
        if path.name != "class_0.mcap":
            raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
        return WholeFile(path)

    writer = begin(folder, open_file=open_one)
    messages = fill(writer, 100)
    with refused(BAG_NOT_WRITTEN, DiskTrouble, problem=os.strerror(errno.EACCES)):
        writer.split()
    writer.close()
    assert Bag(folder).troubles == []
    assert read(folder) == read_by_rosbags(folder) == messages


def test_a_bag_that_cannot_be_begun_leaves_nothing(tmp_path, monkeypatch):
    def refuse(*_: Any) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as patch:
        patch.setattr(os, "posix_fallocate", refuse)
        with refused(BAG_DISK_FULL, DiskTrouble, cause="disk"):
            begin(tmp_path / "class")
    with refused(BAG_DISK_FULL, DiskTrouble, cause="disk"):
        begin(tmp_path / "class", open_file=lambda path: WholeFile(path, FullDisk(0)))
    assert list(tmp_path.iterdir()) == []


def test_folders_that_cannot_be_made_are_named(tmp_path):
    (tmp_path / "there").mkdir()
    with refused(BAG_EXISTS, BadInput):
        begin(tmp_path / "there")
    (tmp_path / "file").write_text("")
    with refused(BAG_FOLDER_NOT_MADE, BadInput):
        begin(tmp_path / "file" / "bag")


def test_a_bag_that_is_recorded_is_known_and_not_mended(folder, writer):
    messages = fill(writer, 100)
    writer.flush()
    assert is_being_written(folder / "class_0.mcap")
    with refused(BAG_BEING_RECORDED, Misuse) as caught:
        repair(folder)
    assert [fix.command for fix in caught.value.diagnostic.fixes] == ["mrlab record --stop"]
    assert not refresh_metadata(folder)
    assert Bag(folder).live
    assert Bag(folder).troubles == []
    writer.close()
    assert not Bag(folder).live
    assert not is_being_written(folder / "class_0.mcap")
    assert read(folder) == messages
    assert repair(folder).files == []


def test_metadata_of_a_killed_bag_is_right_after_it_was_looked_at(folder, writer):
    writer.write_metadata()
    messages = fill(writer, 100)
    killed(writer)
    assert sorted(path.name for path in folder.iterdir()) == ["class_0.mcap", "metadata.yaml"]
    assert refresh_metadata(folder)
    facts = yaml.safe_load((folder / "metadata.yaml").read_text())
    assert facts["rosbag2_bagfile_information"]["message_count"] == len(messages)
    assert not refresh_metadata(folder)


def test_a_renamed_folder_ends_the_recording_at_once_and_the_bag_is_whole(
    tmp_path, folder, writer
):
    messages = fill(writer, 100)
    folder.rename(tmp_path / "moved")
    with refused(BAG_MOVED, DiskTrouble, folder=str(folder)):
        writer.flush()
    with pytest.raises(DiskTrouble):
        writer.close()
    assert read(tmp_path / "moved") == messages


def test_a_bag_that_is_renamed_while_it_is_read_is_said_so(tmp_path, folder, writer):
    fill(writer, 20)
    writer.attach("scene.json", "application/json", b"[]", START_NS)
    writer.close()
    bag = Bag(folder)
    (folder).rename(tmp_path / "other")
    for read_it in (lambda: list(bag.messages()), lambda: bag.attachment("scene.json")):
        with refused(BAG_GONE, BadInput):
            read_it()


def test_a_bag_that_goes_on_counts_its_earlier_bytes(folder):
    first = begin(folder)
    fill(first, 100)
    first.close()
    size = Bag(folder).size
    writer = BagWriter(folder, lambda kind: DEFINITION, after=Bag(folder).facts())
    assert writer.facts.messages == 100
    assert writer.size > size
    writer.close()


def test_only_a_bag_without_messages_makes_room_for_another(tmp_path, folder, writer):
    assert not remove_empty(folder), "it is being written"
    # As a recorder leaves it that is killed now.
    killed(writer)
    assert remove_empty(folder)
    writer = begin(folder)
    fill(writer, 1)
    writer.close()
    assert not remove_empty(folder)
    other = tmp_path / "mine"
    other.mkdir()
    (other / "notes.txt").write_text("mine")
    assert not remove_empty(other)
    (other / "notes.txt").rename(other / "mine_0.mcap")
    assert not remove_empty(other)
    assert not remove_empty(tmp_path / "nowhere")


def test_a_file_whose_messages_cannot_be_read_is_not_empty(folder, writer):
    fill(writer, 1000)
    writer.close()
    path = folder / "class_0.mcap"
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 4])
    assert Bag(folder).message_count == 0
    assert not remove_empty(folder)


def test_bags_are_listed_newest_first_and_nothing_else_is(tmp_path):
    for age, name in enumerate(("new", "middle", "old")):
        writer = begin(tmp_path / name)
        fill(writer, 2)
        writer.close()
        for file in (tmp_path / name).glob("*.mcap"):
            os.utime(file, (1_700_000_000 - age, 1_700_000_000 - age))
    loose = tmp_path / "loose.mcap"
    loose.write_bytes(next((tmp_path / "old").glob("*.mcap")).read_bytes())
    os.utime(loose, (1_600_000_000, 1_600_000_000))
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes.txt").write_text("no bag")
    (tmp_path / "away").symlink_to(tmp_path / "gone")
    assert bags_in(tmp_path) == ["new", "middle", "old", "loose.mcap"]
    assert bags_in(tmp_path, most=2) == ["new", "middle"]
    assert bags_in(tmp_path / "gone") == []
    # one that is recorded elsewhere is listed by a link, once, and no longer than it is there
    elsewhere = tmp_path / "notes" / "old"
    shutil.copytree(tmp_path / "old", elsewhere)
    for _ in range(2):
        list_in(tmp_path, elsewhere)
    assert bags_in(tmp_path) == ["new", "middle", "old_2", "old", "loose.mcap"]
    assert not (tmp_path / "away").is_symlink()
