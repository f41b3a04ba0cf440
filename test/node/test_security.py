"""A bridge with keys between a real graph and real zenoh sessions over TLS.

Where something must not happen, something that may has happened after it on the same way.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from contextlib import suppress
from datetime import timedelta
from pathlib import Path

import pytest
import zenoh
from child_process import HOST, start_child
from graph import wait_for
from mrlab_msgs.msg import Latency, Robot, Robots
from mrlab_msgs.srv import ListTrajectories, Remove, StartRecording, Step, Trigger
from own_port import free_endpoint
from rclpy.parameter import Parameter
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState
from zenoh import ext

from mrlab_ros.adapters.keys.folder import Keys, now
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge import access
from mrlab_ros.core.bridge.access import Login
from mrlab_ros.core.bridge.rules import Role
from mrlab_ros.messages import qos
from mrlab_ros.nodes.bridge.node import BridgeNode

ROOT = Path(__file__).parents[2]
CLIENT = ROOT / "examples" / "clients" / "python" / "mrlab_client.py"
JOINTS = "ur5e_1/joint_states"
TOKENS = "@/*/@ros2_lv/**"
# Ways to reach what one may not ask for by its name.
TRICKS = (
    "**",
    "*/play",
    "*/stop",
    "ur5e_1/*",
    "ur5e_1/**",
    "**/play",
    "ur5e_1/pl$*",
    "$*_1/play",
    "rec$*/stop",
    "recorder/s$*",
    "recorder/stop/**",
    "ur5e_1/play/**",
    "**/recorder/stop",
    "@/**",
    "@/*/**",
    "@/*/router/**",
    "@/*/session/**",
)
CALLS = {
    "converter/list": (ListTrajectories, Role.DISPLAY),
    "ur5e_1/play": (Trigger, Role.OPERATOR),
    "cell/step": (Step, Role.OPERATOR),
    "recorder/stop": (Trigger, Role.INSTRUCTOR),
    "lab/remove_robot": (Remove, Role.INSTRUCTOR),
}


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """Make a keys folder for every way to log in, with somebody of each role."""
    made = {}
    for login in Login:
        made[login] = Keys.create(tmp_path_factory.mktemp("lab") / "keys", [], login, now())
        for role in Role:
            made[login].add(role.value, role, now())
    return made


@pytest.fixture(scope="module")
def keys(folders):
    return folders[Login.CERTIFICATE]


@pytest.fixture
def endpoint():
    return free_endpoint("tls", "localhost")


@pytest.fixture
def start(graph, endpoint):
    """Start a bridge with the keys of a folder."""

    def make(keys, **parameters):
        settings = {"listen": [endpoint], "discovery_period": 0.02, "keys": str(keys.folder)}
        return graph.add(BridgeNode, **(settings | parameters))

    return make


def configuration(file, endpoint):
    """Return what a client's file says, for the endpoint of this test."""
    config = zenoh.Config.from_file(str(file))
    config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    return config


@pytest.fixture
def connect(endpoint):
    """Open sessions that are closed after the test."""
    opened = []

    def make(file):
        opened.append(zenoh.open(configuration(file, endpoint)))
        return opened[-1]

    yield make
    for session in opened:
        session.close()


@pytest.fixture
def people(keys, start, connect):
    """Start a bridge and connect one person of each role, by certificate."""
    start(keys)
    return {role: connect(keys.client_file(role.value)) for role in Role}


def ask(session, key, payload=None):
    """Return the payloads, and the reasons, with which a key was answered."""
    replies = list(session.get(key, payload=payload, timeout=10.0))
    good = [reply.ok.payload.to_bytes() for reply in replies if reply.ok]
    return good, [reply.err.payload.to_string() for reply in replies if not reply.ok]


def tokens(session):
    return {str(reply.ok.key_expr) for reply in session.liveliness().get(TOKENS) if reply.ok}


def offered(session, key):
    return any(f"SS/{key.replace('/', '§')}/" in token for token in tokens(session))


def serve(graph, names):
    """Offer the services of CALLS in the graph; return a list that tells which were called."""
    called = []

    def answerer(name):
        def answer(request, response):
            called.append(name)
            return response

        return answer

    for name in names:
        graph.client.create_service(CALLS[name][0], name, answerer(name))
    return called


