"""The recorder as a node: what it writes, how it ends, and what it replays."""

from __future__ import annotations

import errno
import itertools
import json
import os
import resource
import signal
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import small_lab
import yaml
from child_process import HOST, start_child
from diagnostic_msgs.msg import DiagnosticArray
from graph import Graph, Inbox, wait_for
from mcap.reader import NonSeekingReader
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from rclpy.serialization import serialize_message
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from sensor_msgs.msg import JointState
from sqlite_bag import as_sqlite
from std_msgs.msg import String

from mrlab_ros.adapters.bags.diagnostics import (
    BAG_EXISTS,
    BAG_MOVED,
    BAG_NOT_WRITTEN,
    NO_ATTACHMENT,
    NO_BAG,
    NOT_MCAP,
)
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.bags.repair import repair
from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.adapters.journal_file import Journal
from mrlab_ros.adapters.share import directory
from mrlab_ros.adapters.trajectories.formats import chunks, parse
from mrlab_ros.app.diagnostics import RECORDED, RECORDING_WITH_GAP
from mrlab_ros.app.recorder import recorder as use_case
from mrlab_ros.core.base.diagnostics import BAD_POSITION
from mrlab_ros.core.bridge import rules
from mrlab_ros.core.recording import recorder as entries
from mrlab_ros.core.recording.diagnostics import (
    BAD_REPLAY_RATE,
    BAD_SPLIT_DURATION,
    BAD_TOPIC_PATTERN,
    LEFT_OUT,
    NO_RECORDING,
    NO_REPLAY,
    NO_STOP_BEFORE,
    NOTHING_RUNS,
    NOTHING_TO_REPLAY,
    RECORDING_GAP,
    RECORDING_RUNS,
    REPLAY_OVER,
    REPLAY_RUNS,
    TO_END,
    TO_STOP,
    TOUR_STOP,
)
from mrlab_ros.core.recording.metadata import QosProfile, Topic
from mrlab_ros.core.recording.topics import LAB_TOPICS, Topics
from mrlab_ros.messages import qos, trajectories
from mrlab_ros.messages.definitions import definition
from mrlab_ros.messages.qos import message_class
from mrlab_ros.messages.status import INSTANT
from mrlab_ros.nodes.recorder import recording, replaying
from mrlab_ros.nodes.recorder.diagnostics import (
    OTHERS_PUBLISH,
    RECORDER_FAULT,
    RECORDING_FAILED,
)
from mrlab_ros.nodes.recorder.node import RecorderNode
from mrlab_ros.ros.raw_streams import Received

State = msg.RecorderState
START_NS = 1_700_000_000_000_000_000


