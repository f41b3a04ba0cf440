"""`mrlab bag` on a bag of real messages, and the keys of `mrlab replay`."""

from __future__ import annotations

import errno
import json
import os
import shutil
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import scipy.io
import zstandard
from mrlab_msgs import msg
from page_document import document_in
from PIL import Image
from rclpy.serialization import deserialize_message, serialize_message
from refusals import refused
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from sensor_msgs.msg import JointState
from sqlite_bag import as_sqlite
from typer.testing import CliRunner

from mrlab_ros.adapters.bags.diagnostics import (
    BAG_WITHOUT_FILES,
    MOVES_NO_ROBOT,
    NOT_ROS_BAG,
)
from mrlab_ros.adapters.bags.foreign import Imported
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.adapters.diagnostics import COMPRESSED_CUT_SHORT
from mrlab_ros.cli import make_app
from mrlab_ros.cli import refused as disk_refused
from mrlab_ros.commands.diagnostics import REFERENCE_REFUSED
from mrlab_ros.commands.foreign import import_of
from mrlab_ros.commands.lab.replay import Keyboard, next_rate
from mrlab_ros.commands.status.table import recorder_line
from mrlab_ros.commands.status.view import recorder_facts
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.physics.diagnostics import SLIPS
from mrlab_ros.core.recording.diagnostics import NO_SUCH_JOINTS
from mrlab_ros.core.recording.metadata import QosProfile, Topic
from mrlab_ros.core.runtime.colours import STATES
from mrlab_ros.messages.definitions import definition
from mrlab_ros.messages.texts import told
from mrlab_ros.messages.time import make_header

UR5E = (
    "shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint",
    "wrist_1_joint", "wrist_2_joint", "wrist_3_joint",
)  # fmt: skip
START_NS = 1_700_000_000_000_000_000
TRAJECTORY = {"frame_rate": 10.0, "frames": {"q": [[0.0], [90.0], [180.0]]}}


@pytest.fixture
def bag(tmp_path: Path) -> Path:
    """A robot that plays three frames, is halted by a table and holds a cube."""
    writer = BagWriter(tmp_path / "class", definition, {"mrlab_ros": "1"})
    writer.attach("trajectories/wave.json", "application/json", json.dumps(TRAJECTORY).encode(), 0)
    topics: set[str] = set()

    def write(at: float, topic: str, message: Any, kind: str) -> None:
        if topic not in topics:
            topics.add(topic)
            writer.add_topic(Topic(topic, kind, (QosProfile(),), "RIHS01_0"))
        writer.write(topic, START_NS + round(at * 1e9), serialize_message(message), START_NS)

    def stamp(at: float) -> Any:
        return make_header(START_NS + round(at * 1e9))

    def say(at: float, name: str, message: Any) -> None:
        write(at, name, message, f"mrlab_msgs/msg/{type(message).__name__}")

    say(0.0, "/robots", msg.Robots(robots=[msg.Robot(name="ur5e_1", model="ur5e")]))
    state = msg.PlaybackState(header=stamp(1.0), label="PLAYING", trajectory_id="wave")
    state.clock.stamp, state.clock.rate = stamp(1.0).stamp, 1.0
    say(1.0, "/ur5e_1/playback_state", state)
    for frame, angle in enumerate((0.0, 1.5707963267948966, 3.0)):
        at = 1.0 + frame / 10
        joints = JointState(header=stamp(at), name=["a"], position=[angle], velocity=[0.0])
        write(at, "/ur5e_1/joint_states", joints, "sensor_msgs/msg/JointState")
    say(1.25, "/ur5e_1/telemetry", msg.Telemetry(frames_sent=3, deadline_error=0.002))
    contact = msg.Contact(robot="ur5e_1", link="wrist_3_link", other="table", frame=2)
    say(1.3, "/contacts", msg.Contacts(contacts=[contact]))
    say(1.3, "/ur5e_1/collision", msg.Collision(colliding=True, contact=contact))
    # The last field of a grasp is a list of doubles, empty here: rclpy leaves room for one.
    say(1.5, "/ur5e_1/grasp", msg.Grasp(state=msg.Grasp.HOLDING, object="cube_1"))
    hop = msg.LatencyHop(topic="", count=5, p50=0.001)
    say(2.0, "/latency", msg.Latency(observer="bridge", hops=[hop]))
    writer.note("mrlab", {"mrlab_ros": "1"})
    writer.close()
    return writer.folder


