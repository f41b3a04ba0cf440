"""Services of the graph that zenoh may call, each as a queryable.

A thread of its own answers, so that who takes no answers holds up neither the graph nor the look
at it.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from rclpy.client import Client
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.task import Future

from mrlab_ros.adapters.zenoh_session import Declared, Query
from mrlab_ros.core.bridge import rules
from mrlab_ros.core.bridge.rules import ServiceRule
from mrlab_ros.nodes.bridge.crossing import BridgeContext, Count
from mrlab_ros.nodes.bridge.sender import Sender

# Calls that one service has at a time; DDS keeps ten for a server and forgets older ones.
IN_FLIGHT = 8


@dataclass(eq=False)
class Call:
    """A question on its way; it is given up at `give_up` (monotonic, ns)."""

    query: Query
    request: Any
    give_up: int
    future: Future | None = None


@dataclass
class ServiceRoute:
    """One service's way. It is offered once its server is matched."""

    name: str
    type: str
    rule: ServiceRule
    count: Count
    client: Client
    declared: list[Declared] = field(default_factory=list)
    asked: set[Call] = field(default_factory=set)
    waiting: deque[Call] = field(default_factory=deque)


class Services:
    """The services' routes."""

    def __init__(self, crossing: BridgeContext) -> None:
        self._crossing = crossing
        # Taken again where an answer is there before anybody waits for it.
        self._lock = threading.RLock()
        self._routes: dict[str, ServiceRoute] = {}
        self._answers = Sender("bridge_answers", crossing.warn_once)

    def stop(self) -> None:
        """Close all routes and end once what waits is answered."""
        self.keep({})
        self._answers.stop()

    def keep(self, wanted: dict[str, tuple[ServiceRule, str]]) -> None:
        """Make the routes those of `wanted`: name -> rule and type."""
        for name, route in list(self._routes.items()):
            if name not in wanted or wanted[name][1] != route.type:
                self._close(name)
        for name, (rule, type_name) in wanted.items():
            self._renew(name, rule, type_name)

    def _renew(self, name: str, rule: ServiceRule, type_name: str) -> None:
        crossing = self._crossing
        route = self._routes.get(name)
        key, session = crossing.key(name), crossing.session
        if route is None:
            kind = crossing.kind(name, type_name)
            if kind is None:
                return
            client = crossing.streams.create_client(kind, name)
            count = crossing.count(key, type_name, "service")
            route = ServiceRoute(name, type_name, rule, count, client)
            self._routes[name] = route
        if not route.declared and route.client.service_is_ready():
            token = rules.service_token(session.zid, key, type_name)
            route.declared = [session.queryable(key, self._asker(route)), session.token(token)]

    def _close(self, name: str) -> None:
        route = self._routes.pop(name)
        for declared in route.declared:
            declared.undeclare()
        with self._lock:
            calls = [*route.asked, *route.waiting]
            route.asked.clear()
            route.waiting.clear()
            self._crossing.streams.destroy_client(route.client)
        for call in calls:
            self._refuse(
                route, call.query, f"the service {name} has gone; see what runs, then call again"
            )

    def _asker(self, route: ServiceRoute) -> Callable[[Query], None]:
        read = _reader(route)
        key = self._crossing.key(route.name)

        def ask(query: Query) -> None:
            if query.key != key:
                # Who looks around with ** must not call everything there is.
                words = f"the service {route.name} is called by its key {key}, not as {query.key}"
                self._refuse(route, query, words)
                return
            request, why_not = read(query.payload)
            if why_not:
                self._refuse(route, query, why_not)
                return
            timeout = round(route.rule.timeout * rules.SECOND)
            with self._lock:
                why_not = self._why_full(route)
                if not why_not:
                    route.waiting.append(Call(query, request, time.monotonic_ns() + timeout))
                    self._send(route)
            if why_not:
                self._refuse(route, query, why_not)
                return
            route.count.messages += 1
            route.count.bytes += len(query.payload or b"")

        return ask

    def _why_full(self, route: ServiceRoute) -> str:
        if self._routes.get(route.name) is not route:
            return f"the service {route.name} has gone; see what runs, then call again"
        if len(route.waiting) >= route.rule.waiting:
            return (
                f"the service {route.name} has {route.rule.waiting} calls waiting and takes no "
                "more; wait for an answer, then call again"
            )
        return ""

    def _send(self, route: ServiceRoute) -> None:
        """Pass on what waits while the server has room for it. The lock must be held."""
        while route.waiting and len(route.asked) < IN_FLIGHT:
            call = route.waiting.popleft()
            route.asked.add(call)
            call.future = route.client.call_async(call.request)
            call.future.add_done_callback(partial(self._answer, route, call))

    def _answer(self, route: ServiceRoute, call: Call, future: Future) -> None:
        with self._lock:
            waited_for = call in route.asked
            route.asked.discard(call)
            self._send(route)
        response = future.result()
        if waited_for and response is not None:
            payload = serialize_message(response)
            route.count.bytes += len(payload)
            self._answers.send(partial(call.query.reply, payload), len(payload))

    def give_up(self) -> None:
        """Refuse the questions whose time is over."""
        now = time.monotonic_ns()
        for route in self._routes.values():
            with self._lock:
                late = [c for c in (*route.asked, *route.waiting) if c.give_up <= now]
                route.asked.difference_update(late)
                route.waiting = deque(c for c in route.waiting if c.give_up > now)
                self._send(route)
            for call in late:
                if call.future is not None:
                    route.client.remove_pending_request(call.future)
                self._refuse(
                    route,
                    call.query,
                    f"the service {route.name} did not answer within {route.rule.timeout:g} s; "
                    "see whether its node runs, then call again",
                )

    def _refuse(self, route: ServiceRoute, query: Query, reason: str) -> None:
        """Answer a query with the reason why it has no other answer."""
        route.count.refused += 1
        self._answers.send(partial(query.refuse, reason), len(reason))


def _reader(route: ServiceRoute) -> Callable[[bytes | None], tuple[Any, str]]:
    """Return what reads a request: the request and "", or None and why it is none."""
    service: Any = route.client.srv_type
    kind = service.Request
    bare = not kind.get_fields_and_field_types()

    def read(payload: bytes | None) -> tuple[Any, str]:
        if not payload or len(payload) <= 4:
            if bare:
                return kind(), ""
            return None, (
                f"the service {route.name} was called without a request; send the CDR of "
                f"{route.type}'s request as the query's payload"
            )
        try:
            return deserialize_message(payload, kind), ""
        except Exception:
            return None, (
                f"the service {route.name} got {len(payload)} bytes that are not a request of "
                f"{route.type}; send its CDR, with the 4-byte header"
            )

    return read