@pytest.fixture
def recorder(graph: Graph, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> RecorderNode:
    # No bridge here that first has to find the topics.
    monkeypatch.setattr(replaying, "SETTLE_TIME_S", 0.0)
    return graph.add(RecorderNode, bag_dir=str(tmp_path), lab_id="lab")


@pytest.fixture
def states(graph: Graph) -> Inbox:
    return graph.listen(State, "/recorder/state", qos.LATCHED_EVENTS)


def start(graph: Graph, bag: str, topics: tuple[str, ...] = (), **fields: Any) -> Path:
    answer = graph.call(
        srv.StartRecording, "/recorder/start", bag=bag, topics=list(topics), **fields
    )
    assert answer.success, answer.message
    return Path(answer.bag)


def order(graph: Graph, service: str, kind: Any = Trigger, **fields: Any) -> Any:
    answer = graph.call(kind, f"/recorder/{service}", **fields)
    assert answer.success, answer.message
    return answer


def held(answer: Any) -> int:
    """Return how many messages a bag holds that was closed."""
    assert answer.code == RECORDED.code
    return next(int(each.value) for each in answer.values if each.key == "messages")


def reason(answer: Any) -> str:
    """Return the code of the reason in a refusal by the state."""
    reasons = [json.loads(each.value) for each in answer.values if each.key == "reason"]
    return reasons[0]["code"] if reasons else ""


def publisher(graph: Graph, topic: str, quality: Any = qos.STREAM) -> Callable[[str], None]:
    made = graph.client.create_publisher(String, topic, quality)
    return lambda word: made.publish(String(data=word))


def words(bag: Path, topic: str) -> list[str]:
    return [decoded(m.data) for m in Bag(bag).messages(topics={topic})]


def decoded(data: bytes) -> str:
    return data[8:-1].split(b"\0")[0].decode()


def test_a_recording_holds_what_was_said_also_by_who_came_later(graph, recorder, states, tmp_path):
    say_state = publisher(graph, "/ur5e_1/grasp", qos.LATCHED)
    say_state("before")
    say = publisher(graph, "/ur5e_1/telemetry")
    folder = start(graph, "class", ("/*/telemetry", "/*/grasp"))
    assert folder == tmp_path / "class"
    wait_for(lambda: states.last().state == State.RECORDING, "the state")
    wait_for(lambda: graph.client.count_subscribers("/ur5e_1/telemetry"), "the recorder")
    later = publisher(graph, "/ur5e_2/telemetry")
    publisher(graph, "/ur5e_2/unwanted")("never")
    wait_for(lambda: graph.client.count_subscribers("/ur5e_2/telemetry"), "the recorder")
    for number in range(300):
        say(f"first {number}")
        later(f"second {number}")
    wait_for(lambda: states.last().messages >= 601, "the messages")
    order(graph, "split")
    say("after")
    wait_for(lambda: states.last().messages >= 602, "the last message")
    assert held(order(graph, "stop")) == 602
    wait_for(lambda: states.last().state == State.STOPPED, "the end")
    assert words(folder, "/ur5e_1/telemetry") == [f"first {n}" for n in range(300)] + ["after"]
    assert words(folder, "/ur5e_2/telemetry") == [f"second {n}" for n in range(300)]
    assert words(folder, "/ur5e_1/grasp") == ["before"]
    assert "/ur5e_2/unwanted" not in Bag(folder).topics
    assert [file.path.name for file in Bag(folder).files] == ["class_0.mcap", "class_1.mcap"]
    assert Bag(folder).troubles == []


def test_what_displays_send_is_asked_for_and_held(graph, recorder, states):
    """The bridge brings a topic of displays into the graph while somebody there subscribes."""
    topics = rules.parse(
        yaml.safe_load((directory() / "config" / "bridge.yaml").read_text())
    ).topics
    sent = [each for each in topics if each.direction is rules.Direction.IN]
    taken_in_any_case = {"/moves", "/latency/clients"}  # by lab and bridge
    wanted = {
        each.name: each.type
        for each in sent
        if each.name in Topics(LAB_TOPICS) and each.name not in taken_in_any_case
    }
    assert {"/presence", "/look_here"} <= wanted.keys()
    folder = start(graph, "")
    made = {}
    for name, kind in wanted.items():
        wait_for(lambda name=name: graph.client.count_subscribers(name), f"who wants {name}")
        made[name] = graph.client.create_publisher(message_class(kind), name, qos.STREAM)
    for name, each in made.items():
        wait_for(lambda name=name: graph.client.count_subscribers(name) > 1, "the recorder")
        each.publish(message_class(wanted[name])())
    wait_for(
        lambda: {m.topic for m in Bag(folder).messages(topics=set(wanted))} == set(wanted),
        "a message of each on the disk",
    )
    order(graph, "stop")
    assert not any(map(graph.client.count_subscribers, wanted))


def test_a_clock_that_is_set_back_does_not_keep_messages_from_the_disk(
    graph, recorder, states, monkeypatch
):
    began_ns = time.time_ns()
    clock = SimpleNamespace(time_ns=lambda: began_ns, monotonic_ns=time.monotonic_ns)
    monkeypatch.setattr(recording, "time", clock)
    say = publisher(graph, "/ur5e_1/telemetry")
    folder = start(graph, "class", ("/*/telemetry",))
    wait_for(lambda: graph.client.count_subscribers("/ur5e_1/telemetry"), "the recorder")
    say("first")
    wait_for(lambda: Bag(folder).message_count, "the message on the disk")
    order(graph, "stop")


def test_a_session_of_the_lab_is_complete_in_itself(graph, recorder):
    small_lab.start(graph)
    robot = small_lab.spawn(graph)
    small_lab.load(graph, robot, "wave")
    folder = start(graph, "")
    assert folder.name.startswith("session_")
    inbox = graph.listen(JointState, f"/{robot}/joint_states", qos.STREAM)
    played = small_lab.listen_state(graph, robot)
    wait_for(lambda: graph.client.count_subscribers(f"/{robot}/joint_states") > 1, "the recorder")
    order_play = graph.call(Trigger, f"/{robot}/play")
    assert order_play.success
    wait_for(lambda: "COMPLETE" in small_lab.labels(played), "the motion")
    order(graph, "stop")
    bag = Bag(folder)
    names = set(bag.attachments())
    assert {f"robots/{robot}.urdf", "scene.json", "trajectories/wave.json"} <= names
    assert "parameters.yaml" in names
    urdf = bag.attachment(f"robots/{robot}.urdf").data.decode()
    for mesh in urdf.split('filename="package://')[1:]:
        name = f"meshes/{mesh.split(chr(34))[0]}"
        original = directory() / name.split("/", 2)[2]
        assert bag.attachment(name).data == original.read_bytes()
    data = bag.attachment("trajectories/wave.json").data
    attached = parse(data, "wave")
    assert attached.positions == pytest.approx(small_lab.TRAJECTORIES["wave"].positions, abs=1e-12)
    with AnyReader([folder]) as reader:
        kinds = {c.topic: c.msgtype for c in reader.connections}
        assert kinds[f"/{robot}/playback_state"] == "mrlab_msgs/msg/PlaybackState"
        joints = [c for c in reader.connections if c.topic == f"/{robot}/joint_states"]
        recorded = [
            tuple(reader.deserialize(data, c.msgtype).position)
            for c, _, data in reader.messages(joints)
        ]
    heard = [tuple(state.position) for state in inbox]
    # The pose in which it stood before was published until the recorder listened, or longer.
    moving = next(i for i, (a, b) in enumerate(itertools.pairwise(heard), 1) if a != b) + 10
    begin = recorded.index(heard[moving])
    assert recorded[begin : begin + 40] == heard[moving : moving + 40]


def test_the_meshes_of_an_imported_robot_are_in_the_bag(graph, recorder, monkeypatch, tmp_path):
    monkeypatch.setenv("MRLAB_ROBOTS", str(tmp_path / "robots"))
    mesh = tmp_path / "robots" / "mine" / "meshes" / "link.glb"
    mesh.parent.mkdir(parents=True)
    mesh.write_bytes(b"glTF mine")
    describe = publisher(graph, "/mine_1/robot_description")
    folder = start(graph, "imported", ("/*/robot_description",))
    wait_for(lambda: graph.client.count_subscribers("/mine_1/robot_description"), "the recorder")
    uri = "package://mrlab_ros/robots/mine/meshes/link.glb"
    describe(f'<robot><link><visual><mesh filename="{uri}"/></visual></link></robot>')
    wait_for(lambda: Bag(folder).message_count, "the message on the disk")
    order(graph, "stop")
    attached = Bag(folder).attachment("meshes/mrlab_ros/robots/mine/meshes/link.glb")
    assert (attached.media_type, attached.data) == ("model/gltf-binary", b"glTF mine")


def test_one_thing_at_a_time_and_each_refusal_says_why(graph, recorder, tmp_path):
    def refused(kind: Any, service: str, **fields: Any) -> list[str]:
        answer = graph.call(kind, f"/recorder/{service}", **fields)
        assert not answer.success
        return [answer.code, reason(answer)]

    assert NOTHING_RUNS.code in refused(Trigger, "stop")
    assert NO_RECORDING.code in refused(Trigger, "split")
    for service in ("pause", "resume"):
        assert NO_REPLAY.code in refused(Trigger, service)
    assert BAD_SPLIT_DURATION.code in refused(srv.StartRecording, "start", split_duration=0.1)
    assert BAD_TOPIC_PATTERN.code in refused(srv.StartRecording, "start", topics=["x"])
    (tmp_path / "file").write_text("words")
    assert NOT_MCAP.code in refused(srv.Replay, "replay", bag="file", rate=1.0)
    assert NO_BAG.code in refused(srv.Replay, "replay", bag="nowhere", rate=1.0)
    start(graph, "class", ("/*/telemetry",))
    assert RECORDING_RUNS.code in refused(srv.StartRecording, "start")
    assert RECORDING_RUNS.code in refused(srv.Replay, "replay", bag="x", rate=1.0)
    order(graph, "stop")
    assert BAG_EXISTS.code in refused(srv.StartRecording, "start", bag="file")
    assert NOTHING_TO_REPLAY.code in refused(srv.Replay, "replay", bag="class", rate=1.0)


# a recorder in a process of its own -----------------------------------------------------------


class Counter:
    """Says numbers on /counted, 500 a second."""

    def __init__(self, graph: Graph) -> None:
        self._publisher = graph.client.create_publisher(String, "/counted", qos.STREAM)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self) -> None:
        for number in itertools.count():
            if self._stop.wait(0.002):
                return
            # Words long enough that a disk fills.
            self._publisher.publish(String(data=f"{number} {os.urandom(64).hex()}"))

    def stop(self) -> None:
        self._stop.set()
        self._thread.join()


