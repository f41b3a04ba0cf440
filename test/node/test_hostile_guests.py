"""People with keys who take more than their share: real zenoh sessions against a real bridge."""

from __future__ import annotations

import json
from contextlib import suppress

import pytest
import zenoh
from graph import wait_for
from mrlab_msgs.msg import Latency
from mrlab_msgs.srv import ListTrajectories
from own_port import free_endpoint
from rclpy.serialization import serialize_message

from mrlab_ros.adapters.keys.folder import Keys, now
from mrlab_ros.core.bridge import guests
from mrlab_ros.core.bridge.access import Login
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.messages import qos
from mrlab_ros.nodes.bridge import node
from mrlab_ros.nodes.bridge.node import BridgeNode

REPORTS = "latency/clients"
LIST = "converter/list"


@pytest.fixture(scope="module")
def keys(tmp_path_factory):
    made = Keys.create(tmp_path_factory.mktemp("lab") / "keys", [], Login.CERTIFICATE, now())
    for role in Role:
        made.add(role.value, role, now())
    return made


@pytest.fixture
def endpoint():
    return free_endpoint("tls", "localhost")


@pytest.fixture
def start(graph, endpoint, keys):
    """Start a bridge with keys."""

    def make(**parameters):
        settings = {"listen": [endpoint], "discovery_period": 0.02, "keys": str(keys.folder)}
        return graph.add(BridgeNode, **(settings | parameters))

    return make


@pytest.fixture
def enter(endpoint, keys):
    """Open a session of a person; all are closed after the test."""
    opened = []

    def make(name):
        config = zenoh.Config.from_file(str(keys.client_file(name)))
        config.insert_json5("connect/endpoints", json.dumps([endpoint]))
        opened.append(zenoh.open(config))
        return opened[-1]

    yield make
    for session in opened:
        session.close()


@pytest.fixture
def received(graph):
    """Collect what arrives in the graph of clients' reports."""
    got = []
    graph.client.create_subscription(Latency, f"/{REPORTS}", got.append, qos.EVENTS)
    return got


def report(observer):
    return bytes(serialize_message(Latency(observer=observer)))


def entered(enter, name):
    try:
        return enter(name)
    except zenoh.ZError:
        return None


def connected(session):
    return bool(session.info.links())


def answers(session, key, payload=None):
    replies = list(session.get(key, payload=payload, timeout=10.0))
    return [r.ok.payload.to_bytes() if r.ok else r.err.payload.to_string() for r in replies]


def refused(session):
    (found,) = answers(session, "@mrlab/bridge/statistics")
    return json.loads(found)["keys"][REPORTS]["refused"]


def test_messages_that_are_too_large_or_too_many_do_not_reach_the_bridge(start, enter, received):
    start(guest_burst=1e9)
    viewer, screen = enter("display"), enter("student")
    publisher = viewer.declare_publisher(REPORTS)
    wait_for(lambda: publisher.matching_status.matching, "the topic")
    large = report("x" * 100_000)
    for _ in range(50):
        publisher.put(large)
    for i in range(20_000):
        publisher.put(report(f"viewer {i}"))
    wait_for(lambda: received, "the first report")

    # On the way of the flood, behind it, and by another person.
    def others_arrive():
        screen.put(REPORTS, report("screen"))
        return any(each.observer == "screen" for each in received)

    wait_for(others_arrive, "the report of somebody else")
    assert not any(each.observer.startswith("x") for each in received)
    # Had zenoh passed all of them on, the bridge would have refused thousands.
    assert refused(screen) < 500
    assert sum(each.observer.startswith("viewer") for each in received) < 5_000


def test_one_viewer_cannot_keep_the_teacher_out(start, enter, monkeypatch):
    # Together fewer sessions than the viewer tries to have.
    monkeypatch.setattr(node, "LEAST_SESSIONS", 0)
    monkeypatch.setattr(guests, "SPARE", 10)
    start(sessions_each=3)
    crowd = []
    for _ in range(30):
        with suppress(zenoh.ZError):  # no room at this instant
            crowd.append(enter("display"))
    wait_for(lambda: sum(map(connected, crowd)) <= 3, "the surplus sessions to end")
    # The crowd goes on trying, several times a second each.
    teacher = wait_for(lambda: entered(enter, "instructor"), "the teacher to come in")
    assert answers(teacher, "@mrlab/bridge/clock")
    assert connected(teacher)


def test_who_sends_without_end_is_disconnected_and_others_are_not(start, enter):
    start(guest_burst=200_000.0)
    viewer, screen, teacher = enter("display"), enter("student"), enter("instructor")
    assert connected(viewer)

    def flood():
        # Neither a key that one may publish nor one that exists.
        for _ in range(100):
            viewer.put("robots", b"x" * 10_000)
            teacher.put("robots", b"x" * 10_000)
        return not connected(viewer)

    wait_for(flood, "the viewer to be disconnected")
    assert connected(screen)
    assert connected(teacher)


def test_a_request_that_is_too_large_is_refused_with_a_reason(graph, start, enter):
    start(guest_burst=1e9)
    called = []
    graph.client.create_service(
        ListTrajectories, f"/{LIST}", lambda request, answer: called.append(1) or answer
    )
    viewer = enter("display")
    wait_for(lambda: answers(viewer, LIST, bytes(serialize_message(_ask()))), "the service")
    called.clear()
    (reason,) = answers(viewer, LIST, b"\0" * 300_000)
    assert "/converter/list has 300000 bytes" in reason
    assert not called


def _ask():
    return ListTrajectories.Request()
