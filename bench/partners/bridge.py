"""The ends of the bridge's way: what publishes joint states, and what receives them."""

from __future__ import annotations

import ctypes
import os
import struct
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import rclpy
import zenoh
from mrlab_msgs.msg import Latency
from partner import until
from partners.zenoh_client import client_config
from rclpy.node import Node
from rclpy.serialization import serialize_message
from sensor_msgs.msg import JointState

from mrlab_ros.adapters.zenoh.configuration import configuration
from mrlab_ros.adapters.zenoh.session import ZenohSession
from mrlab_ros.core.bridge.latency import attachment
from mrlab_ros.core.bridge.rules import Congestion, TopicRule
from mrlab_ros.messages import qos
from mrlab_ros.nodes.playback.direct import Direct, Stream
from mrlab_ros.ros.arrivals import Arrivals

# All topics are matched long before; what discovery still does must not be measured, s.
SETTLE_S = 1.0
# s of a burst of a flood; shorter ones cannot be kept in time.
BURST_S = 0.01
NANOSECONDS = 1_000_000_000
# In a joint state's CDR; in the bridge's attachment: sequence, received, bridged.
STAMP, STAMPS = struct.Struct("<iI"), struct.Struct("<qqq")
# What is measured while the last things settle does not count, ns from the first message.
WARM_UP_NS = NANOSECONDS
# Of so many messages at most an age is kept.
KEPT = 500_000
LEVELS = (50, 95, 99, 100)
CLONE_NEWNET = 0x40000000


def enter(namespace: str) -> None:
    """Move this thread, and those that it starts, into a network namespace; empty: stay."""
    if namespace:
        with Path("/run/netns", namespace).open() as file:
            libc = ctypes.CDLL(None, use_errno=True)
            if libc.setns(file.fileno(), CLONE_NEWNET):
                raise OSError(ctypes.get_errno(), f"no way into the namespace {namespace}")


@contextmanager
def dds(topics: list[str], socket: str = "") -> Iterator[list[Callable[[bytes], None]]]:
    """Yield what publishes on each topic; socket: and puts it on zenoh, as a playback does."""
    rclpy.init()
    node = rclpy.create_node("bench_source")
    publishers = [node.create_publisher(JointState, topic, qos.STREAM) for topic in topics]
    if not socket:
        until(
            lambda: all(p.get_subscription_count() for p in publishers), "a subscription a topic"
        )
        yield [publisher.publish for publisher in publishers]
        return
    direct = Direct(socket, "")
    heard = [threading.Event() for _ in topics]
    streams = [direct.stream(*each) for each in zip(topics, (e.set for e in heard), strict=True)]
    for event in heard:
        until(event.is_set, "a subscriber a key")

    def both(publisher: Any, stream: Stream) -> Callable[[bytes], None]:
        def publish(payload: bytes) -> None:
            now = time.time_ns()
            publisher.publish(payload)
            stream.put(payload, now)

        return publish

    yield [both(*each) for each in zip(publishers, streams, strict=True)]
    direct.close()


@contextmanager
def zenoh_alone(topics: list[str], endpoint: str) -> Iterator[list[Callable[[bytes], None]]]:
    """Yield what puts on each topic's key, with stamps as the bridge's."""
    session = ZenohSession(configuration(listen=(endpoint,)))
    rule = TopicRule("/any", priority=2, congestion=Congestion.DROP)
    publishers = [session.publisher(topic[1:], rule, 0) for topic in topics]
    until(lambda: all(p.has_subscriber() for p in publishers), "a subscriber a key")

    def putter(publisher: Any) -> Callable[[bytes], None]:
        def put(payload: bytes) -> None:
            now = time.time_ns()
            publisher.put(payload, attachment(0, now, now))

        return put

    yield [putter(publisher) for publisher in publishers]
    session.close()


def source(
    pipe: Any,
    robots: int,
    rate: float,
    seconds: float,
    endpoint: str = "",
    namespace: str = "",
    socket: str = "",
) -> None:
    """Publish joint states of six joints over DDS, or over zenoh at an endpoint.

    socket: of a bridge, to which they go over zenoh, too. rate: Hz; 0: flat out. Sends "ready"
    when all topics are matched, begins when it is told, sends how many it sent. The stamp in a
    message is taken just before it is published.
    """
    enter(namespace)
    state = JointState(name=[f"joint_{i}" for i in range(6)], position=[0.5] * 6)
    state.velocity = [0.1] * 6
    message = bytearray(serialize_message(state))
    topics = [f"/bench_{i}/joint_states" for i in range(robots)]
    with zenoh_alone(topics, endpoint) if endpoint else dds(topics, socket) as publishers:
        time.sleep(SETTLE_S)
        pipe.send("ready")
        pipe.recv()
        due, sent = time.perf_counter(), 0
        end = due + seconds
        while (now := time.perf_counter()) < end:
            if rate and now < due:
                time.sleep(due - now)
            due += 1 / rate if rate else 0
            for publish in publishers:
                STAMP.pack_into(message, 4, *divmod(time.time_ns(), NANOSECONDS))
                publish(bytes(message))
            sent += len(publishers)
        pipe.send(sent)
        pipe.recv()


