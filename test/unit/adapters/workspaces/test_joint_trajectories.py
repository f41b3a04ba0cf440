"""JointTrajectory in: from bags and CDR, by the names of its joints; and out, and in again."""

from pathlib import Path

import numpy as np
import pytest
from fakes import make_model
from found_matrices import matrix
from hypothesis import given, settings
from hypothesis import strategies as st
from refusals import said_in
from rosbags.rosbag2 import CompressionFormat, CompressionMode, Reader, StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces import file_formats
from mrlab_ros.adapters.workspaces.joint_trajectories import serialized
from mrlab_ros.adapters.workspaces.matlab.elements import Damaged, NotAWorkspace, TooLarge
from mrlab_ros.core.conversion.convert import Outcome, convert
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.core.conversion.resampling import MOST_FRAMES
from mrlab_ros.core.conversion.workspace import JOINT_TRAJECTORY, Variable, Workspace
from mrlab_ros.core.trajectory import derived_signals
from mrlab_ros.core.trajectory.trajectory import Source, Trajectory

COEFFICIENTS = load_coefficients(Path(__file__).parents[4] / "config" / "torque_proxy.yaml")
ARM = make_model(3)
NAMES = ARM.joint_names
TYPES = get_typestore(Stores.ROS2_JAZZY)
POINTS = [(0.0, [0.0, 0.1, 0.2]), (0.5, [0.5, 0.4, 0.3]), (1.0, [0.6, 0.4, 0.2])]


class Variables(list):
    """A sink that keeps what it is given, as the lab sees it."""

    def add(self, found):
        values = matrix(found) if found.data else None
        facts = found.is_object, found.note, tuple(found.columns)
        self.append(Variable(found.path, found.kind, tuple(found.shape), values, *facts))


def read(data, name="run.mcap", limit=1 << 24):
    sink = Variables()
    form = file_formats.read(memoryview(data), name, sink, limit)
    return Workspace(form, tuple(sink), 0, "0" * 64)


def message(points=POINTS, names=NAMES, velocities=None):
    t = TYPES.types
    built = []
    for number, (seconds, positions) in enumerate(points):
        whole = int(seconds)
        duration = t["builtin_interfaces/msg/Duration"](whole, round((seconds - whole) * 1e9))
        speeds = np.array([] if velocities is None else velocities[number], float)
        nothing = np.empty(0)
        built.append(
            t["trajectory_msgs/msg/JointTrajectoryPoint"](
                np.array(positions, float), speeds, nothing, nothing, duration
            )
        )
    header = t["std_msgs/msg/Header"](t["builtin_interfaces/msg/Time"](0, 0), "")
    trajectory = t[JOINT_TRAJECTORY](header, list(names), built)
    return bytes(TYPES.serialize_cdr(trajectory, JOINT_TRAJECTORY))


def bag(folder, topics, storage="mcap", compressed=None):
    """Return the bytes of a bag with the messages of `topics`: name -> list of CDR."""
    opened = Writer(folder, version=9, storage_plugin=StoragePlugin[storage.upper()])
    if compressed:
        opened.set_compression(compressed, CompressionFormat.ZSTD)
    with opened as writer:
        note = writer.add_connection("/note", "std_msgs/msg/String", typestore=TYPES)
        text = TYPES.types["std_msgs/msg/String"]("hello")
        writer.write(note, 1, TYPES.serialize_cdr(text, "std_msgs/msg/String"))
        for topic, messages in topics.items():
            connection = writer.add_connection(topic, JOINT_TRAJECTORY, typestore=TYPES)
            for at, data in enumerate(messages, 2):
                writer.write(connection, at, data)
    (path,) = (p for p in folder.iterdir() if p.suffix in (".mcap", ".db3", ".zstd"))
    return path.read_bytes()


def converted(data, name="run.cdr", robot=ARM, **options):
    return convert(name, lambda: read(data, name), Options(**options), robot, COEFFICIENTS)


def codes(result):
    return [d.code for d in result.diagnostics]


@pytest.mark.parametrize(("storage", "suffix"), [("mcap", "mcap"), ("sqlite3", "db3")])
def test_the_only_joint_trajectory_of_a_bag_is_taken(storage, suffix, tmp_path):
    data = bag(tmp_path / "bag", {"/arm/joint_trajectory": [message()]}, storage)
    result = converted(data, f"run.{suffix}")
    t = result.trajectory
    assert t is not None, result.message
    assert (t.id, t.source.variable, t.frame_rate) == ("run", "/arm/joint_trajectory", 100.0)
    np.testing.assert_array_equal(t.positions[[0, 50, 100]], [q for _, q in POINTS])
    np.testing.assert_allclose(t.positions[25], [0.25, 0.25, 0.25], atol=1e-12)
    assert codes(result) == ["resampled"]


