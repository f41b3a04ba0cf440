"""Carries the graph over zenoh, both ways, as raw CDR.

A thread of its own receives from the graph and puts what may be dropped. Another puts what must
arrive, so that a client that does not read holds up nobody's motion.
"""

from __future__ import annotations

import importlib
import json
import queue
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml
from rclpy.client import Client
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher as GraphPublisher
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.subscription import Subscription
from rclpy.topic_endpoint_info import TopicEndpointInfo

from mrlab_ros import host, share
from mrlab_ros.adapters.zenoh_session import (
    LOOPBACK,
    Declared,
    Publisher,
    Query,
    Session,
    ZenohSession,
    configuration,
)
from mrlab_ros.core import bridge_rules
from mrlab_ros.core.bridge_rules import (
    Congestion,
    Direction,
    RateCap,
    ServiceRule,
    TopicQos,
    TopicRule,
)
from mrlab_ros.core.errors import BadInput
from mrlab_ros.wait_set import WaitSetThread

STATISTICS = "/@mrlab/bridge/statistics"


@dataclass
class Count:
    """What went over one key since the bridge started."""

    type: str
    direction: str
    messages: int = 0
    bytes: int = 0
    refused: int = 0


@dataclass
class OutRoute:
    """A topic of the graph that goes to zenoh."""

    rule: TopicRule
    type: str
    qos: TopicQos
    count: Count
    publisher: Publisher
    token: Declared
    subscription: Subscription
    cap: RateCap[bytes] | None


@dataclass
class InRoute:
    """A topic of zenoh that goes to the graph."""

    type: str
    qos: TopicQos
    publisher: GraphPublisher
    subscriber: Declared
    token: Declared


@dataclass
class ServiceRoute:
    """A service of the graph that zenoh may call. It is offered once its server is matched."""

    name: str
    type: str
    rule: ServiceRule
    count: Count
    client: Client
    declared: list[Declared] = field(default_factory=list)
    # sequence number -> the question and when it is given up, ns
    waiting: dict[int, tuple[Query, int]] = field(default_factory=dict)


