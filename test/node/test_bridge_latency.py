"""The stamps that the bridge attaches, and what it and its clients make of them."""

from __future__ import annotations

import struct
import time

from graph import wait_for
from mrlab_msgs.msg import Latency, LatencyHop, Robots
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import JointState
from zenoh_side import JOINTS, ask, connect, heard, joints, start_client

from mrlab_ros.core.bridge.latency import stamps
from mrlab_ros.messages import qos


def attached(sample):
    return stamps(sample.attachment.to_bytes())


def measured(report, hop, topic):
    return [h for h in report.hops if h.hop == hop and h.topic == topic]


def test_every_message_has_its_number_and_its_times(graph, bridge, session):
    got = []
    session.declare_subscriber(JOINTS, lambda s: got.append((attached(s), time.time_ns())))
    publisher = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    wait_for(lambda: heard(session, JOINTS), "the bridge to hear of the subscriber")
    began = time.time_ns()
    for i in range(20):
        publisher.publish(joints(float(i)))
    wait_for(lambda: len(got) == 20, "twenty frames")
    assert [found.sequence for found, _ in got] == list(range(1, 21))
    for found, received in got:
        assert began <= found.published_ns <= found.bridged_ns <= received


def test_a_state_from_before_keeps_its_times_and_is_no_delay(graph, listed, endpoint):
    state = graph.client.create_publisher(Robots, "robots", qos.LATCHED)
    state.publish(Robots())
    late = time.time_ns()
    rules = [{"name": "/robots"}, {"name": "/latency"}]
    reports = graph.listen(Latency, "latency", qos.LATCHED)
    listed({"topics": rules})
    with connect(endpoint) as session:
        replies = wait_for(lambda: list(session.get("robots")), "the state on zenoh")
        assert attached(replies[0].ok).published_ns <= late
        wait_for(lambda: len(reports) > 2, "the bridge's reports")
    assert not any(measured(report, 0, "/robots") for report in reports)


def test_the_bridge_reports_how_long_messages_took_to_it(graph, bridge, session):
    reports = graph.listen(Latency, "latency", qos.LATCHED)
    over_zenoh = []
    session.declare_subscriber("latency", lambda s: over_zenoh.append(s.payload.to_bytes()))
    session.declare_subscriber(JOINTS, lambda _: None)
    publisher = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    wait_for(publisher.get_subscription_count, "the bridge's subscription")
    for i in range(50):
        publisher.publish(joints(float(i)))
    hop, topic = LatencyHop.PUBLISHED_TO_BRIDGED, f"/{JOINTS}"

    def count(topic):
        return sum(h.count for report in reports for h in measured(report, hop, topic))

    wait_for(lambda: count(topic) == 50, "all frames in the reports")
    assert count("") >= 50
    report = next(report for report in reports if measured(report, hop, topic))
    (found,) = measured(report, hop, topic)
    assert report.observer == "bridge"
    assert report.window > 0
    assert 0 < found.p50 <= found.p95 <= found.max < 30
    wait_for(lambda: over_zenoh, "a report on zenoh")
    assert deserialize_message(over_zenoh[0], Latency).observer == "bridge"


def test_the_bridge_tells_the_time(bridge, session):
    before = time.time_ns()
    asked, answered = struct.unpack("<qq", ask(session, "@mrlab/bridge/clock")[0])
    assert before <= asked <= answered <= time.time_ns()


def test_a_client_measures_and_the_graph_hears_of_it(graph, bridge, session, endpoint):
    reports = graph.listen(Latency, "latency/clients", qos.LATCHED_EVENTS)
    publisher = graph.client.create_publisher(JointState, JOINTS, qos.STREAM)
    client = start_client("mrlab_latency.py", "--connect", endpoint, "--name", "quest")
    try:
        wait_for(lambda: heard(session, JOINTS), "the bridge to hear of the client")
        sent = 0

        def full():
            nonlocal sent
            publisher.publish(joints(float(sent)))
            sent += 1
            return next((r for r in reports if measured(r, 2, "")), None)

        report = wait_for(full, "a report with delays")
    finally:
        client.kill()
        out, err = client.communicate()
    assert report.observer == "quest", err
    assert 0 < report.clock_error < 5
    for hop in (LatencyHop.BRIDGED_TO_RECEIVED, LatencyHop.PUBLISHED_TO_RECEIVED):
        (everything,), (only,) = measured(report, hop, ""), measured(report, hop, f"/{JOINTS}")
        assert 0 < only.count == everything.count <= sent
        assert only.p50 <= only.p95 <= only.max
        # As good as the clocks' comparison, on one machine with one clock.
        assert only.p50 > -report.clock_error
    assert "lost: 0" in out


def test_who_asks_late_has_the_clients_reports_at_once(graph, bridge, session):
    early = graph.listen(Latency, "latency/clients", qos.LATCHED_EVENTS)
    report = bytes(serialize_message(Latency(observer="quest")))

    def arrived():
        # Until the client's session knows the bridge's subscriber, it sends nothing.
        session.put("latency/clients", report)
        return early

    wait_for(arrived, "the report")
    late = graph.listen(Latency, "latency/clients", qos.LATCHED_EVENTS)
    wait_for(lambda: late, "the report from before")
    assert late[0].observer == "quest"
