"""A replay is detected, during which the lab's own nodes leave the graph."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from graph import Graph, wait_for
from mrlab_msgs.msg import RecorderState

from mrlab_ros.messages import qos
from mrlab_ros.processes import stand_aside
from mrlab_ros.processes.stand_aside import TOPIC, StandAside


@pytest.fixture
def aside(graph: Graph) -> Iterator[StandAside]:
    made = StandAside(graph.context)
    yield made
    made.close()


def test_who_comes_during_a_replay_knows_before_it_joins(graph, monkeypatch):
    monkeypatch.setattr(stand_aside, "STATE_TIMEOUT_S", 15.0)
    recorder = graph.client.create_publisher(RecorderState, TOPIC, qos.LATCHED)
    recorder.publish(RecorderState(state=RecorderState.PAUSED))
    aside = StandAside(graph.context)
    try:
        aside.wait_for_recorder(15.0)
        assert aside.wanted
        recorder.publish(RecorderState(state=RecorderState.STOPPED))
        wait_for(lambda: not aside.wanted, "the end of the replay")
    finally:
        aside.close()


def test_a_recorder_that_is_gone_wants_nothing(graph, aside):
    recorder = graph.client.create_publisher(RecorderState, TOPIC, qos.LATCHED)
    recorder.publish(RecorderState(state=RecorderState.REPLAYING))
    wait_for(lambda: aside.wanted, "the replay")
    graph.client.destroy_publisher(recorder)
    wait_for(lambda: not aside.wanted, "the recorder gone")


def test_without_a_recorder_nobody_waits(aside):
    aside.wait_for_recorder(0.0)
    assert not aside.wanted
