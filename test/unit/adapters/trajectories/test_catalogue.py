"""The catalogue in a store: one writer, any number of readers, whatever is killed or fails."""

import io
import os

import numpy as np
import orjson
import pytest
from fakes import make_trajectory
from kept import Kept
from memory_store import MemoryStore
from refusals import refused

from mrlab_ros.adapters.store import keys
from mrlab_ros.adapters.store.port import StoreFailure
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.adapters.trajectories.catalogue import Catalogue, NoTrajectory
from mrlab_ros.adapters.trajectories.catalogue_writer import DAMAGED, CatalogueWriter
from mrlab_ros.adapters.trajectories.files import TrajectoryFiles
from mrlab_ros.adapters.trajectories.npz_file import Damaged
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory.catalogue import TrajectoryName
from mrlab_ros.core.trajectory.diagnostics import (
    NO_TRAJECTORY_OF_NAME,
    NOBODYS_TRAJECTORIES,
    OVER_QUOTA,
)

DAY_NS = 86_400 * 10**9


class Clock:
    now_ns = 1_700_000_000 * 10**9

    def __call__(self):
        self.now_ns += 1
        return self.now_ns


@pytest.fixture
def store():
    return MemoryStore()


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def log():
    return []


@pytest.fixture
def writer(store, clock, log):
    writer = CatalogueWriter(store, log.append, now_ns=clock)
    writer.open()
    return writer


def make(name="pick", value=0.0, rows=4):
    return make_trajectory(np.full((rows, 2), value), trajectory_id=name)


def ids(catalogue):
    return [f"{r.id}@{r.newest.number}" for r in catalogue.records() if not r.deleted_ns]


def reader_of(store):
    reader = Catalogue(store)
    reader.refresh()
    return reader


def draft_of(store, user, trajectory):
    key = keys.draft(user, keys.unique())
    file = io.BytesIO()
    npz_file.write(trajectory, file)
    store.put(key, file.getvalue())
    return key


def test_versions_of_two_users_and_the_lab_stay_apart(store, writer, tmp_path):
    kept = Kept(writer, TrajectoryFiles(store, tmp_path))
    for name, value in [("pick", 1), ("anna/pick", 2), ("ben/pick", 3), ("anna/pick", 4)]:
        kept.save(make(name, value))
    assert ids(writer) == ["anna/pick@2", "ben/pick@1", "pick@1"]
    for name, value in [("pick", 1), ("anna/pick", 4), ("anna/pick@1", 2), ("ben/pick@1", 3)]:
        loaded = kept.load(name)
        assert loaded.positions[0, 0] == value
        assert loaded.id == name.split("@")[0]
    assert (loaded.owner, loaded.version, loaded.shared) == ("ben", 1, False)
    assert ids(reader_of(store)) == ids(writer)


def test_a_reader_reads_what_changed_and_nothing_else(store, writer):
    for i in range(5):
        writer.save(make(f"m{i}"))
    reader = reader_of(store)
    assert not reader.refresh()
    read = []
    get = store.get
    store.get = lambda key: read.append(key) or get(key)
    writer.save(make("m3"))
    writer.delete("m1")
    read.clear()
    assert reader.refresh()
    assert ids(reader) == ["m0@1", "m2@1", "m3@2", "m4@1"]
    assert sorted(read) == [keys.CHANGES, keys.record("", "m1"), keys.record("", "m3")]


def test_a_reader_that_missed_much_reads_all(store, writer):
    reader = reader_of(store)
    for i in range(300):
        writer.save(make(f"m{i % 7}"))
    assert reader.refresh()
    assert ids(reader) == ids(writer)


def test_a_reader_follows_a_writer_that_was_started_again(store, writer):
    writer.save(make("one"))
    reader = reader_of(store)
    again = CatalogueWriter(store)
    again.open()
    again.save(make("two"))
    assert reader.refresh()
    assert ids(reader) == ["one@1", "two@1"]


