"""Opens a client of the running lab in the quickest way that there is."""

from __future__ import annotations

import time

from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.bridge.links import local_endpoint
from mrlab_ros.processes.run_file import RunFile, domains, nobody
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.environment import domain_id, skip_generator
from mrlab_ros.ros.graph import GraphClient

# After so many looks a node of a lab is in the graph; its topics and services may take longer.
# They are counted, not timed: on a busy machine looks and discovery take longer alike.
LOOKS = 30
LOOK_PERIOD_S = 0.05


def open_graph() -> GraphClient:
    """Return a client of the lab on the ROS domain of this environment.

    A lab of `mrlab up` answers through its socket at once. Where it has none (no bridge, another
    user's, `ros2 launch`) or its bridge does not answer, a node in the graph finds it. Raises
    NoAnswer where no lab of this user runs and the domain stays without a node.
    """
    skip_generator()
    domain = domain_id()
    facts = RunFile(domain).read()
    if facts is None:
        return _found(_node())
    if socket := facts.get("socket"):
        from mrlab_ros.adapters.zenoh.links import ZenohLink
        from mrlab_ros.client.link import LinkGraph

        try:
            link = ZenohLink(local_endpoint(socket))
        except LabError:
            return _node()
        try:
            return LinkGraph(domain, link, facts.get("prefix") or "")
        except LabError:
            link.close()
    return _node()


def _node() -> GraphClient:
    from mrlab_ros.ros.graph_node import Graph

    return Graph()


def _found(graph: GraphClient) -> GraphClient:
    """Return `graph` once another node is in it; close it and raise NoAnswer where none comes."""
    for _ in range(LOOKS):
        # Nodes of tools, such as the daemon of `ros2`, begin with an underscore.
        if not all(name.startswith("_") for name in graph.node_names()):
            return graph
        time.sleep(LOOK_PERIOD_S)
    graph.close()
    raise NoAnswer(nobody(graph.domain, domains()))
