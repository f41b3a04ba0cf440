"""The bridge between a real graph and real zenoh sessions, some in processes of their own."""

from __future__ import annotations

import re
import signal
import subprocess
import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest
from child_process import HOST, start_child
from graph import wait_for
from mrlab_msgs.msg import (
    LabProcess,
    LabProcesses,
    RecorderState,
    Robot,
    Robots,
    RobotSystems,
)
from mrlab_msgs.srv import SetLoop, Trigger
from rclpy.serialization import deserialize_message, serialize_message
from refusals import refused
from sensor_msgs.msg import JointState
from std_msgs.msg import String
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

from mrlab_ros.adapters.stop_orders import StopOrders
from mrlab_ros.adapters.zenoh.diagnostics import BAD_ZENOH_FILE, ENDPOINT_TAKEN
from mrlab_ros.core.base.diagnostics import BAD_VALUE
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.bridge.diagnostics import ALLOW_LIST_NOT_READ, OPEN_ENDPOINT
from mrlab_ros.core.bridge.rules import Congestion
from mrlab_ros.core.recording.diagnostics import STOP_LEFT
from mrlab_ros.messages import qos
from mrlab_ros.nodes.bridge.node import BridgeNode
from mrlab_ros.ros.services import create_deferred_service

ROOT = Path(__file__).parents[2]


def client(endpoint, *arguments):
    return start_client("mrlab_client.py", "--connect", endpoint, *arguments)


def test_a_stock_client_receives_the_frames(graph, bridge, session, endpoint):
    publisher = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    watcher = client(endpoint, "watch", JOINTS, "sensor_msgs/msg/JointState", "--count", "5")
    wait_for(lambda: heard(session, JOINTS), "the bridge to hear of the client")
    for i in range(5):
        publisher.publish(joints(0.125 * i))
    out, err = watcher.communicate(timeout=60)
    assert watcher.returncode == 0, err
    lines = out.splitlines()
    assert len(lines) == 5
    assert all("0.125" in lines[1] and "shoulder" in line for line in lines)


def test_frames_arrive_in_order_and_untouched(graph, bridge, session):
    got = []
    session.declare_subscriber(JOINTS, lambda s: got.append(s.payload.to_bytes()))
    publisher = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    wait_for(lambda: heard(session, JOINTS), "the bridge to hear of the subscriber")
    sent = [serialize_message(joints(float(i))) for i in range(500)]
    for i, payload in enumerate(sent):
        publisher.publish(payload)
        wait_for(lambda i=i: len(got) > i, f"frame {i}")
    assert got == sent


def test_a_stream_is_received_only_while_somebody_subscribes(graph, bridge, session, monkeypatch):
    monkeypatch.setattr("mrlab_ros.nodes.bridge.outward.LINGER_S", 0.0)
    stream = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    state = graph.client.create_publisher(Robots, "robots", qos.LATCHED)
    wait_for(state.get_subscription_count, "the state, which late joiners need, to be received")
    assert stream.get_subscription_count() == 0
    got = []
    for _ in range(2):
        subscriber = session.declare_subscriber(JOINTS, got.append)
        wait_for(lambda: heard(session, JOINTS), "the bridge to hear of the subscriber")
        stream.publish(joints(0.5))
        wait_for(lambda: got, "the frame")
        del got[:]
        subscriber.undeclare()
        wait_for(lambda: not stream.get_subscription_count(), "the end of the subscription")


