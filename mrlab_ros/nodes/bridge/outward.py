"""Forwards topics from the graph to zenoh, undecoded, each message with its stamps.

The thread that receives from the graph also publishes what may be dropped. What must arrive is
published by a second thread, so that a client that does not read delays no motion. A stream that
no client subscribes to is not received at all.

Limits the rates of topics: a message that comes too early waits until it is due.

Sends to clients in a separate thread, so that a slow client delays no other work.

Grants streams to publishers that put them on zenoh themselves (core.bridge.direct).
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.serialization import deserialize_message
from rclpy.subscription import Subscription
from rclpy.topic_endpoint_info import TopicEndpointInfo

from mrlab_ros.adapters.zenoh.port import Declared, Publisher
from mrlab_ros.core.bridge import direct, rules
from mrlab_ros.core.bridge.latency import Ledger, attachment
from mrlab_ros.core.bridge.rules import (
    SECOND,
    Congestion,
    Direction,
    RateCap,
    TopicRule,
)
from mrlab_ros.nodes.bridge.routes import BridgeContext, Count, Route, TopicRoutes, profile
from mrlab_ros.ros.arrivals import Arrivals, OnMessage
from mrlab_ros.ros.node import HiddenNode
from mrlab_ros.ros.worker import Worker

# Bytes in the queue; beyond it the oldest messages are dropped, so that the newest state arrives.
ROOM = 64 * 1024 * 1024
# Time that a stopped sender has to send its queue, s.
STOP_TIMEOUT_S = 2.0


class Sender(Worker):
    """A worker with a queue of at most `room` bytes.

    warn_once: logs a text, each text once.
    """

    def __init__(self, name: str, warn_once: Callable[[str], None], room: int = ROOM) -> None:
        def on_drop() -> None:
            warn_once(
                f"a client reads its messages too slowly: more than {room / 1e6:g} MB were "
                "queued, and the oldest messages were dropped; check the client's network"
            )

        def on_error(error: Exception) -> None:  # the client, or the topic, may have gone
            warn_once(f"a message was lost: {type(error).__name__}: {error}")

        super().__init__(name, capacity=room, on_drop=on_drop, on_error=on_error)

    def stop(self) -> None:
        """Send the queue, for STOP_TIMEOUT_S at most, and end."""
        self.close(STOP_TIMEOUT_S)


# A message's CDR and when it was published, ns since 1970.
Message = tuple[bytes, int]


class RateCaps:
    """Lets messages of each limited topic through at most at its rate, the newest each time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._waiting: dict[RateCap[Message], OnMessage] = {}
        self._worker = Worker("bridge_caps", self._emit_due, self._until_due)

    def stop(self) -> None:
        """Drop what waits, and end."""
        with self._lock:
            self._waiting.clear()
        self._worker.close()

    def limit(self, max_rate: float, emit: OnMessage) -> OnMessage:
        """Return a callback that calls `emit` at most at `max_rate`, Hz.

        `emit` must neither wait nor raise.
        """
        cap: RateCap[Message] = RateCap(max_rate)

        def limited(payload: bytes, published_ns: int) -> None:
            # Emitted under the lock, so that a newer message never overtakes an older one.
            with self._lock:
                passed = cap.offer((payload, published_ns), time.monotonic_ns())
                if passed is not None:
                    emit(*passed)
                    return
                if cap in self._waiting:
                    return
                self._waiting[cap] = emit
            # Wakes the worker, which then waits until the message is due.
            self._worker.send(self._emit_due)

        return limited

    def _until_due(self) -> float | None:
        """Return the time until the next message is due, s; None where none waits."""
        with self._lock:
            due = [cap.due_ns for cap in self._waiting if cap.due_ns is not None]
        return max(min(due) - time.monotonic_ns(), 0) / SECOND if due else None

    def _emit_due(self) -> None:
        with self._lock:
            now = time.monotonic_ns()
            for cap, emit in list(self._waiting.items()):
                message = cap.take(now)
                if message is not None:
                    emit(*message)
                if cap.due_ns is None:
                    del self._waiting[cap]