def request(name):
    return bytes(serialize_message(CALLS[name][0].Request()))


@pytest.mark.parametrize("login", Login)
def test_each_way_to_log_in_lets_its_people_in(graph, folders, start, connect, login):
    start(folders[login])
    graph.client.create_publisher(Robots, "robots", qos.LATCHED).publish(Robots())
    for role in Role:
        session = connect(folders[login].client_file(role.value))
        wait_for(lambda session=session: ask(session, "robots")[0], f"the state for {role}")


def test_whoever_may_connect_receives_streams_states_and_who_is_there(graph, people):
    joints = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    graph.client.create_publisher(Robots, "robots", qos.LATCHED).publish(Robots())
    wait_for(lambda: ask(people[Role.DISPLAY], "robots")[0], "the newest state")
    streamed, states = {role: [] for role in Role}, {role: [] for role in Role}
    history = ext.HistoryConfig(detect_late_publishers=True)
    late = []
    for role, session in people.items():
        session.declare_subscriber("*/joint_states", streamed[role].append)
        late.append(
            ext.declare_advanced_subscriber(
                session, "robots", states[role].append, history=history
            )
        )
    wait_for(lambda: all(states.values()), "the state from before")

    def everybody_has_one():
        joints.publish(JointState(name=["shoulder"]))
        return all(streamed.values())

    wait_for(everybody_has_one, "a frame for everybody")
    for session in people.values():
        assert any("MP/robots/" in token for token in tokens(session))
        assert ask(session, "@mrlab/bridge/statistics")[0]


@pytest.mark.parametrize("prefix", ["", "campus/lab_1/"])
def test_whoever_may_connect_draws_and_decodes_the_lab(keys, start, connect, prefix):
    start(keys, prefix=prefix.rstrip("/"))
    mesh = "assets/mrlab_ros/robots/ur5e/meshes/base_link_inertia.glb"
    for role in Role:
        session = connect(keys.client_file(role.value))
        answers, reasons = ask(session, f"{prefix}{mesh}")
        assert (answers[0][:4], reasons) == (b"glTF", []), role
        assert json.loads(ask(session, f"{prefix}assets/robots.json")[0][0])["robots"]
        assert json.loads(ask(session, f"{prefix}schema")[0][0])["messages"]
        foreign, why = ask(session, f"{prefix}assets/mrlab_ros/config/bridge.yaml")
        assert foreign == []
        assert "no asset" in why[0]


@pytest.mark.parametrize("prefix", ["", "campus/lab_1/"])
def test_each_role_calls_what_it_may_and_nothing_else(graph, keys, start, connect, prefix):
    start(keys, prefix=prefix.rstrip("/"))
    people = {role: connect(keys.client_file(role.value)) for role in Role}
    called = serve(graph, CALLS)
    for name in CALLS:
        wait_for(lambda key=prefix + name: offered(people[Role.DISPLAY], key), name)
    for role, session in people.items():
        for name, (_, needed) in CALLS.items():
            called.clear()
            answers, reasons = ask(session, prefix + name, request(name))
            assert reasons == []
            assert called == ([name] if role.may(needed) else []), f"{role} called {name}"
            assert len(answers) == len(called)


def test_a_client_that_heeds_nothing_is_refused_by_the_bridge(
    graph, keys, start, connect, monkeypatch
):
    # zenoh's own clients do not ask for what the bridge does not offer them. Here it offers all.
    real = access.role_rules

    def all_goes_out(rules, role, prefix=""):
        everything = {
            "id": f"{role.value}_everything_goes_out",
            "permission": "allow",
            "flows": ["egress"],
            "messages": ["declare_queryable", "declare_subscriber", "reply", "put"],
            "key_exprs": ["**"],
        }
        return [*real(rules, role, prefix), everything]

    monkeypatch.setattr(access, "role_rules", all_goes_out)
    start(keys)
    people = {role: connect(keys.client_file(role.value)) for role in Role}
    graph.client.create_publisher(Robots, "robots", qos.LATCHED).publish(Robots())
    called = serve(graph, ["ur5e_1/play", "recorder/stop"])
    for name in ("ur5e_1/play", "recorder/stop"):
        wait_for(lambda name=name: offered(people[Role.DISPLAY], name), name)
    wait_for(lambda: ask(people[Role.DISPLAY], "robots")[0], "the newest state")
    viewer, operator = people[Role.DISPLAY], people[Role.OPERATOR]
    unanswered = [
        *(viewer.get(key, timeout=60.0) for key in ("ur5e_1/play", *TRICKS)),
        *(operator.get(key, timeout=60.0) for key in ("recorder/stop", *TRICKS)),
    ]
    # Each session's link keeps order: what is answered now came after the above.
    assert ask(viewer, "robots")[0]
    assert ask(operator, "robots")[0]
    assert ask(operator, "ur5e_1/play")[0]
    assert ask(people[Role.INSTRUCTOR], "recorder/stop")[0]
    assert called == ["ur5e_1/play", "recorder/stop"]
    assert len(unanswered) == 2 * (1 + len(TRICKS))