def test_who_may_not_see_it_is_told_nothing_of_it(writer):
    writer.save(make("anna/secret"))
    writer.save(make("open"))
    with refused(NO_TRAJECTORY_OF_NAME, NoTrajectory, known=["open"], close=None):
        writer.find("anna/secret", lambda r: r.visible_to("ben"))
    with pytest.raises(NoTrajectory) as said:
        writer.find("anna/secre", lambda r: r.visible_to("ben"))
    assert "anna/secret'" not in str(said.value)
    assert writer.find("anna/secret", lambda r: r.visible_to("anna"))[1].number == 1
    with pytest.raises(NoTrajectory) as said:
        writer.find("anna/secre", named=lambda r: r.visible_to(""))
    assert "anna/secret'" not in str(said.value)
    for text in ("", "/", "../x", "a@0", "x\x00"):
        with pytest.raises(NoTrajectory):
            writer.find(text)


def test_deleted_shared_and_restored(store, writer):
    writer.save(make("anna/pick", 1))
    writer.save(make("anna/pick", 2))
    writer.share("anna/pick", True)
    assert writer.find("anna/pick", lambda r: r.visible_to("ben"))
    writer.delete("anna/pick")
    with pytest.raises(NoTrajectory):
        writer.find("anna/pick")
    with pytest.raises(NoTrajectory):
        writer.share("anna/pick", False)
    assert ids(reader_of(store)) == []
    writer.restore("anna/pick", 0)
    assert writer.restore("anna/pick", 1).newest.number == 3
    assert ids(reader_of(store)) == ["anna/pick@3"]


def test_old_versions_go_with_their_files(store, writer):
    writer.versions_kept = 2
    for value in range(5):
        writer.save(make("pick", value))
    assert [v.number for v in writer.find("pick")[0].versions] == [4, 5]
    assert len(store.list(keys.VERSIONS)) == 2
    writer.restore("pick", 4)
    assert len(store.list(keys.VERSIONS)) == 2


def test_a_draft_is_published_once(store, writer):
    key = draft_of(store, "anna", make("pick", 7))
    head = {"id": "pick", "frame_count": 4}
    name = TrajectoryName("anna", "pick")
    first, _ = writer.publish(name, head, key)
    assert store.list("users") == []
    again, _ = writer.publish(name, head, key)
    assert again is first
    assert [v.number for v in again.versions] == [1]


@pytest.mark.parametrize("left", range(4))
def test_a_store_that_fails_in_between_changes_nothing_or_all(store, writer, left, tmp_path, log):
    kept = Kept(writer, TrajectoryFiles(store, tmp_path))
    kept.save(make("pick", 1))
    store.writes_left = left
    failed = False
    try:
        kept.save(make("pick", 2))
    except StoreFailure:
        failed = True
    store.writes_left = None
    assert failed == (left < 2)
    after = Kept(CatalogueWriter(store), TrajectoryFiles(store, tmp_path))
    after.catalogue.open()
    for each in (kept, after):
        assert each.load("pick").positions[0, 0] == (1 if failed else 2)
    kept.catalogue.sweep(1e9, 1e9)
    assert ids(reader_of(store)) == ids(writer)


def test_a_store_on_a_full_disk_is_read(store, writer, tmp_path, log):
    kept = Kept(writer, TrajectoryFiles(store, tmp_path))
    kept.save(make("pick", 1))
    store.writes_left = 0
    again = Kept(CatalogueWriter(store, log.append), TrajectoryFiles(store, tmp_path))
    again.catalogue.open()
    assert again.load("pick").positions[0, 0] == 1
    assert len(log) == 1
    store.writes_left = None
    again.catalogue.sweep(1e9, 1e9)
    again.save(make("pick", 2))
    assert ids(reader_of(store)) == ids(again.catalogue)


