"""A secured router between a bridge and its people: real graph, real sessions over TLS."""

from __future__ import annotations

import json

import pytest
import yaml
import zenoh
from graph import wait_for
from mrlab_msgs.msg import Latency, Robots
from mrlab_msgs.srv import Remove, Trigger
from own_port import free_endpoint
from rclpy.parameter import Parameter
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState
from zenoh import ext
from zenoh_side import JOINTS, tokens

from mrlab_ros.adapters import share
from mrlab_ros.adapters.keys.folder import Keys, now
from mrlab_ros.adapters.zenoh.configuration import limits
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.bridge.access import Login
from mrlab_ros.core.bridge.rules import Role, parse
from mrlab_ros.messages import qos
from mrlab_ros.nodes.bridge.node import BridgeNode

CONFIG = share.directory() / "config"
PREFIX = "campus/lab_1/"
CALLS = {
    "ur5e_1/play": (Trigger, Role.OPERATOR),
    "recorder/stop": (Trigger, Role.INSTRUCTOR),
    "lab/remove_robot": (Remove, Role.INSTRUCTOR),
}


def write_router(keys):
    rules = parse(yaml.safe_load((CONFIG / "bridge.yaml").read_text()))
    return keys.router(rules, PREFIX[:-1], limits(CONFIG / "zenoh" / "lab.json5"), now())


@pytest.fixture(scope="module")
def keys(tmp_path_factory):
    made = Keys.create(tmp_path_factory.mktemp("lab") / "keys", [], Login.CERTIFICATE, now())
    for role in Role:
        made.add(role.value, role, now())
    write_router(made)
    made.add("late", Role.INSTRUCTOR, now())
    return made


@pytest.fixture
def endpoint():
    return free_endpoint("tls", "localhost")


@pytest.fixture
def router(keys, endpoint):
    config = zenoh.Config.from_file(str(keys.folder / "router.json5"))
    config.insert_json5("listen/endpoints", json.dumps([endpoint]))
    with zenoh.open(config):
        yield endpoint


@pytest.fixture
def connect(keys, router):
    opened = []

    def make(name):
        config = zenoh.Config.from_file(str(keys.client_file(name)))
        config.insert_json5("connect/endpoints", json.dumps([router]))
        opened.append(zenoh.open(config))
        return opened[-1]

    yield make
    for session in opened:
        session.close()


@pytest.fixture
def bridge(graph, keys, router):
    return graph.add(
        BridgeNode,
        keys=str(keys.folder),
        mode="client",
        connect=[router],
        prefix=PREFIX[:-1],
        discovery_period=0.02,
    )


def ask(session, key, payload=None):
    replies = session.get(key, payload=payload, timeout=10.0)
    return [reply.ok.payload.to_bytes() for reply in replies if reply.ok]


def test_the_router_lets_each_role_do_what_it_may(graph, bridge, connect):
    called = []

    def answerer(name):
        def answer(request, response):
            called.append(name)
            return response

        return answer

    for name, (kind, _) in CALLS.items():
        graph.client.create_service(kind, name, answerer(name))
    joints = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    graph.client.create_publisher(Robots, "robots", qos.LATCHED).publish(Robots())
    for role in Role:
        session, moved, states = connect(role.value), [], []
        session.declare_subscriber(f"{PREFIX}*/joint_states", moved.append)
        late = ext.declare_advanced_subscriber(
            session,
            f"{PREFIX}robots",
            states.append,
            history=ext.HistoryConfig(detect_late_publishers=True),
        )
        wait_for(lambda states=states: states, f"the state from before, for {role}")
        wait_for(
            lambda session=session: sum("/SS/" in t for t in tokens(session)) == len(CALLS),
            f"the services, for {role}",
        )
        assert ask(session, f"{PREFIX}robots")
        assert ask(session, f"{PREFIX}@mrlab/bridge/clock")

        def moves(moved=moved):
            joints.publish(JointState(name=["shoulder"]))
            return moved

        wait_for(moves, f"motion, for {role}")
        for name, (kind, needed) in CALLS.items():
            called.clear()
            answers = ask(session, PREFIX + name, bytes(serialize_message(kind.Request())))
            assert called == ([name] if role.may(needed) else []), f"{role} called {name}"
            assert len(answers) == len(called)
        late.undeclare()


def test_nobody_passes_for_the_lab_at_the_router(graph, bridge, connect):
    received = []
    watcher, instructor = connect("display"), connect("instructor")
    watcher.declare_subscriber(f"{PREFIX}**", lambda s: received.append(str(s.key_expr)))
    reports = graph.listen(Latency, "latency/clients", qos.LATCHED_EVENTS)
    held = [
        instructor.liveliness().declare_token("@/ab/@ros2_lv/MP/fake/x"),
        instructor.declare_queryable(f"{PREFIX}ur5e_1/play", lambda q: q.reply(q.key_expr, b"x")),
    ]

    def send():
        instructor.put(f"{PREFIX}{JOINTS}", b"fake")
        instructor.put(f"{PREFIX}latency/clients", bytes(serialize_message(Latency())))
        return reports and f"{PREFIX}latency/clients" in received

    wait_for(send, "what clients may send")
    assert f"{PREFIX}{JOINTS}" not in received
    assert not any("fake" in token for token in tokens(watcher))
    assert ask(watcher, f"{PREFIX}ur5e_1/play") == []
    assert len(held) == 2


def test_whom_the_router_s_file_does_not_name_sees_nothing(graph, bridge, connect):
    graph.client.create_publisher(Robots, "robots", qos.LATCHED).publish(Robots())
    named, late = connect("display"), connect("late")
    wait_for(lambda: ask(named, f"{PREFIX}robots"), "the state")
    assert ask(late, f"{PREFIX}robots") == []
    assert tokens(late) == set()


def test_a_bridge_connects_with_keys_to_a_secured_router_only(graph, keys, tmp_path):
    def refused(words, **settings):
        overrides = [Parameter(k, value=v) for k, v in settings.items()]
        with pytest.raises(BadInput, match=words):
            BridgeNode(context=graph.context, parameter_overrides=overrides)

    folder = str(keys.folder)
    refused("it can show none", keys=folder, mode="client", connect=["tcp/router:7447"])
    refused("set mode to client", keys=folder, connect=["tls/router:7447"])
    refused(
        "Leave listen empty",
        keys=folder,
        mode="client",
        connect=["tls/router:7447"],
        listen=["tls/0.0.0.0:7447"],
    )
    refused("Name the router", keys=folder, mode="client")
    without = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, now())
    refused(
        "no file",
        keys=str(without.folder),
        mode="client",
        connect=["tls/router:7447"],
    )


def test_a_router_takes_certificates_only(tmp_path):
    keys = Keys.create(tmp_path / "keys", [], Login.BOTH, now())
    with pytest.raises(Misuse, match="log in by certificate"):
        write_router(keys)
