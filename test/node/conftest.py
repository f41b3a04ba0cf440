from __future__ import annotations

from collections.abc import Iterator

import pytest
import yaml
from graph import Graph
from own_domain import own_domain
from own_port import free_endpoint
from zenoh_side import connect


@pytest.fixture
def graph() -> Iterator[Graph]:
    graph = Graph()
    yield graph
    graph.close()


@pytest.fixture
def other_graph(monkeypatch):
    """Make a graph on another domain, as another lab has."""
    with own_domain() as domain:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
        graph = Graph()
        yield graph
        graph.close()


@pytest.fixture
def endpoint():
    return free_endpoint()


@pytest.fixture
def bridge(graph, endpoint):
    from mrlab_ros.nodes.bridge.node import BridgeNode

    return graph.add(BridgeNode, listen=[endpoint], discovery_period=0.02)


@pytest.fixture
def session(bridge, endpoint):
    with connect(endpoint) as session:
        yield session


@pytest.fixture
def listed(graph, endpoint, tmp_path):
    """Make a bridge with an allow-list of the test's own."""
    from mrlab_ros.nodes.bridge.node import BridgeNode

    def make(document, **parameters):
        path = tmp_path / "bridge.yaml"
        path.write_text(yaml.safe_dump(document))
        settings = {"listen": [endpoint], "discovery_period": 0.02, "allow_list": str(path)}
        return graph.add(BridgeNode, **(settings | parameters))

    return make
