"""Waits for one trajectory_msgs/JointTrajectory on a topic of the graph."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

from rclpy.exceptions import InvalidTopicNameException
from rclpy.qos import qos_profile_best_available
from rclpy.validate_full_topic_name import validate_full_topic_name
from trajectory_msgs.msg import JointTrajectory

from mrlab_ros.commands.convert.diagnostics import (
    NO_MESSAGE,
    NO_PUBLISHER,
    NOT_A_TOPIC,
    OTHER_TYPE,
)
from mrlab_ros.core.base.errors import BadInput, WrongUsage
from mrlab_ros.core.conversion.workspace import JOINT_TRAJECTORY
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.graph_node import Graph

LOOK_EVERY = 0.05  # s


def receive(topic: str, timeout: float) -> bytes:
    """Return the next message of `topic`, serialized as CDR, waiting up to `timeout` s.

    A latched topic gives its last one. Raises Misuse for an impossible name, BadInput where the
    topic carries something else, NoAnswer where nothing comes.
    """
    name = topic if topic.startswith("/") else f"/{topic}"
    try:
        validate_full_topic_name(name)
    except InvalidTopicNameException as error:
        raise WrongUsage(NOT_A_TOPIC(topic=topic, why=str(error))) from None
    deadline = time.monotonic() + timeout
    received: list[bytes] = []
    with Graph() as graph:
        node = graph.node
        print(f"Waiting up to {timeout:g} s for a JointTrajectory on {name}", file=sys.stderr)
        # what a publisher offers is known only once it is there
        if not _until(lambda: bool(node.get_publishers_info_by_topic(name)), deadline):
            others = [
                t for t, kinds in node.get_topic_names_and_types() if JOINT_TRAJECTORY in kinds
            ]
            raise NoAnswer(
                NO_PUBLISHER(
                    topic=name, domain=graph.domain, timeout=timeout, others=sorted(others)
                )
            )
        kinds = {info.topic_type for info in node.get_publishers_info_by_topic(name)}
        if JOINT_TRAJECTORY not in kinds:
            raise BadInput(OTHER_TYPE(topic=name, found=sorted(kinds), expected=JOINT_TRAJECTORY))
        node.create_subscription(
            JointTrajectory, name, received.append, qos_profile_best_available, raw=True
        )
        if not _until(lambda: bool(received), deadline):
            raise NoAnswer(NO_MESSAGE(topic=name, timeout=timeout))
    return received[0]


def _until(condition: Callable[[], bool], deadline: float) -> bool:
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(LOOK_EVERY)
    return True
