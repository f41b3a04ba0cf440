"""Clients that hang, links that break, routers between, several labs: with real sessions."""

from __future__ import annotations

import json
import signal
import threading

import pytest
import zenoh
from graph import wait_for
from mrlab_msgs.msg import Robot, Robots
from mrlab_msgs.srv import SetLoop, Trigger
from own_port import free_endpoint
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState
from wire import Wire
from zenoh import ext
from zenoh_side import (
    JOINTS,
    ask,
    connect,
    heard,
    joints,
    start_client,
    statistics,
    tokens,
)

from mrlab_ros.adapters.zenoh.configuration import configuration
from mrlab_ros.core.bridge.latency import stamps
from mrlab_ros.messages import qos
from mrlab_ros.nodes.bridge.node import BridgeNode

# What a client needs to notice a dead link and to try again as soon as the bridge does.
HEALING = {
    "transport__link__tx__lease": 1500,
    "transport__unicast__open_timeout": 2000,
    "connect__retry": {
        "period_init_ms": 250,
        "period_max_ms": 500,
        "period_increase_factor": 1.5,
    },
}


@pytest.fixture
def bridge(graph, endpoint):
    return graph.add(BridgeNode, listen=[endpoint], discovery_period=0.02, lease=1.5)


@pytest.fixture
def wire(bridge, endpoint):
    wire = Wire(int(endpoint.rsplit(":", 1)[1]))
    yield wire
    wire.close()


@pytest.fixture
def router():
    """Run what zenohd is: a router that knows no lab."""
    endpoint = free_endpoint()
    config = zenoh.Config()
    config.insert_json5("mode", '"router"')
    config.insert_json5("listen/endpoints", json.dumps([endpoint]))
    config.insert_json5("scouting/multicast/enabled", "false")
    with zenoh.open(config):
        yield endpoint


def test_a_client_that_is_stopped_costs_another_no_message(graph, bridge, session, endpoint):
    state = graph.client.create_publisher(Robots, "robots", qos.LATCHED_EVENTS)
    motion = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    stuck = [
        start_client("mrlab_client.py", "--connect", endpoint, "watch", *what)
        for what in ((JOINTS, "sensor_msgs/msg/JointState"), ("robots", "std_msgs/msg/String"))
    ]
    try:
        wait_for(lambda: heard(session, JOINTS) and heard(session, "robots"), "both clients")
        for client in stuck:
            client.send_signal(signal.SIGSTOP)
        moved, states = [], []
        session.declare_subscriber(JOINTS, lambda s: moved.append(stamps(bytes(s.attachment))))
        session.declare_subscriber("robots", lambda s: states.append(s.payload.to_bytes()))

        def arrives():
            # Until the bridge knows of these subscribers, too.
            motion.publish(joints(0.0))
            state.publish(Robots())
            return moved and states

        wait_for(arrives, "the first frame and the first state")
        # More than the link of a stopped client can hold.
        big = Robots(robots=[Robot(name="x" * 200_000)])
        first = moved[0].sequence
        for i in range(150):
            motion.publish(joints(float(i)))
            if i % 5 == 0:
                state.publish(big)
            wait_for(lambda i=i: len(moved) > i + 1, f"frame {i}")
        wait_for(lambda: sum(len(s) > 200_000 for s in states) == 30, "all states", 40)
        sent = statistics(session)["keys"][JOINTS]["messages"]
        wait_for(lambda: len(moved) == sent - first + 1, "all frames")
        assert [m.sequence for m in moved] == list(range(first, sent + 1))
    finally:
        for client in stuck:
            client.kill()
            client.communicate()


def test_calls_wait_for_those_before_them_and_too_many_are_refused(graph, listed, endpoint):
    listed({"services": [{"name": "/slow", "waiting": 20, "timeout": 60}]})
    released, asked = threading.Event(), []

    def answer(request, response):
        released.wait(30)
        asked.append(request.loop)
        response.success, response.message = True, f"call {len(asked)}"
        return response

    graph.client.create_service(SetLoop, "slow", answer)
    answers, refused = [], []

    def sort(reply):
        if reply.ok is not None:
            answers.append(deserialize_message(reply.ok.payload.to_bytes(), SetLoop.Response))
        else:
            refused.append(reply.err.payload.to_string())

    with connect(endpoint) as session:
        wait_for(lambda: any("SS/slow/" in t for t in tokens(session)), "the service")
        request = b"\0\1\0\0\1"
        for _ in range(40):
            session.get("slow", sort, payload=request, timeout=60.0)
        # Eight are with the server, twenty wait.
        wait_for(lambda: len(refused) == 12, "the refusals")
        assert all("20 calls waiting" in reason for reason in refused)
        released.set()
        wait_for(lambda: len(answers) == 28, "the answers")
        assert len(asked) == 28
        assert ask(session, "slow", request)[1] is None


class Watcher:
    """A client that follows motion, states and who is there."""

    def __init__(self, endpoint):
        self.moved, self.names, self.there = [], [], set()
        self.session = connect(endpoint, **HEALING)
        self._kept = [
            self.session.declare_subscriber(JOINTS, lambda s: self.moved.append(s)),
            ext.declare_advanced_subscriber(
                self.session,
                "robots",
                lambda s: self.names.append(self._name(s)),
                history=ext.HistoryConfig(detect_late_publishers=True),
            ),
            self.session.liveliness().declare_subscriber(
                "@/*/@ros2_lv/**", self._note, history=True
            ),
        ]

    def _name(self, sample):
        return deserialize_message(sample.payload.to_bytes(), Robots).robots[0].name

    def _note(self, sample):
        came = sample.kind == zenoh.SampleKind.PUT
        (self.there.add if came else self.there.discard)(str(sample.key_expr))


