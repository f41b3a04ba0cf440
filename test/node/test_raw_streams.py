"""Raw messages of real subscriptions, taken by threads without an executor."""

from __future__ import annotations

import threading
import time

import pytest
from graph import wait_for
from rclpy.node import Node
from rclpy.serialization import deserialize_message
from std_msgs.msg import String

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.messages import qos
from mrlab_ros.ros.arrivals import BATCH, Arrivals
from mrlab_ros.ros.raw_streams import Received, TopicPoll, WaitSetThread


@pytest.fixture
def streams(graph):
    """A node that no executor spins."""
    node = Node("streams", context=graph.context)
    yield node
    node.destroy_node()


def subscribe(streams, topic):
    return streams.create_subscription(String, topic, lambda _: None, qos.STREAM, raw=True)


def publisher(graph, topic):
    made = graph.client.create_publisher(String, topic, qos.STREAM)
    wait_for(made.get_subscription_count, f"a subscription to {topic}")
    return made


def text(data):
    return deserialize_message(data, String).data


class TestWaitSetThread:
    @pytest.fixture
    def errors(self):
        return []

    @pytest.fixture
    def thread(self, graph, errors):
        made = WaitSetThread(graph.context, "test", lambda: 50_000_000, errors.append)
        made.start()
        yield made
        made.stop()

    def test_each_subscription_has_its_messages_in_order(self, graph, streams, thread):
        got = {"a": [], "b": []}
        for topic, inbox in got.items():
            thread.add(subscribe(streams, topic), inbox.append)
        for topic in got:
            out = publisher(graph, topic)
            for i in range(100):
                out.publish(String(data=f"{topic}{i}"))
        wait_for(lambda: all(len(inbox) == 100 for inbox in got.values()), "all messages")
        for topic, inbox in got.items():
            assert [text(data) for data in inbox] == [f"{topic}{i}" for i in range(100)]

    def test_a_turn_that_raises_is_reported_and_the_thread_continues(self, graph, streams, errors):
        def turn():
            if not errors:
                raise OSError("no descriptor")
            return 50_000_000

        thread = WaitSetThread(graph.context, "test", turn, errors.append)
        got = []
        thread.add(subscribe(streams, "a"), got.append)
        thread.start()
        wait_for(lambda: errors, "the error")
        publisher(graph, "a").publish(String(data="after"))
        wait_for(lambda: got, "a message after the error")
        assert [str(error) for error in errors] == ["no descriptor"]
        thread.stop()

    def test_a_callback_that_raises_is_reported_and_the_next_message_taken(
        self, graph, streams, thread, errors
    ):
        got = []

        def take(data):
            if text(data) == "bad":
                raise ValueError("bad")
            got.append(text(data))

        thread.add(subscribe(streams, "a"), take)
        out = publisher(graph, "a")
        for word in ("one", "bad", "two"):
            out.publish(String(data=word))
        wait_for(lambda: len(got) == 2, "both good messages")
        assert got == ["one", "two"]
        assert [str(error) for error in errors] == ["bad"]

    def test_a_removed_subscription_may_be_destroyed_at_once(self, graph, streams, thread):
        kept, gone = [], []
        removed = subscribe(streams, "gone")
        thread.add(removed, gone.append)
        thread.add(subscribe(streams, "kept"), kept.append)
        out, other = publisher(graph, "gone"), publisher(graph, "kept")
        out.publish(String(data="first"))
        wait_for(lambda: gone, "the first message")
        thread.remove(removed)
        streams.destroy_subscription(removed)
        out.publish(String(data="second"))
        other.publish(String(data="third"))
        wait_for(lambda: kept, "the message of the other")
        assert len(gone) == 1

    def test_turn_runs_without_messages(self, graph):
        turns = []

        def turn():
            turns.append(1)
            return 1_000_000

        thread = WaitSetThread(graph.context, "test", turn, print)
        thread.start()
        wait_for(lambda: len(turns) > 10, "turns")
        thread.stop()