@pytest.fixture
def counter(graph: Graph) -> Iterator[Counter]:
    made = Counter(graph)
    yield made
    made.stop()


@pytest.fixture
def launch(tmp_path: Path) -> Iterator[Callable[..., subprocess.Popen[bytes]]]:
    running = []

    def start_process() -> subprocess.Popen[bytes]:
        argv = (*HOST, "recorder", "--ros-args")
        process = start_child(*argv, "-p", f"bag_dir:={tmp_path}", "-p", "topics:=['/counted']")
        running.append(process)
        return process

    yield start_process
    for process in running:
        process.kill()
        process.wait()


def test_a_killed_recorder_loses_less_than_a_second(graph, counter, launch, states, tmp_path):
    process = launch()
    folder = start(graph, "class")
    wait_for(lambda: states and states.last().messages > 500, "messages in the bag")
    # The recorder tells once a second how many messages it has.
    told = states.last().messages
    wait_for(lambda: states.last().messages > told, "the next second")
    process.send_signal(signal.SIGKILL)
    process.wait()
    numbers = [int(word.split()[0]) for word in words(folder, "/counted")]
    assert numbers == list(range(numbers[0], numbers[-1] + 1))
    assert len(numbers) >= told
    with AnyReader([folder]) as reader:
        assert len(list(reader.messages())) == len(numbers)
    with open(folder / "class_0.mcap", "rb") as file:
        assert len(list(NonSeekingReader(file).iter_messages())) == len(numbers)
    assert repair(folder).messages == len(numbers)
    assert Bag(folder).troubles == []


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
def test_a_recorder_that_ends_continues_in_the_same_bag_and_states_the_gap(
    graph, counter, tmp_path, states, how
):
    folder = tmp_path / "bags"
    journal = tmp_path / "state"

    def launch() -> subprocess.Popen[bytes]:
        parameters = {
            "bag_dir": folder,
            "state_dir": journal,
            "topics": "['/counted']",
            "lab_id": "lab",
        }
        given = [a for name, value in parameters.items() for a in ("-p", f"{name}:={value}")]
        return start_child(*HOST, "recorder", "--ros-args", *given)

    process = launch()
    try:
        bag = start(graph, "class")
        wait_for(lambda: states and states.last().messages > 500, "messages in the bag")
        process.send_signal(how)
        process.wait()
        states.clear()
        process = launch()
        wait_for(
            lambda: states and states.last().state == State.RECORDING and states.last().messages,
            "the recording again",
        )
        earlier = Bag(bag).message_count
        assert Path(states.last().bag) == bag
        assert states.last().code == RECORDING_GAP.code
        wait_for(lambda: states.last().messages > earlier + 500, "more messages")
        order(graph, "stop")
        assert states.last() is not None
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()
    found = Bag(bag)
    assert [file.path.name for file in found.files] == ["class_0.mcap", "class_1.mcap"]
    (gap,) = found.gaps()
    assert gap.duration > 0.1
    assert gap.said(found.start_ns).code == RECORDING_GAP.code
    numbers = [int(word.split()[0]) for word in words(bag, "/counted")]
    assert sum(b != a + 1 for a, b in itertools.pairwise(numbers)) == 1
    with AnyReader([bag]) as reader:
        assert len(list(reader.messages())) == len(numbers)
    assert found.versions()


