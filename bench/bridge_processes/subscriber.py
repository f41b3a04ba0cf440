"""Receives joint states for the bridge's benchmark, over zenoh or over DDS.

Says "ready" when it listens; at a line on stdin says as JSON what it received: messages
and percentiles of the age on arrival and of the two hops, ms.
"""

from __future__ import annotations

import argparse
import json
import struct
import sys
import time
from typing import Any

import numpy as np

STAMP = struct.Struct("<iI")
# What is measured while the last things settle does not count, ns from the first message.
WARM_UP = 1_000_000_000
# Of so many messages at most an age is kept.
KEPT = 500_000


class Ages:
    """How old messages are on arrival, and when the bridge had them. ns."""

    def __init__(self) -> None:
        self.count = 0
        self.first = 0
        self.ages: list[tuple[int, int]] = []

    def note(self, payload: bytes, bridged_ns: int | None) -> None:
        """Note a message that has just arrived."""
        now = time.time_ns()
        self.count += 1
        self.first = self.first or now
        if len(self.ages) < KEPT and now - self.first > WARM_UP:
            seconds, nanoseconds = STAMP.unpack_from(payload, 4)
            stamp = seconds * 1_000_000_000 + nanoseconds
            self.ages.append((now - stamp, now - (bridged_ns or now)))

    def report(self) -> dict[str, Any]:
        if not self.ages:
            return {"count": self.count}
        age, after = np.array(self.ages).T / 1e6
        levels = [50, 95, 99, 100]
        return {
            "count": self.count,
            "age": np.percentile(age, levels).tolist(),
            "before_bridged": np.percentile(age - after, levels).tolist(),
            "after_bridged": np.percentile(after, levels).tolist(),
        }


def over_zenoh(endpoint: str, sessions: int, ages: Ages) -> Any:
    """Subscribe with so many sessions; return what keeps them."""
    import zenoh

    bridged = struct.Struct("<16xq")

    def connect() -> Any:
        config = zenoh.Config()
        config.insert_json5("mode", '"client"')
        config.insert_json5("connect/endpoints", json.dumps([endpoint]))
        config.insert_json5("scouting/multicast/enabled", "false")
        return zenoh.open(config)

    def receive(sample: zenoh.Sample) -> None:
        # The stock bridge attaches nothing.
        stamps = sample.attachment
        bridged_ns = bridged.unpack_from(stamps.to_bytes())[0] if stamps else None
        ages.note(sample.payload.to_bytes(), bridged_ns)

    def count(_: zenoh.Sample) -> None:
        ages.count += 1

    opened = [connect() for _ in range(sessions)]
    # In zenoh's own thread. Of the further sessions only the messages are counted.
    for i, session in enumerate(opened):
        callback = zenoh.handlers.Callback(count if i else receive, indirect=False)
        session.declare_subscriber("*/joint_states", callback)
    return opened


def over_dds(robots: int, ages: Ages) -> Any:
    """Subscribe to every robot's topic; return what keeps the subscriptions."""
    import rclpy
    from rclpy.node import Node
    from sensor_msgs.msg import JointState

    from mrlab_ros.messages import qos
    from mrlab_ros.ros.arrivals import Arrivals

    def receive(payload: bytes, _: int) -> None:
        ages.note(payload, None)

    rclpy.init()
    node = Node("bench_subscriber")
    arrivals = Arrivals("bench_subscriber", print)
    for i in range(robots):
        subscription = node.create_subscription(
            JointState, f"/bench_{i}/joint_states", receive, qos.STREAM, raw=True
        )
        arrivals.add(subscription, receive)
    return arrivals


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--zenoh", metavar="ENDPOINT", help="subscribe there")
    parser.add_argument("--sessions", type=int, default=1)
    parser.add_argument("--dds", type=int, default=0, metavar="ROBOTS")
    arguments = parser.parse_args()
    ages = Ages()
    kept = (
        over_zenoh(arguments.zenoh, arguments.sessions, ages)
        if arguments.zenoh
        else over_dds(arguments.dds, ages)
    )
    print("ready", flush=True)
    sys.stdin.readline()
    print(json.dumps(ages.report()), flush=True)
    sys.stdin.readline()
    if arguments.zenoh:
        for session in kept:
            session.close()
    else:
        kept.close()


if __name__ == "__main__":
    main()