def test_a_pattern_calls_no_service(graph, people):
    called = serve(graph, ["recorder/stop", "ur5e_1/play"])
    instructor = people[Role.INSTRUCTOR]
    for name in ("recorder/stop", "ur5e_1/play"):
        wait_for(lambda name=name: offered(instructor, name), name)
    for session in (people[Role.OPERATOR], instructor):
        answers, reasons = ask(session, "*/stop")
        assert answers == []
        assert reasons == [
            "The service /recorder/stop is called by its key recorder/stop, not as */stop."
        ]
    assert called == []


def test_nobody_names_a_file_of_the_lab_s_machine(graph, people):
    asked = []

    def answer(request, response):
        asked.append(request.bag)
        return response

    graph.client.create_service(StartRecording, "recorder/start", answer)
    instructor = people[Role.INSTRUCTOR]
    wait_for(lambda: offered(instructor, "recorder/start"), "recorder/start")
    for path in ("/etc/bag", "../bag", "..", "~/bag", "a/b", "monday", ""):
        wanted = bytes(serialize_message(StartRecording.Request(bag=path)))
        answers, reasons = ask(instructor, "recorder/start", wanted)
        assert len(answers) + len(reasons) == 1
    assert asked == ["monday", ""]


def test_nobody_sends_for_the_lab(graph, keys, people, connect):
    received = {}

    def note(sample):
        received.setdefault(str(sample.key_expr), []).append(sample.payload.to_bytes())

    watcher = connect(keys.client_file("display"))
    watcher.declare_subscriber("**", note)
    reports = graph.listen(Latency, "latency/clients", qos.LATCHED_EVENTS)
    fake = bytes(serialize_message(JointState(name=["fake"])))
    for role, session in people.items():
        report = bytes(serialize_message(Latency(observer=role.value)))

        def send(session=session, report=report, role=role):
            session.put(JOINTS, fake)
            session.put("robots", fake)
            session.delete("robots")
            session.put("latency/clients", report)
            in_graph = any(message.observer == role.value for message in reports)
            return in_graph and report in received.get("latency/clients", [])

        wait_for(send, f"what {role} may send")
    assert JOINTS not in received
    assert "robots" not in received


def test_nobody_pretends_to_be_the_lab(people):
    viewer = people[Role.DISPLAY]
    got = []
    viewer.declare_subscriber("latency/clients", lambda s: got.append(s.payload.to_bytes()))
    report = bytes(serialize_message(Latency()))
    held = []
    for role in (Role.OPERATOR, Role.INSTRUCTOR):
        session = people[role]
        held.append(session.declare_queryable("ur5e_1/play", lambda q: q.reply(q.key_expr, b"x")))
        held.append(session.liveliness().declare_token("@/ab/@ros2_lv/MP/fake/x"))
        got.clear()

        def sent(session=session):
            session.put("latency/clients", report)
            return got

        wait_for(sent, "what was sent after the declarations")
    assert ask(viewer, "ur5e_1/play") == ([], [])
    assert not any("fake" in token for token in tokens(viewer))
    assert len(held) == 4


