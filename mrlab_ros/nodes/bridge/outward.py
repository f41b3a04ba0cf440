"""Forwards topics from the graph to zenoh, undecoded, each message with its stamps.

The thread that receives from the graph also publishes what may be dropped. What must arrive is
published by a second thread, so that a client that does not read delays no motion.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial
from typing import Any

from rclpy.serialization import deserialize_message
from rclpy.subscription import Subscription

from mrlab_ros.adapters.zenoh_session import Declared, Publisher
from mrlab_ros.core.bridge import rules
from mrlab_ros.core.bridge.latency import Ledger, attachment
from mrlab_ros.core.bridge.rules import (
    Congestion,
    Direction,
    TopicQos,
    TopicRule,
)
from mrlab_ros.nodes.bridge.context import BridgeContext, Count, profile
from mrlab_ros.nodes.bridge.rate_caps import RateCaps
from mrlab_ros.nodes.bridge.sender import Sender
from mrlab_ros.ros.raw_callback import OnMessage, Stamped


@dataclass
class OutRoute:
    """The route of one topic; sources: its publishers at the last check."""

    type: str
    qos: TopicQos
    sources: int
    publisher: Publisher
    token: Declared
    subscription: Subscription


class Outward:
    """The routes from the graph to zenoh."""

    def __init__(self, bridge: BridgeContext, ledger: Ledger, lab: str) -> None:
        """lab: the id of this lab; what another lab says of itself is not forwarded."""
        self._bridge = bridge
        self._ledger = ledger
        self._lab = lab
        self._caps = RateCaps()
        self._routes: dict[str, OutRoute] = {}
        self._must_arrive = Sender("bridge_sender", bridge.warn_once)

    def stop(self) -> None:
        """Stop receiving, publish what waits, close all routes."""
        for route in self._routes.values():
            self._bridge.streams.destroy_subscription(route.subscription)
        self._caps.stop()
        self._must_arrive.stop()
        self.keep({})

    def keep(self, wanted: dict[str, tuple[TopicRule, str]], thorough: bool = True) -> None:
        """Open and close routes until they are those of `wanted`: name -> rule and type.

        Unless `thorough`, a topic whose number of publishers is unchanged is not checked further.
        """
        for name in [n for n in self._routes if n not in wanted]:
            self._close(name)
        for name, (rule, type_name) in wanted.items():
            self._renew(name, rule, type_name, thorough)
            self._bridge.give_way()

    def subscribed(self) -> dict[str, bool]:
        """Return for every key whether it has a zenoh subscriber."""
        bridge = self._bridge
        return {bridge.key(n): r.publisher.has_subscriber() for n, r in list(self._routes.items())}

    def _renew(self, name: str, rule: TopicRule, type_name: str, thorough: bool) -> None:
        bridge = self._bridge
        known = self._routes.get(name)
        # Counting takes a fifth of the time of the full information.
        sources = bridge.streams.count_publishers(name)
        if (
            known is not None
            and not thorough
            and (known.sources, known.type) == (sources, type_name)
        ):
            return
        infos = bridge.streams.get_publishers_info_by_topic(name)
        qos = bridge.quality(infos, rule, type_name)
        if known is not None and (known.qos, known.type) == (qos, type_name):
            known.sources = sources
            return
        if known is not None:
            self._close(name)
        kind = bridge.kind(name, type_name)
        if qos is None or kind is None:
            return
        key, session = bridge.key(name), bridge.session
        count = bridge.count(key, type_name, Direction.OUT.value)
        publisher = session.publisher(key, rule, rule.history if qos.latched else 0)
        token = session.token(rules.topic_token(session.zid, Direction.OUT, key, type_name, qos))
        on_message = self._emitter(name, publisher, count)
        if self._lab and "lab" in kind.get_fields_and_field_types():
            on_message = self._own(kind, on_message)
        if rule.congestion is Congestion.BLOCK:
            on_message = self._queued(on_message)
        if rule.max_rate:
            on_message = self._caps.limit(rule.max_rate, on_message)
        subscription = bridge.streams.create_subscription(
            kind, name, Stamped(on_message), profile(qos), raw=True
        )
        self._routes[name] = OutRoute(type_name, qos, sources, publisher, token, subscription)

    def _close(self, name: str) -> None:
        route = self._routes.pop(name)
        self._bridge.streams.destroy_subscription(route.subscription)
        route.token.undeclare()
        route.publisher.undeclare()
        self._ledger.forget(name)

    def _emitter(self, name: str, publisher: Publisher, count: Count) -> OnMessage:
        """Return a callback that publishes a message and records its delay.

        Latched messages older than the route are not timed.
        """
        put, note, warn_of_loss = (
            publisher.put,
            self._ledger.window(name).add,
            self._bridge.warn_of_loss,
        )
        since = time.time_ns()

        def emit(payload: bytes, published_ns: int) -> None:
            count.messages += 1
            count.bytes += len(payload)
            now = time.time_ns()
            if published_ns >= since:
                note(now - published_ns)
            try:
                put(payload, attachment(count.messages, published_ns, now))
            except Exception as error:  # the route may be closed meanwhile
                warn_of_loss(error)

        return emit

    def _own(self, kind: Any, emit: OnMessage) -> OnMessage:
        """Forward what names this lab, or none."""
        own = self._lab.encode()

        def emit_own(payload: bytes, published_ns: int) -> None:
            # Most messages need not be decoded for that.
            if own in payload or not deserialize_message(payload, kind).lab:
                emit(payload, published_ns)

        return emit_own

    def _queued(self, emit: OnMessage) -> OnMessage:
        send = self._must_arrive.send
        return lambda payload, published: send(partial(emit, payload, published), len(payload))