def test_what_a_topic_said_before_is_recorded_as_its_newest_value_alone(
    graph, recorder, states, tmp_path
):
    said = publisher(graph, "/systems", qos.LATCHED_EVENTS)
    for number in range(5):
        said(f"old {number}")
    bag = start(graph, "class", ("/systems",))
    wait_for(lambda: states.last() and states.last().messages == 1, "the present value")
    said("new")
    wait_for(lambda: states.last().messages == 2, "the new value")
    order(graph, "stop")
    assert words(bag, "/systems") == ["old 4", "new"]


def test_every_value_of_a_latched_topic_is_recorded_where_the_clock_is_set(
    graph, recorder, states, monkeypatch
):
    said = publisher(graph, "/systems", qos.LATCHED_EVENTS)
    said("old")
    folder = start(graph, "class", ("/systems",))
    wait_for(lambda: states.last() and states.last().messages == 1, "the present value")
    # What follows was published before the topic was followed, by the clock.
    hour_ns = 3600 * 10**9
    (followed,) = recorder.recorder._recording._followed.values()
    followed.since_ns += hour_ns
    for number in range(3):
        said(f"new {number}")
    wait_for(lambda: states.last().messages == 4, "all values")
    order(graph, "stop")
    assert words(folder, "/systems") == ["old", "new 0", "new 1", "new 2"]


def test_a_topic_without_publishers_is_given_up_and_followed_again(
    graph, recorder, states, monkeypatch
):
    monkeypatch.setattr(recording, "GONE_NS", 0)
    monkeypatch.setattr(recording, "PUBLISHER_CHECK_EVERY", 1)
    folder = start(graph, "class", ("/*/telemetry",))
    for number in range(2):
        made = graph.client.create_publisher(String, "/ur5e_1/telemetry", qos.STREAM)
        wait_for(made.get_subscription_count, "the recorder")
        made.publish(String(data=f"word {number}"))
        wait_for(lambda number=number: states.last().messages == number + 1, "the word")
        graph.client.destroy_publisher(made)
        wait_for(lambda: not graph.client.count_subscribers("/ur5e_1/telemetry"), "the end")
    order(graph, "stop")
    assert words(folder, "/ur5e_1/telemetry") == ["word 0", "word 1"]


def test_a_value_of_before_a_clock_was_set_back_is_no_event_of_the_recording():
    topic = Topic("/systems", "std_msgs/msg/String", (QosProfile(durability="transient_local"),))
    followed = recording.Followed(None, topic, 1)
    late_ns = followed.since_ns + 3600 * 10**9
    for published_ns in (late_ns, followed.since_ns - 1):
        assert not followed.takes(Received(0, "/systems", b"", published_ns, 0))
    assert followed.takes(Received(0, "/systems", b"", followed.since_ns, 0))
    assert followed.take_before() is None
    assert followed.take_before(at_once=True).published_ns == followed.since_ns - 1


def test_a_disk_that_refuses_is_told_at_once_and_the_recorder_lives_on(
    graph, counter, launch, states, tmp_path
):
    process = launch()
    assert not graph.call(Trigger, "/recorder/stop").success
    # Files of the recorder may not grow beyond this: EFBIG instead of a full disk.
    limit = 100_000
    resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (limit, limit))
    folder = start(graph, "class")
    wait_for(lambda: states and states.last().code, "the trouble")
    assert states.last().state == State.STOPPED
    assert states.last().code == BAG_NOT_WRITTEN.code
    values = {each.key: each.value for each in states.last().values}
    assert values["problem"] == os.strerror(errno.EFBIG)
    numbers = [int(word.split()[0]) for word in words(folder, "/counted")]
    assert numbers
    assert numbers == list(range(numbers[0], numbers[-1] + 1))
    start(graph, "next", ("/nothing",))
    order(graph, "stop")


