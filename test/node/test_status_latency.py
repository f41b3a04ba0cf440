"""What `mrlab status` makes of reports on latency, which clients send, too."""

from __future__ import annotations

import time
from types import SimpleNamespace

import pytest
from mrlab_msgs.msg import Latency, LatencyHop
from rich.console import Console

from mrlab_ros.commands.status.table import overview
from mrlab_ros.commands.status.view import LATENCY_AGE_S, Presence, View, expected_nodes


class Graph:
    """A graph in which a test says what arrives."""

    domain = 231
    prompt = False

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
        console.print(overview(view.facts(), {}, console.width))
    assert "\x1b[2J" not in capture.get()
    assert observers(view) == ["client quest?[2J??rest"]


def test_a_node_that_is_discovered_late_is_not_missing():
    known, now = {"lab"}, [0.0]

    def clock():
        now[0] += 0.5
        if now[0] > 2.0:
            known.add("bridge")
        return now[0]

    presence = Presence(lambda: known, clock)
    assert presence.wait(lambda: ("lab", "bridge")) == {"lab": True, "bridge": True}
    assert presence.wait(lambda: ("lab", "playback_host")) == {
        "lab": True,
        "playback_host": False,
    }


def test_a_node_is_missing_in_the_live_view_after_a_while():
    known, now = {"lab"}, [0.0]
    presence = Presence(lambda: known, lambda: now[0])
    for now[0], lab, bridge in ((4.0, True, True), (6.0, True, False)):
        assert presence.present(("lab", "bridge"), 5.0) == {"lab": lab, "bridge": bridge}
    known.clear()
    for now[0], lab in ((10.0, True), (12.0, False)):
        assert presence.present(("lab",), 5.0) == {"lab": lab}


def test_only_the_nodes_of_this_lab_are_expected():
    everything = expected_nodes(None, in_replay=False)
    assert {"bridge", "physics", "lab", "playback_host"} <= set(everything)
    kept = {"processes": [{"name": name} for name in ("lab", "playback", "recorder")]}
    without = set(expected_nodes(kept, in_replay=False))
    assert set(everything) - without == {"bridge", "frames", "physics"}
    assert set(expected_nodes(None, in_replay=True)) == {"bridge", "recorder"}