def run(*arguments: object) -> str:
    done = CliRunner().invoke(make_app(), list(map(str, arguments)))
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    assert done.exit_code == 0, done.output
    return done.stdout


def test_the_report_tells_states_contacts_grasps_errors_and_latency(bag, tmp_path):
    facts = json.loads(run("bag", "report", bag, "--json", "--out", tmp_path / "out"))
    (robot,) = facts["robots"]
    assert (robot["name"], robot["model"]) == ("ur5e_1", "ur5e")
    assert [span["label"] for span in robot["states"]] == ["PLAYING"]
    assert robot["tracking_error"]["count"] == 3
    assert robot["tracking_error"]["max"] == pytest.approx(3.141592653589793 - 3.0)
    assert robot["tracking_error"]["p50"] == pytest.approx(0.0, abs=1e-12)
    assert robot["deadline_error"]["max"] == 0.002
    assert robot["collisions"][0]["link"] == "wrist_3_link"
    assert robot["contacts"] == 1
    assert robot["grasps"][0]["detail"] == "cube_1"
    (hop,) = facts["latency"]
    assert (hop["ends"], hop["observer"], hop["p50"]) == ("published_to_bridged", "", 0.001)
    (run_,) = facts["runs"]
    hit, grasped = (each["said"] for each in run_["actions"])
    assert (hit["code"], hit["link"], hit["values"]["row"]) == ("run_hit", "wrist_3_link", 3)
    assert (grasped["code"], grasped["values"]["object"]) == ("run_grasped", "cube_1")
    text = (tmp_path / "out" / "report.txt").read_text()
    assert grasped["message"] in text
    assert text == run("bag", "report", bag)
    with Image.open(tmp_path / "out" / "report.png") as picture:
        # The halt's mark and the colour of playing are there.
        colours = {colour for _, colour in picture.convert("RGB").getcolors(1 << 24)}
        assert tuple(bytes.fromhex(STATES["PLAYING"][1:])) in colours
        assert picture.width > 1000
    page = (tmp_path / "out" / "report.html").read_text()
    assert hit["message"] in page
    (drawn,) = document_in(tmp_path / "out" / "report.html")["report"]["robots"]
    assert [span["label"] for span in drawn["states"]] == ["PLAYING"]
    shown = tmp_path / "shown.html"
    run("show", tmp_path / "out", "--out", shown)
    assert hit["message"] in shown.read_text()
    run("bag", "report", bag, "--out", tmp_path / "one" / "page.html")
    assert hit["message"] in (tmp_path / "one" / "page.html").read_text()
    assert (run_["robot"], run_["trajectory"], run_["result"]) == ("ur5e_1", "wave", "open")
    assert [each["deed"] for each in run_["actions"]] == ["hit", "grasped"]
    assert run_["deviation"]["most"] == pytest.approx(3.141592653589793 - 3.0)


def test_remarks_of_physics_come_with_their_codes_and_those_of_older_bags_as_texts(tmp_path):
    writer = BagWriter(tmp_path / "class", definition)
    slips = SLIPS(mass=1.5, friction_needed=0.9, friction=0.4)
    older = msg.Grasp(state=msg.Grasp.EMPTY, reason="an earlier lab said so")
    state = msg.PlaybackState(label="PLAYING", trajectory_id="wave")
    for at, name, message in (
        (0, "playback_state", state),
        (1, "grasp", msg.Grasp(state=msg.Grasp.HOLDING, object="a", **told(slips, "reason"))),
        (2, "grasp", msg.Grasp(state=msg.Grasp.HOLDING, object="b", **told(slips, "reason"))),
        (3, "grasp", older),
    ):
        topic = f"/ur5e_1/{name}"
        message.header = make_header(START_NS + at * 10**9)
        kind = f"mrlab_msgs/msg/{type(message).__name__}"
        writer.add_topic(Topic(topic, kind, (QosProfile(),), "RIHS01_0"))
        writer.write(topic, START_NS + at * 10**9, serialize_message(message), START_NS)
    writer.close()
    facts = json.loads(run("bag", "report", tmp_path / "class", "--json"))
    remarks = [a["said"] for a in facts["runs"][0]["actions"] if a["deed"] == "remark"]
    assert [(said["code"], said["values"].get("object")) for said in remarks] == [
        ("slips", "a"), ("slips", "b"), ("", None),
    ]  # fmt: skip
    assert (remarks[0]["robot"], remarks[0]["values"]["friction_needed"]) == ("ur5e_1", "0.9")
    assert remarks[2]["message"] == older.reason