def test_whose_key_was_taken_back_sees_and_moves_nothing(graph, start, connect, tmp_path):
    keys = Keys.create(tmp_path / "keys", [], Login.CERTIFICATE, now())
    keys.add("anna", Role.INSTRUCTOR, now())
    keys.add("ben", Role.OPERATOR, now())
    kept = tmp_path / "anna.json5"
    kept.write_bytes(keys.client_file("anna").read_bytes())
    keys.revoke("anna")
    start(keys)

    def connected():
        # The bridge may disconnect her before zenoh says that it is open.
        with suppress(zenoh.ZError):
            return connect(kept)

    anna, ben = wait_for(connected, "a connection"), connect(keys.client_file("ben"))
    called = serve(graph, ["ur5e_1/play"])
    joints = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    graph.client.create_publisher(Robots, "robots", qos.LATCHED).publish(Robots())
    seen = {"anna": [], "ben": []}
    anna.declare_subscriber("**", seen["anna"].append)
    ben.declare_subscriber("**", seen["ben"].append)
    wait_for(lambda: offered(ben, "ur5e_1/play"), "the service")

    def ben_has_many():
        joints.publish(JointState(name=["shoulder"]))
        return len(seen["ben"]) > 20

    wait_for(ben_has_many, "frames")
    assert ask(anna, "ur5e_1/play") == ([], [])
    assert ask(anna, "robots") == ([], [])
    assert tokens(anna) == set()
    assert ask(ben, "ur5e_1/play")[0]
    assert called == ["ur5e_1/play"]
    assert seen["anna"] == []


def without(config, path):
    config.insert_json5(path, "null")


def spoil(name, folders, tmp_path, endpoint):
    """Return the configuration of a client that must not get in."""
    login = Login.PASSWORD if "password" in name or "user" in name else Login.CERTIFICATE
    keys = folders[login]
    tls, auth = "transport/link/tls", "transport/auth/usrpwd"
    file = keys.client_file("instructor")
    if name == "another lab's certificate":
        other = Keys.create(tmp_path / "other", [], login, now())
        other.add("instructor", Role.INSTRUCTOR, now())
        config = configuration(other.client_file("instructor"), endpoint)
        ours = configuration(file, endpoint).get_json(f"{tls}/root_ca_certificate_base64")
        config.insert_json5(f"{tls}/root_ca_certificate_base64", ours)
        return config
    if name == "trust in another authority":
        other = Keys.create(tmp_path / "other", [], login, now())
        other.add("instructor", Role.INSTRUCTOR, now())
        return configuration(other.client_file("instructor"), endpoint)
    if name == "an expired certificate":
        begin = now() - timedelta(minutes=30)
        keys.add("late", Role.DISPLAY, begin, timedelta(minutes=20))
        late = configuration(keys.client_file("late"), endpoint)
        keys.revoke("late")
        return late
    config = configuration(file, endpoint)
    if name == "no certificate":
        config.insert_json5(f"{tls}/enable_mtls", "false")
    elif name == "the lab's own certificate":
        for part, value in (("certificate", "server.pem"), ("private_key", "server.key")):
            without(config, f"{tls}/connect_{part}_base64")
            config.insert_json5(f"{tls}/connect_{part}", json.dumps(str(keys.folder / value)))
    elif name == "no password":
        without(config, f"{auth}/user")
        without(config, f"{auth}/password")
    elif name == "a wrong password":
        config.insert_json5(f"{auth}/password", '"guess"')
    elif name == "an unknown user":
        config.insert_json5(f"{auth}/user", '"mallory"')
    return config


@pytest.mark.parametrize(
    ("login", "names"),
    [
        (
            Login.CERTIFICATE,
            [
                "no certificate",
                "another lab's certificate",
                "trust in another authority",
                "an expired certificate",
                "the lab's own certificate",
            ],
        ),
        (Login.PASSWORD, ["no password", "a wrong password", "an unknown user"]),
    ],
)
def test_who_is_nobody_cannot_connect(graph, folders, start, connect, tmp_path, login, names):
    endpoint = start(folders[login]).get_parameter("listen").value[0]
    graph.client.create_publisher(Robots, "robots", qos.LATCHED).publish(Robots())
    for i, name in enumerate(names):
        (tmp_path / str(i)).mkdir()
        config = spoil(name, folders, tmp_path / str(i), endpoint)
        with pytest.raises(zenoh.ZError, match="Unable to connect"):
            zenoh.open(config).close()
        good = connect(folders[login].client_file("display"))
        wait_for(lambda good=good: ask(good, "robots")[0], f"the state, after {name}")