def test_a_write_whose_answer_was_lost_is_looked_up(store, writer):
    """The store has the new record, and its writer was told that it failed."""
    key = draft_of(store, "anna", make("pick"))
    head, name = {"id": "pick", "frame_count": 4}, TrajectoryName("anna", "pick")
    put = store.put

    def lost(key, data):
        put(key, data)
        if key.startswith(keys.RECORDS):
            raise StoreFailure("no answer")

    store.put = lost
    with pytest.raises(StoreFailure):
        writer.publish(name, head, key)
    store.put = put
    record, _ = writer.publish(name, head, key)
    assert [v.number for v in record.versions] == [1]


def test_a_quota_bounds_a_user_and_nobody_else(writer):
    writer.save(make("anna/a"))
    writer.quota = writer.usage("anna") + 100
    with refused(OVER_QUOTA, BadInput, owner="anna"):
        writer.save(make("anna/b"))
    writer.save(make("ben/b"))
    writer.save(make("lab"))
    assert ids(writer) == ["anna/a@1", "ben/b@1", "lab@1"]


def test_the_trash_is_emptied_after_its_time(store, writer, clock):
    writer.save(make("old"))
    writer.save(make("young"))
    writer.delete("old")
    clock.now_ns += 2 * DAY_NS
    writer.delete("young")
    writer.sweep(86_400, 1e12)
    with pytest.raises(NoTrajectory):
        writer.restore("old", 0)
    assert writer.restore("young", 0).name == "young"
    assert len(store.list(keys.VERSIONS)) == 1


def test_what_nobody_names_is_swept_and_the_rest_stays(store, writer, clock, tmp_path):
    kept = Kept(writer, TrajectoryFiles(store, tmp_path))
    kept.save(make("pick", 1))
    orphan = keys.version("", "pick")
    store.put(orphan, b"half a change")
    upload = keys.upload("anna", keys.unique(), "a.mat")
    store.put(upload, b"data")
    writer.sweep(1e12, 1e12)
    store.objects = {key: (data, 0.0) for key, (data, _) in store.objects.items()}
    clock.now_ns = 10 * DAY_NS
    writer.sweep(1e12, 11 * 86_400)
    assert orphan not in store.objects
    assert upload in store.objects
    writer.sweep(1e12, 9 * 86_400)
    assert upload not in store.objects
    assert kept.load("pick").positions[0, 0] == 1


def test_a_damaged_record_is_kept_aside_and_the_others_count(store, writer, log):
    writer.save(make("good"))
    writer.save(make("bad"))
    key = keys.record("", "bad")
    store.objects[key] = (b'{"format": 1', 0.0)
    again = CatalogueWriter(store, log.append)
    again.open()
    assert ids(again) == ["good@1"]
    assert store.get(f"{DAMAGED}/{key}") == b'{"format": 1'
    assert "left out of the catalogue" in log[-1]


def test_a_damaged_file_leaves_the_older_version(store, writer, tmp_path):
    files = TrajectoryFiles(store, tmp_path)
    writer.save(make("pick", 1))
    record, version = writer.save(make("pick", 2, rows=400))
    data = bytearray(store.get(version.key))
    data[3000] ^= 1
    store.put(version.key, bytes(data))
    with pytest.raises(Damaged):
        files.load(record, version)
    place = writer.set_aside(record, version)
    assert place == f"memory/{DAMAGED}/{version.key}"
    assert store.get(f"{DAMAGED}/{version.key}") == bytes(data)
    assert ids(writer) == ["pick@1"]
    assert files.load(*writer.find("pick")).positions[0, 0] == 1


def test_a_fetched_file_that_is_damaged_is_fetched_again(store, writer, tmp_path):
    files = TrajectoryFiles(store, tmp_path / "fetched")
    record, version = writer.save(make("pick", 3))
    path = files.path(version)
    path.write_bytes(path.read_bytes()[:500])
    assert files.load(record, version).positions[0, 0] == 3


