"""Whether a lab is complete, beside another one on its ROS domain."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from graph import Graph, wait_for
from mrlab_msgs import msg
from small_lab import Catalogue, spawn

from mrlab_ros.core.runtime.diagnostics import OTHER_LAB, SHARED_SERVICE
from mrlab_ros.core.runtime.identity import Identity
from mrlab_ros.messages import qos
from mrlab_ros.nodes.coordinator.node import CoordinatorNode
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode
from mrlab_ros.processes.lab import NODES
from mrlab_ros.processes.readiness import Readiness
from mrlab_ros.ros.graph import GraphClient

PARTS = [NODES[name] for name in ("coordinator", "lab", "playback")]


class Client(GraphClient):
    """A client of the lab under test."""

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self.node = graph.client

    def close(self) -> None: ...

    def call(self, *_args: object, **_options: object) -> None:
        pytest.fail("readiness calls nothing")

    def subscribe(self, kind, topic, callback, quality) -> None:
        self.node.create_subscription(kind, topic, callback, quality)

    def node_names(self) -> list[str]:
        return self.node.get_node_names()

    def is_published(self, topic: str) -> bool:
        return bool(self.node.count_publishers(topic))

    def is_offered(self, service: str) -> bool:
        return bool(self.node.count_services(service))


def start(graph: Graph, lab: str) -> SimpleNamespace:
    return SimpleNamespace(
        lab=graph.add(LabNode, lab_id=lab),
        host=graph.add(PlaybackHostNode, lab_id=lab),
        coordinator=graph.add(CoordinatorNode, lab_id=lab),
    )


def follow(graph: Graph, lab: str, robots: int) -> tuple[Readiness, list[str]]:
    said: list[str] = []
    return Readiness(Client(graph), PARTS, robots, Identity(lab, said.append)), said


def test_a_lab_is_complete_by_its_own_parts_not_by_those_of_another_on_its_domain(graph):
    graph.add(Catalogue)
    start(graph, "a1")
    robot = spawn(graph)
    states = graph.listen(msg.PlaybackState, f"/{robot}/playback_state", qos.LATCHED_EVENTS)
    wait_for(lambda: states, "the other lab's robot")
    second, said = follow(graph, "b2", 1)
    wait_for(lambda: said, "a word on the other lab")
    assert second.missing() == "coordinator, lab"
    graph.add(LabNode, lab_id="b2")
    wait_for(lambda: second.missing() == "coordinator", "the second lab's scene")
    graph.add(CoordinatorNode, lab_id="b2")
    wait_for(lambda: second.missing() == "a robot", "the second lab's systems")
    (sentence,) = said
    assert sentence == OTHER_LAB(other_lab="a1", lab="b2")


def test_what_two_labs_would_carry_out_is_not_called_when_one_is_ready(graph):
    graph.add(Catalogue)
    start(graph, "b2")
    alone, said = follow(graph, "b2", 0)
    wait_for(lambda: not alone.missing(), "the lab")
    assert alone.why_not("/lab/load_scene") is None
    assert not said
    first = start(graph, "a1")
    wait_for(lambda: graph.client.count_services("/lab/load_scene") == 2, "the other lab")
    why = wait_for(lambda: alone.why_not("/lab/load_scene"), "a reason")
    assert why == SHARED_SERVICE(service="/lab/load_scene", labs=["a1"])
    assert alone.why_not("/recorder/start") is None, "nobody has it twice"
    graph.drop(first.lab)
    wait_for(lambda: not alone.why_not("/lab/load_scene"), "the end of the other lab")