def test_a_split_that_the_disk_refuses_ends_the_recording(graph, counter, launch, states):
    launch()
    folder = start(graph, "class")
    wait_for(lambda: states and states.last().messages > 100, "messages in the bag")
    # A full disk would refuse the next messages before the split.
    (folder / "class_1.mcap").mkdir()
    answer = graph.call(Trigger, "/recorder/split")
    assert answer.code == RECORDING_FAILED.code
    wait_for(lambda: states.last().state == State.STOPPED, "the end")
    assert (states.last().code, states.last().values) == (answer.code, answer.values)
    (folder / "class_1.mcap").rmdir()
    numbers = [int(word.split()[0]) for word in words(folder, "/counted")]
    assert numbers
    assert numbers == list(range(numbers[0], numbers[-1] + 1))
    start(graph, "next")
    order(graph, "stop")


@pytest.mark.parametrize("broken", ["write", "flush", "take"])
def test_an_error_of_the_recorder_itself_ends_the_recording_and_is_named(
    graph, recorder, states, monkeypatch, broken
):
    say = publisher(graph, "/ur5e_1/telemetry")
    folder = start(graph, "class", ("/*/telemetry",))
    wait_for(lambda: graph.client.count_subscribers("/ur5e_1/telemetry"), "the recorder")
    say("before")
    wait_for(lambda: Bag(folder).message_count, "the message on the disk")

    def fail(*_: Any) -> None:
        raise ZeroDivisionError("injected")

    owner = recorder.recorder._recording._poll if broken == "take" else BagWriter
    monkeypatch.setattr(owner, f"_{broken}" if broken == "take" else broken, fail)
    say("after")
    wait_for(lambda: states.last().state == State.STOPPED, "the end")
    failed = recorder.failed[0]
    assert states.last().code == failed.code == RECORDING_FAILED.code
    why = failed.values["why"].diagnostic
    assert (why.code, why.values["error"]) == (
        RECORDER_FAULT.code,
        repr(ZeroDivisionError("injected")),
    )
    assert words(folder, "/ur5e_1/telemetry")[0] == "before"
    monkeypatch.undo()
    start(graph, "next")
    order(graph, "stop")


# replay ---------------------------------------------------------------------------------------


@pytest.fixture
def session(recorder: RecorderNode, tmp_path: Path) -> Path:
    """A second of two topics, one of them latched, and one that is not replayed."""
    kind, latched = "std_msgs/msg/String", QosProfile(durability="transient_local")
    writer = BagWriter(tmp_path / "class", definition)
    wave = b"".join(map(bytes, chunks(small_lab.TRAJECTORIES["wave"])))
    writer.attach("trajectories/wave.json", "application/json", wave, START_NS)
    for name, quality in (
        ("/ur5e_1/telemetry", QosProfile()),
        ("/ur5e_1/grasp", latched),
        ("/latency", QosProfile()),
    ):
        writer.add_topic(Topic(name, kind, (quality,)))

    def write(number: int, topic: str, word: str) -> None:
        data = serialize_message(String(data=word))
        writer.write(topic, START_NS + number * 10_000_000, data, START_NS)

    for number in range(100):
        if number % 25 == 0:
            write(number, "/ur5e_1/grasp", f"state {number}")
            write(number, "/latency", "slow")
        write(number, "/ur5e_1/telemetry", f"event {number}")
        if number % 10 == 9:
            writer.flush()
    writer.close()
    return writer.folder


class Ears:
    """Hears everything of the session in one order, as CDR."""

    def __init__(self, graph: Graph) -> None:
        self.heard: list[tuple[str, str]] = []
        for topic, quality in (
            ("/ur5e_1/telemetry", qos.STREAM),
            ("/ur5e_1/grasp", qos.LATCHED_EVENTS),
            ("/latency", qos.STREAM),
        ):
            graph.client.create_subscription(
                String,
                topic,
                lambda data, topic=topic: self.heard.append((topic, decoded(data))),
                quality,
                raw=True,
            )

    def of(self, topic: str) -> list[str]:
        return [word for heard, word in self.heard if heard == topic]


def replay(graph: Graph, bag: str = "class", **fields: Any) -> None:
    order(graph, "replay", srv.Replay, bag=bag, **{"rate": 1.0, **fields})


def wait_until_over(states: Inbox) -> None:
    """Wait until a replay was told, and then its end."""
    wait_for(
        lambda: (
            State.REPLAYING in [state.state for state in states]
            and states.last().state == State.STOPPED
        ),
        "the end",
    )


def test_a_replay_says_the_same_in_the_same_order(graph, recorder, session, states):
    ears = Ears(graph)
    replay(graph, rate=4.0)
    wait_until_over(states)
    told = next(state for state in states if state.state == State.REPLAYING)
    assert told.duration == pytest.approx(Bag(session).duration)
    assert ears.of("/ur5e_1/telemetry") == words(session, "/ur5e_1/telemetry")
    assert ears.of("/ur5e_1/grasp") == ["state 0", "state 25", "state 50", "state 75"]
    assert ears.of("/latency") == []
    assert graph.client.count_publishers("/ur5e_1/telemetry") == 0
    assert words(session, "/ur5e_1/telemetry") == [f"event {n}" for n in range(100)]