def test_a_reference_takes_the_place_of_what_was_played(bag, tmp_path):
    wave = np.outer(np.linspace(0, 0.2, 50), np.ones(6))
    scipy.io.savemat(tmp_path / "ref.mat", {"q": wave, "fs": 10.0})
    # The bag's robot of one joint is no ur5e: nothing is compared, and nothing fails.
    facts = json.loads(run("bag", "report", bag, "--json", "--reference", tmp_path / "ref.mat"))
    assert facts["runs"][0]["deviation"] is None
    scipy.io.savemat(tmp_path / "ref.mat", {"q": wave[:, :2], "fs": 10.0})
    with refused(REFERENCE_REFUSED, BadInput, model="ur5e"):
        run("bag", "report", bag, "--reference", tmp_path / "ref.mat")


def test_a_bag_without_a_session_says_what_it_has(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "empty", definition)
    writer.close()
    page = tmp_path / "page.html"
    (trouble,) = troubles(tmp_path / "empty", "--out", page)
    assert trouble["code"] == "nothing_recorded"
    assert trouble["message"] in page.read_text()
    # a page without messages says no date
    assert document_in(page)["report"]["start_ns"] == 0
    (trouble,) = troubles(foreign(tmp_path / "foreign", StoragePlugin.MCAP))
    assert trouble["code"] == "bag_without_robots"
    assert trouble["values"]["topics"] == ["/joint_states", "/secret"]
    assert trouble["values"]["types"][0] == "sensor_msgs/msg/JointState"
    assert trouble["fixes"][0]["command"].startswith("mrlab bag import ")


def troubles(bag: Path, *options: object) -> list[dict[str, Any]]:
    """Return what a report says is wrong with a bag; its text has the same."""
    found = json.loads(run("bag", "report", bag, "--json", *options))["troubles"]
    text = run("bag", "report", bag)
    assert all(each["message"] in text for each in found)
    return list(found)


def test_a_report_goes_on_where_the_clock_was_set_and_an_attachment_is_broken(
    tmp_path: Path,
) -> None:
    writer = BagWriter(tmp_path / "class", definition)
    writer.attach("trajectories/wave.json", "application/json", b"{", 0)
    topic = Topic("/a/playback_state", "mrlab_msgs/msg/PlaybackState", (QosProfile(),), "RIHS01_0")
    writer.add_topic(topic)
    for at, label in ((0, "PLAYING"), (2, "READY"), (-60, "PLAYING"), (-58, "READY")):
        at_ns = START_NS + at * 10**9
        state = msg.PlaybackState(header=make_header(at_ns), label=label, trajectory_id="wave")
        writer.write(topic.name, at_ns, serialize_message(state), START_NS)
    writer.close()
    unread, clock = troubles(tmp_path / "class")
    assert unread["code"] == "trajectory_unreadable"
    assert unread["values"]["attachment"] == "trajectories/wave.json"
    assert clock["code"] == "clock_set_back"
    assert (clock["values"]["by"], clock["values"]["then"]) == (62.0, "piled")
    assert len(json.loads(run("bag", "report", tmp_path / "class", "--json"))["runs"]) == 2