def test_a_certificate_with_somebody_else_s_password_has_no_rights(
    graph, folders, start, connect, endpoint
):
    keys = folders[Login.BOTH]
    start(keys)
    graph.client.create_publisher(Robots, "robots", qos.LATCHED).publish(Robots())
    viewer = connect(keys.client_file("display"))
    wait_for(lambda: ask(viewer, "robots")[0], "the state")
    mixed = configuration(keys.client_file("instructor"), endpoint)
    theirs = configuration(keys.client_file("display"), endpoint)
    for part in ("user", "password"):
        path = f"transport/auth/usrpwd/{part}"
        mixed.insert_json5(path, theirs.get_json(path))
    with zenoh.open(mixed) as session:
        assert ask(session, "robots") == ([], [])
        assert tokens(session) == set()


def stock_client(*arguments):
    """Run the client of the examples, which sees nothing of the lab's packages."""
    ours = ("PYTHONPATH", "AMENT_PREFIX_PATH", "LD_LIBRARY_PATH")
    return subprocess.run(
        [sys.executable, CLIENT, *map(str, arguments)],
        env={name: value for name, value in os.environ.items() if name not in ours},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def test_the_example_client_connects_with_its_file_and_says_why_not(
    graph, keys, start, endpoint, tmp_path
):
    start(keys)
    publisher = graph.client.create_publisher(Robots, "robots", qos.LATCHED)
    publisher.publish(Robots(robots=[Robot(name="ur5e_1")]))
    watch = ("watch", "robots", "mrlab_msgs/msg/Robots", "--latched", "--count", "1")
    known = (*watch, "--connect", endpoint)
    done = stock_client(*known, "--config", keys.client_file("display"))
    assert done.returncode == 0, done.stderr
    assert "ur5e_1" in done.stdout
    refused = stock_client(*known)
    assert refused.returncode == 1
    assert "no connection to the lab" in refused.stderr
    assert "UnknownIssuer" in refused.stdout


def test_the_lab_s_log_says_who_came_and_who_was_refused(graph, folders, endpoint, tmp_path):
    log = tmp_path / "bridge.log"
    arguments = (
        f"bridge --ros-args -p listen:=['{endpoint}'] -p keys:={folders[Login.BOTH].folder}"
    )
    with open(log, "wb") as output:
        process = start_child(
            *HOST, *arguments.split(), stdout=output, stderr=subprocess.STDOUT, cwd=ROOT
        )
    try:
        wait_for(lambda: "carries" in log.read_text(), "the bridge")
        good = configuration(folders[Login.BOTH].client_file("display"), endpoint)
        wrong = configuration(folders[Login.BOTH].client_file("display"), endpoint)
        wrong.insert_json5("transport/auth/usrpwd/password", '"guess"')
        stranger = configuration(folders[Login.CERTIFICATE].client_file("display"), endpoint)
        authority = "transport/link/tls/root_ca_certificate_base64"
        stranger.insert_json5(authority, good.get_json(authority))
        zenoh.open(good).close()
        for config in (wrong, stranger):
            with pytest.raises(zenoh.ZError):
                zenoh.open(config).close()
        for words in ("Common Name: display.", "Invalid password", "invalid peer certificate"):
            wait_for(lambda words=words: words in log.read_text(), words)
    finally:
        process.kill()
        process.wait()


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"keys": "/nowhere/keys"}, "/nowhere/keys has no keys"),
        ({"keys": "KEYS", "listen": ["tcp/127.0.0.1:7447"]}, "leave the keys out"),
        ({"keys": "KEYS", "zenoh_config": "/a.json5"}, "expected one"),
        ({"listen": ["tls/127.0.0.1:7447"]}, "needs keys"),
    ],
)
def test_a_wrong_setting_is_said_in_one_sentence(graph, keys, settings, words):
    values = {k: str(keys.folder) if v == "KEYS" else v for k, v in settings.items()}
    overrides = [Parameter(name, value=value) for name, value in values.items()]
    with pytest.raises(BadInput, match=words):
        BridgeNode(context=graph.context, parameter_overrides=overrides)
