"""Takes what a topic of the graph carries: one JointTrajectory, or joint states for a while."""

from __future__ import annotations

import sys
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

from rclpy.exceptions import InvalidTopicNameException
from rclpy.qos import qos_profile_best_available
from rclpy.validate_full_topic_name import validate_full_topic_name
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory

from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.commands.convert.diagnostics import (
    NO_MESSAGE,
    NO_PUBLISHER,
    NOT_A_TOPIC,
    OTHER_TYPE,
)
from mrlab_ros.core.base.errors import BadInput, WrongUsage
from mrlab_ros.core.conversion.workspace import JOINT_TRAJECTORY
from mrlab_ros.core.recording.metadata import Topic
from mrlab_ros.messages.definitions import definition
from mrlab_ros.messages.joint_states import stamp_of
from mrlab_ros.messages.qos import profile, topic_of
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.graph_node import Graph

LOOK_EVERY = 0.05  # s
QUEUE = 1000  # messages of a topic
JOINT_STATE = "sensor_msgs/msg/JointState"


def receive(topic: str, timeout: float) -> bytes:
    """Return the next message of `topic`, serialized as CDR, waiting up to `timeout` s.

    A latched topic gives its last one. Raises Misuse for an impossible name, BadInput where the
    topic carries something else, NoAnswer where nothing comes.
    """
    name = full_name(topic)
    deadline = time.monotonic() + timeout
    received: list[bytes] = []
    with Graph() as graph:
        print(f"Waiting up to {timeout:g} s for a JointTrajectory on {name}", file=sys.stderr)
        _publishers(graph, name, JOINT_TRAJECTORY, timeout)
        graph.node.create_subscription(
            JointTrajectory, name, received.append, qos_profile_best_available, raw=True
        )
        if not _until(lambda: bool(received), deadline):
            raise NoAnswer(NO_MESSAGE(topic=name, timeout=timeout))
    return received[0]


def full_name(topic: str) -> str:
    """Return a topic's full name; raise WrongUsage where it cannot be one."""
    name = topic if topic.startswith("/") else f"/{topic}"
    try:
        validate_full_topic_name(name)
    except InvalidTopicNameException as error:
        raise WrongUsage(NOT_A_TOPIC(topic=topic, why=str(error))) from None
    return name


def record(
    topics: Mapping[str, Path], seconds: float, timeout: float, domain: int | None
) -> dict[str, list[int]]:
    """Write the joint states of topics, each into a new bag; return the stamps of each, ns.

    It begins when each has brought a message, for which `timeout` s are waited, and ends after
    `seconds` or at Ctrl-C. domain: None: that of the environment. Raises as receive() does, and
    what BagWriter raises.
    """
    with Graph(domain) as graph:
        taken: deque[tuple[str, int, bytes]] = deque()
        known = [topic_of(name, _publishers(graph, name, JOINT_STATE, timeout)) for name in topics]
        for topic in known:
            graph.node.create_subscription(
                JointState,
                topic.name,
                partial(_take, taken, topic.name),
                profile(topic, QUEUE),
                raw=True,
            )
        deadline = time.monotonic() + timeout
        for name in topics:
            if not _until(partial(_heard, taken, name), deadline):
                raise NoAnswer(NO_MESSAGE(topic=name, timeout=timeout))
        print(f"Capturing {seconds:g} s of {', '.join(topics)}; Ctrl-C ends it", file=sys.stderr)
        taken.clear()
        return _write(taken, known, time.monotonic() + seconds, topics)


def _heard(taken: deque[tuple[str, int, bytes]], name: str) -> bool:
    return any(each[0] == name for each in list(taken))


def _take(taken: deque[tuple[str, int, bytes]], name: str, data: bytes) -> None:
    taken.append((name, time.time_ns(), data))


def _write(
    taken: deque[tuple[str, int, bytes]],
    topics: Sequence[Topic],
    end: float,
    folders: Mapping[str, Path],
) -> dict[str, list[int]]:
    stamps: dict[str, list[int]] = {topic.name: [] for topic in topics}
    writers: dict[str, BagWriter] = {}
    try:
        for topic in topics:
            writers[topic.name] = BagWriter(folders[topic.name], definition)
            writers[topic.name].add_topic(topic)
        with suppress(KeyboardInterrupt):
            while time.monotonic() < end:
                time.sleep(LOOK_EVERY)
                while taken:
                    name, now_ns, data = taken.popleft()
                    writers[name].write(name, now_ns, data, now_ns)
                    stamps[name].append(stamp_of(data))
    finally:
        for writer in writers.values():
            writer.close()
    return stamps


def _publishers(graph: Graph, name: str, kind: str, timeout: float) -> list[Any]:
    """Wait for publishers of a topic, which say what they offer; raise as receive() does."""
    node, deadline = graph.node, time.monotonic() + timeout
    if not _until(lambda: bool(node.get_publishers_info_by_topic(name)), deadline):
        others = [t for t, kinds in node.get_topic_names_and_types() if kind in kinds]
        raise NoAnswer(
            NO_PUBLISHER(
                topic=name,
                domain=graph.domain,
                timeout=timeout,
                expected=kind,
                others=sorted(others),
            )
        )
    found: list[Any] = node.get_publishers_info_by_topic(name)
    kinds = {info.topic_type for info in found}
    if kind not in kinds:
        raise BadInput(OTHER_TYPE(topic=name, found=sorted(kinds), expected=kind))
    return found


def _until(condition: Callable[[], bool], deadline: float) -> bool:
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(LOOK_EVERY)
    return True
