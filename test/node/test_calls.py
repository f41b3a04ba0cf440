"""Calls of services that are not there, do not answer, or end before they answer."""

from __future__ import annotations

import threading

import pytest
from graph import wait_for
from mrlab_msgs.srv import Trigger
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

from mrlab_ros.messages import qos
from mrlab_ros.ros.calls import NoAnswer, call, call_each
from mrlab_ros.ros.graph_node import Graph

SENSOR = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
OFFERED = {"latched": qos.LATCHED, "stream": qos.STREAM, "sensor": SENSOR}


def answer(request, response):
    response.success = True
    return response


def test_one_that_is_not_there_costs_the_others_nothing(graph):
    other = graph.add(lambda parameter_overrides, **kwargs: Node("server", **kwargs))
    other.create_service(Trigger, "/third", answer, qos_profile=qos.SERVICES)
    names = ("/third", "/nowhere", "/third")
    clients = [graph.client.create_client(Trigger, name) for name in names]
    assert clients[0].wait_for_service(15.0)
    first, nowhere, last = call_each([(client, Trigger.Request()) for client in clients], 3.0)
    assert isinstance(nowhere, NoAnswer)
    assert (nowhere.diagnostic.code, nowhere.diagnostic.values["service"]) == (
        "not_offered",
        "/nowhere",
    )
    assert isinstance(first, Trigger.Response)
    assert isinstance(last, Trigger.Response)


def test_a_service_that_ends_before_it_answers_is_noticed_before_the_time_out(graph):
    # Nobody spins it, so it never answers.
    server = Node("server", context=graph.context)
    server.create_service(Trigger, "/slow", answer, qos_profile=qos.SERVICES)
    client = graph.client.create_client(Trigger, "/slow")
    assert client.wait_for_service(15.0)
    raised: list[NoAnswer] = []

    def ask() -> None:
        try:
            call(client, Trigger.Request(), 600.0)
        except NoAnswer as error:
            raised.append(error)

    thread = threading.Thread(target=ask, daemon=True)
    thread.start()
    wait_for(lambda: client._pending_requests, "the request")
    server.destroy_node()
    wait_for(lambda: raised, "the end of the call")
    assert raised[0].diagnostic.code == "service_ended"
    thread.join()


def test_a_service_that_comes_late_is_asked_when_it_comes(graph):
    server = graph.add(lambda parameter_overrides, **kwargs: Node("server", **kwargs))
    client = graph.client.create_client(Trigger, "/late")
    answers: list[Trigger.Response] = []
    thread = threading.Thread(
        target=lambda: answers.append(call(client, Trigger.Request(), 15.0)), daemon=True
    )
    thread.start()
    server.create_service(Trigger, "/late", answer, qos_profile=qos.SERVICES)
    wait_for(lambda: answers, "the answer")
    assert answers[0].success
    thread.join()


def test_a_closed_client_leaves_no_thread_behind(graph, monkeypatch):
    # One that waits within rcl while the interpreter ends aborts the process.
    monkeypatch.setattr(
        "mrlab_ros.ros.graph_node.domain_id", lambda: graph.context.get_domain_id()
    )
    with Graph() as client:
        (thread,) = (thread for thread in threading.enumerate() if thread.name == "graph")
        assert client.node_names()
    assert not thread.is_alive()


@pytest.mark.parametrize(
    "offered", [qos.LATCHED, qos.STREAM, SENSOR], ids=["latched", "stream", "sensor"]
)
@pytest.mark.parametrize("late", [False, True])
def test_what_is_published_is_heard_however_it_is_offered(graph, offered, late, monkeypatch):
    monkeypatch.setattr(
        "mrlab_ros.ros.graph_node.domain_id", lambda: graph.context.get_domain_id()
    )
    other = graph.add(lambda parameter_overrides, **kwargs: Node("talker", **kwargs))
    heard: list[str] = []
    client = Graph()
    publisher = None if late else other.create_publisher(String, "/words", offered)
    client.subscribe(String, "/words", lambda message: heard.append(message.data), qos.LATCHED)
    if publisher is None:
        publisher = other.create_publisher(String, "/words", offered)

    def said() -> bool:
        publisher.publish(String(data="word"))
        return bool(heard)

    wait_for(said, "a word")
    client.close()
