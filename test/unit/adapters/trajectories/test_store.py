"""The catalogue's files: bit for bit, checked, replaced as a whole, damage set aside."""

import os
import threading
import zipfile
from dataclasses import replace

import numpy as np
import orjson
import pytest
from fakes import make_trajectory
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from mrlab_ros.adapters.trajectories import json_file, store
from mrlab_ros.adapters.trajectories.store import Damaged, TrajectoryStore
from mrlab_ros.core.diagnostics import Diagnostic, Severity
from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.trajectory import document
from mrlab_ros.core.trajectory.trajectory import Channels

MATRICES = hnp.arrays(np.float64, st.tuples(st.integers(2, 40), st.integers(1, 8)),
                      elements=st.floats(allow_nan=False, allow_infinity=False))  # fmt: skip


def make(positions=None, name="pick", gripper=False):
    positions = np.random.default_rng(1).normal(size=(50, 3)) if positions is None else positions
    made = make_trajectory(
        positions,
        joint_names=tuple(f"j{i}" for i in range(positions.shape[1])),
        gripper=[i % 3 == 1 for i in range(len(positions))] if gripper else None,
        trajectory_id=name,
    )
    warning = Diagnostic("gripper_range", Severity.WARNING, "says", "fix", "q", "x")
    channels = Channels(positions / 2, positions[::-1].copy())
    return replace(made, channels=channels, created_ns=1_700_000_000_123_456_789,
                   warnings=(warning,))  # fmt: skip


def same(one, other):
    """Whether two arrays have the same bytes."""
    if one is None or other is None:
        return one is other
    return one.shape == other.shape and one.tobytes() == other.tobytes()


def equal(one, other):
    channels, others = one.channels, other.channels
    names = ("id", "robot_model", "end_effector", "joint_names", "frame_rate", "source",
             "created_ns", "warnings")  # fmt: skip
    return (
        same(one.positions, other.positions)
        and same(one.gripper, other.gripper)
        and same(channels.velocities, others.velocities)
        and same(channels.effort_proxy, others.effort_proxy)
        and all(getattr(one, name) == getattr(other, name) for name in names)
    )


@pytest.fixture
def kept(tmp_path):
    return TrajectoryStore(tmp_path / "store")


@given(MATRICES, st.booleans(), st.booleans())
def test_what_is_kept_comes_back_bit_for_bit(tmp_path_factory, positions, gripper, by_column):
    kept = TrajectoryStore(tmp_path_factory.mktemp("store"))
    positions = np.asarray(positions, order="F" if by_column else "C")
    written = make(positions, gripper=gripper)
    kept.save(written)
    assert equal(kept.load("pick"), written)


def test_numpy_reads_the_file(kept):
    written = make(gripper=True)
    with np.load(kept.save(written), allow_pickle=False) as content:
        assert same(content["positions"], written.positions)
        assert same(content["gripper"], written.gripper)
        assert orjson.loads(content["head.json"])["id"] == "pick"


def test_the_store_replaces_lists_and_deletes(kept):
    assert kept.ids() == []
    kept.save(make(np.zeros((3, 2))))
    kept.save(make(np.ones((5, 2))))
    kept.save(make(np.ones((5, 2)), name="a-b.c"))
    assert kept.ids() == ["a-b.c", "pick"]
    assert kept.load("pick").frame_count == 5
    head = kept.head("pick")
    assert (head["frame_count"], head["joint_names"]) == (5, ["j0", "j1"])
    assert document.warnings_of(head) == kept.load("pick").warnings
    kept.delete("pick")
    assert kept.ids() == ["a-b.c"]
    assert [p.name for p in kept.folder.iterdir()] == ["a-b.c.npz"]


@pytest.mark.parametrize("name", ["no", "../pick", "pick.npz", "", ".writing-1", "pick/../pick"])
def test_what_is_not_there_is_named(kept, name):
    kept.save(make())
    for use in (kept.load, kept.head, kept.delete, lambda i: kept.frames(i, 0, 0)):
        with pytest.raises(BadInput, match="there are: pick"):
            use(name)