def test_a_bag_of_another_lab_is_replayed_as_of_this_one(graph, recorder, tmp_path):
    writer = BagWriter(tmp_path / "theirs", definition)
    latched = QosProfile(durability="transient_local")
    writer.add_topic(Topic("/robots", "mrlab_msgs/msg/Robots", (latched,)))
    message = msg.Robots(lab="another", robots=[msg.Robot(name="ur5e_1")])
    for number in range(2):
        time_ns = START_NS + number * 1_000_000_000
        writer.write("/robots", time_ns, serialize_message(message), START_NS)
    writer.close()
    robots = graph.listen(msg.Robots, "/robots", qos.LATCHED_EVENTS)
    replay(graph, "theirs", rate=0.1)
    wait_for(lambda: len(robots), "the robots of the bag")
    assert (robots.last().lab, robots.last().robots[0].name) == ("lab", "ur5e_1")
    order(graph, "stop")


def test_a_sqlite3_bag_is_replayed_as_it_is(graph, recorder, session, states, tmp_path):
    as_sqlite(Bag(session), tmp_path / "other")
    ears = Ears(graph)
    replay(graph, "other", rate=10.0, start=0.6)
    wait_until_over(states)
    assert ears.of("/ur5e_1/grasp") == ["state 50", "state 75"]
    assert ears.of("/ur5e_1/telemetry") == [f"event {n}" for n in range(60, 100)]


def test_a_replay_that_starts_later_says_first_how_things_are(graph, recorder, session, states):
    ears = Ears(graph)
    replay(graph, rate=10.0, start=0.6)
    wait_until_over(states)
    events = ears.of("/ur5e_1/telemetry")
    assert ears.of("/ur5e_1/grasp") == ["state 50", "state 75"]
    assert events == [f"event {n}" for n in range(60, 100)]


def test_pause_seek_rate_and_loop_do_what_they_say(graph, recorder, session, states):
    ears = Ears(graph)
    replay(graph, rate=0.1, loop=True)
    wait_for(lambda: "event 3" in ears.of("/ur5e_1/telemetry"), "the first events")
    order(graph, "pause")
    wait_for(lambda: states.last().state == State.PAUSED, "the pause")
    position = states.last().position
    heard = len(ears.heard)
    order(graph, "seek", srv.Seek, position=0.8)
    wait_for(lambda: ears.of("/ur5e_1/grasp")[-1] == "state 75", "the state at that place")
    wait_for(lambda: states.last().position == pytest.approx(0.8), "the place")
    assert position < 0.5
    assert [word for topic, word in ears.heard[heard:] if "grasp" in topic] == ["state 75"]
    order(graph, "set_rate", srv.SetRate, rate=10.0)
    answer = graph.call(srv.SetRate, "/recorder/set_rate", rate=11.0)
    assert answer.code == BAD_REPLAY_RATE.code
    answer = graph.call(srv.Seek, "/recorder/seek", position=99.0)
    assert answer.code == BAD_POSITION.code
    order(graph, "resume")
    wait_for(lambda: ears.of("/ur5e_1/telemetry").count("event 50") >= 2, "two rounds more")
    order(graph, "set_loop", SetLoop, loop=False)
    wait_until_over(states)
    events = [int(word.split()[1]) for word in ears.of("/ur5e_1/telemetry")]
    jumps = [pair for pair in itertools.pairwise(events) if pair[1] != pair[0] + 1]
    # In order and whole, but for the seek; each further round begins at the beginning.
    assert jumps[0][1] in range(70, 90)
    assert len(jumps) > 2
    assert set(jumps[1:]) == {(99, 0)}
    assert events[-1] == 99


