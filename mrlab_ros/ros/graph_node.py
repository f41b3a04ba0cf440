"""A client of the graph that is a node of rclpy, which spins in a thread of its own.

So a command reads from top to bottom. A command that reaches the lab by its bridge never needs it,
nor what it imports.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Any

import rclpy
from rclpy.context import Context
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSPolicyKind, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions

from mrlab_ros.adapters import threads
from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.messages import qos
from mrlab_ros.messages.definitions import fitted
from mrlab_ros.ros import environment
from mrlab_ros.ros.calls import NoAnswer, call
from mrlab_ros.ros.decoding import subscribe
from mrlab_ros.ros.diagnostics import CLIENT_CLOSED, NOT_OFFERED
from mrlab_ros.ros.environment import domain_id
from mrlab_ros.ros.graph import CALL_TIMEOUT_S, FIND_TIMEOUT_S, GraphClient, Request, Response, T
from mrlab_ros.ros.node import HiddenNode

if TYPE_CHECKING:
    from message_bases import Service

OFFER_PERIOD_S = 0.05
# How long closing waits for a callback that runs, s.
CLOSE_TIMEOUT_S = 5.0


class _Ear:
    """A subscription that asks for less where the topic's publishers offer less."""

    def __init__(
        self,
        node: Node,
        kind: type[T],
        topic: str,
        callback: Callable[[T], None],
        quality: QoSProfile,
    ) -> None:
        self._node = node
        self._what = (kind, topic, callback)
        self._quality = quality
        # The node's thread may hear of a publisher before __init__ has returned.
        self._lock = threading.Lock()
        with self._lock:
            self._subscription = self._subscribe()

    def _subscribe(self) -> Any:
        events = SubscriptionEventCallbacks(incompatible_qos=self._weaken)
        return subscribe(self._node, *self._what, self._quality, event_callbacks=events)

    def _weaken(self, found: Any) -> None:
        with self._lock:
            durability, reliability = self._quality.durability, self._quality.reliability
            if found.last_policy_kind == QoSPolicyKind.DURABILITY:
                durability = DurabilityPolicy.VOLATILE
            else:
                reliability = ReliabilityPolicy.BEST_EFFORT
            self._quality = QoSProfile(
                depth=qos.STREAM.depth, durability=durability, reliability=reliability
            )
            self._node.destroy_subscription(self._subscription)
            self._subscription = self._subscribe()


class Graph(GraphClient):
    """A node of its own in the graph, which discovery takes a second or more to connect."""

    def __init__(self, domain: int | None = None, context: Context | None = None) -> None:
        """domain: the ROS domain; None: that of this process's environment.

        context: one of this domain to be in, which stays; None: one of its own.
        """
        self.domain = domain_id() if domain is None else domain
        self._own = context is None
        self._context = self._joined() if context is None else context
        self.node: Node = HiddenNode("_mrlab_command", self._context, remapped=True)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._clients: dict[str, Any] = {}
        self._closing = threading.Event()
        # The executor's own wake() builds its wait set anew and goes on; this ends spin_once().
        self._end = self.node.create_guard_condition(lambda: None)
        self._thread = threads.loop("graph", self._spin, self._context.ok)
        self._thread.start()

    def _joined(self) -> Context:
        environment.prepare()
        context = Context()
        try:
            rclpy.init(
                args=[],
                context=context,
                domain_id=self.domain,
                signal_handler_options=SignalHandlerOptions.NO,
            )
        except rclpy_implementation.RCLError:
            environment.check_log_folder()
            raise
        return context

    def _spin(self) -> None:
        try:
            while not self._closing.is_set():
                self._executor.spin_once()
        except ExternalShutdownException:
            return

    def close(self) -> None:
        # First the thread ends: the executor takes its conditions away from one that still spins,
        # and one that waits within rcl when the interpreter ends aborts the process.
        self._closing.set()
        self._end.trigger()
        self._thread.join(CLOSE_TIMEOUT_S)
        self._executor.shutdown(timeout_sec=1.0)
        self.node.destroy_node()
        if self._own:
            self._context.try_shutdown()

    def subscribe(
        self, kind: type[T], topic: str, callback: Callable[[T], None], quality: QoSProfile
    ) -> None:
        self._check_open()
        _Ear(self.node, kind, topic, callback, quality)

    def call(
        self,
        kind: type[Service[Request, Response]],
        service: str,
        request: Request,
        timeout: float = CALL_TIMEOUT_S,
        find_timeout: float = FIND_TIMEOUT_S,
    ) -> Response:
        self._check_open()
        fitted(request)
        client = self._clients.get(service)
        if client is None:
            client = self._clients[service] = self.node.create_client(
                kind, service, qos_profile=qos.SERVICES
            )
        if not client.wait_for_service(timeout_sec=find_timeout):
            raise NoAnswer(NOT_OFFERED(service=service, domain=self.domain, fixes=self.advice()))
        answer: Response = call(client, request, timeout)
        return answer

    def _check_open(self) -> None:
        if self._closing.is_set():
            raise Misuse(CLIENT_CLOSED())

    def node_names(self) -> Collection[str]:
        names: list[str] = self.node.get_node_names()
        return names

    def is_published(self, topic: str) -> bool:
        return bool(self.node.count_publishers(topic))

    def is_offered(self, service: str) -> bool:
        deadline = time.monotonic() + FIND_TIMEOUT_S
        while not self.node.count_services(service):
            if time.monotonic() > deadline:
                return False
            time.sleep(OFFER_PERIOD_S)
        return True
