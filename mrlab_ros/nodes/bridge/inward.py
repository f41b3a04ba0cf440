"""Forwards topics from zenoh to the graph; each message is checked before it is published."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.publisher import Publisher
from rclpy.serialization import deserialize_message
from rclpy.topic_endpoint_info import TopicEndpointInfo

from mrlab_ros.adapters.zenoh.port import Declared
from mrlab_ros.core.bridge import rules
from mrlab_ros.core.bridge.rules import Direction, TopicRule
from mrlab_ros.core.runtime.bucket import Bucket
from mrlab_ros.nodes.bridge.context import Count, profile
from mrlab_ros.nodes.bridge.routes import Route, TopicRoutes


@dataclass
class InRoute(Route):
    """ends: the topic's subscriptions."""

    publisher: Publisher
    subscriber: Declared
    token: Declared


class Inward(TopicRoutes[InRoute]):
    """The routes from zenoh to the graph."""

    def _count_ends(self, name: str) -> int:
        count: int = self._bridge.streams.count_subscribers(name)
        return count

    def _ends(self, name: str) -> list[TopicEndpointInfo]:
        ends: list[TopicEndpointInfo] = self._bridge.streams.get_subscriptions_info_by_topic(name)
        return ends

    def _open(self, name: str, rule: TopicRule, route: Route, kind: Any) -> None:
        bridge, type_name, qos = self._bridge, route.type, route.qos
        key, session = bridge.key(name), bridge.session
        publisher = bridge.streams.create_publisher(kind, name, profile(qos))
        count = bridge.count(key, type_name, Direction.IN.value)
        subscriber = session.subscriber(
            key,
            self._admission(key, rule, count),
            self._receiver(key, kind, publisher, count),
            qos.latched and rule.history > 0,
        )
        token = session.token(rules.topic_token(session.zid, Direction.IN, key, type_name, qos))
        self._routes[name] = InRoute(type_name, qos, route.ends, publisher, subscriber, token)

    def _close(self, name: str) -> None:
        route = self._routes.pop(name)
        route.token.undeclare()
        route.subscriber.undeclare()
        self._bridge.streams.destroy_publisher(route.publisher)

    def _admission(self, key: str, rule: TopicRule, count: Count) -> Callable[[int], bool]:
        """Return what says whether a message of so many bytes may be read.

        zenoh has dropped most of what may not: see core.bridge.access.bounds().
        """
        largest, warn_once = rule.max_size, self._bridge.warn_once
        # A second of messages at once: many clients send at the same instant.
        bucket = Bucket(rule.max_rate, max(rule.max_rate, 1.0)) if rule.max_rate else None

        def admit(size: int) -> bool:
            if size > largest:
                warn_once(
                    f"a client published a message of more than {largest} bytes on {key}; such "
                    "messages are dropped (max_size in the allow-list)"
                )
            elif bucket is not None and not bucket.take(1, time.monotonic()):
                warn_once(
                    f"clients publish more than {rule.max_rate:g} messages a second on {key}; "
                    "further ones are dropped (max_rate in the allow-list)"
                )
            else:
                return True
            count.refused += 1
            return False

        return admit

    def _receiver(
        self, key: str, kind: Any, publisher: Publisher, count: Count
    ) -> Callable[[bytes], None]:
        def receive(payload: bytes) -> None:
            try:
                deserialize_message(payload, kind)
            except Exception:
                count.refused += 1
                self._bridge.warn_once(
                    f"a client published bytes on {key} that are not CDR of {count.type}; such "
                    "messages are dropped"
                )
                return
            try:
                publisher.publish(payload)
            except InvalidHandle:  # the route was closed meanwhile
                return
            count.messages += 1
            count.bytes += len(payload)

        return receive
