"""Which parts of a lab are complete in the graph."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from mrlab_ros.processes.lab import NodeEntry

if TYPE_CHECKING:
    from mrlab_ros.ros.graph_node import Graph


# A lab that is incomplete after this time is in trouble, s.
READY_TIMEOUT_S = 20.0
POLL_PERIOD_S = 0.05


def wait_until_complete(
    stop: threading.Event,
    nodes: Sequence[NodeEntry],
    robots: int,
    web: Callable[[], bool] | None = None,
) -> str:
    """Wait until `nodes` and `robots` robots are in the graph; return what is missing at the end.

    web: whether the gateway answers; None where there is none.

    That is nothing where the lab is complete or `stop` is set, and what is missing after
    READY_TIMEOUT_S.
    """
    from mrlab_ros.ros.graph_node import Graph

    with Graph() as graph:
        missing = missing_parts(graph, nodes, robots)
        deadline = time.monotonic() + READY_TIMEOUT_S
        while not stop.wait(POLL_PERIOD_S):
            what = missing()
            if not what and web is not None:
                what, web = ("", None) if web() else ("the pages", web)
            if not what or time.monotonic() > deadline:
                return what
    return ""


def missing_parts(graph: Graph, nodes: Sequence[NodeEntry], robots: int) -> Callable[[], str]:
    """Return a function that names what of a lab is not complete yet; empty: everything is.

    A node is complete once its latched topic has a message, or, without such a topic, once it is
    in the graph; a robot once its playback has published a state.
    """
    from mrlab_msgs import msg

    watches = {
        node.graph_name: graph.watch(getattr(msg, node.state[1]), node.state[0])
        for node in nodes
        if node.state is not None
    }
    scene = graph.watch(msg.Robots, "/robots")
    playbacks: dict[str, Any] = {}

    def missing() -> str:
        present = set(graph.node.get_node_names())
        absent = [
            node.graph_name
            for node in nodes
            if node.graph_name not in present
            or (node.state is not None and watches[node.graph_name].value is None)
        ]
        if absent:
            return ", ".join(absent)
        spawned = scene.value.robots if scene.value else ()
        for robot in spawned:
            if robot.name not in playbacks:
                playbacks[robot.name] = graph.watch(
                    msg.PlaybackState, f"/{robot.name}/playback_state"
                )
            if playbacks[robot.name].value is None:
                return f"the playback of {robot.name}"
        return "" if len(spawned) >= robots else "a robot"

    return missing