@pytest.mark.parametrize("how", ["cut", "freeze"])
def test_a_link_that_comes_back_heals_without_ghosts(graph, bridge, session, wire, how):
    state = graph.client.create_publisher(Robots, "robots", qos.LATCHED)
    motion = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    state.publish(Robots(robots=[Robot(name="before")]))
    watcher = Watcher(wire.endpoint)
    with watcher.session:
        wait_for(lambda: watcher.names == ["before"], "the state")
        wait_for(lambda: heard(session, JOINTS), "the bridge to hear of the client")
        wait_for(
            lambda: {"MP"} <= {t.split("/")[3] for t in watcher.there if t.count("/") > 2},
            "tokens",
        )
        tokens_before = set(watcher.there)
        getattr(wire, how)()
        wait_for(lambda: not watcher.there, "the client to notice that the lab is gone")
        # The bridge notices, too: nobody listens to motion.
        wait_for(lambda: not heard(session, JOINTS), "the bridge to notice")
        state.publish(Robots(robots=[Robot(name="meanwhile")]))
        wire.mend()
        wait_for(lambda: watcher.there == tokens_before, "the tokens to come back")
        wait_for(lambda: watcher.names[-1] == "meanwhile", "the state from meanwhile")
        wait_for(lambda: heard(session, JOINTS), "the bridge to hear of the client again")
        seen = len(watcher.moved)
        motion.publish(joints(1.0))
        wait_for(lambda: len(watcher.moved) > seen, "motion")
        assert len(watcher.moved) == seen + 1
        assert watcher.names == ["before", "meanwhile"]


def test_several_labs_share_a_router_and_a_client_sees_each(graph, other_graph, router):
    labs = {"north/lab_1": graph, "south/lab_2": other_graph}
    for prefix, each in labs.items():
        each.add(
            BridgeNode,
            mode="client",
            connect=[router],
            listen=[""],
            prefix=prefix,
            discovery_period=0.02,
        )

        def answer(request, response, prefix=prefix):
            response.success, response.message = True, f"plays in {prefix}"
            return response

        each.client.create_service(Trigger, "ur5e_1/play", answer)
    motion = {
        prefix: each.client.create_publisher(JointState, JOINTS, qos.STREAM)
        for prefix, each in labs.items()
    }
    with connect(router) as session:
        got = []
        session.declare_subscriber(f"*/*/{JOINTS}", lambda s: got.append(str(s.key_expr)))
        wait_for(lambda: sum("SS/" in t for t in tokens(session)) == 2, "both labs' services")
        for prefix in labs:
            wait_for(lambda p=prefix: heard(session, JOINTS, f"{p}/"), f"{prefix} to hear of it")
            motion[prefix].publish(joints(1.0))
            wait_for(lambda p=prefix: got[-1:] == [f"{p}/{JOINTS}"], f"motion of {prefix}")
            reply, _ = ask(session, f"{prefix}/ur5e_1/play")
            answer = deserialize_message(reply, Trigger.Response)
            assert answer.message == f"plays in {prefix}"
            assert statistics(session, f"{prefix}/")["prefix"] == prefix
        assert len(got) == 2


@pytest.mark.parametrize("mode", ["peer", "router", "client"])
def test_a_lab_is_reached_over_a_router_in_every_mode(graph, router, mode):
    listen = "" if mode == "client" else free_endpoint()
    graph.add(BridgeNode, mode=mode, connect=[router], listen=[listen], discovery_period=0.02)
    motion = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    state = graph.client.create_publisher(Robots, "robots", qos.LATCHED)
    state.publish(Robots(robots=[Robot(name="ur5e_1")]))
    with connect(router) as session:
        got, names = [], []
        session.declare_subscriber(JOINTS, got.append)
        ext.declare_advanced_subscriber(
            session,
            "robots",
            lambda s: names.append(deserialize_message(s.payload.to_bytes(), Robots)),
            history=ext.HistoryConfig(detect_late_publishers=True),
        )
        wait_for(lambda: list(session.get("@mrlab/bridge/statistics")), "the bridge")
        wait_for(lambda: heard(session, JOINTS), "the bridge to hear of the subscriber")
        motion.publish(joints(1.0))
        wait_for(lambda: got, "motion")
        wait_for(lambda: names, "the state from before")
        assert [message.robots[0].name for message in names] == ["ur5e_1"]


@pytest.mark.parametrize(
    ("settings", "lease_ms", "batches"),
    [
        ({"listen": ("tcp/127.0.0.1:7447",)}, 10_000, 16),
        ({"listen": ("tcp/0.0.0.0:7447",)}, 1500, 2),
        ({"mode": "client", "listen": (), "connect": ("tcp/router:7447",)}, 1500, 2),
        ({"lease": 0.5}, 500, 16),
    ],
)
def test_a_link_that_leaves_this_machine_is_given_up_soon_and_holds_little(
    settings, lease_ms, batches
):
    tx = json.loads(configuration(**settings).get_json("transport/link/tx"))
    assert tx["lease"] == lease_ms
    assert tx["queue"]["size"]["data"] == batches


def test_a_lab_finds_a_router_that_starts_later(graph):
    endpoint = free_endpoint()
    graph.add(BridgeNode, mode="peer", connect=[endpoint], listen=[""], discovery_period=0.02)
    config = zenoh.Config()
    config.insert_json5("mode", '"router"')
    config.insert_json5("listen/endpoints", json.dumps([endpoint]))
    config.insert_json5("scouting/multicast/enabled", "false")
    with zenoh.open(config), connect(endpoint) as session:
        wait_for(lambda: list(session.get("@mrlab/bridge/statistics")), "the bridge")
