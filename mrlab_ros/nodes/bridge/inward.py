"""Forwards topics from zenoh to the graph; each message is checked before it is published.

Closes the links of people who take more than their share.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from rclpy.exceptions import InvalidHandle
from rclpy.publisher import Publisher
from rclpy.serialization import deserialize_message
from rclpy.topic_endpoint_info import TopicEndpointInfo

from mrlab_ros.adapters.zenoh.links import LinkSockets
from mrlab_ros.adapters.zenoh.port import Declared
from mrlab_ros.core.bridge import rules
from mrlab_ros.core.bridge.guests import Cut, Guests, Link
from mrlab_ros.core.bridge.links import LOCAL_PROTOCOL
from mrlab_ros.core.bridge.rules import Direction, TopicRule
from mrlab_ros.core.runtime.bucket import Bucket
from mrlab_ros.nodes.bridge.routes import Count, Route, TopicRoutes, profile
from mrlab_ros.ros.worker import Worker


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
        self._bridge.close(self._bridge.key(name))

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


# How often the bytes of each link are read, s.
PERIOD_S = 0.2


class GuestWatch:
    """Follows the links of a session; `on_link` is for the session. log: gets a sentence."""

    def __init__(self, guests: Guests, log: Callable[[str], None]) -> None:
        self._guests = guests
        self._log = log
        self._sockets = LinkSockets()
        self._due = 0.0
        self._worker = Worker("bridge_guests", self._read, self._until_due)

    def stop(self) -> None:
        """End; links stay as they are."""
        self._worker.close()

    def on_link(self, link: Link, opened: bool) -> None:
        """Take a link that was opened or closed; this machine's user is no guest."""
        if link.local.startswith(LOCAL_PROTOCOL) or link.remote.startswith(LOCAL_PROTOCOL):
            return
        self._worker.send(partial(self._opened if opened else self._closed, link))

    def _opened(self, link: Link) -> None:
        self._cut(self._guests.opened(link, time.monotonic()))
        self._read_where_due()

    def _closed(self, link: Link) -> None:
        self._guests.closed(link)
        self._sockets.forget(link)
        self._read_where_due()

    def _until_due(self) -> float:
        return max(self._due - time.monotonic(), 0.0)

    def _read_where_due(self) -> None:
        # A client that opens links without end must not keep the bytes from being read.
        if self._until_due() == 0.0:
            self._read()

    def _read(self) -> None:
        now = time.monotonic()
        self._due = now + PERIOD_S
        for cut in self._guests.received(self._sockets.received(self._guests.links), now):
            self._cut(cut)

    def _cut(self, cut: Cut | None) -> None:
        if cut is None:
            return
        for link in cut.links:
            self._sockets.shut(link)
        if cut.words:
            self._log(cut.words)
