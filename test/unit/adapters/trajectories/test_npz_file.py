"""A trajectory's file: bit for bit, every part checked."""

import zipfile
from dataclasses import replace

import numpy as np
import orjson
import pytest
from fakes import make_trajectory
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from refusals import refused

from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.adapters.trajectories.npz_file import Damaged
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory import document
from mrlab_ros.core.trajectory.diagnostics import DAMAGED_TRAJECTORY, NEWER_FORMAT, NO_SUCH_FRAME
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
    warning = Diagnostic("gripper_range", Severity.WARNING, "says", "fix", {"variable": "q"})
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
def path(tmp_path):
    return tmp_path / "pick.npz"


def save(path, trajectory):
    with path.open("w+b") as file:
        npz_file.write(trajectory, file)
    return trajectory


@given(MATRICES, st.booleans(), st.booleans())
def test_what_is_kept_comes_back_bit_for_bit(tmp_path_factory, positions, gripper, by_column):
    path = tmp_path_factory.mktemp("kept") / "pick.npz"
    positions = np.asarray(positions, order="F" if by_column else "C")
    written = save(path, make(positions, gripper=gripper))
    assert equal(npz_file.read(path), written)


def test_numpy_reads_the_file(path):
    written = save(path, make(gripper=True))
    with np.load(path, allow_pickle=False) as content:
        assert same(content["positions"], written.positions)
        assert same(content["gripper"], written.gripper)
        assert orjson.loads(content["head.json"])["id"] == "pick"


def test_the_head_is_read_alone(path):
    written = save(path, make())
    head = npz_file.read_head(path)
    assert (head["frame_count"], head["joint_names"]) == (50, ["j0", "j1", "j2"])
    assert document.warnings_of(head) == written.warnings


@given(st.integers(0, 49), st.integers(0, 60), st.booleans(), st.booleans())
def test_some_frames_are_those_of_the_whole(tmp_path_factory, begin, count, gripper, verified):
    path = tmp_path_factory.mktemp("kept") / "pick.npz"
    written = save(path, make(gripper=gripper))
    part = slice(begin, begin + count if count else None)
    frames = npz_file.read_frames(path, begin, count, verified=verified)
    assert frames.head["frame_count"] == 50
    assert same(frames.positions, written.positions[part])
    assert same(frames.velocities, written.channels.velocities[part])
    assert same(frames.effort_proxy, written.channels.effort_proxy[part])
    assert same(frames.gripper, written.gripper[part] if gripper else None)


@pytest.mark.parametrize("begin", [50, 1000])
def test_frames_after_the_last_one_are_refused(path, begin):
    save(path, make())
    with refused(NO_SUCH_FRAME, BadInput, frame=begin, last=49):
        npz_file.read_frames(path, begin, 1)


@given(st.data())
def test_a_changed_byte_changes_nothing_or_is_found(tmp_path_factory, data):
    path = tmp_path_factory.mktemp("kept") / "pick.npz"
    written = save(path, make(gripper=True))
    content = bytearray(path.read_bytes())
    at = data.draw(st.integers(0, len(content) - 1))
    content[at] ^= data.draw(st.integers(1, 255))
    path.write_bytes(content)
    found = None
    try:
        assert equal(npz_file.read(path), written)
    except Damaged as error:
        found = error.diagnostic.code
    assert found in (None, DAMAGED_TRAJECTORY.code)


@pytest.mark.parametrize("length", [0, 1, 30, 200, 1500, -1, -22, -400])
def test_a_file_that_was_cut_is_damage(path, length):
    for use in (npz_file.read_head, npz_file.read, lambda p: npz_file.read_frames(p, 3, 4)):
        save(path, make())
        path.write_bytes(path.read_bytes()[:length])
        with refused(DAMAGED_TRAJECTORY, Damaged, file="pick.npz"):
            use(path)


def test_damage_beside_the_frames_asked_for_is_found_too(path):
    save(path, make())
    with zipfile.ZipFile(path) as archive:
        at = archive.getinfo("effort_proxy.npy").header_offset + 400
    content = bytearray(path.read_bytes())
    content[at] ^= 1
    path.write_bytes(content)
    with pytest.raises(Damaged, match="effort_proxy"):
        npz_file.read_frames(path, 0, 2)


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
def test_a_head_that_contradicts_the_matrices_is_damage(path, changes):
    save(path, make())
    rewritten(path, **changes)
    with pytest.raises(Damaged):
        npz_file.read_head(path)


def test_a_file_of_a_later_version_is_not_called_damaged(path):
    save(path, make())
    rewritten(path, format=2)
    for use in (npz_file.read_head, npz_file.read):
        with refused(NEWER_FORMAT, BadInput, found=2, known=1) as said:
            use(path)
        assert not isinstance(said.value, Damaged)


def test_objects_are_never_unpickled(path):
    save(path, make())
    with path.open("wb") as file, zipfile.ZipFile(file, "w") as archive:
        archive.writestr("head.json", orjson.dumps(document.metadata(make()) | {"format": 1}))
        with archive.open("positions.npy", "w") as part:
            np.save(part, np.array([[print]], dtype=object), allow_pickle=True)
    with pytest.raises(Damaged):
        npz_file.read(path)