def test_a_guided_replay_stands_where_somebody_pointed(graph, recorder, states, tmp_path):
    writer = BagWriter(tmp_path / "lesson", definition)
    for name, kind in (("/ur5e_1/telemetry", "String"), ("/look_here", "LookHere")):
        package = "std_msgs" if kind == "String" else "mrlab_msgs"
        writer.add_topic(Topic(name, f"{package}/msg/{kind}", (QosProfile(),)))

    def write(topic: str, message: Any, number: int) -> None:
        time_ns = START_NS + number * 10_000_000
        writer.write(topic, time_ns, serialize_message(message), START_NS)

    for number in range(100):
        if number in (5, 10, 70):
            mark = msg.LookHere(name="Anna")
            mark.point.x = number / 10
            write("/look_here", mark, number)
        write("/ur5e_1/telemetry", String(data=f"event {number}"), number)
    writer.close()

    def stands_at(place: float) -> dict[str, Any]:
        wait_for(
            lambda: (
                states.last().state == State.PAUSED
                and states.last().position == pytest.approx(place)
                and states.last().code == TOUR_STOP.code
            ),
            f"the stop at {place}",
        )
        values = {each.key: json.loads(each.value) for each in states.last().values}
        assert [event["code"] for event in values["events"]]
        return values

    ears = Ears(graph)
    all_stops = graph.listen(DiagnosticArray, "/recorder/stops", qos.LATCHED_EVENTS)
    replay(graph, "lesson", rate=0.1)
    assert graph.call(Trigger, "/recorder/previous_stop").code == NO_STOP_BEFORE.code
    order(graph, "set_rate", srv.SetRate, rate=2.0)
    assert order(graph, "next_stop").code == TO_STOP.code
    first = stands_at(0.2)
    # Two marks are so near to each other that they are one stop, which shows the first.
    assert (first["number"], first["count"], first["place"]) == (1, 2, [0.5, 0.0, 0.0])
    assert len(first["events"]) == 2
    assert ears.of("/ur5e_1/telemetry")[-1] == "event 20"
    order(graph, "next_stop")
    assert stands_at(0.8)["place"] == [7.0, 0.0, 0.0]
    order(graph, "previous_stop")
    stands_at(0.2)
    order(graph, "seek", srv.Seek, position=0.9)
    wait_for(lambda: states.last().code == "", "what stood there is gone")
    assert order(graph, "next_stop").code == TO_END.code
    wait_until_over(states)
    assert states.last().code == ""
    told = next(each.status for each in all_stops if each.status)
    instants = [value.value for each in told for value in each.values if value.key == INSTANT]
    assert instants == ["0.200", "0.800"]
    assert all_stops.last().status == []


def test_the_rate_is_kept(graph, recorder, session, states):
    began = time.monotonic()
    replay(graph, rate=0.5, start=0.6)
    wait_until_over(states)
    # Never early; how late is the machine's affair.
    assert time.monotonic() - began > 0.39 / 0.5


def test_the_bag_s_trajectories_can_be_fetched_while_it_is_replayed(graph, recorder, session):
    replay(graph, rate=0.1)
    answer = graph.call(srv.GetTrajectory, "/converter/get", id="wave")
    assert answer.success, answer.message
    positions = small_lab.TRAJECTORIES["wave"].positions
    assert list(answer.trajectory.positions) == pytest.approx(positions.ravel(), abs=1e-12)
    answer = graph.call(srv.GetTrajectory, "/converter/get", id="nothing")
    assert answer.code == NO_ATTACHMENT.code
    order(graph, "stop")
    wait_for(lambda: not graph.client.count_services("/converter/get"), "the service gone")


def test_a_replay_ends_when_asked_and_refuses_to_run_beside_another(graph, recorder, session):
    assert graph.call(srv.ListBags, "/recorder/list_bags").bags == ["class"]
    replay(graph, rate=0.1)
    answer = graph.call(srv.Replay, "/recorder/replay", bag="class", rate=1.0)
    assert REPLAY_RUNS.code in reason(answer)
    answer = graph.call(srv.StartRecording, "/recorder/start")
    assert REPLAY_RUNS.code in reason(answer)
    assert order(graph, "stop").code == REPLAY_OVER.code
    wait_for(lambda: graph.client.count_publishers("/ur5e_1/telemetry") == 0, "its topics gone")


def test_who_still_publishes_is_named(graph, recorder, session, states, monkeypatch):
    monkeypatch.setattr(replaying, "LEAVE_TIMEOUT_S", 0.3)
    publisher(graph, "/ur5e_1/telemetry")
    answer = graph.call(srv.Replay, "/recorder/replay", bag="class", rate=1.0)
    assert not answer.success
    assert answer.code == OTHERS_PUBLISH.code
    values = {each.key: json.loads(each.value) for each in answer.values}
    assert values == {"nodes": ["/test_client"], "topics": ["/ur5e_1/telemetry"]}
    wait_until_over(states)


def test_a_bag_of_one_moment_is_not_looped(graph, recorder, states, tmp_path):
    writer = BagWriter(tmp_path / "moment", definition)
    writer.add_topic(Topic("/ur5e_1/telemetry", "std_msgs/msg/String", (QosProfile(),)))
    writer.write("/ur5e_1/telemetry", START_NS, serialize_message(String(data="now")), START_NS)
    writer.close()
    ears = Ears(graph)
    replay(graph, bag="moment", loop=True)
    wait_until_over(states)
    assert ears.of("/ur5e_1/telemetry") == ["now"]


