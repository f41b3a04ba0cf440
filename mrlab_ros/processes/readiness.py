"""Readiness of a lab: its nodes, services and robots, and a program that waits for it.

The launch file runs `python -m mrlab_ros.processes.readiness` beside the lab. It prints
`... ready LAB ROBOTS NODE,NODE,... SERVICE...` and ends; programs that call the lab start then.
"""

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
import functools
import signal
import sys

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


# The lab is waited for this often, for readiness.READY_TIMEOUT_S each time.
MOST_WAITS = 15


def main() -> None:
    """Exit with 0 once the nodes and so many robots of the lab with the id LAB are there.

    Exits with 1 where they do not come, or where another lab on the domain would carry out a call
    of one of the services, too.
    """
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    began = time.monotonic()
    lab, robots, names, services = sys.argv[1], int(sys.argv[2]), sys.argv[3], sys.argv[4:]
    from mrlab_ros.core.runtime.identity import Identity
    from mrlab_ros.processes.diagnostics import NOBODY_WAITS
    from mrlab_ros.processes.lab import NODES
    from mrlab_ros.ros.graph_node import Graph

    nodes = [NODES[name] for name in names.split(",")]
    identity = Identity(lab, functools.partial(print, flush=True))
    with Graph() as graph:
        readiness = Readiness(graph, nodes, robots, identity)
        for _ in range(MOST_WAITS):
            missing = readiness.wait(threading.Event())
            if not missing:
                break
            said = f"{missing} is missing after {time.monotonic() - began:.0f} s"
            print(f"the lab is not ready: {said}; the lines above say why", flush=True)
        else:
            sys.exit(str(NOBODY_WAITS()))
        print(f"the lab is ready after {time.monotonic() - began:.1f} s", flush=True)
        if refused := [why for service in services if (why := readiness.why_not(service))]:
            sys.exit("\n".join(map(str, refused)))


if __name__ == "__main__":
    main()
