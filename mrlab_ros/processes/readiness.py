"""Which parts of a lab are complete in the graph."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.runtime.identity import Identity, Neighbours
from mrlab_ros.processes.lab import NodeEntry

if TYPE_CHECKING:
    from mrlab_ros.ros.graph_node import Graph


# A lab that is incomplete after this time is in trouble, s.
READY_TIMEOUT_S = 20.0
POLL_PERIOD_S = 0.05


class Readiness:
    """Follows the parts of one lab in the graph; what another lab there publishes does not count.

    A node is complete once its latched topic has a message, or, without such a topic, once a node
    of its name is in the graph; a robot once its playback has published a state.

    robots: how many there are at least. identity: the lab's; it names other labs as they are met.
    """

    def __init__(
        self, graph: Graph, nodes: Sequence[NodeEntry], robots: int, identity: Identity
    ) -> None:
        from mrlab_msgs import msg

        self._graph = graph
        self._nodes = nodes
        self._robots = robots
        self._identity = identity
        self._neighbours = Neighbours(identity.lab)
        # By topic: the newest message of this lab.
        self._newest: dict[str, Any] = {}
        self._followed: set[str] = set()
        self._follow(msg.Robots, "/robots")
        for node in nodes:
            if node.state is not None:
                self._follow(getattr(msg, node.state[1]), node.state[0])

    def _follow(self, kind: Any, topic: str) -> None:
        from mrlab_ros.messages import qos

        if topic in self._followed:
            return
        self._followed.add(topic)

        def take(message: Any) -> None:
            # A catalogue of trajectories does not name its lab.
            lab = getattr(message, "lab", "")
            self._neighbours.notice(lab, time.monotonic())
            own = self._identity.obeys if topic == "/robots" else self._identity.accepts
            if own(lab):
                self._newest[topic] = message

        # Of a queue of one message, the other lab's would take the place of this one's.
        self._graph.subscribe(kind, topic, take, qos.LATCHED_EVENTS)

    def missing(self) -> str:
        """Name what is not complete yet; empty: everything is."""
        from mrlab_msgs import msg

        present = self._graph.node_names()
        absent = [
            node.graph_name
            for node in self._nodes
            if node.graph_name not in present
            or (node.state is not None and node.state[0] not in self._newest)
        ]
        if absent:
            return ", ".join(absent)
        scene = self._newest.get("/robots")
        spawned = scene.robots if scene else ()
        for robot in spawned:
            topic = f"/{robot.name}/playback_state"
            self._follow(msg.PlaybackState, topic)
            if topic not in self._newest:
                return f"the playback of {robot.name}"
        return "" if len(spawned) >= self._robots else "a robot"

    def wait(self, stop: threading.Event, web: Callable[[], bool] | None = None) -> str:
        """Wait until the lab is complete; return what is missing at the end.

        web: whether the gateway answers; None where there is none.

        That is nothing where the lab is complete or `stop` is set, and what is missing after
        READY_TIMEOUT_S.
        """
        deadline = time.monotonic() + READY_TIMEOUT_S
        while not stop.wait(POLL_PERIOD_S):
            what = self.missing()
            if not what and web is not None:
                what, web = ("", None) if web() else ("the pages", web)
            if not what or time.monotonic() > deadline:
                return what
        return ""

    def why_not(self, service: str) -> Diagnostic | None:
        """Return why a call of `service` would reach another lab, too; None: it would not."""
        servers = self._graph.node.count_services(service)
        return self._neighbours.why_not(service, servers, time.monotonic())