def test_a_bag_of_other_definitions_is_brought_to_those_here(graph, recorder, states, tmp_path):
    """An earlier grasp had no reason and a field more; nobody here knows acme_msgs."""
    kind, acme = "mrlab_msgs/msg/Grasp", "acme_msgs/msg/Secret"
    header = definition(kind).split("std_msgs/Header header")[1].split("=" * 80, 1)[1]
    texts = {
        kind: f"std_msgs/Header header\nuint8 state\nint32 gone\nstring object\n"
        f"{'=' * 80}{header}",
        acme: "int32 x\n",
    }
    old = get_typestore(Stores.EMPTY)
    old.register(get_types_from_msg(texts[kind], kind))
    stamp = old.types["builtin_interfaces/msg/Time"](0, 0)
    said = old.types[kind](old.types["std_msgs/msg/Header"](stamp, ""), 2, 7, "cube_1")
    writer = BagWriter(tmp_path / "older", texts.__getitem__)
    writer.add_topic(Topic("/ur5e_1/grasp", kind, (QosProfile(),)))
    writer.add_topic(Topic("/secret", acme, (QosProfile(),)))
    writer.write("/ur5e_1/grasp", START_NS, bytes(old.serialize_cdr(said, kind)), START_NS)
    writer.write("/secret", START_NS, b"\0\1\0\0\1\0\0\0", START_NS)
    writer.close()
    inbox = graph.listen(msg.Grasp, "/ur5e_1/grasp", qos.STREAM)
    answer = graph.call(srv.Replay, "/recorder/replay", bag="older", rate=1.0)
    assert answer.success, answer.message
    (left_out,) = (json.loads(each.value) for each in answer.values if each.key == "left_out")
    assert [(each["code"], each["values"]["topic"]) for each in left_out] == [
        (LEFT_OUT.code, "/secret")
    ]
    wait_until_over(states)
    grasp = inbox.last()
    assert (grasp.state, grasp.object, grasp.reason) == (msg.Grasp.HOLDING, "cube_1", "")


def test_meshes_of_objects_are_in_the_bag(graph, recorder):
    made = graph.client.create_publisher(msg.SceneObjects, "/objects", qos.STREAM)
    folder = start(graph, "things", ("/objects",))
    wait_for(lambda: graph.client.count_subscribers("/objects"), "the recorder")
    uri = "package://mrlab_ros/config/objects/bin.glb"
    made.publish(msg.SceneObjects(objects=[msg.SceneObject(name="bin_1", mesh=uri)]))
    wait_for(lambda: Bag(folder).message_count, "the message on the disk")
    order(graph, "stop")
    attached = Bag(folder).attachment("meshes/mrlab_ros/config/objects/bin.glb")
    assert attached.data == (directory() / "config" / "objects" / "bin.glb").read_bytes()


def test_a_mesh_of_an_object_in_a_message_of_the_same_size_is_in_the_bag(graph, recorder):
    made = graph.client.create_publisher(msg.SceneObjects, "/objects", qos.STREAM)
    folder = start(graph, "things", ("/objects",))
    wait_for(lambda: graph.client.count_subscribers("/objects"), "the recorder")
    meshes = ("bin", "can")
    for count, mesh in enumerate(meshes, 1):
        uri = f"package://mrlab_ros/config/objects/{mesh}.glb"
        made.publish(msg.SceneObjects(objects=[msg.SceneObject(name="thing", mesh=uri)]))
        wait_for(lambda count=count: Bag(folder).message_count == count, "the message")
    order(graph, "stop")
    attached = Bag(folder).attachments()
    for mesh in meshes:
        assert f"meshes/mrlab_ros/config/objects/{mesh}.glb" in attached


def test_a_long_trajectory_that_is_announced_without_frames_is_in_the_bag(graph, recorder):
    small_lab.start(graph)
    whole = small_lab.TRAJECTORIES["wave"]
    said = graph.client.create_publisher(msg.Trajectory, "/trajectories/converted", qos.EVENTS)
    folder = start(graph, "long", ("/trajectories/converted",))
    wait_for(lambda: graph.client.count_subscribers("/trajectories/converted"), "the recorder")
    said.publish(
        msg.Trajectory(
            info=trajectories.info_to_message(whole), joint_names=list(whole.joint_names)
        )
    )
    wait_for(lambda: Bag(folder).message_count, "the message on the disk")
    order(graph, "stop")
    attached = parse(Bag(folder).attachment(f"trajectories/{whole.id}.json").data, whole.id)
    assert attached.positions == pytest.approx(whole.positions, abs=1e-12)


def test_a_recording_that_goes_on_counts_the_bag_and_a_failure_is_told(
    graph, tmp_path, monkeypatch
):
    writer = BagWriter(tmp_path / "class", definition)
    writer.add_topic(Topic("/counted", "std_msgs/msg/String", (QosProfile(),)))
    for number in range(7):
        data = serialize_message(String(data=str(number)))
        writer.write("/counted", START_NS + number, data, START_NS)
    writer.close()
    journal = Journal.of(str(tmp_path), "recorder", pytest.fail)
    journal.save(entries.plain(entries.Entry(tmp_path / "class", ("/counted",), 0.0)))
    journal.close()
    node = graph.add(
        RecorderNode, bag_dir=str(tmp_path), state_dir=str(tmp_path), topics=["/counted"]
    )
    assert node.lost[0].values["gap"].code == RECORDING_GAP.code
    assert held(order(graph, "stop")) == 7
    folder = start(graph, "next")
    assert node.lost[0].code == RECORDING_WITH_GAP.code, "the restart is still reported"
    folder.rename(tmp_path / "moved")
    wait_for(lambda: node.failed, "the failure")
    assert node.failed[0].code == BAG_MOVED.code
    monkeypatch.setattr(use_case, "RESTART_SHOWN_S", 0.0)
    start(graph, "last")
    assert node.failed == node.lost == []
    order(graph, "stop")
