"""Routes of topics, whichever way they go: opened, renewed and closed as the graph changes.

Shared context of all routes: zenoh session, ROS node, counters, warn-once log.

Keeps the newest messages of topics that zenoh does not carry, for programs of this machine.
"""

from __future__ import annotations

import base64
import importlib
import json
import time
from abc import ABC, abstractmethod
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.topic_endpoint_info import TopicEndpointInfo

from mrlab_ros.adapters.zenoh.port import Query, Session
from mrlab_ros.core.bridge.links import key_of
from mrlab_ros.core.bridge.rules import Direction, TopicQos, TopicRule

# Reports come once a second; an older one says nothing of now, s.
KEPT_FOR_S = 5.0
# More than a class of clients reports in that time.
MOST = 512


class Kept:
    """The messages of one topic from the last KEPT_FOR_S, as CDR."""

    def __init__(self, node: Node, kind: Any, topic: str, quality: QoSProfile) -> None:
        self._messages: deque[tuple[float, bytes]] = deque(maxlen=MOST)
        node.create_subscription(kind, topic, self._keep, quality, raw=True)

    def _keep(self, message: bytes) -> None:
        self._messages.append((time.monotonic(), message))

    def answer(self, query: Query) -> None:
        """Reply with a JSON list of [age in s, CDR as base64], the oldest first."""
        now = time.monotonic()
        found = [
            [now - at, base64.b64encode(message).decode()]
            for at, message in list(self._messages)
            if now - at <= KEPT_FOR_S
        ]
        query.reply(json.dumps(found).encode())


@dataclass
class Count:
    """Traffic of one key since the bridge started; lost: before they reached the bridge."""

    type: str
    direction: str
    messages: int = 0
    bytes: int = 0
    refused: int = 0
    lost: int = 0

    def add(self, other: Count) -> None:
        """Add the traffic of another key."""
        self.messages += other.messages
        self.bytes += other.bytes
        self.refused += other.refused
        self.lost += other.lost


# Keys without a route whose traffic is known apart; that of older ones is known as a sum.
MOST_CLOSED = 200


@dataclass
class BridgeContext:
    """State that the routes share.

    streams: the node of the forwarding publishers, subscriptions and clients; it is spun in a
    thread of its own. prefix: what every key begins with. warn_once: logs a text, each text once.
    counts: by key. gone: of all keys whose routes were closed long ago.
    """

    session: Session
    streams: Node
    prefix: str
    warn_once: Callable[[str], None]
    counts: dict[str, Count] = field(default_factory=dict)
    gone: Count = field(default_factory=lambda: Count("", ""))
    _closed: dict[str, None] = field(default_factory=dict)

    def key(self, name: str) -> str:
        return key_of(name, self.prefix)

    def count(self, key: str, type_name: str, direction: str) -> Count:
        """Return the count of a key that gets a route."""
        self._closed.pop(key, None)
        return self.counts.setdefault(key, Count(type_name, direction))

    def close(self, key: str) -> None:
        """Note that a key has no route any more."""
        self._closed[key] = None
        if len(self._closed) > MOST_CLOSED:
            oldest = next(iter(self._closed))
            del self._closed[oldest]
            self.gone.add(self.counts.pop(oldest))

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


@dataclass
class Route:
    """The route of one topic. ends: its publishers, or its subscriptions, in the graph at the last
    check: those that the route is for."""

    type: str
    qos: TopicQos
    ends: int


R = TypeVar("R", bound=Route)


class TopicRoutes(ABC, Generic[R]):
    """The routes of one direction."""

    def __init__(self, bridge: BridgeContext) -> None:
        self._bridge = bridge
        self._routes: dict[str, R] = {}

    def keep(self, wanted: dict[str, tuple[TopicRule, str]], thorough: bool = True) -> None:
        """Open and close routes until they are those of `wanted`: name -> rule and type.

        Unless `thorough`, a topic whose number of ends is unchanged is not checked further.
        """
        for name in [n for n in self._routes if n not in wanted]:
            self._close(name)
        for name, (rule, type_name) in wanted.items():
            self._renew(name, rule, type_name, thorough)
            self._bridge.give_way()

    def _renew(self, name: str, rule: TopicRule, type_name: str, thorough: bool) -> None:
        """Open a topic's route, or open it anew where its type or its QoS is another now."""
        bridge = self._bridge
        known = self._routes.get(name)
        # Counting takes a fifth of the time of the full information.
        count = self._count_ends(name)
        if known is not None and not thorough and (known.ends, known.type) == (count, type_name):
            return
        qos = bridge.quality(self._ends(name), rule, type_name)
        if known is not None and (known.qos, known.type) == (qos, type_name):
            known.ends = count
            return
        if known is not None:
            self._close(name)
        kind = bridge.kind(name, type_name)
        if qos is not None and kind is not None:
            self._open(name, rule, Route(type_name, qos, count), kind)

    @abstractmethod
    def _count_ends(self, name: str) -> int:
        """Return how many ends of a topic there are in the graph."""

    @abstractmethod
    def _ends(self, name: str) -> list[TopicEndpointInfo]:
        """Return the ends of a topic in the graph."""

    @abstractmethod
    def _open(self, name: str, rule: TopicRule, route: Route, kind: Any) -> None:
        """Open a topic's route; kind: the class of its type."""

    @abstractmethod
    def _close(self, name: str) -> None:
        """Close a topic's route."""
