"""Waiting for a JointTrajectory on a topic, whoever publishes it and however."""

import threading

import numpy as np
import pytest
import rclpy
from graph import wait_for
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from refusals import refused
from std_msgs.msg import String
from trajectory_msgs.msg import JointTrajectory

from mrlab_ros.commands.convert.diagnostics import (
    NO_MESSAGE,
    NO_PUBLISHER,
    NOT_A_TOPIC,
    OTHER_TYPE,
)
from mrlab_ros.commands.convert.topic import receive
from mrlab_ros.core.base.errors import BadInput, LabError, Misuse
from mrlab_ros.messages import qos

BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


@pytest.fixture
def node():
    context = rclpy.Context()
    context.init()
    node = rclpy.create_node("planner", context=context)
    yield node
    node.destroy_node()
    context.try_shutdown()


def test_a_latched_message_is_waiting_already(node):
    publisher = node.create_publisher(JointTrajectory, "/arm/joint_trajectory", qos.LATCHED)
    publisher.publish(JointTrajectory(joint_names=["a", "b"]))
    message = deserialize_message(receive("arm/joint_trajectory", 30.0), JointTrajectory)
    assert message.joint_names == ["a", "b"]


@pytest.mark.parametrize("quality", [BEST_EFFORT, qos.EVENTS])
def test_the_next_message_is_taken(node, quality):
    publisher = node.create_publisher(JointTrajectory, "/arm/joint_trajectory", quality)
    received = []
    waiting = threading.Thread(
        target=lambda: received.append(receive("/arm/joint_trajectory", 30.0))
    )
    waiting.start()

    def publish():
        publisher.publish(JointTrajectory(joint_names=["a"]))
        return received

    wait_for(publish, "the message to be taken", 30.0)
    waiting.join()
    assert np.frombuffer(received[0], np.uint8)[1] == 1, "little-endian CDR"


@pytest.mark.parametrize(
    ("topic", "error", "code"),
    [("/nobody", LabError, NO_PUBLISHER), ("/a b", Misuse, NOT_A_TOPIC)],
)
def test_what_cannot_come_is_said(node, topic, error, code):
    with refused(code, error, topic=topic):
        receive(topic, 0.5)


def test_another_type_and_silence_are_told_apart(node):
    node.create_publisher(String, "/note", 1)
    with refused(OTHER_TYPE, BadInput, found=["std_msgs/msg/String"]):
        receive("/note", 30.0)
    node.create_publisher(JointTrajectory, "/arm/joint_trajectory", 1)
    with refused(NO_MESSAGE):
        receive("/arm/joint_trajectory", 8.0)