@pytest.mark.parametrize("compressed", [CompressionMode.FILE, CompressionMode.MESSAGE])
@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_a_file_of_a_compressed_bag_needs_no_metadata(storage, compressed, tmp_path):
    data = bag(tmp_path / "bag", {"/arm/joint_trajectory": [message()]}, storage, compressed)
    trajectory = converted(data, "run.mcap.zstd").trajectory
    assert trajectory is not None
    assert trajectory.id == "run"
    np.testing.assert_array_equal(trajectory.positions[[0, 50, 100]], [q for _, q in POINTS])


def test_several_are_offered_by_topic_and_number(tmp_path):
    data = bag(tmp_path / "bag", {"/a": [message(), message()], "/b": [message()]})
    result = converted(data, "run.mcap")
    assert result.outcome is Outcome.AMBIGUOUS
    assert [c.path for c in result.candidates] == ["/a(1)", "/a(2)", "/b"]
    assert converted(data, "run.mcap", variable="/a(2)").trajectory is not None


def test_a_bag_without_any_is_answered_with_its_topics(tmp_path):
    result = converted(bag(tmp_path / "bag", {}), "run.mcap")
    assert codes(result) == ["no_trajectory"]
    assert result.diagnostics[0].values["held"] == ["/note (std_msgs/msg/String)"]


def test_joints_are_matched_by_name():
    points = [(t, q[::-1]) for t, q in POINTS]
    result = converted(message(points, NAMES[::-1]))
    assert result.trajectory is not None, result.message
    np.testing.assert_array_equal(result.trajectory.positions[50], POINTS[1][1])
    assert codes(result) == ["joints_matched", "resampled"]
    (said,) = [d for d in result.diagnostics if d.code == "joints_matched"]
    assert said.values["order"] == [3, 2, 1]


@pytest.mark.parametrize(
    ("names", "values"),
    [
        (("joint_1", "joint_2", "elbow"), {"missing": ["joint_3"], "unknown": ["elbow"]}),
        (("joint_1", "joint_2", "joint_2"), {"missing": ["joint_3"], "repeated": ["joint_2"]}),
        (("a", "b", "c"), {"unknown": ["a", "b", "c"]}),
    ],
)
def test_other_joints_are_refused_by_name(names, values):
    result = converted(message(names=names))
    assert codes(result) == ["joint_names"]
    assert values.items() <= result.diagnostics[0].values.items()


def test_a_joint_too_many_is_refused_and_can_be_left_out():
    points = [(t, [*q, 0.5]) for t, q in POINTS]
    data = message(points, [*NAMES, "finger"])
    result = converted(data)
    assert codes(result) == ["joint_names"]
    assert result.diagnostics[0].values["unknown"] == ["finger"]
    assert converted(data, columns="1:3").trajectory is not None


def test_velocities_make_it_curved_whatever_their_order():
    flat = [[0.0, 0.0, 0.0]] * 3
    straight, curved = converted(message()), converted(message(velocities=flat))
    assert curved.diagnostics[0].values["curve"] == "splines"
    np.testing.assert_array_equal(curved.trajectory.positions[50], POINTS[1][1])
    assert straight.trajectory.positions[10, 0] == pytest.approx(0.1)
    assert curved.trajectory.positions[10, 0] == pytest.approx(0.5 * (3 * 0.04 - 2 * 0.008))
    speeds = [[0.1, 0.2, 0.3]] * 3
    one = converted(message(velocities=speeds))
    other = converted(
        message([(t, q[::-1]) for t, q in POINTS], NAMES[::-1], [v[::-1] for v in speeds])
    )
    np.testing.assert_array_equal(one.trajectory.positions, other.trajectory.positions)


def test_degrees_hold_for_velocities_too():
    scaled = [(t, np.degrees(q)) for t, q in POINTS]
    speeds = np.full((3, 3), 0.1)
    radians = converted(message(velocities=speeds)).trajectory
    degrees = converted(message(scaled, velocities=np.degrees(speeds)), degrees=True).trajectory
    np.testing.assert_allclose(degrees.positions, radians.positions, rtol=0, atol=1e-12)


def test_a_faster_even_message_keeps_its_rate_and_another_can_be_asked_for():
    points = [(i / 250, [i / 1000] * 3) for i in range(100)]
    assert converted(message(points)).trajectory.frame_rate == 250
    hasty = [(i * 1e-6, [0.0] * 3) for i in range(9)]
    assert converted(message(hasty)).trajectory.frame_rate == 100
    asked = converted(message(points), frame_rate=50).trajectory
    assert (asked.frame_rate, asked.frame_count) == (50, 21)


@pytest.mark.parametrize(
    ("points", "code", "values"),
    [
        ([(0.0, [0, 0, 0]), (0.0, [0, 0, 0])], "late_point", {"point": 2, "time": 0.0}),
        ([(0.0, [0, 0, 0]), (1.0, [0, 0])], "short_point", {"point": 2, "count": 2}),
        ([(0.0, [0, 0, 0])], "single_sample", {}),
        ([], "empty", {}),
        ([(0.0, [0, 0, 0]), (1.0, [0, np.nan, 0])], "non_finite", {"first_row": 2, "column": 2}),
        ([(0.0, [0, 0, 0]), (2**31 - 1, [1, 0, 0])], "too_long", {"most": MOST_FRAMES}),
    ],
)
def test_messages_that_cannot_be_played_say_why(points, code, values):
    (found,) = converted(message(points)).diagnostics
    assert values.items() <= said_in(found)[code].items()


