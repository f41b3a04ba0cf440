"""A client of the graph through the socket of the lab's bridge: no discovery to wait for."""

from __future__ import annotations

import base64
import json
import threading
import time
from collections.abc import Callable, Collection
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message, serialize_message

from mrlab_ros.adapters.zenoh.links import NoQueryable, Refusal, ZenohLink
from mrlab_ros.core.bridge.links import key_of
from mrlab_ros.messages.definitions import fitted
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.decoding import decoder
from mrlab_ros.ros.graph import CALL_TIMEOUT_S, FIND_TIMEOUT_S, GraphClient, Request, Response, T

if TYPE_CHECKING:
    from message_bases import Service

BRIDGE = "/@mrlab/bridge"
# How old what the bridge said of the graph may be, s.
NODES_AGE_S = 0.2
# The bridge finds what is new in the graph within this time; how often it is asked, s.
FOUND_S = 0.5
RETRY_S = 0.05


class LinkGraph(GraphClient):
    """Talks to the bridge, and to the graph itself for what the bridge does not carry."""

    prompt = True

    def __init__(self, domain: int, link: ZenohLink, prefix: str = "") -> None:
        """Raise LabError where the bridge does not answer."""
        self.domain = domain
        self._link = link
        self._prefix = prefix
        self._graph: GraphClient | None = None
        self._statistics: dict[str, Any] = {}
        self._asked = 0.0
        self._ask()

    def close(self) -> None:
        self._link.close()
        if self._graph is not None:
            self._graph.close()

    def subscribe(
        self, kind: type[T], topic: str, callback: Callable[[T], None], quality: QoSProfile
    ) -> None:
        key = key_of(topic, self._prefix)
        lock, live = threading.Lock(), threading.Event()

        def receive(message: Any) -> None:
            with lock:
                live.set()
                callback(message)

        def receive_newest(message: Any) -> None:
            with lock:
                # Messages that came meanwhile are newer.
                if not live.is_set():
                    callback(message)

        unsubscribe = self._link.subscribe(key, decoder(kind, topic, receive))
        if quality.durability is not DurabilityPolicy.TRANSIENT_LOCAL:
            return
        newest = self._newest(key)
        if newest is None:
            if not self._carries(key):
                unsubscribe()
                self._whole_graph().subscribe(kind, topic, callback, quality)
            return
        decoder(kind, topic, receive_newest)(newest)

    def call(
        self,
        kind: type[Service[Request, Response]],
        service: str,
        request: Request,
        timeout: float = CALL_TIMEOUT_S,
        find_timeout: float = FIND_TIMEOUT_S,
    ) -> Response:
        key = key_of(service, self._prefix)
        payload = serialize_message(fitted(request))
        deadline = time.monotonic() + FOUND_S
        while True:
            try:
                data = self._link.query(key, payload, timeout)
                answer: Response = deserialize_message(data, kind.Response)
                return answer
            except Refusal as error:
                raise NoAnswer(error.diagnostic) from None
            except NoQueryable:
                if time.monotonic() > deadline:
                    break
                time.sleep(RETRY_S)
        return self._whole_graph().call(kind, service, request, timeout, find_timeout)

    def node_names(self) -> Collection[str]:
        if time.monotonic() - self._asked > NODES_AGE_S:
            with suppress(NoQueryable, Refusal):
                self._ask()
        names: list[str] = self._statistics["nodes"]
        return names

    def is_published(self, topic: str) -> bool:
        return self._carries(key_of(topic, self._prefix))

    def is_offered(self, service: str) -> bool:
        return self._carries(key_of(service, self._prefix))

    def kept(self, kind: type[T], topic: str) -> list[tuple[float, T]]:
        """Return what the bridge kept of a topic that it does not carry: age in s, message."""
        key = key_of(f"{BRIDGE}/kept{topic}", self._prefix)
        try:
            found = json.loads(self._link.query(key))
        except (NoQueryable, Refusal):
            return []
        return [(age, deserialize_message(base64.b64decode(cdr), kind)) for age, cdr in found]

    def _newest(self, key: str) -> bytes | None:
        """Return the newest message of a latched topic; None where there is none."""
        deadline = time.monotonic() + FOUND_S
        while True:
            try:
                return self._link.query(key)
            except Refusal:
                return None
            except NoQueryable:
                if self._carries(key) or time.monotonic() > deadline:
                    return None
                time.sleep(RETRY_S)
                self._ask()

    def _ask(self) -> None:
        answer = self._link.query(key_of(f"{BRIDGE}/statistics", self._prefix))
        self._statistics, self._asked = json.loads(answer), time.monotonic()

    def _carries(self, key: str) -> bool:
        return key in self._statistics["keys"]

    def _whole_graph(self) -> GraphClient:
        if self._graph is None:
            from mrlab_ros.ros.graph_node import Graph

            self._graph = Graph()
        return self._graph