def test_a_late_joiner_gets_the_newest_state_and_only_that(graph, bridge, session):
    publisher = graph.client.create_publisher(Robots, "robots", qos.LATCHED)
    for name in ("ur5e_1", "ur5e_2", "kr6_1"):
        publisher.publish(Robots(robots=[Robot(name=name)]))
    wait_for(lambda: list(session.get("robots")), "the newest state")

    def newest():
        return deserialize_message(ask(session, "robots")[0], Robots).robots[0].name

    wait_for(lambda: newest() == "kr6_1", "the newest state")
    got = []
    late = ext.declare_advanced_subscriber(
        session,
        "robots",
        lambda s: got.append(deserialize_message(s.payload.to_bytes(), Robots)),
        history=ext.HistoryConfig(detect_late_publishers=True),
    )
    wait_for(lambda: got, "the state from before the subscription")
    publisher.publish(Robots(robots=[Robot(name="kr3_1")]))
    wait_for(lambda: len(got) > 1, "the next state")
    assert [message.robots[0].name for message in got] == ["kr6_1", "kr3_1"]
    late.undeclare()


@pytest.mark.parametrize("given", [(), ("--definitions", str(ROOT / "msg_schemas"))])
def test_a_stock_client_reads_a_state(graph, bridge, session, endpoint, given):
    publisher = graph.client.create_publisher(Robots, "robots", qos.LATCHED)
    publisher.publish(Robots(robots=[Robot(name="ur5e_1", joint_names=["shoulder"])]))
    wait_for(lambda: list(session.get("robots")), "the state on zenoh")
    options = (*given, "--latched", "--count", "1")
    watcher = client(endpoint, "watch", "robots", "mrlab_msgs/msg/Robots", *options)
    out, err = watcher.communicate(timeout=60)
    assert watcher.returncode == 0, err
    assert "ur5e_1" in out


def test_a_stock_client_calls_a_service(graph, bridge, session, endpoint):
    def answer(request, response):
        response.success, response.message = request.loop, "said " + "yes" * request.loop
        return response

    graph.client.create_service(SetLoop, "ur5e_1/set_loop", answer)
    wait_for(lambda: any("set_loop" in t for t in tokens(session)), "the service on zenoh")
    caller = client(endpoint, "call", "ur5e_1/set_loop", "mrlab_msgs/srv/SetLoop", "loop=true")
    out, err = caller.communicate(timeout=60)
    assert caller.returncode == 0, err
    assert "said yes" in out


def test_a_request_without_fields_needs_no_payload(graph, bridge, session):
    def answer(request, response):
        response.success, response.message = True, "plays"
        return response

    graph.client.create_service(Trigger, "ur5e_1/play", answer)
    wait_for(lambda: any("SS/ur5e_1§play/" in t for t in tokens(session)), "the service")
    for payload in (None, b"\0\1\0\0", b"\0\1\0\0\0", bytes(serialize_message(Trigger.Request()))):
        reply, reason = ask(session, "ur5e_1/play", payload)
        assert reason is None
        assert deserialize_message(reply, Trigger.Response).message == "plays"


def test_a_wrong_request_is_refused_in_words_and_changes_nothing(graph, bridge, session):
    asked = []

    def answer(request, response):
        asked.append(request)
        return response

    graph.client.create_service(SetLoop, "ur5e_1/set_loop", answer)
    wait_for(lambda: any("set_loop" in t for t in tokens(session)), "the service")
    _, reason = ask(session, "ur5e_1/set_loop")
    assert "without a request" in reason
    _, reason = ask(session, "ur5e_1/set_loop", b"not CDR at all")
    assert "not a request of mrlab_msgs/srv/SetLoop" in reason
    assert asked == []


def test_a_service_that_does_not_answer_is_given_up(graph, listed, endpoint):
    listed({"services": [{"name": "/slow", "timeout": 0.1}]})
    released = threading.Event()

    def answer(request, response):
        released.wait(20)
        return response

    graph.client.create_service(Trigger, "slow", answer)
    with connect(endpoint) as session:
        wait_for(lambda: any("SS/slow/" in t for t in tokens(session)), "the service")
        _, reason = ask(session, "slow")
    released.set()
    assert "/slow did not answer" in reason


