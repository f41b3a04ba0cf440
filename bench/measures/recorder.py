"""What recording a class costs: 50 robots at 100 Hz with all topics of the lab.

A process publishes what the lab says of its robots, counted; the recorder, or a baseline, writes
it in a process of its own. "CPU" is that process's time as a share of one core, so what else runs
on the machine matters little. "lost" is what was sent and is not in the bag. The baselines:
rclpy's executor with raw callbacks that write through the rosbags library, and through mcap's
writer.
"""

from __future__ import annotations

import os
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import rclpy
from mcap.writer import Writer as McapWriter
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from partner import HOST, Failed, Partner, cpu_s, program, until
from rclpy.executors import SingleThreadedExecutor
from rclpy.serialization import serialize_message
from rclpy.task import Future
from rosbags.rosbag2 import StoragePlugin, Writer
from sensor_msgs.msg import JointState
from size import Size
from std_msgs.msg import String

from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.core.recording.metadata import QosProfile, Topic
from mrlab_ros.core.recording.topics import LAB_TOPICS, Topics
from mrlab_ros.messages import qos
from mrlab_ros.messages.definitions import definition
from mrlab_ros.ros.graph_node import Graph

NEEDS = ()
OURS, BASELINES = "mrlab", ("executor, rosbags", "executor, mcap")
OF_THE_LAB = ("/rosout", "/recorder/state", "/diagnostics")  # what the recorder says itself
SETTLED_S = 30.0  # a bag that grows for longer than that after the last message is broken
OWN_BYTES = 20_000  # that the recorder writes of itself meanwhile
CLOSED_S = 60.0
JOINTS = [f"joint_{number}" for number in range(6)]
# Message, name, quality, messages each 100 ticks of 10 ms; 0: latched, once.
OF_A_ROBOT: tuple[tuple[Any, str, Any, int], ...] = (
    (
        JointState(name=JOINTS, position=[0.5] * 6, velocity=[0.1] * 6, effort=[0.0]),
        "joint_states", qos.STREAM, 100,
    ),
    (
        msg.Telemetry(joint_names=JOINTS, velocities=[0.1] * 6, effort_proxy=[1.0] * 6),
        "telemetry", qos.STREAM, 10,
    ),
    (
        msg.PlaybackState(label="PLAYING", trajectory_id="wave", host="/playback_host"),
        "playback_state", qos.LATCHED_EVENTS, 1,
    ),
    (msg.Collision(), "collision", qos.LATCHED, 0),
    (msg.Grasp(finger_forces=[0.0]), "grasp", qos.LATCHED, 0),
    (msg.GraspTargets(), "targets", qos.LATCHED, 0),
    (String(data=f"<robot>{'<link/>' * 1000}</robot>"), "robot_description", qos.LATCHED, 0),
)  # fmt: skip
OF_THE_WORLD: tuple[tuple[Any, str, Any, int], ...] = (
    (msg.Robots(), "/robots", qos.LATCHED, 0),
    (msg.SceneObjects(), "/objects", qos.STREAM, 50),
    (msg.Contacts(), "/contacts", qos.STREAM, 25),
)