@given(st.integers(0, 49), st.integers(0, 60), st.booleans())
def test_some_frames_are_those_of_the_whole(tmp_path_factory, begin, count, gripper):
    kept = TrajectoryStore(tmp_path_factory.mktemp("store"))
    written = make(gripper=gripper)
    kept.save(written)
    part = slice(begin, begin + count if count else None)
    for _ in range(2):  # the second time the file is known to be whole
        frames = kept.frames("pick", begin, count)
        assert frames.head["frame_count"] == 50
        assert same(frames.positions, written.positions[part])
        assert same(frames.velocities, written.channels.velocities[part])
        assert same(frames.effort_proxy, written.channels.effort_proxy[part])
        assert same(frames.gripper, written.gripper[part] if gripper else None)


@pytest.mark.parametrize("begin", [50, 1000])
def test_frames_after_the_last_one_are_refused(kept, begin):
    kept.save(make())
    with pytest.raises(BadInput, match=f"no frame {begin}; expected 0 to 49"):
        kept.frames("pick", begin, 1)
    assert kept.ids() == ["pick"]


@given(st.data())
def test_a_changed_byte_changes_nothing_or_is_found(tmp_path_factory, data):
    kept = TrajectoryStore(tmp_path_factory.mktemp("store"))
    written = make(gripper=True)
    path = kept.save(written)
    content = bytearray(path.read_bytes())
    at = data.draw(st.integers(0, len(content) - 1))
    content[at] ^= data.draw(st.integers(1, 255))
    path.write_bytes(content)
    said = ""
    try:
        assert equal(kept.load("pick"), written)
    except Damaged as error:
        said = str(error)
    if said:
        assert "'pick.npz' is damaged" in said
        assert "convert the workspace again" in said
        assert kept.ids() == []
        assert (kept.folder / "damaged" / "pick.npz").read_bytes() == bytes(content)


@pytest.mark.parametrize("length", [0, 1, 30, 200, 1500, -1, -22, -400])
def test_a_file_that_was_cut_is_set_aside_and_the_others_stay(kept, length):
    kept.save(make(name="good"))
    for use in (kept.head, kept.load, lambda i: kept.frames(i, 3, 4)):
        path = kept.save(make())
        path.write_bytes(path.read_bytes()[:length])
        with pytest.raises(Damaged, match=r"'pick\.npz' is damaged"):
            use("pick")
        assert kept.ids() == ["good"]
    names = sorted(p.name for p in (kept.folder / "damaged").iterdir())
    assert names == ["pick-2.npz", "pick-3.npz", "pick.npz"]
    assert equal(kept.load("good"), make(name="good"))


def test_damage_beside_the_frames_asked_for_is_found_too(kept):
    path = kept.save(make())
    with zipfile.ZipFile(path) as archive:
        at = archive.getinfo("effort_proxy.npy").header_offset + 400
    content = bytearray(path.read_bytes())
    content[at] ^= 1
    path.write_bytes(content)
    with pytest.raises(Damaged, match="effort_proxy"):
        kept.frames("pick", 0, 2)


def rewritten(path, **changes):
    """Write the file again with another head."""
    with zipfile.ZipFile(path) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    parts["head.json"] = orjson.dumps(orjson.loads(parts["head.json"]) | changes)
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in parts.items():
            archive.writestr(name, content)


@pytest.mark.parametrize("changes", [
    {"frame_count": 51}, {"frame_count": 10**15}, {"frame_count": -1}, {"frame_count": "50"},
    {"joint_names": ["a"]}, {"has_gripper": True}, {"id": 7}, {"source": None},
    {"warnings": [1]}, {"robot_model": None},
])  # fmt: skip
def test_a_head_that_contradicts_the_matrices_is_damage(kept, changes):
    rewritten(kept.save(make()), **changes)
    with pytest.raises(Damaged):
        kept.head("pick")


def test_a_file_of_a_later_version_stays_where_it_is(kept):
    rewritten(kept.save(make()), format=2)
    for use in (kept.head, kept.load):
        with pytest.raises(BadInput, match="kept in format 2; this MR-Lab reads format 1"):
            use("pick")
    assert kept.ids() == ["pick"]


def test_a_file_under_another_name_is_named(kept):
    os.rename(kept.save(make()), kept.path("other"))
    with pytest.raises(BadInput, match="holds the trajectory 'pick'; name it pick.npz"):
        kept.head("other")


