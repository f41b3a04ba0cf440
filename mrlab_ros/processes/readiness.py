"""When a lab that was started is complete."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mrlab_ros.ros.graph import Graph


# A lab that is not complete by then has trouble, s.
READY_TIMEOUT = 20.0


def wait_until_complete(
    stop: threading.Event, robots: int, bridge: bool, physics: bool = False
) -> str:
    """Wait until every node of the lab speaks; return what is missing after READY_TIMEOUT."""
    from mrlab_ros.ros.graph import Graph

    with Graph() as graph:
        missing = lab_is_missing(graph, robots, bridge, physics)
        deadline = time.monotonic() + READY_TIMEOUT
        while not stop.wait(0.05):
            what = missing()
            if not what or time.monotonic() > deadline:
                return what
    return ""


def lab_is_missing(
    graph: Graph, robots: int, bridge: bool, physics: bool = False
) -> Callable[[], str]:
    """Return a function that names what of a lab has not spoken yet; empty: all is there."""
    from mrlab_msgs import msg

    scene = graph.watch(msg.Robots, "/robots")
    watches = {
        "lab": scene,
        "converter": graph.watch(msg.TrajectoryCatalogue, "/trajectories"),
        "coordinator": graph.watch(msg.RobotSystems, "/systems"),
    }
    optional = {"bridge": bridge, "physics": physics}
    quiet = ("playback_host", "recorder", *(name for name, on in optional.items() if on))
    playbacks: dict[str, Any] = {}

    def missing() -> str:
        silent = [name for name, watch in watches.items() if watch.value is None]
        names = set(graph.node.get_node_names())
        silent += [name for name in quiet if name not in names]
        if silent:
            return ", ".join(silent)
        present = scene.value.robots if scene.value else ()
        for robot in present:
            if robot.name not in playbacks:
                playbacks[robot.name] = graph.watch(
                    msg.PlaybackState, f"/{robot.name}/playback_state"
                )
            if playbacks[robot.name].value is None:
                return f"the playback of {robot.name}"
        return "" if len(present) >= robots else "a robot"

    return missing
