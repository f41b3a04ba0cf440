"""Shared context of all routes: zenoh session, ROS node, counters, warn-once log."""

from __future__ import annotations

import importlib
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

from mrlab_ros.adapters.zenoh.port import Session
from mrlab_ros.core.bridge.links import key_of
from mrlab_ros.core.bridge.rules import Direction, TopicQos, TopicRule


@dataclass
class Count:
    """Traffic of one key since the bridge started; lost: before they reached the bridge."""

    type: str
    direction: str
    messages: int = 0
    bytes: int = 0
    refused: int = 0
    lost: int = 0


@dataclass
class BridgeContext:
    """What the routes share.

    streams: the node of the forwarding publishers, subscriptions and clients; it is spun in a
    thread of its own. prefix: what every key begins with. warn_once: logs a text, each text once.
    counts: by key.
    """

    session: Session
    streams: Node
    prefix: str
    warn_once: Callable[[str], None]
    counts: dict[str, Count] = field(default_factory=dict)

    def key(self, name: str) -> str:
        return key_of(name, self.prefix)

    def count(self, key: str, type_name: str, direction: str) -> Count:
        return self.counts.setdefault(key, Count(type_name, direction))

    def kind(self, name: str, type_name: str) -> Any:
        """Return the class of a type such as mrlab_msgs/srv/Trigger.

        Where its package is not installed, log that once and return None.
        """
        package, folder, kind = type_name.split("/")
        try:
            return getattr(importlib.import_module(f"{package}.{folder}"), kind)
        except (ImportError, AttributeError):
            self.warn_once(
                f"{name} is not forwarded: its type {type_name} is not installed here; install "
                "its package and restart the bridge"
            )
            return None

    @staticmethod
    def give_way() -> None:
        """Let the forwarding thread go on: a check of the graph takes milliseconds."""
        time.sleep(0)

    def warn_of_loss(self, error: Exception) -> None:
        self.warn_once(f"a message was lost: {type(error).__name__}: {error}")

    def quality(
        self, ends: list[TopicEndpointInfo], rule: TopicRule, type_name: str
    ) -> TopicQos | None:
        """Return a QoS that is compatible with all `ends` but the bridge's own; None without any.

        A subscription requests no more than every publisher offers; a publisher offers as much
        as any subscription requests.
        """
        others = [
            end
            for end in ends
            if end.topic_type == type_name and end.node_name != self.streams.get_name()
        ]
        if not others:
            return None
        suits = all if rule.direction is Direction.OUT else any
        profiles = [end.qos_profile for end in others]
        return TopicQos(
            reliable=suits(p.reliability is ReliabilityPolicy.RELIABLE for p in profiles),
            latched=suits(p.durability is DurabilityPolicy.TRANSIENT_LOCAL for p in profiles),
            depth=rule.depth,
            type_hash=str(others[0].topic_type_hash),
        )


def profile(qos: TopicQos) -> QoSProfile:
    """Return rclpy's QoS profile."""
    return QoSProfile(
        depth=qos.depth,
        reliability=ReliabilityPolicy.RELIABLE if qos.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=(
            DurabilityPolicy.TRANSIENT_LOCAL if qos.latched else DurabilityPolicy.VOLATILE
        ),
    )