def test_what_two_labs_offer_is_not_called_for_either(graph, listed, endpoint):
    listed({"services": [{"name": "/*/play"}, {"name": "/*/pause", "moves": False}]}, lab_id="a1")
    asked = []

    def answer(request, response):
        asked.append(request)
        response.success = True
        return response

    names = ("ur5e_1/play", "ur5e_1/pause", "ur5e_2/play")
    for name in (*names, *names[:2]):
        graph.client.create_service(Trigger, name, answer)
    systems = graph.client.create_publisher(RobotSystems, "/systems", qos.LATCHED)
    empty = bytes(serialize_message(Trigger.Request()))
    with connect(endpoint) as session:
        wait_for(lambda: sum("SS/ur5e_" in t for t in tokens(session)) == 3, "the services")
        assert ask(session, "ur5e_1/play", empty)[1] is None
        systems.publish(RobotSystems(lab="b2 (anna@pc3)"))
        reason = wait_for(lambda: ask(session, "ur5e_1/play", empty)[1], "a refusal")
        assert "/ur5e_1/play was not called" in reason
        assert "b2 (anna@pc3). Start one of the labs again with another ROS_DOMAIN_ID" in reason
        asked.clear()
        assert ask(session, "ur5e_1/play", empty)[1] == reason
        assert asked == []
        for name in names[1:]:
            assert ask(session, name, empty)[1] is None


def test_what_another_lab_says_of_itself_stays_inside(graph, endpoint):
    graph.add(BridgeNode, listen=[endpoint], discovery_period=0.02, lab_id="a1")
    robots = graph.client.create_publisher(Robots, "/robots", qos.LATCHED_EVENTS)
    got = []
    with connect(endpoint) as session:
        wait_for(lambda: any("robots" in t for t in tokens(session)), "the topic")
        session.declare_subscriber("robots", lambda sample: got.append(bytes(sample.payload)))
        wait_for(lambda: heard(session, "robots"), "the bridge to hear of the subscriber")
        for lab in ("a1", "b2", ""):
            robots.publish(Robots(lab=lab))
        wait_for(lambda: len(got) >= 2, "what is of this lab")
        assert [deserialize_message(message, Robots).lab for message in got] == ["a1", ""]


def test_what_is_not_named_stays_inside(graph, bridge, session):
    graph.client.create_publisher(String, "secret", qos.LATCHED).publish(String(data="x"))
    graph.client.create_service(Trigger, "ur5e_1/command_members", lambda q, r: r)
    graph.client.create_publisher(Robots, "robots", qos.LATCHED)
    wait_for(lambda: any("MP/robots/" in t for t in tokens(session)), "a topic that is named")
    announced = "".join(tokens(session))
    assert "secret" not in announced
    assert "command_members" not in announced
    assert "rosout" not in announced
    assert list(session.get("secret")) == []


def test_a_topic_of_another_type_than_the_list_says_stays_inside(graph, bridge, session):
    graph.client.create_publisher(String, "robots", qos.LATCHED)
    graph.client.create_publisher(String, "ur5e_1/robot_description", qos.LATCHED)
    wait_for(lambda: any("robot_description" in t for t in tokens(session)), "the other topic")
    assert not any("MP/robots/" in t for t in tokens(session))


def test_topics_and_services_that_go_take_their_tokens_along(graph, bridge, session):
    publisher = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    service = graph.client.create_service(Trigger, "ur5e_1/play", lambda q, r: r)
    own = f"@/{bridge._session.zid}/@ros2_lv"
    wait_for(lambda: len(tokens(session)) == 3, "the tokens of both and of the bridge")
    assert own in tokens(session)
    graph.client.destroy_publisher(publisher)
    graph.client.destroy_service(service)
    wait_for(lambda: tokens(session) == {own}, "the tokens to go")
    graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    wait_for(lambda: len(tokens(session)) == 2, "the topic to come back")