def test_damage_is_named(tmp_path):
    whole = bag(tmp_path / "bag", {"/a": [message()]}, "sqlite3")
    with pytest.raises(NotAWorkspace, match="sqlite"):
        read(whole[:1000], "run.db3")
    with pytest.raises(TooLarge):
        read(whole, "run.db3", limit=1000)
    with pytest.raises(Damaged, match="cannot read it"):
        read(b"\x89MCAP0\r\n" + bytes(40))
    with pytest.raises(Damaged, match="cannot read it"):
        read(message()[:-30], "run.cdr")


def made(positions, rate, gripper):
    return Trajectory(
        "round",
        ARM.id,
        None,
        NAMES,
        rate,
        positions,
        gripper,
        derived_signals.derive(positions, rate, COEFFICIENTS),
        Source("round.mat", "q", "0" * 64),
    )


@pytest.mark.parametrize("form", ["csv", "mat", "npz", "jointtrajectory"])
@settings(max_examples=15)
@given(st.integers(2, 60), st.sampled_from([30.0, 50.0, 100.0, 125.0]), st.booleans(), st.data())
def test_what_is_written_comes_back_exactly(form, tmp_path_factory, rows, rate, gripped, data):
    seed = data.draw(st.integers(0, 1000))
    steps = np.random.default_rng(seed).uniform(-1, 1, (rows, 3)) / rate
    positions = np.cumsum(steps, axis=0)
    gripper = np.arange(rows) >= rows // 2 if gripped else None
    trajectory = made(positions, rate, gripper)
    folder = tmp_path_factory.mktemp("round")
    path = formats.writer(form)(trajectory, folder)
    back = converted(
        path.read_bytes(),
        path.name,
        frame_rate=rate,
        variable=("/joint_trajectory" if form == "jointtrajectory" else "q"),
    ).trajectory
    np.testing.assert_array_equal(back.positions, positions)
    assert back.frame_rate == rate
    if gripped:
        np.testing.assert_array_equal(back.gripper, gripper)


def test_the_bag_that_is_written_is_one_that_others_read(tmp_path):
    trajectory = made(np.zeros((5, 3)), 100.0, None)
    path = formats.writer("jointtrajectory")(trajectory, tmp_path)
    formats.writer("jointtrajectory")(trajectory, tmp_path)
    assert list(tmp_path.iterdir()) == [path], "written again, it is replaced"
    with Reader(path) as opened:
        ((connection, _, data),) = opened.messages()
    assert (connection.topic, connection.msgtype) == ("/joint_trajectory", JOINT_TRAJECTORY)
    assert bytes(data) == serialized(trajectory)


def table(headings, rows=30):
    t = np.arange(rows)[:, None] / 50
    columns = {"t": t, **{n: 0.1 * (i + 1) * t for i, n in enumerate(NAMES)}}
    columns |= {"gripper": (t > 0.2) * 1.0, "power": t * 7}
    body = np.hstack([columns.get(h, t) for h in headings])
    lines = [",".join(headings), *(",".join(map(repr, row.tolist())) for row in body)]
    return "\n".join(lines).encode()


@pytest.mark.parametrize(
    "headings",
    [
        ["t", *NAMES],
        [*NAMES[::-1], "t"],
        ["power", "joint_2", "t", "gripper", "joint_3", "joint_1"],
    ],
)
def test_headings_that_are_joint_names_order_the_columns(headings):
    result = converted(table(headings), "run.csv")
    t = result.trajectory
    assert t is not None, result.message
    expected = np.arange(30)[:, None] / 50 * [0.1, 0.2, 0.3]
    np.testing.assert_allclose(t.positions, expected, rtol=0, atol=1e-12)
    assert t.frame_rate == 50
    assert (t.gripper is not None) == ("gripper" in headings)
    if "power" in headings:
        (said,) = [d for d in result.diagnostics if d.code == "joints_matched"]
        assert said.values["left_out"] == ["power"]


@pytest.mark.parametrize("others", [["power"], ["power", "heat"]])
def test_the_columns_that_are_no_joints_are_named(others):
    result = converted(table([*others, "t", *NAMES]), "run.csv")
    (said,) = [d for d in result.diagnostics if d.code == "joints_matched"]
    assert said.values["left_out"] == others


def test_headings_that_lack_a_joint_are_refused_and_numbers_overrule_them():
    data = table(["t", "joint_1", "joint_2", "joint_4"])
    assert codes(converted(data, "run.csv")) == ["joint_names"]
    assert converted(data, "run.csv", columns="1:3").trajectory is not None


def test_other_headings_are_taken_by_place():
    assert converted(table(["t", "a", "b", "c"]), "run.csv").trajectory is not None
