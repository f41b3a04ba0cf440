"""The bridge's threads against each other, on a zenoh and a graph that do as the test says."""

from __future__ import annotations

import threading

import pytest
from graph import wait_for
from mrlab_msgs.srv import Trigger
from rclpy.exceptions import InvalidHandle
from rclpy.serialization import serialize_message
from rclpy.task import Future
from std_msgs.msg import String

from mrlab_ros.adapters.zenoh.configuration import configuration
from mrlab_ros.adapters.zenoh.session import ZenohSession
from mrlab_ros.core.bridge.rules import ServiceRule, TopicRule
from mrlab_ros.nodes.bridge.inward import Inward
from mrlab_ros.nodes.bridge.outward import Sender
from mrlab_ros.nodes.bridge.routes import MOST_CLOSED, BridgeContext, Count
from mrlab_ros.nodes.bridge.services import Services

PLAY = "/ur5e_1/play"


class Zenoh:
    """A session that keeps who answers."""

    zid = "ab"

    def __init__(self):
        self.asked = {}

    def queryable(self, key, on_query, quick=False):
        self.asked[key] = on_query
        return self

    def token(self, key):
        return self

    def undeclare(self):
        pass


class Client:
    """A service's client; `at_once`: the answer is there before anybody can wait for it."""

    srv_type = Trigger

    def __init__(self, at_once):
        self._at_once = at_once
        self.futures = []

    def service_is_ready(self):
        return True

    def call_async(self, request):
        future = Future()
        if self._at_once:
            future.set_result(Trigger.Response(success=True))
        self.futures.append(future)
        return future

    def remove_pending_request(self, future):
        pass


class Graph:
    """A node with one client."""

    def __init__(self, client):
        self._client = client

    def create_client(self, kind, name, qos_profile):
        return self._client

    def destroy_client(self, client):
        pass


class Query:
    """A question whose asker takes the answer once `takes` is set."""

    payload = None
    size = 0

    def __init__(self, key, takes):
        self.key = key
        self._takes = takes
        self.answers = []

    def reply(self, payload):
        self._takes.wait(20)
        self.answers.append(payload)

    refuse = reply


@pytest.fixture
def takes():
    event = threading.Event()
    event.set()
    yield event
    event.set()


@pytest.fixture
def offer():
    """Offer PLAY by a client; return the routes, and who takes a query."""
    made = []

    def make(client, **fields):
        zenoh = Zenoh()
        routes = Services(BridgeContext(zenoh, Graph(client), "", lambda _: None))
        made.append(routes)
        routes.keep({PLAY: (ServiceRule(PLAY, **fields), "mrlab_msgs/srv/Trigger")})
        return routes, zenoh.asked[PLAY[1:]]

    yield make
    for routes in made:
        stopping = in_a_thread(routes.stop)
        wait_for(lambda stopping=stopping: not stopping.is_alive(), "the routes to close")


def in_a_thread(task):
    thread = threading.Thread(target=task, daemon=True)
    thread.start()
    return thread


def test_an_answer_that_is_there_at_once_is_passed_on(offer, takes):
    _, ask = offer(Client(at_once=True))
    queries = [Query(PLAY[1:], takes) for _ in range(3)]
    for query in queries:
        asking = in_a_thread(lambda query=query: ask(query))
        wait_for(lambda query=query: query.answers, "the answer")
        wait_for(lambda asking=asking: not asking.is_alive(), "the end of the question")


def test_who_takes_no_answer_holds_up_neither_the_graph_nor_the_look_at_it(offer, takes):
    client = Client(at_once=False)
    routes, ask = offer(client, timeout=0.01)
    takes.clear()
    first, second = Query(PLAY[1:], takes), Query(PLAY[1:], takes)
    ask(first)
    ask(second)
    answering = in_a_thread(lambda: client.futures[0].set_result(Trigger.Response()))
    wait_for(lambda: not answering.is_alive(), "the graph's thread")

    def looked():
        # Refuses the second once its time is over.
        looking = in_a_thread(routes.refuse_late)
        wait_for(lambda: not looking.is_alive(), "the look")
        takes.set()
        return second.answers

    wait_for(looked, "the refusal")
    assert len(first.answers) == len(second.answers) == 1


def test_what_waits_for_slow_clients_has_bounds_and_the_newest_stays(takes):
    said, done = [], []
    sender = Sender("test_sender", said.append, room=1000)
    takes.clear()
    busy = threading.Event()

    def hold():
        busy.set()
        takes.wait(20)

    sender.send(hold, 1)
    wait_for(busy.is_set, "the sender to be held up")
    for i in range(50):
        sender.send(lambda i=i: done.append(i), 100)
    takes.set()
    sender.stop()
    assert done == list(range(40, 50))
    assert said
    assert all("too slowly" in text for text in said)


def test_a_sender_that_stops_puts_what_waits_and_outlives_an_error():
    said, done = [], []

    def fails():
        raise RuntimeError("gone")

    sender = Sender("test_sender", said.append)
    sender.send(fails, 1)
    sender.send(lambda: done.append(1), 1)
    sender.stop()
    assert done == [1]
    assert said == ["a message was lost: RuntimeError: gone"]


class Topic:
    """A publisher of the graph, which may be gone."""

    def __init__(self, gone=False):
        self.published = []
        self._gone = gone

    def publish(self, payload):
        if self._gone:
            raise InvalidHandle("destroyed")
        self.published.append(payload)


def receiver(topic, said):
    inward = Inward(BridgeContext(Zenoh(), Graph(None), "", said.append))
    count = Count("std_msgs/msg/String", "in")
    return inward._receiver("hello", String, topic, count), count


def test_rubbish_of_any_length_is_reported_once():
    said = []
    receive, count = receiver(Topic(), said)
    for size in range(1, 20):
        receive(b"\xff" * size)
    assert count.refused == 19
    assert len(set(said)) == 1


def test_a_message_for_a_topic_that_has_just_gone_is_dropped():
    receive, count = receiver(Topic(gone=True), [])
    receive(bytes(serialize_message(String(data="late"))))
    assert count.messages == 0


def test_a_publisher_that_has_just_gone_has_no_subscriber():
    session = ZenohSession(configuration(listen=()))
    try:
        for cache in (0, 1):
            publisher = session.publisher("hello", TopicRule("/hello"), cache)
            publisher.undeclare()
            assert publisher.has_subscriber() is False
    finally:
        session.close()


def test_keys_that_are_gone_are_counted_as_a_sum():
    bridge = BridgeContext(None, None, "", lambda _: None)
    for number in range(MOST_CLOSED + 50):
        bridge.count(f"robot_{number}/joint_states", "", "out").messages += 1
        bridge.close(f"robot_{number}/joint_states")
    assert len(bridge.counts) == MOST_CLOSED
    assert bridge.gone.messages == 50
    # One that came back is not among the closed ones.
    back = bridge.count("robot_60/joint_states", "", "out")
    for number in range(MOST_CLOSED):
        bridge.count(f"other_{number}", "", "out")
        bridge.close(f"other_{number}")
    assert bridge.counts["robot_60/joint_states"] is back