def test_a_topic_comes_in_and_rubbish_does_not(graph, listed, endpoint):
    bridge = listed({"topics": [{"name": "/hello", "direction": "in"}]}, prefix="lab_1")
    got = graph.listen(String, "hello", qos.EVENTS)
    with connect(endpoint) as session:
        wait_for(lambda: any("MS/lab_1§hello/" in t for t in tokens(session)), "the token")
        graph_side = graph.client.count_publishers
        wait_for(lambda: graph_side("hello"), "the bridge's publisher")
        session.put("lab_1/hello", b"rubbish")
        session.put("lab_1/hello", bytes(serialize_message(String(data="from zenoh"))))
        wait_for(lambda: got, "the message from zenoh")
        assert [m.data for m in got] == ["from zenoh"]
        assert bridge.statistics()["keys"]["lab_1/hello"]["refused"] == 1


def test_a_capped_topic_sends_the_newest_value_in_the_end(graph, listed, endpoint):
    listed({"topics": [{"name": "/fast", "max_rate": 5}]})
    publisher = graph.client.create_publisher(String, "fast", qos.EVENTS)
    got = []
    with connect(endpoint) as session:
        session.declare_subscriber("fast", lambda s: got.append(s.payload.to_bytes()))
        wait_for(lambda: heard(session, "fast"), "the bridge to hear of the subscriber")
        last = serialize_message(String(data="99"))
        for i in range(100):
            publisher.publish(String(data=f"{i}"))
        wait_for(lambda: got and got[-1] == last, "the last value")
        assert len(got) < 50


def test_statistics_count_what_was_carried(graph, bridge, session):
    got = []
    session.declare_subscriber(JOINTS, got.append)
    publisher = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    wait_for(lambda: heard(session, JOINTS), "the bridge to hear of the subscriber")
    for i in range(7):
        publisher.publish(joints(float(i)))
    wait_for(lambda: len(got) == 7, "seven frames")
    counted = statistics(session)
    size = len(got[0].payload.to_bytes())
    assert counted["keys"][JOINTS]["messages"] == 7
    assert counted["keys"][JOINTS]["bytes"] == 7 * size
    assert counted["messages"] == sum(k["messages"] for k in counted["keys"].values())
    assert counted["bytes"] == sum(k["bytes"] for k in counted["keys"].values())


class StuckSession:
    """A zenoh whose blocking keys never take a message: its client is dead."""

    zid = "ab"

    def __init__(self):
        self.moved = []
        self.released = threading.Event()

    def publisher(self, key, rule, cache, on_match=None):
        return self.Publisher(self, rule.congestion is Congestion.BLOCK)

    def queryable(self, key, on_query, quick=False):
        return self.Publisher(self, False)

    def token(self, key):
        return self.Publisher(self, False)

    def subscriber(self, key, admit, on_payload, late):
        return self.Publisher(self, False)

    def follow_tokens(self, key, on_token):
        return self.Publisher(self, False)

    def close(self):
        pass

    class Publisher:
        def __init__(self, session, stuck):
            self._session = session
            self._stuck = stuck

        def put(self, payload, attachment):
            if self._stuck:
                self._session.released.wait(20)
            else:
                self._session.moved.append(payload)

        def has_subscriber(self):
            return True

        def undeclare(self):
            pass


def test_a_client_that_takes_no_states_holds_up_no_motion(graph):
    session = StuckSession()
    graph.add(lambda **settings: BridgeNode(session=session, **settings), discovery_period=0.02)
    state = graph.client.create_publisher(Robots, "robots", qos.LATCHED)
    motion = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    wait_for(lambda: motion.get_subscription_count() and state.get_subscription_count(), "routes")
    for i in range(20):
        state.publish(Robots())
        motion.publish(joints(float(i)))
        wait_for(lambda i=i: len(session.moved) > i, f"frame {i}")
    session.released.set()


def test_an_occupied_port_is_said_in_one_sentence(graph, bridge, endpoint):
    with refused(ENDPOINT_TAKEN, BadInput, endpoints=[endpoint]):
        BridgeNode(
            context=graph.context,
            parameter_overrides=[_parameter("listen", [endpoint])],
        )


