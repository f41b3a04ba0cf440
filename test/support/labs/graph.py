"""A graph of real nodes in this process, for the node tests."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, TypeVar

import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile

from mrlab_ros.ros.environment import remove_abandoned
from mrlab_ros.ros.spinning import SpunNode

Value = TypeVar("Value")
# Of what comes within a second on a machine with nothing else to do, s.
TIMEOUT_S = 30.0


def wait_for(condition: Callable[[], Value], what: str, timeout: float = TIMEOUT_S) -> Value:
    """Return the condition's first true value; fail the test after `timeout` s."""
    deadline = time.monotonic() + timeout
    while not (value := condition()):
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {timeout:g} s in vain for {what}")
        time.sleep(0.005)
    return value


class Inbox(list[Any]):
    """The messages of one topic, oldest first."""

    def last(self) -> Any:
        return self[-1] if self else None


class Graph:
    """Spins nodes in a private context; calls services and listens as a client would."""

    def __init__(self, domain: int | None = None) -> None:
        """domain: the ROS domain; None: that of this run."""
        remove_abandoned()  # of a lab that an earlier test killed
        self.context = rclpy.Context()
        self.context.init(domain_id=domain)
        self._spun: dict[Node, SpunNode] = {}
        self.client = Node("test_client", context=self.context)
        self._client_spun = SpunNode(self.client)

    def add(self, make: Callable[..., Node], **parameters: Any) -> Any:
        """Make a node of the lab in this graph, with parameters."""
        overrides = [rclpy.parameter.Parameter(k, value=v) for k, v in parameters.items()]
        node = make(context=self.context, parameter_overrides=overrides)
        self._spun[node] = SpunNode(node)
        return node

    def drop(self, node: Node) -> None:
        """Take a node of the lab out of the graph, as if its process had ended."""
        self._spun.pop(node).close()

    def call(self, kind: Any, service: str, /, timeout: float = TIMEOUT_S, **fields: Any) -> Any:
        """Call a service and return its answer."""
        client = self.client.create_client(kind, service)
        assert client.wait_for_service(timeout_sec=timeout), f"nobody offers {service}"
        future = client.call_async(kind.Request(**fields))
        wait_for(future.done, f"an answer of {service}", timeout)
        self.client.destroy_client(client)
        return future.result()

    def listen(self, kind: Any, name: str, qos: QoSProfile) -> Inbox:
        """Collect the messages of a topic."""
        inbox = Inbox()
        self.client.create_subscription(kind, name, inbox.append, qos)
        return inbox

    def close(self) -> None:
        self.context.try_shutdown()
        for spun in (*reversed(self._spun.values()), self._client_spun):
            spun.close()
