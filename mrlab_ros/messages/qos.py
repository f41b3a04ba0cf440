"""The qualities of service that the graph uses."""

import importlib
from typing import Any

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

from mrlab_ros.core.base.diagnostics import TYPE_NOT_INSTALLED
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.recording.metadata import QosProfile, Topic

# State: the newest value, also for who comes late (a latched topic).
LATCHED = QoSProfile(
    depth=1,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)
# Events: every one arrives, in order.
EVENTS = QoSProfile(depth=100, reliability=ReliabilityPolicy.RELIABLE)
# Motion: every frame arrives, also at a reader that stalls for seconds; one that wants the newest
# only asks for best effort.
STREAM = QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE)
# Moves by hand: of each only the newest counts, and a lost one is not sent again.
NEWEST = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
# Services, at both ends: rclpy's own depth of 10 loses requests, or answers, of a class that calls
# at once.
SERVICES = QoSProfile(depth=1000, reliability=ReliabilityPolicy.RELIABLE)
# State whose every change counts: as latched, and changes in quick succession all arrive.
LATCHED_EVENTS = QoSProfile(
    depth=10,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
)


def topic_of(name: str, ends: list[TopicEndpointInfo]) -> Topic:
    """Return what a bag says of a topic with these publishers."""
    return Topic(
        name, ends[0].topic_type, tuple(map(quality_of, ends)), str(ends[0].topic_type_hash)
    )


def quality_of(end: TopicEndpointInfo) -> QosProfile:
    """Return the QoS of a topic's publisher or subscription."""
    qos = end.qos_profile
    return QosProfile(
        history=qos.history.name.lower(),
        depth=qos.depth,
        reliability=qos.reliability.name.lower(),
        durability=qos.durability.name.lower(),
        deadline_ns=qos.deadline.nanoseconds,
        lifespan_ns=qos.lifespan.nanoseconds,
        liveliness=qos.liveliness.name.lower(),
        lease_ns=qos.liveliness_lease_duration.nanoseconds,
    )


def profile(topic: Topic, depth: int) -> QoSProfile:
    """Return the strongest quality that all of the topic's publishers offer."""
    return QoSProfile(
        depth=depth,
        reliability=(
            ReliabilityPolicy.RELIABLE if topic.reliable else ReliabilityPolicy.BEST_EFFORT
        ),
        durability=(
            DurabilityPolicy.TRANSIENT_LOCAL if topic.latched else DurabilityPolicy.VOLATILE
        ),
    )


def message_class(kind: str) -> Any:
    """Return the class of a type such as std_msgs/msg/String; raise BadInput without one."""
    try:
        package, folder, name = kind.split("/")
        return getattr(importlib.import_module(f"{package}.{folder}"), name)
    except (ImportError, AttributeError, ValueError):
        raise BadInput(TYPE_NOT_INSTALLED(type=kind)) from None