class Direct:
    """The offers of publishers that put their topics on zenoh themselves, and the grants.

    settle() and withdraw() are for one thread. on_offer: called in any thread when an offer has
    come or gone.
    """

    def __init__(
        self, bridge: BridgeContext, ledger: Ledger, on_offer: Callable[[], None]
    ) -> None:
        self._bridge = bridge
        self._ledger = ledger
        self._on_change = on_offer
        self._offers = bridge.key(direct.OFFERS)
        self._offered: set[str] = set()
        self._grants: dict[str, Declared] = {}
        session = bridge.session
        self._declared = [
            session.follow_tokens(f"{self._offers}/**", self._on_offer),
            session.subscriber(
                bridge.key(direct.REPORTS), self._admits, self._on_report, late=False
            ),
        ]

    def stop(self) -> None:
        """Take no further offers and reports."""
        for declared in self._declared:
            declared.undeclare()

    def settle(self, name: str, rule: TopicRule | None) -> bool:
        """Grant a topic by its rule where it is offered; return whether it is granted now.

        rule: None where it may not be.
        """
        if rule is None or name not in self._offered:
            self.withdraw(name)
        elif name not in self._grants:
            token = self._bridge.key(direct.grant(name, rule))
            self._grants[name] = self._bridge.session.token(token)
        return name in self._grants

    def withdraw(self, name: str) -> None:
        """Take the grant of a topic back, if there is one."""
        grant = self._grants.pop(name, None)
        if grant is not None:
            grant.undeclare()

    def _on_offer(self, key: str, there: bool) -> None:
        (self._offered.add if there else self._offered.discard)(key.removeprefix(self._offers))
        self._on_change()

    def _admits(self, size: int) -> bool:
        return size <= direct.LARGEST_REPORT

    def _on_report(self, payload: bytes) -> None:
        try:
            carried = direct.reported(payload)
        except (TypeError, ValueError) as error:
            self._bridge.warn_of_loss(error)
            return
        count = self._bridge.counts.get(self._bridge.key(carried.name))
        if count is None or carried.name not in self._grants:  # closed meanwhile
            return
        count.messages += len(carried.delays_ns)
        count.bytes += carried.bytes
        note = self._ledger.window(carried.name).add
        for delay_ns in carried.delays_ns:
            note(delay_ns)


# How long a stream is received on after its last zenoh subscriber has gone, s: a page that is
# loaded again finds it running.
LINGER_S = 5.0


@dataclass
class OutRoute(Route):
    """ends: the topic's publishers.

    subscribe: opens its subscription. always: it is received without a zenoh subscriber, too.
    grantable: the rule by which its publisher may put it itself; None: it may not. direct: it
    does, so that it is not received here. unheard_since: when its last zenoh subscriber had gone,
    s.
    """

    publisher: Publisher
    token: Declared
    subscribe: Callable[[], Subscription]
    always: bool
    grantable: TopicRule | None
    direct: bool = False
    subscription: Subscription | None = None
    unheard_since: float | None = None

    def heard(self) -> bool:
        """Return whether messages go from the graph to a zenoh subscriber now."""
        subscription = self.subscription
        try:
            matched = self.direct or (
                subscription is not None and subscription.get_publisher_count() > 0
            )
            return matched and self.publisher.has_subscriber()
        except Exception:  # closed meanwhile, or the context is shut down
            return False


