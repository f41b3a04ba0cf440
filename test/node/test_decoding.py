"""Bytes that are no message break no view: they are counted, and said with their publisher."""

from __future__ import annotations

import pytest
from graph import wait_for
from mrlab_msgs import msg

from mrlab_ros.core.runtime.bucket import Occurrences
from mrlab_ros.messages import qos
from mrlab_ros.ros import decoding
from mrlab_ros.ros.calls import NoAnswer
from mrlab_ros.ros.graph_node import Graph

GARBAGE = b"\x00\x01\x00\x00" + b"\xff" * 80


@pytest.fixture(autouse=True)
def nothing_undecoded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(decoding, "_undecoded", Occurrences())


def test_garbage_is_counted_with_its_publisher_and_messages_after_it_arrive(graph):
    publisher = graph.client.create_publisher(
        msg.RecorderState, "/recorder/state", qos.LATCHED_EVENTS
    )
    for _ in range(50):
        publisher.publish(GARBAGE)
    heard: list[str] = []
    decoding.subscribe(
        graph.client,
        msg.RecorderState,
        "/recorder/state",
        lambda message: heard.append(message.bag),
        qos.LATCHED_EVENTS,
    )
    wait_for(decoding.undecoded, "garbage to be counted")
    publisher.publish(msg.RecorderState(bag="after"))
    wait_for(lambda: heard == ["after"], "the message after the garbage")
    (said,) = decoding.undecoded()
    assert said.code == "undecodable"
    assert said.values["topic"] == "/recorder/state"
    assert said.values["publishers"] == [graph.client.get_fully_qualified_name()]
    assert said.values["count"] >= 1


def test_a_decoder_without_a_node_counts_too():
    heard: list[object] = []
    take = decoding.decoder(msg.RecorderState, "/recorder/state", heard.append)
    take(b"")
    take(GARBAGE)
    assert heard == []
    (said,) = decoding.undecoded()
    assert said.values["count"] == 2


def test_who_asks_for_robots_hears_of_garbage_in_their_place(graph):
    publisher = graph.client.create_publisher(msg.Robots, "/robots", qos.LATCHED)
    publisher.publish(GARBAGE)
    with Graph() as client, pytest.raises(NoAnswer) as refused:
        client.robots(2.0)
    assert refused.value.diagnostic.code == "undecodable"