class Ages:
    """How old messages are on arrival, and when the bridge had them. ns."""

    def __init__(self) -> None:
        self.count = 0
        self._first = 0
        self._ages: list[tuple[int, int]] = []

    def note(self, payload: bytes, bridged_ns: int | None = None) -> None:
        """Note a message that has just arrived."""
        now = time.time_ns()
        self.count += 1
        self._first = self._first or now
        if len(self._ages) < KEPT and now - self._first > WARM_UP_NS:
            seconds, nanoseconds = STAMP.unpack_from(payload, 4)
            stamp = seconds * NANOSECONDS + nanoseconds
            self._ages.append((now - stamp, now - (bridged_ns or now)))

    def found(self) -> dict[str, Any]:
        """Return the count and percentiles of the age and of its two parts, ms."""
        if not self._ages:
            return {"count": self.count}
        age, after = np.array(self._ages).T / 1e6
        parts = {"age": age, "before": age - after, "after": after}
        levels = {name: np.percentile(part, LEVELS).tolist() for name, part in parts.items()}
        return {"count": self.count, **levels}


def over_zenoh(pipe: Any, endpoint: str, sessions: int = 1) -> None:
    """Subscribe with so many sessions; send what the first received, and how many all did."""
    ages = Ages()

    def receive(sample: zenoh.Sample) -> None:
        # The stock bridge attaches nothing.
        stamps = sample.attachment
        bridged_ns = STAMPS.unpack_from(stamps.to_bytes())[2] if stamps else None
        ages.note(sample.payload.to_bytes(), bridged_ns)

    def count(_: zenoh.Sample) -> None:
        ages.count += 1

    opened = [zenoh.open(client_config(endpoint)) for _ in range(sessions)]
    # In zenoh's own thread. Of the further sessions only the messages are counted.
    for i, session in enumerate(opened):
        callback = zenoh.handlers.Callback(count if i else receive, indirect=False)
        session.declare_subscriber("*/joint_states", callback)
    _answer(pipe, ages)


def over_dds(pipe: Any, robots: int) -> None:
    """Subscribe to every robot's topic; send what was received."""
    ages = Ages()

    def receive(payload: bytes, _: int) -> None:
        ages.note(payload)

    rclpy.init()
    node = Node("bench_subscriber")
    arrivals = Arrivals("bench_subscriber", print)
    for i in range(robots):
        topic = f"/bench_{i}/joint_states"
        subscription = node.create_subscription(JointState, topic, receive, qos.STREAM, raw=True)
        arrivals.add(subscription, receive)
    _answer(pipe, ages)


def _answer(pipe: Any, ages: Ages) -> None:
    pipe.send("ready")
    pipe.recv()
    pipe.send(ages.found())
    pipe.recv()


def flood(pipe: Any, endpoint: str, rate: int) -> None:
    """Publish small reports of latency without end, `rate` a second."""
    payload = bytes(serialize_message(Latency(observer="flood")))
    with zenoh.open(client_config(endpoint)) as session:
        publisher = session.declare_publisher(
            "latency/clients", congestion_control=zenoh.CongestionControl.BLOCK
        )
        due = time.monotonic()
        while True:
            for _ in range(round(rate * BURST_S)):
                publisher.put(payload)
            due += BURST_S
            time.sleep(max(0.0, due - time.monotonic()))


class Witness:
    """What came over a link since it was last asked."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._there: set[str] = set()
        self._sequence: dict[str, int] = {}
        self._forget()

    def _forget(self) -> None:
        self._first: int | None = None
        self._ages: list[float] = []
        self._lost = 0
        self._gone = 0

    def move(self, sample: zenoh.Sample) -> None:
        now = time.time_ns()
        sequence, _, bridged = STAMPS.unpack_from(sample.attachment.to_bytes())
        with self._lock:
            key = str(sample.key_expr)
            self._lost += max(0, sequence - self._sequence.get(key, sequence - 1) - 1)
            self._sequence[key] = sequence
            self._first = self._first or now
            self._ages.append((now - bridged) / 1e6)

    def token(self, sample: zenoh.Sample) -> None:
        with self._lock:
            if sample.kind == zenoh.SampleKind.PUT:
                self._there.add(str(sample.key_expr))
            else:
                self._there.discard(str(sample.key_expr))
                self._gone += 1

    def found(self) -> dict[str, Any]:
        """Return what came; first: ns; age: percentiles in ms."""
        with self._lock:
            said = {
                "count": len(self._ages),
                "lost": self._lost,
                "first": self._first,
                "tokens": len(self._there),
                "gone": self._gone,
                "age": np.percentile(self._ages or [np.nan], LEVELS).tolist(),
            }
            self._forget()
        return said


def witness(pipe: Any, endpoint: str, namespace: str) -> None:
    """Follow joint states and tokens over a link that breaks; send what came, if asked."""
    enter(namespace)
    seen = Witness()
    config = client_config(
        endpoint,
        transport__link__tx__lease=1500,
        transport__unicast__open_timeout=2000,
        connect__retry={
            "period_init_ms": 250, "period_max_ms": 500, "period_increase_factor": 1.5
        },
        # The bridge may begin to listen after this.
        connect__timeout_ms=30_000,
    )  # fmt: skip
    with zenoh.open(config) as session:
        session.declare_subscriber("*/joint_states", seen.move)
        session.liveliness().declare_subscriber("@/*/@ros2_lv/**", seen.token, history=True)
        pipe.send(os.getpid())
        while pipe.recv() == "ask":
            pipe.send(seen.found())