def test_objects_are_never_unpickled(kept):
    path = kept.save(make())
    with path.open("wb") as file, zipfile.ZipFile(file, "w") as archive:
        archive.writestr("head.json", orjson.dumps(document.metadata(make()) | {"format": 1}))
        with archive.open("positions.npy", "w") as part:
            np.save(part, np.array([[print]], dtype=object), allow_pickle=True)
    with pytest.raises(Damaged):
        kept.load("pick")


def test_json_files_of_earlier_versions_are_part_of_the_catalogue(kept):
    written = make(gripper=True)
    json_file.write(written, kept.folder / "pick.json")
    assert kept.ids() == ["pick"]
    assert kept.head("pick")["frame_count"] == 50
    assert [p.name for p in kept.folder.iterdir()] == ["pick.json"]
    read = kept.load("pick")
    np.testing.assert_allclose(read.positions, written.positions, rtol=0, atol=1e-12)
    assert sorted(p.name for p in kept.folder.iterdir()) == ["imported", "pick.npz"]
    assert (kept.folder / "imported" / "pick.json").exists()
    assert equal(kept.load("pick"), read)
    kept.delete("pick")
    assert kept.ids() == []


def test_a_json_file_of_the_same_name_is_deleted_and_replaced_with_it(kept):
    json_file.write(make(), kept.folder / "pick.json")
    kept.save(make(np.zeros((3, 2))))
    assert kept.head("pick")["frame_count"] == 3
    json_file.write(make(), kept.folder / "pick.json")
    kept.delete("pick")
    assert kept.ids() == []


def test_a_json_file_that_is_none_is_set_aside(kept):
    (kept.folder / "pick.json").write_text("{")
    with pytest.raises(Damaged, match=r"'pick\.json' is no JSON.*moved to .*damaged/pick\.json"):
        kept.load("pick")
    assert kept.ids() == []


def test_a_write_that_fails_leaves_the_old_file(kept, monkeypatch):
    kept.save(make(np.zeros((3, 2))))

    def broken(trajectory, file):
        file.write(b"PK")
        raise OSError("disk full")

    monkeypatch.setattr(store, "write", broken)
    with pytest.raises(OSError, match="disk full"):
        kept.save(make())
    assert kept.load("pick").frame_count == 3
    assert [p.name for p in kept.folder.iterdir()] == ["pick.npz"]


def test_files_that_a_killed_process_left_are_removed_later(kept):
    for name, age in ((".writing-old", 2 * store.STALE_AFTER_S), (".writing-new", 0.0)):
        path = kept.folder / name
        path.touch()
        os.utime(path, (path.stat().st_mtime - age,) * 2)
    assert TrajectoryStore(kept.folder).ids() == []
    assert [p.name for p in kept.folder.iterdir()] == [".writing-new"]


def test_readers_see_the_old_or_the_new_file_while_it_is_replaced(kept):
    versions = [make(np.full((2000, 3), float(i))) for i in range(2)]
    kept.save(versions[0])
    stop, seen, failures = threading.Event(), set(), []

    def read():
        try:
            while not stop.is_set():
                values = np.unique(kept.load("pick").positions)
                assert len(values) == 1
                seen.add(float(values[0]))
        except BaseException as error:
            failures.append(error)

    reader = threading.Thread(target=read)
    reader.start()
    for i in range(200):
        kept.save(versions[i % 2])
    stop.set()
    reader.join()
    assert not failures
    assert seen <= {0.0, 1.0}


def test_a_file_in_place_of_the_folder_is_renamed_and_named(tmp_path):
    (tmp_path / "store").write_text("notes")
    log: list[str] = []
    kept = TrajectoryStore(tmp_path / "store", log.append)
    assert kept.ids() == []
    (aside,) = tmp_path.glob("store.damaged-*")
    assert aside.read_text() == "notes"
    (said,) = log
    assert "store is no folder" in said
    assert aside.name in said


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    (tmp_path / "state").write_text("")
    with pytest.raises(BadInput, match="state_dir"):
        TrajectoryStore(tmp_path / "state" / "store")


def test_a_folder_named_like_a_trajectory_is_moved_away(tmp_path):
    kept = TrajectoryStore(tmp_path)
    (tmp_path / "foo.npz").mkdir()
    with pytest.raises(Damaged, match=r"'foo.npz' is a folder, not a trajectory; it was moved"):
        kept.head("foo")
    assert kept.ids() == []
    assert (tmp_path / "damaged" / "foo.npz").is_dir()