def test_a_report_counts_what_cannot_be_read_and_knows_a_bag_of_even_times(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "class", definition)
    topic = Topic("/a/playback_state", "mrlab_msgs/msg/PlaybackState", (QosProfile(),), "RIHS01_0")
    writer.add_topic(topic)
    for at, stamp, label in ((0, 0, "PLAYING"), (2, -60, "PLAYING"), (4, -58, "READY")):
        state = msg.PlaybackState(
            header=make_header(START_NS + stamp * 10**9), label=label, trajectory_id="wave"
        )
        writer.write(topic.name, START_NS + at * 10**9, serialize_message(state), START_NS)
    writer.write(topic.name, START_NS + 5 * 10**9, b"\0\1\0\0" + bytes(8) + b"\xff" * 8, START_NS)
    writer.close()
    unread, clock = troubles(tmp_path / "class")
    assert unread["code"] == "messages_unreadable"
    assert unread["values"] == {"topic": "/a/playback_state", "messages": 1}
    assert clock["values"] == {"time": 2.0, "by": 62.0, "then": "even"}
    assert len(json.loads(run("bag", "report", tmp_path / "class", "--json"))["runs"]) == 1


def foreign(
    folder: Path,
    plugin: StoragePlugin,
    prefix: str = "",
    mode: CompressionMode = CompressionMode.NONE,
) -> Path:
    """A bag of another lab's recorder: an arm's joints in its own order, and a type of its own."""
    types = get_typestore(Stores.ROS2_HUMBLE)
    types.register(get_types_from_msg("int32 x\n", "acme_msgs/msg/Secret"))
    kind = "sensor_msgs/msg/JointState"
    names = [f"{prefix}{name}" for name in (*UR5E[::-1], "finger")]
    writer = Writer(folder, version=9, storage_plugin=plugin)
    if mode is not CompressionMode.NONE:
        writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer as bag:
        joints = bag.add_connection("/joint_states", kind, typestore=types)
        secret = bag.add_connection("/secret", "acme_msgs/msg/Secret", typestore=types)
        for i in range(3):
            header = types.types["std_msgs/msg/Header"](
                types.types["builtin_interfaces/msg/Time"](0, 0), ""
            )
            values = np.array([6.0, 5.0, 4.0, 3.0, 2.0, 1.0 + i, 0.0])
            state = types.types[kind](header, names, values, np.zeros(0), np.zeros(0))
            stamp = START_NS + i * 10_000_000
            bag.write(joints, stamp, types.serialize_cdr(state, kind))
        word = types.types["acme_msgs/msg/Secret"](1)
        bag.write(secret, START_NS, types.serialize_cdr(word, "acme_msgs/msg/Secret"))
    return folder


@pytest.mark.parametrize("plugin", list(StoragePlugin))
def test_any_ros_bag_becomes_one_of_the_lab(tmp_path: Path, plugin: StoragePlugin) -> None:
    source = foreign(tmp_path / "foreign", plugin, "cell/")
    done = json.loads(run("bag", "import", source, tmp_path / "mine", "--json"))
    assert (done["robots"], done["skipped"]) == ({"ur5e_1": "ur5e"}, {})
    found = Bag(tmp_path / "mine")
    assert "int32 x" in found.definitions()["acme_msgs/msg/Secret"]
    moved = [
        deserialize_message(m.data, JointState)
        for m in found.messages(topics={"/ur5e_1/joint_states"})
    ]
    assert [list(m.position) for m in moved] == [[1.0 + i, 2, 3, 4, 5, 6] for i in range(3)]
    assert list(moved[0].name) == list(UR5E)
    assert moved[0].header.stamp.sec == START_NS // 10**9
    assert "robots/ur5e_1.urdf" in found.attachments()
    page = tmp_path / "page.html"
    run("show", tmp_path / "mine", "-o", page, "--no-open")
    assert "ur5e_1" in page.read_text()


@pytest.mark.parametrize("mode", [CompressionMode.FILE, CompressionMode.MESSAGE])
def test_a_compressed_file_alone_becomes_a_bag(tmp_path: Path, mode: CompressionMode) -> None:
    source = foreign(tmp_path / "foreign", StoragePlugin.MCAP, mode=mode)
    (file,) = (each for each in source.iterdir() if each.name != "metadata.yaml")
    alone = file.rename(tmp_path / file.name)
    done = json.loads(run("bag", "import", alone, tmp_path / "mine", "--json"))
    assert done["robots"] == {"ur5e_1": "ur5e"}
    if mode is CompressionMode.FILE:
        alone.write_bytes(alone.read_bytes()[:-9])
        with refused(COMPRESSED_CUT_SHORT, BadInput):
            run("bag", "import", alone, tmp_path / "other")