class TestArrivals:
    @pytest.fixture
    def errors(self):
        return []

    @pytest.fixture
    def arrivals(self, streams, errors):
        made = Arrivals("test", errors.append)
        yield made
        made.close()

    def test_each_subscription_has_its_messages_in_order_with_their_stamps(
        self, graph, streams, arrivals
    ):
        got = {"a": [], "b": []}
        for topic, inbox in got.items():
            arrivals.add(
                subscribe(streams, topic),
                lambda data, published_ns, inbox=inbox: inbox.append((text(data), published_ns)),
            )
        began = time.time_ns()
        for topic in got:
            out = publisher(graph, topic)
            for i in range(2 * BATCH):
                out.publish(String(data=f"{topic}{i}"))
        wait_for(lambda: all(len(inbox) == 2 * BATCH for inbox in got.values()), "all messages")
        for topic, inbox in got.items():
            assert [words for words, _ in inbox] == [f"{topic}{i}" for i in range(2 * BATCH)]
            stamps = [published_ns for _, published_ns in inbox]
            assert stamps == sorted(stamps)
            assert began <= stamps[0] <= stamps[-1] <= time.time_ns()

    def test_what_came_before_it_is_taken(self, graph, streams, arrivals):
        subscription = subscribe(streams, "a")
        out = publisher(graph, "a")
        for i in range(2 * BATCH):
            out.publish(String(data=str(i)))
        out.wait_for_all_acked()
        got = []
        arrivals.add(subscription, lambda data, _: got.append(text(data)))
        wait_for(lambda: len(got) == 2 * BATCH, "the messages from before")

    def test_a_callback_that_raises_is_reported_and_the_next_message_taken(
        self, graph, streams, arrivals, errors
    ):
        got = []

        def take(data, _):
            if text(data) == "bad":
                raise ValueError("bad")
            got.append(text(data))

        arrivals.add(subscribe(streams, "a"), take)
        out = publisher(graph, "a")
        for word in ("one", "bad", "two"):
            out.publish(String(data=word))
        wait_for(lambda: len(got) == 2, "both good messages")
        assert got == ["one", "two"]
        assert [str(error) for error in errors] == ["bad"]

    def test_what_a_publisher_sent_in_vain_is_counted(self, graph, streams, arrivals):
        got, gaps = [], []
        held = threading.Event()

        def take(data, _):
            got.append(text(data))
            held.wait(20)

        subscription = streams.create_subscription(String, "a", lambda _: None, 1, raw=True)
        arrivals.add(subscription, take, gaps.append)
        out = graph.client.create_publisher(String, "a", 1)
        wait_for(out.get_subscription_count, "a subscription")
        out.publish(String(data="0"))
        wait_for(lambda: got, "the first message")
        for i in range(1, 6):
            out.publish(String(data=str(i)))
            out.wait_for_all_acked()
        held.set()
        wait_for(lambda: "5" in got, "the newest message")
        assert len(got) + sum(gaps) == 6
        assert sum(gaps) == 4

    def test_a_removed_subscription_may_be_destroyed_at_once_under_a_flood(
        self, graph, streams, arrivals, errors
    ):
        got = []
        out = graph.client.create_publisher(String, "a", qos.STREAM)
        over = threading.Event()

        def flood():
            while not over.is_set():
                out.publish(String(data="x"))

        flooding = threading.Thread(target=flood)
        flooding.start()
        try:
            for _ in range(10):
                subscription = subscribe(streams, "a")
                arrivals.add(subscription, lambda data, _: got.append(1))
                count = len(got)
                wait_for(lambda count=count: len(got) > count, "a message")
                arrivals.remove(subscription)
                streams.destroy_subscription(subscription)
        finally:
            over.set()
            flooding.join()
        assert errors == []


class TestTopicPoll:
    def test_messages_of_all_topics_come_in_the_order_of_their_reception(self, graph, streams):
        batches: list[list[Received]] = []
        poll = TopicPoll("test", 0.01, lambda messages: batches.append(messages) or True, print)
        for topic in ("a", "b"):
            poll.add(subscribe(streams, topic), topic)
        poll.start()
        outs = [publisher(graph, topic) for topic in ("a", "b")]
        for i in range(100):
            for out in outs:
                out.publish(String(data=str(i)))
        wait_for(lambda: sum(map(len, batches)) == 200, "all messages")
        poll.stop()
        messages = [message for batch in batches for message in batch]
        assert messages == sorted(messages, key=lambda message: message.received_ns)
        for topic in ("a", "b"):
            mine = [message for message in messages if message.topic == topic]
            assert [text(message.data) for message in mine] == [str(i) for i in range(100)]
            # By two clocks: while the wall clock is slewed, they part by microseconds.
            assert all(abs(m.received_ns - m.published_ns) < SECOND for m in mine)

    def test_stop_takes_what_has_come(self, graph, streams):
        got = []
        poll = TopicPoll("test", 600.0, lambda messages: got.extend(messages) or True, print)
        subscription = subscribe(streams, "a")
        out = publisher(graph, "a")
        poll.start()
        poll.add(subscription, "a")
        out.publish(String(data="late"))
        with subscription.handle:
            wait_for(lambda: out.wait_for_all_acked(), "the message to arrive")
        poll.stop()
        assert [text(message.data) for message in got] == ["late"]

    def test_it_ends_where_its_messages_are_refused(self, graph, streams):
        calls = []
        poll = TopicPoll("test", 0.001, lambda messages: calls.append(1) and False, print)
        poll.start()
        poll._thread.join(10)
        assert not poll._thread.is_alive()
        assert len(calls) == 1
        poll.stop()

    def test_an_error_is_reported_and_the_thread_continues(self, graph, streams):
        errors: list[Exception] = []
        got: list[str] = []

        def take(messages):
            if not errors:
                raise OSError("no descriptor")
            got.extend(text(message.data) for message in messages)
            return True

        poll = TopicPoll("test", 0.01, take, errors.append)
        poll.add(subscribe(streams, "a"), "a")
        poll.start()
        wait_for(lambda: errors, "the error")
        publisher(graph, "a").publish(String(data="after"))
        wait_for(lambda: got == ["after"], "a message after the error")
        assert [str(error) for error in errors] == ["no descriptor"]
        poll.stop()