class BridgeNode(Node):
    """Looks at the graph, carries what the allow-list names, forgets what is gone."""

    def __init__(
        self,
        *,
        context: Context | None = None,
        parameter_overrides: list[Parameter] | None = None,
        session: Session | None = None,
    ) -> None:
        super().__init__("bridge", context=context, parameter_overrides=parameter_overrides)
        self._rules = _rules(Path(self._setting("allow_list", "")))
        self._prefix = bridge_rules.checked_prefix(self._setting("prefix", ""))
        settings = self._zenoh_settings()
        self._session: Session = session or ZenohSession(settings)
        self._started = time.monotonic()
        self._lock = threading.Lock()
        self._counts: dict[str, Count] = {}
        self._out: dict[str, OutRoute] = {}
        self._in: dict[str, InRoute] = {}
        self._calls: dict[str, ServiceRoute] = {}
        self._complained: set[str] = set()
        self._must_arrive: queue.SimpleQueue[tuple[Publisher, bytes] | None] = queue.SimpleQueue()
        self._sender = threading.Thread(target=self._send, name="bridge_sender", daemon=True)
        # The forwarding entities are on a node that no executor spins.
        self._streams = Node(
            "bridge_streams",
            context=context,
            start_parameter_services=False,
            enable_rosout=False,
            use_global_arguments=False,
        )
        self._receiver = WaitSetThread(
            self.context, "bridge_receiver", self._send_due, self._complain_of
        )
        zid = self._session.zid
        self._declared = [
            self._session.token(bridge_rules.bridge_token(zid)),
            self._session.queryable(self._key(STATISTICS), self._answer_statistics),
        ]
        self._sender.start()
        self._receiver.start()
        period = self._setting("discovery_period", 0.2)
        self._timer = self.create_timer(period, self.discover)
        self.get_logger().info(
            f"carries {len(self._rules.topics)} kinds of topics and "
            f"{len(self._rules.services)} of services under '{self._prefix or '/'}', zenoh {zid}"
        )

    def _setting(self, name: str, default: Any) -> Any:
        return self.declare_parameter(name, default).value

    def _zenoh_settings(self) -> Any:
        file = self._setting("zenoh_config", "")
        mode = self._setting("mode", "peer")
        listen = tuple(self._setting("listen", list(LOOPBACK)))
        connect = tuple(e for e in self._setting("connect", [""]) if e)
        insecure = self._setting("insecure", False)
        if file:
            return configuration(Path(file))
        listen = tuple(endpoint for endpoint in listen if endpoint)
        bridge_rules.check_endpoints(listen, insecure)
        return configuration(mode=mode, listen=listen, connect=connect)

    def _key(self, name: str) -> str:
        return bridge_rules.key_of(name, self._prefix)

    # Looking at the graph

    def discover(self) -> None:
        """Carry what is new in the graph, let go what is gone, give up what waits too long."""
        self._discover_topics()
        self._discover_services()
        self._give_up()

    def _discover_topics(self) -> None:
        going_out: dict[str, tuple[TopicRule, str]] = {}
        coming_in: dict[str, tuple[TopicRule, str]] = {}
        for name, types in self.get_topic_names_and_types():
            for type_name in types:
                rule = self._rules.topic(name, type_name)
                if rule is not None:
                    out = rule.direction is Direction.OUT
                    (going_out if out else coming_in).setdefault(name, (rule, type_name))
        for name in [n for n in self._out if n not in going_out]:
            self._close_out(name)
        for name in [n for n in self._in if n not in coming_in]:
            self._close_in(name)
        for name, (rule, type_name) in going_out.items():
            self._renew_out(name, rule, type_name)
        for name, (rule, type_name) in coming_in.items():
            self._renew_in(name, rule, type_name)

    def _ends(
        self, ends: list[TopicEndpointInfo], rule: TopicRule, type_name: str
    ) -> TopicQos | None:
        """Return the quality that suits all of `ends` but the bridge's own; None without any."""
        others = [
            end
            for end in ends
            if end.topic_type == type_name and end.node_name != self._streams.get_name()
        ]
        if not others:
            return None
        return TopicQos(
            reliable=all(e.qos_profile.reliability is ReliabilityPolicy.RELIABLE for e in others),
            latched=all(
                e.qos_profile.durability is DurabilityPolicy.TRANSIENT_LOCAL for e in others
            ),
            depth=rule.depth,
            type_hash=str(others[0].topic_type_hash),
        )

    def _renew_out(self, name: str, rule: TopicRule, type_name: str) -> None:
        qos = self._ends(self.get_publishers_info_by_topic(name), rule, type_name)
        known = self._out.get(name)
        if known is not None and (known.qos, known.type) == (qos, type_name):
            return
        if known is not None:
            self._close_out(name)
        kind = self._kind(name, type_name)
        if qos is None or kind is None:
            return
        key = self._key(name)
        subscription = self._streams.create_subscription(
            kind, name, lambda _: None, _profile(qos), raw=True
        )
        publisher = self._session.publisher(key, rule, rule.history if qos.latched else 0)
        token = self._session.token(
            bridge_rules.topic_token(self._session.zid, Direction.OUT, key, type_name, qos)
        )
        cap: RateCap[bytes] | None = RateCap(rule.max_rate) if rule.max_rate else None
        count = self._count(key, type_name, Direction.OUT.value)
        route = OutRoute(rule, type_name, qos, count, publisher, token, subscription, cap)
        self._out[name] = route
        self._receiver.add_subscription(subscription, self._forwarder(route))

    def _close_out(self, name: str) -> None:
        route = self._out.pop(name)
        self._receiver.remove(route.subscription)
        self._streams.destroy_subscription(route.subscription)
        route.token.undeclare()
        route.publisher.undeclare()

    def _renew_in(self, name: str, rule: TopicRule, type_name: str) -> None:
        qos = self._ends(self.get_subscriptions_info_by_topic(name), rule, type_name)
        known = self._in.get(name)
        if known is not None and (known.qos, known.type) == (qos, type_name):
            return
        if known is not None:
            self._close_in(name)
        kind = self._kind(name, type_name)
        if qos is None or kind is None:
            return
        key = self._key(name)
        publisher = self._streams.create_publisher(kind, name, _profile(qos))
        count = self._count(key, type_name, Direction.IN.value)
        subscriber = self._session.subscriber(
            key, self._inward(key, kind, publisher, count), qos.latched
        )
        token = self._session.token(
            bridge_rules.topic_token(self._session.zid, Direction.IN, key, type_name, qos)
        )
        self._in[name] = InRoute(type_name, qos, publisher, subscriber, token)

    def _close_in(self, name: str) -> None:
        route = self._in.pop(name)
        route.token.undeclare()
        route.subscriber.undeclare()
        self._streams.destroy_publisher(route.publisher)

    def _discover_services(self) -> None:
        found: dict[str, tuple[ServiceRule, str]] = {}
        for name, types in self.get_service_names_and_types():
            # A client, the bridge's own too, keeps its service's name in the graph.
            for type_name in types if self.count_services(name) else ():
                rule = self._rules.service(name, type_name)
                if rule is not None:
                    found.setdefault(name, (rule, type_name))
        for name, route in list(self._calls.items()):
            if name not in found or found[name][1] != route.type:
                self._close_service(name)
        for name, (rule, type_name) in found.items():
            self._renew_service(name, rule, type_name)

    def _renew_service(self, name: str, rule: ServiceRule, type_name: str) -> None:
        route = self._calls.get(name)
        key = self._key(name)
        if route is None:
            kind = self._kind(name, type_name)
            if kind is None:
                return
            client = self._streams.create_client(kind, name)
            count = self._count(key, type_name, "service")
            route = ServiceRoute(name, type_name, rule, count, client)
            self._calls[name] = route
            self._receiver.add_client(client, self._answerer(route))
        if not route.declared and route.client.service_is_ready():
            token = bridge_rules.service_token(self._session.zid, key, type_name)
            route.declared = [
                self._session.queryable(key, self._asker(route)),
                self._session.token(token),
            ]

    def _close_service(self, name: str) -> None:
        route = self._calls.pop(name)
        for declared in route.declared:
            declared.undeclare()
        self._receiver.remove(route.client)
        with self._lock:
            waiting = list(route.waiting.values())
            route.waiting.clear()
            self._streams.destroy_client(route.client)
        for query, _ in waiting:
            self._refuse(
                route, query, f"the service {name} has gone; see what runs, then call again"
            )

    def _kind(self, name: str, type_name: str) -> Any:
        """Return the class of a type such as std_srvs/srv/Trigger, or None and complain once."""
        package, folder, kind = type_name.split("/")
        try:
            return getattr(importlib.import_module(f"{package}.{folder}"), kind)
        except (ImportError, AttributeError):
            self._complain(
                f"{name} has the type {type_name}, which is not installed here, so it is not "
                "carried; install its package and start the bridge again"
            )
            return None

    def _count(self, key: str, type_name: str, direction: str) -> Count:
        return self._counts.setdefault(key, Count(type_name, direction))

    # From the graph to zenoh

    def _forwarder(self, route: OutRoute) -> Callable[[bytes], None]:
        emit = self._emitter(route)
        cap = route.cap
        if cap is None:
            return emit

        def limited(payload: bytes) -> None:
            passed = cap.offer(payload, time.monotonic_ns())
            if passed is not None:
                emit(passed)

        return limited

    def _emitter(self, route: OutRoute) -> Callable[[bytes], None]:
        put, count = route.publisher.put, route.count
        waits = route.rule.congestion is Congestion.BLOCK

        def emit(payload: bytes) -> None:
            count.messages += 1
            count.bytes += len(payload)
            if waits:
                self._must_arrive.put((route.publisher, payload))
            else:
                put(payload)

        return emit

    def _send_due(self) -> int | None:
        """Send what a rate cap kept and is due; return ns until the next is, or None."""
        now, soonest = time.monotonic_ns(), None
        for route in list(self._out.values()):
            if route.cap is None or route.cap.due_ns is None:
                continue
            payload = route.cap.take(now)
            if payload is not None:
                self._emitter(route)(payload)
            elif soonest is None or route.cap.due_ns < soonest:
                soonest = route.cap.due_ns
        return None if soonest is None else soonest - now

    def _send(self) -> None:
        while (item := self._must_arrive.get()) is not None:
            publisher, payload = item
            try:
                publisher.put(payload)
            except Exception as error:  # its topic may have gone meanwhile
                self._complain_of(error)

    # From zenoh to the graph

    def _inward(
        self, key: str, kind: Any, publisher: GraphPublisher, count: Count
    ) -> Callable[[bytes], None]:
        def receive(payload: bytes) -> None:
            try:
                deserialize_message(payload, kind)
            except Exception:
                count.refused += 1
                self._complain(
                    f"a client sent {len(payload)} bytes on {key} that are not CDR of "
                    f"{count.type}; they were dropped"
                )
                return
            count.messages += 1
            count.bytes += len(payload)
            with self._lock:
                publisher.publish(payload)

        return receive

    def _asker(self, route: ServiceRoute) -> Callable[[Query], None]:
        service: Any = route.client.srv_type
        request_kind = service.Request
        bare = not request_kind.get_fields_and_field_types()

        def ask(query: Query) -> None:
            payload = query.payload
            if not payload or len(payload) <= 4:
                if not bare:
                    self._refuse(
                        route,
                        query,
                        f"the service {route.name} was called without a request; send the CDR of "
                        f"{route.type}'s request as the query's payload",
                    )
                    return
                request = request_kind()
            else:
                try:
                    request = deserialize_message(payload, request_kind)
                except Exception:
                    self._refuse(
                        route,
                        query,
                        f"the service {route.name} got {len(payload)} bytes that are not a "
                        f"request of {route.type}; send its CDR, with the 4-byte header",
                    )
                    return
            give_up = time.monotonic_ns() + round(route.rule.timeout * bridge_rules.SECOND)
            with self._lock:
                # Under the lock, so that the answer cannot overtake this entry.
                with route.client.handle:
                    sequence = route.client.handle.send_request(request)
                route.waiting[sequence] = (query, give_up)
            route.count.messages += 1
            route.count.bytes += len(payload or b"")

        return ask

    def _answerer(self, route: ServiceRoute) -> Callable[[int, Any], None]:
        def answer(sequence: int, response: Any) -> None:
            with self._lock:
                query, _ = route.waiting.pop(sequence, (None, 0))
            if query is not None:
                payload = serialize_message(response)
                route.count.bytes += len(payload)
                query.reply(payload)

        return answer

    def _give_up(self) -> None:
        now = time.monotonic_ns()
        for route in self._calls.values():
            with self._lock:
                late = [s for s, (_, give_up) in route.waiting.items() if give_up <= now]
                queries = [route.waiting.pop(s)[0] for s in late]
            for query in queries:
                self._refuse(
                    route,
                    query,
                    f"the service {route.name} did not answer within {route.rule.timeout:g} s; "
                    "see whether its node runs, then call again",
                )

    def _refuse(self, route: ServiceRoute, query: Query, reason: str) -> None:
        route.count.refused += 1
        query.refuse(reason)

    # Telling

    def statistics(self) -> dict[str, Any]:
        """Return what was carried: totals since the start, and what each key carried."""
        heard = {self._key(name): r.publisher.heard() for name, r in list(self._out.items())}
        keys = {
            key: {**vars(count), **({"heard": heard[key]} if key in heard else {})}
            for key, count in sorted(self._counts.copy().items())
        }
        counts = list(self._counts.values())
        return {
            "zid": self._session.zid,
            "prefix": self._prefix,
            "uptime_s": round(time.monotonic() - self._started, 3),
            "messages": sum(count.messages for count in counts),
            "bytes": sum(count.bytes for count in counts),
            "refused": sum(count.refused for count in counts),
            "keys": keys,
        }

    def _answer_statistics(self, query: Query) -> None:
        query.reply(json.dumps(self.statistics()).encode())

    def _complain(self, text: str) -> None:
        if text not in self._complained:
            self._complained.add(text)
            self.get_logger().warning(text)

    def _complain_of(self, error: Exception) -> None:
        self._complain(f"a message was lost: {type(error).__name__}: {error}")

    def destroy_node(self) -> None:
        """Let everything go and say what was carried."""
        self._receiver.stop()
        self._must_arrive.put(None)
        self._sender.join()
        total = self.statistics()
        for declared in self._declared:
            declared.undeclare()
        for name in list(self._calls):
            self._close_service(name)
        for name in list(self._out):
            self._close_out(name)
        for name in list(self._in):
            self._close_in(name)
        self._session.close()
        # Not through the node's logger: after a signal the context, and /rosout with it, is gone.
        print(
            f"bridge: carried {total['messages']} messages and {total['bytes']} bytes over "
            f"{len(total['keys'])} keys in {total['uptime_s']:.1f} s",
            flush=True,
        )
        self._streams.destroy_node()
        super().destroy_node()


def _rules(path: Path) -> bridge_rules.Rules:
    path = path if path.name else share.directory() / "config" / "bridge.yaml"
    try:
        document = yaml.safe_load(path.read_text())
    except (OSError, yaml.YAMLError) as error:
        raise BadInput(
            f"the bridge cannot read its allow-list {path}: {error}; name a YAML file with the "
            "parameter allow_list"
        ) from error
    return bridge_rules.parse(document)


def _profile(qos: TopicQos) -> QoSProfile:
    return QoSProfile(
        depth=qos.depth,
        reliability=ReliabilityPolicy.RELIABLE if qos.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=(
            DurabilityPolicy.TRANSIENT_LOCAL if qos.latched else DurabilityPolicy.VOLATILE
        ),
    )


def main() -> None:
    """Run the bridge."""
    host.main(["bridge"])
