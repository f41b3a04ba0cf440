"""The trajectory file: round trips, the schema, and files that contradict themselves."""

import errno
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.core.base.diagnostic import Diagnostic, Fix, Severity
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory.derived_signals import ProxyCoefficients, derive
from mrlab_ros.core.trajectory.trajectory import Source, Trajectory

COEFFICIENTS = ProxyCoefficients((1.0,), (1.0,), (1.0,), (0.1,), 50.0)


def make(positions, rate=100.0, gripper=None, name="pick"):
    warning = Diagnostic(
        "gripper_range",
        Severity.WARNING,
        'says ,"frames":{ ',
        "fix",
        {
            "variable": "q",
            "where": "x",
            "first_row": 2,
            "last_row": 9,
            "joint": "j1",
            "value": 0.5,
            "limit": 1.0,
            "unit": "rad",
            "link": "l1",
            "time": 0.5,
            "end": None,
            "kind": "floor",
            "other": "box_1",
            "robot": "ur5e_1",
        },
        (Fix("gripper", "7", "q(:, 7) = 1 - q(:, 7)"),),
    )
    return Trajectory(
        id=name,
        robot_model="ur5e",
        end_effector=None,
        joint_names=tuple(f"j{i}" for i in range(positions.shape[1])),
        frame_rate=rate,
        positions=positions,
        gripper=gripper,
        channels=derive(positions, rate, COEFFICIENTS),
        source=Source("pick.mat", "s(2).q", "a" * 64),
        created_ns=1_700_000_000_123_456_789,
        warnings=(warning,),
    )


def text(trajectory):
    return b"".join(bytes(c) for c in formats.chunks(trajectory))


def parse(data):
    return formats.parse(data, "pick.json")


MATRICES = hnp.arrays(
    np.float64,
    st.tuples(st.integers(2, 40), st.integers(1, 8)),
    elements=st.floats(-100, 100, allow_subnormal=False),
)


@settings(deadline=None)
@given(MATRICES, st.floats(0.5, 2000), st.booleans())
def test_reading_back_gives_the_radians_of_the_workspace(positions, rate, with_gripper):
    gripper = np.arange(len(positions)) % 3 == 1 if with_gripper else None
    written = make(positions.copy(), rate, gripper)
    read = parse(text(written))
    np.testing.assert_allclose(read.positions, positions, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(read.gripper, gripper)
    channels, expected = read.channels, written.channels
    np.testing.assert_allclose(channels.velocities, expected.velocities, rtol=1e-14, atol=1e-12)
    np.testing.assert_array_equal(channels.effort_proxy, expected.effort_proxy)
    for field in ("id", "robot_model", "end_effector", "joint_names", "frame_rate", "source"):
        assert getattr(read, field) == getattr(written, field)
    assert (read.created_ns, read.warnings) == (written.created_ns, written.warnings)


def test_the_file_is_degrees_and_counts_time_from_the_rate():
    content = json.loads(text(make(np.array([[0.0, np.pi], [np.pi / 2, -np.pi]]), 8.0)))
    assert content["frames"]["q"] == [[0.0, 180.0], [90.0, -180.0]]
    assert content["frames"]["t"] == [0.0, 0.125]
    assert content["units"] == {"q": "deg", "dq": "deg/s", "tau_proxy": "N*m nominal", "t": "s"}
    assert "gripper" not in content["frames"]


def test_blocks_make_the_same_file_as_one_piece():
    long = make(np.random.default_rng(1).normal(size=(2 * formats.BLOCK + 7, 3)))
    content = json.loads(text(long))
    assert list(content)[-1] == "frames"
    assert len(content["frames"]["q"]) == long.frame_count
    np.testing.assert_array_equal(content["frames"]["q"], np.degrees(long.positions))


def changed(path, value):
    content = json.loads(text(make(np.zeros((4, 2)), gripper=np.zeros(4, bool))))
    *parents, last = path
    place = content
    for key in parents:
        place = place[key]
    if value is None:
        del place[last]
    else:
        place[last] = value
    return json.dumps(content).encode()


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (["schema_version"], "2.0"),
        (["id"], "../x"),
        (["frame_rate"], 0),
        (["frame_rate"], "fast"),
        (["frame_count"], 5),
        (["frame_count"], 1),
        (["joint_names"], ["j0"]),
        (["joint_names"], ["j0", "j0"]),
        (["units", "q"], "rad"),
        (["source", "sha256"], "abc"),
        (["frames"], None),
        (["frames", "q"], None),
        (["frames", "gripper"], None),
        (["frames", "gripper"], [0, 1, 0]),
        (["frames", "gripper"], [0, 2, 0, 0]),
        (["has_gripper"], False),
        (["frames", "q", 3], [1.0]),
        (["frames", "q", 3], ["a", "b"]),
        (["frames", "q", 3, 0], float("nan")),
        (["frames", "t", 3], 0.5),
        (["frames", "more"], [1, 2, 3, 4]),
        (["warnings"], [{"code": "x"}]),
        (["surplus"], 1),
    ],
)
def test_a_file_that_contradicts_itself_is_refused(path, value):
    with pytest.raises(BadInput):
        parse(changed(path, value))


@pytest.mark.parametrize("data", [b"", b"[]", b"null", b"{", b'{"a": 1}', b"\xff\xfe"])
def test_other_files_are_refused(data):
    with pytest.raises(BadInput, match=r"pick\.json"):
        parse(data)


def test_a_write_that_fails_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "pick.json"
    formats.write(make(np.zeros((3, 2))), path)

    def broken(trajectory):
        yield b"{"
        raise OSError(errno.ENOSPC, "disk full")

    monkeypatch.setattr(formats, "chunks", broken)
    with pytest.raises(OSError, match="disk full"):
        formats.write(make(np.ones((4, 2))), path)
    assert parse(path.read_bytes()).frame_count == 3
    assert len(list(tmp_path.iterdir())) == 1
