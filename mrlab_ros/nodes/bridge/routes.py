"""Routes of topics, whichever way they go: opened, renewed and closed as the graph changes."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from rclpy.topic_endpoint_info import TopicEndpointInfo

from mrlab_ros.core.bridge.rules import TopicQos, TopicRule
from mrlab_ros.nodes.bridge.context import BridgeContext


@dataclass
class Route:
    """The route of one topic. ends: its publishers, or its subscriptions, in the graph at the last
    check: those that the route is for."""

    type: str
    qos: TopicQos
    ends: int


R = TypeVar("R", bound=Route)


class TopicRoutes(ABC, Generic[R]):
    """The routes of one direction."""

    def __init__(self, bridge: BridgeContext) -> None:
        self._bridge = bridge
        self._routes: dict[str, R] = {}

    def keep(self, wanted: dict[str, tuple[TopicRule, str]], thorough: bool = True) -> None:
        """Open and close routes until they are those of `wanted`: name -> rule and type.

        Unless `thorough`, a topic whose number of ends is unchanged is not checked further.
        """
        for name in [n for n in self._routes if n not in wanted]:
            self._close(name)
        for name, (rule, type_name) in wanted.items():
            self._renew(name, rule, type_name, thorough)
            self._bridge.give_way()

    def _renew(self, name: str, rule: TopicRule, type_name: str, thorough: bool) -> None:
        """Open a topic's route, or open it anew where its type or its QoS is another now."""
        bridge = self._bridge
        known = self._routes.get(name)
        # Counting takes a fifth of the time of the full information.
        count = self._count_ends(name)
        if known is not None and not thorough and (known.ends, known.type) == (count, type_name):
            return
        qos = bridge.quality(self._ends(name), rule, type_name)
        if known is not None and (known.qos, known.type) == (qos, type_name):
            known.ends = count
            return
        if known is not None:
            self._close(name)
        kind = bridge.kind(name, type_name)
        if qos is not None and kind is not None:
            self._open(name, rule, Route(type_name, qos, count), kind)

    @abstractmethod
    def _count_ends(self, name: str) -> int:
        """Return how many ends of a topic there are in the graph."""

    @abstractmethod
    def _ends(self, name: str) -> list[TopicEndpointInfo]:
        """Return the ends of a topic in the graph."""

    @abstractmethod
    def _open(self, name: str, rule: TopicRule, route: Route, kind: Any) -> None:
        """Open a topic's route; kind: the class of its type."""

    @abstractmethod
    def _close(self, name: str) -> None:
        """Close a topic's route."""