def test_a_foreign_bag_is_refused_with_what_it_holds(tmp_path: Path) -> None:
    source = foreign(tmp_path / "last week", StoragePlugin.SQLITE3)
    with refused(NO_SUCH_JOINTS, BadInput, model="kuka_kr3_r540"):
        run("bag", "import", source, tmp_path / "mine", "--robot", "kuka_kr3_r540")
    with refused(BAG_WITHOUT_FILES, BadInput) as caught:
        run("bag", "repair", source)
    assert caught.value.diagnostic.fixes[0].command == f"mrlab bag import '{source}' NEW_FOLDER"
    (tmp_path / "no.db3").write_bytes(b"no database")
    (tmp_path / "cut.db3").write_bytes(b"SQLite format 3\0" + bytes(99))
    (tmp_path / "lone.mcap.zst").write_bytes(zstandard.compress(b"\x89MCAP0\r\n"))
    for name in ("no.db3", "cut.db3", "lone.mcap.zst"):
        with refused(NOT_ROS_BAG, BadInput):
            run("bag", "import", tmp_path / name, tmp_path / "other")
    for name in ("cut.db3", "lone.mcap.zst"):
        with refused(NOT_ROS_BAG, BadInput):
            run("bag", "info", tmp_path / name)
    assert not (tmp_path / "mine").exists()


def test_a_sqlite3_bag_is_read_as_it_is(bag: Path, tmp_path: Path) -> None:
    other = as_sqlite(Bag(bag), tmp_path / "other")
    facts, known = (json.loads(run("bag", "info", each, "--json")) for each in (other, bag))
    assert facts["files"] == ["other.db3"]
    for name in ("start_ns", "duration", "messages"):
        assert facts[name] == known[name]
    counts = [{t["name"]: t["messages"] for t in each["topics"]} for each in (facts, known)]
    assert counts[0] == counts[1]
    assert "in 1 file" in run("bag", "info", other)
    first, second = (json.loads(run("bag", "report", each, "--json")) for each in (bag, other))
    for each in (first, second):
        del each["bag"]
    assert second["runs"][0]["actions"] == first["runs"][0]["actions"]
    # A recorder that was killed wrote no metadata.yaml; the page is one of a session, too.
    (other / "metadata.yaml").unlink()
    assert json.loads(run("bag", "report", other, "--json"))["runs"] == second["runs"]
    run("show", other / "other.db3", "-o", tmp_path / "page.html", "--no-open")
    assert (
        second["runs"][0]["actions"][0]["said"]["message"] in (tmp_path / "page.html").read_text()
    )
    assert run("bag", "import", other, tmp_path / "mine").startswith(str(tmp_path / "mine"))


@pytest.mark.parametrize("mode", [CompressionMode.FILE, CompressionMode.MESSAGE])
def test_a_compressed_bag_is_read_as_it_is(tmp_path: Path, mode: CompressionMode) -> None:
    source = foreign(tmp_path / "foreign", StoragePlugin.SQLITE3, mode=mode)
    assert json.loads(run("bag", "info", source, "--json"))["messages"] == 4
    assert [each["code"] for each in troubles(source)] == ["bag_without_robots"]


def test_joints_of_no_robot_are_named(tmp_path: Path) -> None:
    source = foreign(tmp_path / "foreign", StoragePlugin.MCAP)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("mrlab_ros.adapters.bags.foreign.chosen_models", lambda *_: {})
        done = Imported(**import_of(str(source), str(tmp_path / "mine"), []))
    (strange,) = done.said("mine").values["notes"]
    assert (strange.code, strange.values["topic"]) == (MOVES_NO_ROBOT.code, "/joint_states")
    assert "wrist_3_joint" in strange.values["joints"]


def test_info_says_what_is_in_the_bag(bag):
    facts = json.loads(run("bag", "info", bag, "--json"))
    assert facts["duration"] == 2.0
    assert facts["messages"] == 10
    assert facts["versions"] == {"mrlab_ros": "1"}
    assert facts["attachments"]["trajectories/wave.json"] > 10
    names = [topic["name"] for topic in facts["topics"]]
    assert "/ur5e_1/joint_states" in names
    text = run("bag", "info", bag)
    assert "2.0 s from" in text
    assert "trajectories: 1 attached" in text


