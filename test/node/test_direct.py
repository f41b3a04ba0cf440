"""Joint states that playback puts on zenoh itself, and clients that see no difference."""

from __future__ import annotations

import json

import numpy as np
import pytest
import small_lab
import zenoh
from graph import wait_for
from mrlab_msgs.msg import Latency
from mrlab_msgs.srv import Trigger
from own_port import free_endpoint
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState
from small_lab import TRAJECTORIES, load, spawn
from zenoh_side import connect, heard, joints, statistics, tokens

from mrlab_ros.adapters.keys.folder import Keys, now
from mrlab_ros.core.bridge.access import Login
from mrlab_ros.core.bridge.direct import OFFERS, REPORTS, Carried, report
from mrlab_ros.core.bridge.latency import stamps
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.messages import qos
from mrlab_ros.nodes.bridge.node import BridgeNode


@pytest.fixture
def socket(tmp_path):
    return str(tmp_path / "lab.sock")


def bridge(graph, endpoint, socket, **parameters):
    return graph.add(
        BridgeNode, listen=[endpoint], socket=socket, discovery_period=0.02, **parameters
    )


def granted(bridge):
    return [name for name, route in bridge._outward._routes.items() if route.direct]


def received(bridge):
    """Return whether the bridge receives joint states from the graph."""
    return any("joint" in t for t, r in bridge._outward._routes.items() if r.subscription)


def collect(session, prefix=""):
    got = []
    session.declare_subscriber(f"{prefix}*/joint_states", got.append)
    return got


def played(graph, robot, got):
    """Play, and return what came over zenoh as messages, with its stamps."""
    load(graph, robot, "wave")
    assert graph.call(Trigger, f"/{robot}/play").success
    end = TRAJECTORIES["wave"].positions[-1]

    def messages():
        return [deserialize_message(s.payload.to_bytes(), JointState) for s in list(got)]

    wait_for(lambda: got and np.array_equal(messages()[-1].position, end), "the last frame")
    return messages(), [stamps(s.attachment.to_bytes()) for s in got]


@pytest.mark.parametrize("prefix", ["", "campus/lab_1"])
def test_every_frame_goes_once_and_as_through_the_bridge(graph, endpoint, socket, prefix):
    forwarding = bridge(graph, endpoint, socket, prefix=prefix)
    small_lab.start(graph, socket=socket, prefix=prefix)
    below = f"{prefix}/" if prefix else ""
    reports = graph.listen(Latency, "latency", qos.LATCHED)
    in_graph = graph.listen(JointState, "/ur5e_1/joint_states", qos.STREAM)
    with connect(endpoint) as session:
        got = collect(session, below)
        robot = spawn(graph)
        key = f"{robot}/joint_states"
        wait_for(lambda: heard(session, key, below) and granted(forwarding), "the grant")
        wait_for(lambda: got, "the pose of an arm that stands, at once")
        over_zenoh, attached = played(graph, robot, got)
        assert not received(forwarding)
        # All from where both had found their topic on.
        begin = next(i for i, m in enumerate(over_zenoh) if m in in_graph)
        same = over_zenoh[begin:]
        assert len(same) >= len(TRAJECTORIES["wave"].positions) / 2
        wait_for(lambda: same[-1] in in_graph, "the last frame in the graph")
        place = in_graph.index(same[0])
        assert in_graph[place : place + len(same)] == same
        assert [a.sequence for a in attached] == list(range(1, len(got) + 1))
        assert all(0 < a.published_ns <= a.bridged_ns for a in attached)
        assert any(f"§{robot}§joint_states" in t or f"{robot}§joint_states" in t
                   for t in tokens(session))  # fmt: skip
        wait_for(
            lambda: statistics(session, below)["keys"][below + key]["messages"] == len(got),
            "the bridge's count",
        )
        topics = {hop.topic for report in reports for hop in report.hops}
        assert f"/{key}" in topics


def test_what_another_node_publishes_on_the_topic_arrives_too(graph, endpoint, socket):
    forwarding = bridge(graph, endpoint, socket)
    small_lab.start(graph, socket=socket)
    robot = spawn(graph)
    with connect(endpoint) as session:
        got = collect(session)
        wait_for(lambda: got and granted(forwarding), "the grant")
        topic = f"/{robot}/joint_states"
        other = graph.client.create_publisher(JointState, topic, qos.STREAM)
        wait_for(lambda: received(forwarding) and not granted(forwarding), "the bridge's own way")

        def forwarded():
            other.publish(joints(3.0))
            found = [deserialize_message(s.payload.to_bytes(), JointState) for s in list(got)]
            return {"shoulder"} & {m.name[0] for m in found}

        wait_for(forwarded, "the other's message")
        graph.client.destroy_publisher(other)
        wait_for(lambda: granted(forwarding) and not received(forwarding), "the grant again")


def test_a_bridge_that_starts_again_grants_again(graph, endpoint, socket):
    first = bridge(graph, endpoint, socket)
    small_lab.start(graph, socket=socket)
    spawn(graph)
    wait_for(lambda: granted(first), "the grant")
    graph.drop(first)
    second = bridge(graph, endpoint, socket)
    wait_for(lambda: granted(second), "the grant of the second")
    with connect(endpoint) as session:
        got = collect(session)
        wait_for(lambda: got, "a joint state")
        assert stamps(got[0].attachment.to_bytes()).sequence == 1
        assert not received(second)


@pytest.mark.parametrize(
    ("rule", "parameters"),
    [({"max_rate": 20, "congestion": "drop"}, {}), ({}, {}), (None, {"direct": False})],
)
def test_the_bridge_forwards_what_it_does_not_grant(
    graph, endpoint, socket, listed, rule, parameters
):
    if rule is None:
        forwarding = bridge(graph, endpoint, socket)
    else:
        allowed = {"topics": [{"name": "/*/joint_states", **rule}]}
        forwarding = listed(allowed, socket=socket)
    small_lab.start(graph, socket=socket, **parameters)
    with connect(endpoint) as session:
        got = collect(session)
        robot = spawn(graph)
        wait_for(lambda: got and received(forwarding), "the bridge's own way")
        played(graph, robot, got)
        assert not granted(forwarding)


def test_a_lab_with_keys_takes_offers_from_its_own_machine_only(graph, tmp_path, socket):
    keys = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, now())
    keys.add("ada", Role.INSTRUCTOR, now())
    endpoint = free_endpoint("tls", "localhost")
    forwarding = bridge(graph, endpoint, socket, keys=str(keys.folder))
    small_lab.start(graph, socket=socket)
    config = zenoh.Config.from_file(str(keys.folder / "clients" / "ada.json5"))
    config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    with zenoh.open(config) as session:
        offer = session.liveliness().declare_token(f"{OFFERS[1:]}/ada_1/joint_states")
        session.put(REPORTS[1:], report(Carried("/ada_1/joint_states", 9, [1])))
        got = collect(session)
        robot = spawn(graph)
        wait_for(lambda: got and granted(forwarding), "a joint state that playback put")
        played(graph, robot, got)
        # A query on the same link has come after the offer.
        assert "ada_1/joint_states" not in statistics(session)["keys"]
        assert forwarding._outward._direct._offered == {f"/{robot}/joint_states"}
        offer.undeclare()