@pytest.mark.parametrize(
    ("setting", "value", "code"),
    [
        ("listen", ["tcp/0.0.0.0:7447"], OPEN_ENDPOINT),
        ("listen", ["7447"], BAD_VALUE),
        ("mode", "server", BAD_VALUE),
        ("allow_list", "/nowhere/bridge.yaml", ALLOW_LIST_NOT_READ),
        ("zenoh_config", "/nowhere/zenoh.json5", BAD_ZENOH_FILE),
        ("prefix", "lab/*", BAD_VALUE),
    ],
)
def test_a_wrong_parameter_is_refused(graph, setting, value, code):
    with refused(code, BadInput):
        BridgeNode(context=graph.context, parameter_overrides=[_parameter(setting, value)])


def _parameter(name, value):
    from rclpy.parameter import Parameter

    return Parameter(name, value=value)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_the_process_ends_when_asked_and_tells_what_it_carried(graph, endpoint, number):
    graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    process = start_child(
        *(*HOST, "bridge", "--ros-args", "-p", f"listen:=['{endpoint}']"),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        cwd=ROOT,
    )
    # Fast DDS may say before that another process has a port of its shared memory.
    assert any("carries" in line for line in process.stdout)
    with connect(endpoint) as session:
        wait_for(lambda: any("joint_states" in t for t in tokens(session)), "the topic on zenoh")
    process.send_signal(number)
    rest, _ = process.communicate(timeout=60)
    assert process.returncode == 0, rest
    assert re.search(r"carried \d+ messages and \d+ bytes over \d+ keys", rest)


@pytest.fixture
def recorder_bridge(graph, endpoint, tmp_path):
    graph.add(BridgeNode, listen=[endpoint], discovery_period=0.02, state_dir=str(tmp_path))
    with connect(endpoint) as session:
        yield session


def test_a_stop_for_a_recorder_that_died_or_froze_is_left_for_the_next(
    graph, recorder_bridge, tmp_path
):
    states = graph.client.create_publisher(RecorderState, "/recorder/state", qos.LATCHED_EVENTS)
    processes = graph.client.create_publisher(LabProcesses, "/processes", qos.LATCHED_EVENTS)
    never = Future()
    service = create_deferred_service(graph.client, Trigger, "/recorder/stop", lambda *_: never)

    def stop():
        reply, _ = ask(recorder_bridge, "recorder/stop", serialize_message(Trigger.Request()))
        return deserialize_message(reply, Trigger.Response)

    states.publish(RecorderState(state=RecorderState.RECORDING, bag="/bags/class"))
    wait_for(lambda: "recorder/stop" in statistics(recorder_bridge)["keys"], "the route")
    waiting = StopOrders(str(tmp_path)).waiting

    with ThreadPoolExecutor() as pool:
        asked = pool.submit(stop)
        key = "recorder/stop"
        wait_for(lambda: statistics(recorder_bridge)["keys"][key]["messages"], "the call")
        down = LabProcess(
            name="recorder",
            state=LabProcess.FROZEN,
            nodes=["recorder"],
            down_steady_ns=time.monotonic_ns(),
        )
        processes.publish(LabProcesses(processes=[down]))
        # It does not wait for the time-out of the service, which is 30 s.
        answer = asked.result(10.0)
    assert (answer.success, answer.code) == (True, STOP_LEFT.code)
    assert [order.bag for order in waiting()] == ["/bags/class"]
    assert stop().code == STOP_LEFT.code
    graph.client.destroy_service(service)
    down.state = LabProcess.RUNNING
    processes.publish(LabProcesses(processes=[down]))
    wait_for(lambda: not graph.client.count_services("/recorder/stop"), "the recorder gone")
    wait_for(lambda: stop().code == STOP_LEFT.code, "a third order")
    assert len(waiting()) >= 3
