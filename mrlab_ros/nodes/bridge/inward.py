"""Forwards topics from zenoh to the graph; each message is checked before it is published."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.publisher import Publisher
from rclpy.serialization import deserialize_message

from mrlab_ros.adapters.zenoh_session import Declared
from mrlab_ros.core.bridge import rules
from mrlab_ros.core.bridge.rules import Direction, TopicQos, TopicRule
from mrlab_ros.core.bucket import Bucket
from mrlab_ros.nodes.bridge.context import BridgeContext, Count, profile


@dataclass
class InRoute:
    """The route of one topic; readers: its subscriptions at the last check."""

    type: str
    qos: TopicQos
    readers: int
    publisher: Publisher
    subscriber: Declared
    token: Declared


class Inward:
    """The routes from zenoh to the graph."""

    def __init__(self, bridge: BridgeContext) -> None:
        self._bridge = bridge
        self._routes: dict[str, InRoute] = {}

    def keep(self, wanted: dict[str, tuple[TopicRule, str]], thorough: bool = True) -> None:
        """Open and close routes until they are those of `wanted`: name -> rule and type.

        Unless `thorough`, a topic whose number of subscriptions is unchanged is not checked
        further.
        """
        for name in [n for n in self._routes if n not in wanted]:
            self._close(name)
        for name, (rule, type_name) in wanted.items():
            self._renew(name, rule, type_name, thorough)
            self._bridge.give_way()

    def _renew(self, name: str, rule: TopicRule, type_name: str, thorough: bool) -> None:
        bridge = self._bridge
        known = self._routes.get(name)
        readers = bridge.streams.count_subscribers(name)
        if (
            known is not None
            and not thorough
            and (known.readers, known.type) == (readers, type_name)
        ):
            return
        ends = bridge.streams.get_subscriptions_info_by_topic(name)
        qos = bridge.quality(ends, rule, type_name)
        if known is not None and (known.qos, known.type) == (qos, type_name):
            known.readers = readers
            return
        if known is not None:
            self._close(name)
        kind = bridge.kind(name, type_name)
        if qos is None or kind is None:
            return
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
        self._routes[name] = InRoute(type_name, qos, readers, publisher, subscriber, token)

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