class Outward(TopicRoutes[OutRoute]):
    """The routes from the graph to zenoh. All methods but `heard` are for one thread."""

    def __init__(
        self, bridge: BridgeContext, ledger: Ledger, lab: str, on_match: Callable[[], None]
    ) -> None:
        """lab: the id of this lab; what another lab says of itself is not forwarded.

        on_match: called in any thread when `match` is to be called.
        """
        super().__init__(bridge)
        self._ledger = ledger
        self._lab = lab
        self._on_match = on_match
        self._direct = Direct(bridge, ledger, on_match)
        self._caps = RateCaps()
        self._must_arrive = Sender("bridge_sender", bridge.warn_once)
        # No executor spins this node: its subscriptions have a thread that does nothing else.
        self._receiver = HiddenNode("_bridge_receiver", bridge.streams.context)
        self._arrivals = Arrivals("bridge_out", bridge.warn_of_loss)

    def stop(self) -> None:
        """Stop receiving, publish what waits, close all routes."""
        self._direct.stop()
        for route in self._routes.values():
            self._unsubscribe(route)
        self._arrivals.close()
        self._caps.stop()
        self._must_arrive.stop()
        self.keep({})
        self._receiver.destroy_node()

    def heard(self) -> dict[str, bool]:
        """Return for every key whether its messages reach a zenoh subscriber."""
        return {self._bridge.key(n): route.heard() for n, route in list(self._routes.items())}

    def match(self) -> None:
        """Receive the streams with a zenoh subscriber, and those that had one a moment ago.

        What its only publisher puts on zenoh itself is not received.
        """
        now = time.monotonic()
        for name, route in self._routes.items():
            route.direct = self._direct.settle(name, route.grantable if route.ends == 1 else None)
            if route.direct:
                self._unsubscribe(route)
            elif route.always or route.publisher.has_subscriber():
                route.unheard_since = None
                if route.subscription is None:
                    route.subscription = route.subscribe()
            elif route.unheard_since is None:
                route.unheard_since = now
            elif now - route.unheard_since > LINGER_S:
                self._unsubscribe(route)

    def _unsubscribe(self, route: OutRoute) -> None:
        subscription, route.subscription = route.subscription, None
        if subscription is not None:
            self._arrivals.remove(subscription)
            self._receiver.destroy_subscription(subscription)

    def _count_ends(self, name: str) -> int:
        count: int = self._bridge.streams.count_publishers(name)
        return count

    def _ends(self, name: str) -> list[TopicEndpointInfo]:
        ends: list[TopicEndpointInfo] = self._bridge.streams.get_publishers_info_by_topic(name)
        return ends

    def _open(self, name: str, rule: TopicRule, route: Route, kind: Any) -> None:
        bridge, type_name, qos = self._bridge, route.type, route.qos
        key, session = bridge.key(name), bridge.session
        count = bridge.count(key, type_name, Direction.OUT.value)
        # Late joiners of latched topics, and counted messages, must get each one.
        always = qos.latched or rule.congestion is Congestion.BLOCK
        publisher = session.publisher(
            key, rule, rule.history if qos.latched else 0, None if always else self._on_match
        )
        token = session.token(rules.topic_token(session.zid, Direction.OUT, key, type_name, qos))
        on_message = self._emitter(name, publisher, count)
        if self._lab and "lab" in kind.get_fields_and_field_types():
            on_message = self._own(kind, on_message)
        if rule.congestion is Congestion.BLOCK:
            on_message = self._queued(on_message)
        if rule.max_rate:
            on_message = self._caps.limit(rule.max_rate, on_message)

        def subscribe() -> Subscription:
            subscription = self._receiver.create_subscription(
                kind,
                name,
                _unused,
                profile(qos),
                raw=True,
                event_callbacks=SubscriptionEventCallbacks(use_default_callbacks=False),
            )
            if qos.latched or rule.depth == 1:  # only the newest counts
                self._arrivals.add(subscription, on_message)
            else:
                self._arrivals.add(subscription, on_message, self._gap(name, count))
            return subscription

        self._routes[name] = OutRoute(
            type_name,
            qos,
            route.ends,
            publisher,
            token,
            subscribe,
            always,
            rule if not always and direct.grantable(rule) else None,
        )
        self.match()

    def _close(self, name: str) -> None:
        route = self._routes.pop(name)
        self._unsubscribe(route)
        self._direct.withdraw(name)
        route.token.undeclare()
        route.publisher.undeclare()
        self._ledger.forget(name)
        self._bridge.close(self._bridge.key(name))

    def _emitter(self, name: str, publisher: Publisher, count: Count) -> OnMessage:
        """Return a callback that publishes a message and records its delay.

        Latched messages older than the route are not timed.
        """
        put, note, warn_of_loss = (
            publisher.put,
            self._ledger.window(name).add,
            self._bridge.warn_of_loss,
        )
        since_ns = time.monotonic_ns()

        def emit(payload: bytes, published_ns: int) -> None:
            count.messages += 1
            count.bytes += len(payload)
            now = time.time_ns()
            if now - published_ns <= time.monotonic_ns() - since_ns:
                note(now - published_ns)
            try:
                put(payload, attachment(count.messages, published_ns, now))
            except Exception as error:  # the route may be closed meanwhile
                warn_of_loss(error)

        return emit

    def _gap(self, name: str, count: Count) -> Callable[[int], None]:
        def on_gap(missing: int) -> None:
            # Numbers of several publishers say nothing.
            if self._receiver.count_publishers(name) == 1:
                count.lost += missing
                self._bridge.warn_once(
                    f"messages of {name} were lost on their way to the bridge: it stood still, or "
                    "they are published faster than it forwards them. The bridge's statistics "
                    "count them (lost)"
                )

        return on_gap

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


def _unused(_: bytes) -> None:
    """Stand in for a callback: no executor spins the subscription's node."""