def test_extract_writes_the_attachments(bag, tmp_path):
    said = json.loads(run("bag", "extract", bag, "--out", tmp_path / "out", "--json"))
    assert said["files"] == ["trajectories/wave.json"]
    assert json.loads((tmp_path / "out/trajectories/wave.json").read_text()) == TRAJECTORY


@pytest.mark.parametrize("command", ["extract", "report"])
def test_a_full_disk_leaves_no_part_of_a_file(bag, tmp_path, monkeypatch, command):
    def full(_source, target):
        target.write(b"half")
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(shutil, "copyfileobj", full)
    with pytest.raises(OSError, match="out") as caught:
        run("bag", command, bag, "--out", tmp_path / "out")
    assert disk_refused(caught.value)[1] == 1
    assert not [path for path in (tmp_path / "out").rglob("*") if path.is_file()]


def test_repair_says_what_it_did(bag):
    done = json.loads(run("bag", "repair", bag, "--json"))
    assert done == {"files": [], "troubles": [], "messages": 10}
    file = bag / "class_0.mcap"
    file.write_bytes(file.read_bytes()[:-100])
    (bag / "metadata.yaml").unlink()
    done = json.loads(run("bag", "repair", bag, "--json"))
    assert (done["files"], done["messages"]) == (["class_0.mcap", "metadata.yaml"], 10)
    assert [trouble["values"]["file"] for trouble in done["troubles"]] == ["class_0.mcap"]
    assert (bag / "class_0.mcap.original").exists()


@pytest.mark.parametrize(
    ("fields", "line"),
    [
        ({}, ""),
        ({"message": "the disk is full"}, "the disk is full"),
        (
            {"state": 1, "bag": "/x", "position": 12.0, "messages": 34},
            "Records into /x: 12 s, 34 messages",
        ),
        (
            {"state": 3, "bag": "/x", "position": 1.0, "duration": 9.0},
            "Replays /x: 1.0 of 9.0 s, paused; the lab's own robots stand aside until it ends",
        ),
    ],
)
def test_status_says_what_the_recorder_does(fields, line):
    assert recorder_line(recorder_facts(msg.RecorderState(**fields))) == line
    assert recorder_line(recorder_facts(None)) == ""


@pytest.mark.parametrize(
    ("rate", "faster", "expected"),
    [(1.0, True, 2.0), (1.0, False, 0.5), (3.0, True, 4.0), (10.0, True, 10.0), (0.1, False, 0.1)],
)
def test_plus_and_minus_go_through_the_rates(rate, faster, expected):
    assert next_rate(rate, faster) == expected


@pytest.mark.parametrize(
    ("key", "paused", "service", "values"),
    [
        (b" ", False, "/recorder/pause", {}),
        (b" ", True, "/recorder/resume", {}),
        (b"\x1b[C", True, "/recorder/seek", {"position": 7.0}),
        (b"\x1b[D", True, "/recorder/seek", {"position": 0.0}),
        (b"\x1b[D\x1b[C\x1bOC", True, "/recorder/seek", {"position": 7.0}),
        (b"+", False, "/recorder/set_rate", {"rate": 2.0}),
        (b"-", False, "/recorder/set_rate", {"rate": 0.5}),
        (b"n", True, "/recorder/next_stop", {}),
        (b"p", False, "/recorder/previous_stop", {}),
        (b"q", False, "/recorder/stop", {}),
    ],
)
def test_each_key_calls_its_service(key, paused, service, values):
    called: list[tuple[str, dict[str, float]]] = []

    def order(kind: Any, name: str, request: Any, *_: Any) -> None:
        fields = request.get_fields_and_field_types()
        called.append((name, {field: getattr(request, field) for field in fields}))

    graph: Any = SimpleNamespace(order=order, call=order)
    kind = msg.RecorderState
    state = kind(
        state=kind.PAUSED if paused else kind.REPLAYING, position=2.0, duration=9.0, rate=1.0
    )
    Keyboard(graph, None).press(key, state)
    assert called == [(service, values)]