def test_fetched_files_stay_within_their_bound(store, writer, tmp_path):
    folder = tmp_path / "fetched"
    versions = [writer.save(make(f"m{i}"))[1] for i in range(4)]
    files = TrajectoryFiles(store, folder, most_bytes=2 * versions[0].size)
    for i, version in enumerate(versions):
        path = files.path(version)
        os.utime(path, (i, i))
        assert path.is_file()
    assert len(list(folder.iterdir())) == 2
    store.broken = "it is away"
    assert files.path(versions[3]).is_file()
    with pytest.raises(StoreFailure, match="it is away"):
        files.path(versions[0])


def test_parts_of_a_version_know_whose_they_are(store, writer, tmp_path):
    files = TrajectoryFiles(store, tmp_path)
    record, version = writer.save(make("anna/pick", rows=9), shared=True)
    frames = files.frames(record, version, 2, 3)
    assert frames.positions.shape == (3, 2)
    assert (frames.head["id"], frames.head["owner"]) == ("anna/pick", "anna")
    assert (frames.head["version"], frames.head["shared"]) == (1, True)


# --- folders of earlier versions


def test_changes_that_cannot_be_read_are_read_anew(store, writer):
    writer.save(make("a"))
    reader = reader_of(store)
    store.put(keys.CHANGES, b"[")
    assert reader.refresh()
    assert ids(reader) == ["a@1"]
    writer.save(make("b"))
    assert orjson.loads(store.get(keys.CHANGES))["number"] == 2
    assert reader.refresh()
    assert ids(reader) == ["a@1", "b@1"]


def sent(store, owner):
    """Put an upload and a draft of somebody's into the store."""
    number = keys.unique()
    for key in (keys.upload(owner, number, "a.mat"), keys.draft(owner, number)):
        store.put(key, b"x")


def test_trajectories_change_hands_with_their_versions(store, writer, tmp_path):
    reader = reader_of(store)
    for name in ("anna/pick", "anna/pick", "anna/lift", "ben/pick", "annabel/pick"):
        writer.save(make(name))
    writer.delete("anna/lift")
    for owner in ("anna", "annabel"):
        sent(store, owner)
    assert writer.hand_over("anna", "ben") == 2
    assert ids(writer) == ["annabel/pick@1", "ben/pick@1", "ben/pick-2@2"]
    assert writer.restore("ben/lift", 0).owner == "ben"
    reader.refresh()
    assert ids(reader) == ids(writer)
    record, version = reader.find("ben/pick-2@1")
    assert TrajectoryFiles(store, tmp_path).load(record, version).owner == "ben"
    assert not store.list(keys.user("anna"))
    assert len(store.list(keys.user("annabel"))) == 2
    # What one has got is erased with all else, whoever made it.
    assert writer.erase("ben") == 3
    assert ids(writer) == ["annabel/pick@1"]
    assert len(store.list(keys.VERSIONS)) == 1


def test_erasing_leaves_nothing_of_somebody_and_all_of_the_others(store, writer, tmp_path):
    for name in ("anna/pick", "anna/lift", "ben/pick", "quintic"):
        record, version = writer.save(make(name))
    writer.hand_over("ben", "carla")
    (damaged, version) = writer.find("anna/lift")
    writer.set_aside(damaged, version)
    sent(store, "anna")
    assert writer.erase("anna") == 1
    assert ids(writer) == ["carla/pick@1", "quintic@1"]
    # Its file is still where ben published it.
    assert writer.erase("ben") == 0
    record, version = writer.find("carla/pick")
    assert TrajectoryFiles(store, tmp_path).load(record, version).frame_count == 4
    assert not [key for key in store.objects if "anna" in key and key != keys.CHANGES]


def test_the_labs_own_trajectories_belong_to_nobody(writer):
    for act in (lambda: writer.erase(""), lambda: writer.hand_over("", "ben")):
        with refused(NOBODYS_TRAJECTORIES, BadInput):
            act()