def publish(pipe: Any, robots: int, seconds: float) -> None:
    """Publish what playing robots say, once all of it is subscribed to; send how many that was."""
    rclpy.init()
    node = rclpy.create_node("bench_recorder")
    every = [
        (node.create_publisher(type(m), f"{where}{name}", quality), serialize_message(m), rate)
        for where, kinds in (
            *((f"/bench_{robot}/", OF_A_ROBOT) for robot in range(robots)),
            ("", OF_THE_WORLD),
        )
        for m, name, quality, rate in kinds
    ]
    latched = [(publisher, data) for publisher, data, rate in every if not rate]
    for publisher, data in latched:
        publisher.publish(data)
    until(lambda: all(p.get_subscription_count() for p, *_ in every), "the recorder")
    pipe.send("matched")
    pipe.recv()
    moving = [(p.publish, data, 100 // rate) for p, data, rate in every if rate]
    due, sent = time.perf_counter(), len(latched)
    for tick in range(round(seconds * 100)):
        time.sleep(max(due - time.perf_counter(), 0.0))
        due += 0.01
        for number, (send, data, step) in enumerate(moving):
            # Telemetry and states of different robots come at different times.
            if (tick + number) % step == 0:
                send(data)
                sent += 1
    pipe.send(sent)
    pipe.recv()


class ByMcap:
    """A bag that mcap's own writer writes."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir()
        self._bag = McapWriter(str(folder / "bag_0.mcap"))
        self._bag.start("ros2")
        self.close = self._bag.finish

    def add(self, name: str, kind: str, type_hash: str) -> Callable[[bytes], None]:
        schema = self._bag.register_schema(kind, "ros2msg", definition(kind).encode())
        channel, add = self._bag.register_channel(name, "cdr", schema), self._bag.add_message

        def write(data: bytes) -> None:
            now = time.time_ns()
            add(channel, now, data, now)

        return write


class ByRosbags:
    """A bag that the rosbags library writes."""

    def __init__(self, folder: Path) -> None:
        self._bag = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
        self._bag.open()
        self.close = self._bag.close

    def add(self, name: str, kind: str, type_hash: str) -> Callable[[bytes], None]:
        made = self._bag.add_connection(name, kind, msgdef=definition(kind), rihs01=type_hash)
        return lambda data: self._bag.write(made, time.time_ns(), data)


def write_by_executor(pipe: Any, library: str, folder: Path) -> None:
    """Write every topic of the lab by rclpy's executor and a library, until something is sent."""
    rclpy.init()
    node = rclpy.create_node("bench_writer")
    wanted, known = Topics(LAB_TOPICS), set()
    bag = ByMcap(folder) if library.endswith("mcap") else ByRosbags(folder)

    def discover() -> None:
        for name, _ in node.get_topic_names_and_types():
            ends = node.get_publishers_info_by_topic(name) if name in wanted else []
            if ends and name not in known and name != "/rosout":
                known.add(name)
                topic = qos.topic_of(name, ends)
                write = bag.add(name, topic.type, topic.type_hash)
                kind, quality = qos.message_class(topic.type), qos.profile(topic, 1000)
                node.create_subscription(kind, name, write, quality, raw=True)

    ended: Future = Future()

    def await_end() -> None:
        pipe.recv()
        ended.set_result(None)

    threading.Thread(target=await_end, daemon=True).start()
    node.create_timer(0.25, discover)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.spin_until_future_complete(ended)
    bag.close()
    pipe.send("closed")


@contextmanager
def recorder(folder: Path, bag: Path) -> Iterator[int]:
    """Record with the lab's recorder; yield its process."""
    options = ("--ros-args", "--log-level", "error", "-p", f"bag_dir:={folder}")
    with program(*HOST, "recorder", *options, patience=CLOSED_S) as process:
        with Graph() as graph:
            request = srv.StartRecording.Request(bag=str(bag))
            graph.call(srv.StartRecording, "/recorder/start", request, 30.0, find_timeout=60.0)
        yield process.pid
        with Graph() as graph:
            graph.order(Trigger, "/recorder/stop", Trigger.Request(), timeout=CLOSED_S)


@contextmanager
def baseline(library: str, bag: Path) -> Iterator[int]:
    with Partner(write_by_executor, library, bag) as writer:
        yield writer.pid
        writer.send()
        writer.receive(CLOSED_S)


def recorded(writer: str, robots: int, seconds: float) -> dict[str, Any]:
    """Let `writer` record `robots` robots for `seconds`."""
    with (
        tempfile.TemporaryDirectory() as name,
        Partner(publish, robots, seconds) as source,
    ):
        bag = Path(name) / "bag"
        way = recorder(Path(name), bag) if writer == OURS else baseline(writer, bag)
        with way as pid:
            source.receive()
            # URDFs, meshes and parameters are fetched at the beginning.
            time.sleep(2.0)
            before, began = cpu_s(pid), time.monotonic()
            source.send("go")
            sent = source.receive(seconds + CLOSED_S)
            took, busy = time.monotonic() - began, cpu_s(pid) - before
            settle(bag)
        found = Bag(bag)
        written = sum(t.messages for n, t in found.topics.items() if n not in OF_THE_LAB)
        return {
            "writer": writer,
            "robots": robots,
            "sent": sent,
            "lost": sent - written,
            "messages/s": sent / took,
            "CPU %": 100 * busy / took,
            "us/message": 1e6 * busy / sent,
            "MB": found.size / 1e6,
        }


def settle(bag: Path) -> None:
    """Wait until the bag grows no more; the recorder's own state is a message a second."""
    last, end = -1, time.monotonic() + SETTLED_S
    while (size := sum(f.stat().st_size for f in bag.glob("*.mcap"))) - last > OWN_BYTES:
        last = size
        if time.monotonic() > end:
            raise Failed(f"the bag still grows after {SETTLED_S:g} s: {size} bytes")
        time.sleep(1.5)


def recordings(size: Size) -> list[dict[str, Any]]:
    cases = ((OURS, 2), (OURS, 13), (OURS, 50), *((name, 50) for name in BASELINES))
    seconds = size.of(1.0, 8.0, 60.0)
    return [recorded(writer, robots, seconds) for writer, robots in size.some(cases)]


def write_only(size: Size) -> list[dict[str, Any]]:
    """Measure what writing alone costs, of joint states that are in memory already."""
    messages, kind = size.of(1_000, 50_000, 500_000), "sensor_msgs/msg/JointState"
    names = [f"/bench_{number}/joint_states" for number in range(50)]
    data = [os.urandom(48) + bytes(220) for _ in range(256)]

    def ours(folder: Path) -> None:
        bag = BagWriter(folder, lambda _: definition(kind))
        for name in names:
            bag.add_topic(Topic(name, kind, (QosProfile(),), "RIHS01_0"))
        for number in range(messages):
            bag.write(names[number % 50], number, data[number % 256], number, number)
            if number % 2500 == 0:
                bag.flush()
        bag.close()

    def by(library: Callable[[Path], Any], folder: Path) -> None:
        bag = library(folder)
        made = [bag.add(name, kind, "RIHS01_0") for name in names]
        for number in range(messages):
            made[number % 50](data[number % 256])
        bag.close()

    works: dict[str, Callable[[Path], None]] = {
        OURS: ours,
        "mcap": lambda folder: by(ByMcap, folder),
        "rosbags": lambda folder: by(ByRosbags, folder),
    }
    rows = []
    for name, work in works.items():
        with tempfile.TemporaryDirectory() as folder:
            began = time.process_time()
            work(Path(folder) / name)
            busy = time.process_time() - began
        rows.append({"writer": name, "us/message": 1e6 * busy / messages})
    return rows


TABLES = {
    "Recording all topics of robots at 100 Hz": recordings,
    "Writing alone": write_only,
}
