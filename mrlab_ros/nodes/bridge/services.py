"""Offers services of the graph to zenoh clients, each as a queryable.

Replies are sent by a thread of their own, so that a client that does not read them delays neither
the graph nor discovery.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from rclpy.client import Client
from rclpy.serialization import deserialize_message, serialize_message
from rclpy.task import Future

from mrlab_ros.adapters.zenoh.port import Declared, Query
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.bridge import diagnostics as say
from mrlab_ros.core.bridge import rules
from mrlab_ros.core.bridge.rules import ServiceRule
from mrlab_ros.messages import qos
from mrlab_ros.messages.texts import tell
from mrlab_ros.nodes.bridge.outward import Sender
from mrlab_ros.nodes.bridge.routes import BridgeContext, Count
from mrlab_ros.ros import clock

# Calls that one service has at a time; DDS keeps ten for a server and drops older ones.
IN_FLIGHT = 8


@dataclass(eq=False)
class Call:
    """A call that waits for its response until `deadline_ns` (monotonic, ns)."""

    query: Query
    request: Any
    deadline_ns: int
    future: Future | None = None


@dataclass
class ServiceRoute:
    """The route of one service; it is offered to zenoh once its server is matched.

    in_flight: calls that were sent to the server; waiting: calls that were not. served: a server
    was in the graph at the last check.
    """

    name: str
    type: str
    rule: ServiceRule
    count: Count
    client: Client
    declared: list[Declared] = field(default_factory=list)
    in_flight: set[Call] = field(default_factory=set)
    waiting: deque[Call] = field(default_factory=deque)
    served: bool = True


class Services:
    """The routes of services.

    why_not: gets a service that moves something and returns why it is not called now; None: it is.
    keyed: the lab has keys, and clients on other machines. left: by service, what leaves a call
    for the server that comes next, and returns what its caller is told; None: it cannot be left.
    The route of such a service stays when its server has gone. is_down: returns whether the server
    of a service is known not to run.
    """

    def __init__(
        self,
        bridge: BridgeContext,
        why_not: Callable[[str], Diagnostic | None] = lambda service: None,
        *,
        keyed: bool = False,
        left: Mapping[str, Callable[[], Diagnostic | None]] | None = None,
        is_down: Callable[[str], bool] = lambda service: False,
    ) -> None:
        self._keyed = keyed
        self._left = left or {}
        self._is_down = is_down
        self._bridge = bridge
        self._why_not = why_not
        # Reentrant: add_done_callback may run at once when the response is already there.
        self._lock = threading.RLock()
        self._routes: dict[str, ServiceRoute] = {}
        self._replies = Sender("bridge_replies", bridge.warn_once)

    def stop(self) -> None:
        """Close all routes; end once all replies are sent."""
        for name in list(self._routes):
            self._close(name)
        self._replies.stop()

    def keep(self, wanted: dict[str, tuple[ServiceRule, str]]) -> None:
        """Open and close routes until they are those of `wanted`: name -> rule and type."""
        for name, route in list(self._routes.items()):
            route.served = name in wanted
            stays = route.served or name in self._left
            if not stays or (route.served and wanted[name][1] != route.type):
                self._close(name)
            elif not route.served:
                self.server_gone(name)
        for name, (rule, type_name) in wanted.items():
            self._renew(name, rule, type_name)

    def _renew(self, name: str, rule: ServiceRule, type_name: str) -> None:
        bridge = self._bridge
        route = self._routes.get(name)
        key, session = bridge.key(name), bridge.session
        if route is None:
            kind = bridge.kind(name, type_name)
            if kind is None:
                return
            client = bridge.streams.create_client(kind, name, qos_profile=qos.SERVICES)
            count = bridge.count(key, type_name, "service")
            route = ServiceRoute(name, type_name, rule, count, client)
            self._routes[name] = route
        if not route.declared and route.client.service_is_ready():
            token = rules.service_token(session.zid, key, type_name)
            route.declared = [
                session.queryable(key, self._on_query(route), quick=True),
                session.token(token),
            ]

    def _close(self, name: str) -> None:
        route = self._routes.pop(name)
        for declared in route.declared:
            declared.undeclare()
        with self._lock:
            self._drop(route)
            self._bridge.streams.destroy_client(route.client)
        self._bridge.close(self._bridge.key(name))

    def server_gone(self, name: str) -> None:
        """Take that the server of a service ended or froze: its calls wait no longer."""
        route = self._routes.get(name)
        if route is not None:
            with self._lock:
                self._drop(route)

    def _drop(self, route: ServiceRoute) -> None:
        """Give up all calls of a route. The lock must be held."""
        calls = [*route.in_flight, *route.waiting]
        route.in_flight.clear()
        route.waiting.clear()
        for call in calls:
            self._give_up(route, call.query, say.SERVICE_GONE(service=route.name))

    def _give_up(self, route: ServiceRoute, query: Query, why: Diagnostic) -> None:
        """Leave a call for the next server where that is possible; else refuse it with `why`."""
        leave = self._left.get(route.name)
        said = leave() if leave is not None else None
        if said is None:
            self._refuse(route, query, why)
            return
        service: Any = route.client.srv_type
        response = service.Response()
        tell(response, True, said)
        self._reply(query, serialize_message(response))

    def _on_query(self, route: ServiceRoute) -> Callable[[Query], None]:
        read = _reader(route)
        key = self._bridge.key(route.name)

        def on_query(query: Query) -> None:
            if query.key != key:
                # A query for ** must not call every service.
                other = say.CALLED_BY_ANOTHER_KEY(service=route.name, key=key, found=query.key)
                self._refuse(route, query, other)
                return
            # Not after the call is sent: the query is gone once it has its reply.
            size, largest = query.size, route.rule.max_size
            if size > largest:
                large = say.REQUEST_TOO_LARGE(service=route.name, size=size, largest=largest)
                self._refuse(route, query, large)
                return
            request, why_not = read(query.payload)
            if self._keyed and why_not is None and (path := route.rule.names_a_path(request)):
                why_not = say.PATH_FROM_AFAR(service=route.name, path=path)
            if why_not is None and route.rule.moves:
                why_not = self._why_not(route.name)
                if why_not is None and (why_not := clock.why_doubtful()):
                    self._bridge.warn_once(f"{route.name}: {why_not}")
            if why_not is not None:
                self._refuse(route, query, why_not)
                return
            if not route.served or self._is_down(route.name):
                self._give_up(route, query, say.SERVICE_GONE(service=route.name))
                return
            timeout = round(route.rule.timeout * rules.SECOND)
            with self._lock:
                why_not = self._why_full(route)
                if why_not is None:
                    route.waiting.append(Call(query, request, time.monotonic_ns() + timeout))
                    self._send(route)
            if why_not is not None:
                self._refuse(route, query, why_not)
                return
            route.count.messages += 1
            route.count.bytes += size

        return on_query

    def _reply(self, query: Query, payload: bytes) -> None:
        self._replies.send(partial(query.reply, payload), len(payload))

    def _why_full(self, route: ServiceRoute) -> Diagnostic | None:
        if self._routes.get(route.name) is not route:
            return say.SERVICE_GONE(service=route.name)
        if len(route.waiting) >= route.rule.waiting:
            return say.CALLS_WAIT(service=route.name, waiting=route.rule.waiting)
        return None

    def _send(self, route: ServiceRoute) -> None:
        """Send waiting calls while fewer than IN_FLIGHT are open. The lock must be held."""
        while route.waiting and len(route.in_flight) < IN_FLIGHT:
            call = route.waiting.popleft()
            route.in_flight.add(call)
            call.future = route.client.call_async(call.request)
            call.future.add_done_callback(partial(self._on_response, route, call))

    def _on_response(self, route: ServiceRoute, call: Call, future: Future) -> None:
        with self._lock:
            expected = call in route.in_flight
            route.in_flight.discard(call)
            self._send(route)
        response = future.result()
        if expected and response is not None:
            payload = serialize_message(response)
            route.count.bytes += len(payload)
            self._reply(call.query, payload)

    def refuse_late(self) -> None:
        """Refuse the calls whose deadline has passed."""
        now = time.monotonic_ns()
        for route in list(self._routes.values()):
            if not route.in_flight and not route.waiting:
                continue
            with self._lock:
                late = [c for c in (*route.in_flight, *route.waiting) if c.deadline_ns <= now]
                route.in_flight.difference_update(late)
                route.waiting = deque(c for c in route.waiting if c.deadline_ns > now)
                self._send(route)
            for call in late:
                if call.future is not None:
                    route.client.remove_pending_request(call.future)
                silent = say.SERVER_SILENT(service=route.name, timeout=route.rule.timeout)
                self._give_up(route, call.query, silent)

    def _refuse(self, route: ServiceRoute, query: Query, reason: Diagnostic) -> None:
        """Reply to a query with an error that says the reason."""
        route.count.refused += 1
        self._replies.send(partial(query.refuse, reason), len(str(reason)))


def _reader(route: ServiceRoute) -> Callable[[bytes | None], tuple[Any, Diagnostic | None]]:
    """Return a function that decodes a request: the request, or None and why it cannot."""
    service: Any = route.client.srv_type
    kind = service.Request
    empty = not kind.get_fields_and_field_types()

    def read(payload: bytes | None) -> tuple[Any, Diagnostic | None]:
        if not payload or len(payload) <= 4:
            if empty:
                return kind(), None
            return None, say.REQUEST_MISSING(service=route.name, type=route.type)
        try:
            return deserialize_message(payload, kind), None
        except Exception:
            size = len(payload)
            return None, say.REQUEST_NOT_CDR(service=route.name, size=size, type=route.type)

    return read
