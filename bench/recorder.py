"""What recording a class costs: 50 robots at 100 Hz with all topics of the lab.

A process publishes what the lab says of its robots, counted; the recorder, or a baseline, writes
it in a process of its own. "cpu" is that process's time on a processor as a share of one core, so
what else runs on the machine matters little. "lost" is what was sent and is not in the bag.
The baselines: rclpy's executor with raw callbacks that write through the rosbags library, and
through mcap's writer.
"""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import psutil
import report

DOMAIN = "144"
BASELINES = ("executor, rosbags", "executor, mcap")
OF_THE_LAB = ("/rosout", "/recorder/state", "/diagnostics")  # what the recorder says itself
SETTLED_S = 30.0  # a bag that grows for longer than that after the last message is broken
OWN_BYTES = 20_000  # that the recorder writes of itself meanwhile
URDF = "<robot>" + "<link/>" * 1000 + "</robot>"


def publish(robots: int, seconds: float) -> None:
    """Publish what `robots` playing robots say for `seconds`; print how many messages that was."""
    import rclpy
    from mrlab_msgs import msg
    from rclpy.serialization import serialize_message
    from sensor_msgs.msg import JointState
    from std_msgs.msg import String

    from mrlab_ros.messages import qos

    rclpy.init()
    node = rclpy.create_node("bench_recorder")
    names = [f"joint_{number}" for number in range(6)]
    joints = JointState(name=names, position=[0.5] * 6, velocity=[0.1] * 6, effort=[0.0])
    telemetry = msg.Telemetry(joint_names=names, velocities=[0.1] * 6, effort_proxy=[1.0] * 6)
    state = msg.PlaybackState(label="PLAYING", trajectory_id="wave", host="/playback_host")
    # type, name, quality, messages each 100 ticks of 10 ms; 0: latched, once
    kinds: tuple[tuple[Any, str, Any, int], ...] = (
        (joints, "joint_states", qos.STREAM, 100),
        (telemetry, "telemetry", qos.STREAM, 10),
        (state, "playback_state", qos.LATCHED_EVENTS, 1),
        (msg.Collision(), "collision", qos.LATCHED, 0),
        (msg.Grasp(finger_forces=[0.0]), "grasp", qos.LATCHED, 0),
        (msg.GraspTargets(), "targets", qos.LATCHED, 0),
        (String(data=URDF), "robot_description", qos.LATCHED, 0),
    )
    world: tuple[tuple[Any, str, Any, int], ...] = (
        (msg.Robots(), "/robots", qos.LATCHED, 0),
        (msg.SceneObjects(), "/objects", qos.STREAM, 50),
        (msg.Contacts(), "/contacts", qos.STREAM, 25),
    )
    every = [
        (node.create_publisher(type(m), f"/bench_{r}/{name}", q), serialize_message(m), rate)
        for r in range(robots)
        for m, name, q, rate in kinds
    ] + [
        (node.create_publisher(type(m), n, q), serialize_message(m), rate)
        for m, n, q, rate in world
    ]
    sent = 0
    for publisher, data, rate in every:
        if not rate:
            publisher.publish(data)
            sent += 1
    until(lambda: all(p.get_subscription_count() for p, _, _ in every), "the recorder")
    print("matched", flush=True)
    sys.stdin.readline()
    moving = [(p.publish, data, 100 // rate) for p, data, rate in every if rate]
    due = time.perf_counter()
    for tick in range(round(seconds * 100)):
        time.sleep(max(due - time.perf_counter(), 0.0))
        due += 0.01
        for number, (send, data, step) in enumerate(moving):
            # Telemetry and states of different robots come at different times.
            if (tick + number) % step == 0:
                send(data)
                sent += 1
    print(sent, flush=True)
    sys.stdin.readline()
    rclpy.shutdown()


def write_by_executor(library: str, folder: Path) -> None:
    """Write every topic below /bench_* by rclpy's executor and `library`, until SIGINT."""
    import rclpy
    from mcap.writer import Writer as McapWriter
    from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
    from rosbags.rosbag2 import StoragePlugin, Writer

    from mrlab_ros.core.recording.topics import LAB_TOPICS, Topics
    from mrlab_ros.messages.definitions import definition
    from mrlab_ros.messages.qos import message_class, profile, topic_of

    rclpy.init()
    node = rclpy.create_node("bench_writer")
    wanted, known = Topics(LAB_TOPICS), set()
    bag: Any
    if library == "rosbags":
        bag = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
        bag.open()
    else:
        folder.mkdir()
        bag = McapWriter(str(folder / "bag_0.mcap"))
        bag.start("ros2")

    def write_to(name: str, topic: Any) -> Callable[[bytes], None]:
        text = definition(topic.type)
        if library == "rosbags":
            made = bag.add_connection(name, topic.type, msgdef=text, rihs01=topic.type_hash)
            return lambda data: bag.write(made, time.time_ns(), data)
        schema = bag.register_schema(topic.type, "ros2msg", text.encode())
        channel = bag.register_channel(name, "cdr", schema)

        def write(data: bytes) -> None:
            now = time.time_ns()
            bag.add_message(channel, now, data, now)

        return write

    def discover() -> None:
        for name, _ in node.get_topic_names_and_types():
            ends = node.get_publishers_info_by_topic(name) if name in wanted else []
            if ends and name not in known and name != "/rosout":
                known.add(name)
                topic = topic_of(name, ends)
                node.create_subscription(
                    message_class(topic.type),
                    name,
                    write_to(name, topic),
                    profile(topic, 1000),
                    raw=True,
                )

    node.create_timer(0.25, discover)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    if library == "rosbags":
        bag.close()
    else:
        bag.finish()


def until(condition: Callable[[], object], what: str, seconds: float = 60.0) -> None:
    """Wait for `condition`; raise TimeoutError naming `what` when it does not come true."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(f"waited {seconds:g} s for {what}")
        time.sleep(0.02)


def measure(writer: str, robots: int, seconds: float, folder: Path) -> dict[str, Any]:
    """Let `writer` record `robots` robots for `seconds` into `folder`."""
    bag = folder / "bag"
    if writer == "mrlab":
        argv = [sys.executable, "-m", "mrlab_ros.processes.host", "recorder", "--ros-args"]
        argv += ["--log-level", "error", "-p", f"bag_dir:={folder}"]
    else:
        argv = [sys.executable, __file__, "--write", writer.split()[-1], str(bag)]
    source = subprocess.Popen(
        [sys.executable, __file__, "--publish", str(robots), str(seconds)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    process = subprocess.Popen(argv)
    try:
        assert source.stdin is not None
        assert source.stdout is not None
        if writer == "mrlab":
            order("start", bag)
        source.stdout.readline()
        # URDFs, meshes and parameters are fetched at the beginning.
        time.sleep(2.0)
        watched = psutil.Process(process.pid)
        before, began = watched.cpu_times(), time.monotonic()
        source.stdin.write("go\n")
        source.stdin.flush()
        sent = int(source.stdout.readline())
        took = time.monotonic() - began
        after = watched.cpu_times()
        # What the writer has not taken yet is waiting in its subscriptions.
        settled(bag)
        if writer == "mrlab":
            order("stop", bag)
        process.send_signal(signal.SIGINT)
        process.wait(60)
        source.stdin.write("end\n")
        source.stdin.flush()
        source.wait(10)
    finally:
        for running in (source, process):
            running.kill()
    written, size = counted(bag)
    busy = after.user + after.system - before.user - before.system
    return {
        "writer": writer,
        "robots": robots,
        "sent": sent,
        "lost": sent - written,
        "messages_per_s": round(sent / took),
        "cpu_percent": round(100 * busy / took, 1),
        "us_per_message": round(1e6 * busy / sent, 1),
        "megabytes": round(size / 1e6, 1),
    }


def settled(bag: Path) -> None:
    """Wait until the bag grows no more; the recorder's own state is a message a second."""
    last, end = -1, time.monotonic() + SETTLED_S
    while (size := sum(f.stat().st_size for f in bag.glob("*.mcap"))) - last > OWN_BYTES:
        last = size
        if time.monotonic() > end:
            raise SystemExit(f"{bag} still grows after {SETTLED_S:g} s: {size} bytes")
        time.sleep(1.5)


def counted(bag: Path) -> tuple[int, int]:
    """Return the messages of the bench in the bag, and its bytes."""
    from mrlab_ros.adapters.bags.reader import Bag

    found = Bag(bag)
    mine = [t.messages for n, t in found.topics.items() if n not in OF_THE_LAB]
    return sum(mine), found.size


def order(what: str, bag: Path) -> None:
    """Start or stop the recorder."""
    from mrlab_msgs import srv
    from mrlab_msgs.srv import Trigger

    from mrlab_ros.ros.graph_node import Graph

    with Graph() as graph:
        if what == "start":
            request = srv.StartRecording.Request(bag=str(bag))
            graph.call(srv.StartRecording, "/recorder/start", request, 30.0, find_timeout=60.0)
        else:
            graph.order(Trigger, "/recorder/stop", Trigger.Request(), timeout=60.0)


def write_only(messages: int, folder: Path) -> list[dict[str, Any]]:
    """Return what writing alone costs, of messages that are in memory already."""
    from mcap.writer import Writer as McapWriter
    from rosbags.rosbag2 import StoragePlugin, Writer

    from mrlab_ros.adapters.bags.writer import BagWriter
    from mrlab_ros.core.recording.metadata import QosProfile, Topic
    from mrlab_ros.messages.definitions import definition

    kind, text = "sensor_msgs/msg/JointState", definition("sensor_msgs/msg/JointState")
    names = [f"/bench_{number}/joint_states" for number in range(50)]
    data = [os.urandom(48) + bytes(220) for _ in range(256)]

    def ours() -> None:
        bag = BagWriter(folder / "ours", lambda _: text)
        for name in names:
            bag.add_topic(Topic(name, kind, (QosProfile(),), "RIHS01_0"))
        for number in range(messages):
            bag.write(names[number % 50], number, data[number % 256], number, number)
            if number % 2500 == 0:
                bag.flush()
        bag.close()

    def library() -> None:
        bag = McapWriter(str(folder / "mcap.mcap"))
        bag.start("ros2")
        schema = bag.register_schema(kind, "ros2msg", text.encode())
        channels = [bag.register_channel(name, "cdr", schema) for name in names]
        for number in range(messages):
            bag.add_message(channels[number % 50], number, data[number % 256], number, number)
        bag.finish()

    def rosbags() -> None:
        bag = Writer(folder / "rosbags", version=9, storage_plugin=StoragePlugin.MCAP)
        with bag:
            made = [bag.add_connection(n, kind, msgdef=text, rihs01="RIHS01_0") for n in names]
            for number in range(messages):
                bag.write(made[number % 50], number, data[number % 256])

    rows = []
    for name, work in (("mrlab", ours), ("mcap", library), ("rosbags", rosbags)):
        began = time.process_time()
        work()
        busy = time.process_time() - began
        rows.append({"writer": name, "us_per_message": round(1e6 * busy / messages, 2)})
    return rows


def main() -> None:
    parser = report.options(__doc__.splitlines()[0])
    parser.add_argument("--publish", nargs=2, help=argparse.SUPPRESS)
    parser.add_argument("--write", nargs=2, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ["ROS_DOMAIN_ID"] = DOMAIN
    if arguments.publish:
        publish(int(arguments.publish[0]), float(arguments.publish[1]))
        return
    if arguments.write:
        write_by_executor(arguments.write[0], Path(arguments.write[1]))
        return
    seconds = report.scaled(arguments, 1.0, 8.0, 60.0)
    cases = [("mrlab", 2), ("mrlab", 13), ("mrlab", 50), *((name, 50) for name in BASELINES)]
    rows = []
    for writer, robots in report.some(arguments, cases):
        with tempfile.TemporaryDirectory(prefix="mrlab-bench-") as folder:
            rows.append(measure(writer, robots, seconds, Path(folder)))
    report.show("Recording all topics of robots at 100 Hz", rows, arguments.json)
    with tempfile.TemporaryDirectory(prefix="mrlab-bench-") as folder:
        alone = write_only(report.scaled(arguments, 1_000, 50_000, 500_000), Path(folder))
    report.show("Writing alone, joint states in memory", alone, arguments.json)


if __name__ == "__main__":
    main()
