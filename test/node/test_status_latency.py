"""What `mrlab status` makes of reports on latency, which clients send, too."""

from __future__ import annotations

import time
from types import SimpleNamespace

import pytest
from mrlab_msgs.msg import Latency, LatencyHop
from rich.console import Console

from mrlab_ros.commands.status import LATENCY_AGE_S, View


class Graph:
    """A graph in which a test says what arrives."""

    domain = 231

    def __init__(self):
        self.heard = {}

    def watch(self, kind, topic, quality=None):
        return SimpleNamespace(value=None)

    def subscribe(self, kind, topic, callback, quality):
        self.heard[topic] = callback


@pytest.fixture
def graph():
    return Graph()


@pytest.fixture
def view(graph):
    return View(graph)


def report(observer, age=0.0, p50=0.001):
    hop = LatencyHop(hop=LatencyHop.PUBLISHED_TO_RECEIVED, count=1, p50=p50, p95=p50, max=p50)
    message = Latency(observer=observer, window=1.0, hops=[hop])
    stamp_ns = time.time_ns() - round(age * 1e9)
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp_ns, 10**9)
    return message


def observers(view):
    return [entry["observer"] for entry in view.facts()["latency"]]


def test_a_client_does_not_pass_for_the_bridge(graph, view):
    graph.heard["/latency"](report("bridge"))
    graph.heard["/latency/clients"](report("bridge", p50=9.0))
    graph.heard["/latency/clients"](report("anna"))
    found = view.facts()["latency"]
    assert [entry["observer"] for entry in found] == ["bridge", "client anna", "client bridge"]
    assert found[0]["hops"][0]["p50"] == 0.001


@pytest.mark.parametrize("age", [LATENCY_AGE_S + 1, -LATENCY_AGE_S - 1])
def test_who_is_silent_or_ahead_of_time_is_forgotten(graph, view, age):
    for i in range(100):
        graph.heard["/latency/clients"](report(f"client_{i}", age))
    assert observers(view) == []
    assert not view._latencies


def test_a_client_s_name_does_nothing_to_the_terminal(graph, view):
    graph.heard["/latency/clients"](report("quest\x1b[2J\x07\nrest"))
    console = Console(width=200)
    with console.capture() as capture:
        console.print(view.table())
    assert "\x1b[2J" not in capture.get()
    assert observers(view) == ["client quest?[2J??rest"]
