"""Publishes joint states of six joints for the bridge's benchmark, over DDS or over zenoh.

Says "ready" when all topics are matched, starts at a line on stdin, says how many it sent, ends at
another line. The stamp in a message is taken just before it is published.
"""

from __future__ import annotations

import argparse
import json
import struct
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

# All robots' topics are matched long before; what discovery still does must not be measured.
SETTLE = 1.0


def frame() -> bytearray:
    """Return the CDR of a joint state."""
    import rclpy  # noqa: F401 - finds the message's libraries
    from rclpy.serialization import serialize_message
    from sensor_msgs.msg import JointState

    message = JointState(name=[f"joint_{i}" for i in range(6)], position=[0.5] * 6)
    message.velocity = [0.1] * 6
    return bytearray(serialize_message(message))


@contextmanager
def dds(topics: list[str]) -> Iterator[list[Callable[[bytes], None]]]:
    """Yield what publishes on each topic."""
    import rclpy
    from sensor_msgs.msg import JointState

    from mrlab_ros.messages import qos

    rclpy.init()
    node = rclpy.create_node("bench_source")
    publishers = [node.create_publisher(JointState, topic, qos.STREAM) for topic in topics]
    until(lambda: all(p.get_subscription_count() for p in publishers), "a subscription a topic")
    yield [publisher.publish for publisher in publishers]
    node.destroy_node()
    rclpy.shutdown()


@contextmanager
def zenoh_alone(topics: list[str], endpoint: str) -> Iterator[list[Callable[[bytes], None]]]:
    """Yield what puts on each topic's key, with stamps as the bridge's."""
    from mrlab_ros.adapters.zenoh.configuration import configuration
    from mrlab_ros.adapters.zenoh.session import ZenohSession
    from mrlab_ros.core.bridge.latency import attachment
    from mrlab_ros.core.bridge.rules import Congestion, TopicRule

    session = ZenohSession(configuration(listen=(endpoint,)))
    rule = TopicRule("/any", priority=2, congestion=Congestion.DROP)
    publishers = [session.publisher(topic[1:], rule, 0) for topic in topics]
    until(lambda: all(p.has_subscriber() for p in publishers), "a subscriber a key")

    def putter(publisher) -> Callable[[bytes], None]:
        def put(payload: bytes) -> None:
            now = time.time_ns()
            publisher.put(payload, attachment(0, now, now))

        return put

    yield [putter(publisher) for publisher in publishers]
    session.close()


def until(condition: Callable[[], bool], what: str, seconds: float = 60.0) -> None:
    """Wait for `condition`; raise TimeoutError naming `what` when it does not come true."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(f"waited {seconds:g} s for {what}")
        time.sleep(0.02)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robots", type=int, required=True)
    parser.add_argument("--rate", type=float, required=True, help="Hz; 0: flat out")
    parser.add_argument("--seconds", type=float, required=True)
    parser.add_argument("--zenoh", metavar="ENDPOINT", help="put there, without DDS and bridge")
    arguments = parser.parse_args()
    message = frame()
    topics = [f"/bench_{i}/joint_states" for i in range(arguments.robots)]
    rate = arguments.rate
    way = zenoh_alone(topics, arguments.zenoh) if arguments.zenoh else dds(topics)
    with way as publishers:
        time.sleep(SETTLE)
        print("ready", flush=True)
        sys.stdin.readline()
        due = time.perf_counter()
        end, sent = due + arguments.seconds, 0
        while (now := time.perf_counter()) < end:
            if rate and now < due:
                time.sleep(due - now)
            due += 1 / rate if rate else 0
            for publish in publishers:
                stamp = time.time_ns()
                struct.pack_into("<iI", message, 4, stamp // 1_000_000_000, stamp % 1_000_000_000)
                publish(bytes(message))
            sent += len(publishers)
        print(json.dumps({"sent": sent}), flush=True)
        sys.stdin.readline()


if __name__ == "__main__":
    main()
