"""A lab's zenoh side for the gateway's benchmark: joint states with stamps as the bridge's.

Says "ready" when it listens, publishes until stdin ends.
"""

from __future__ import annotations

import argparse
import select
import sys
import time

from mrlab_ros.adapters.zenoh.configuration import configuration
from mrlab_ros.adapters.zenoh.session import ZenohSession
from mrlab_ros.core.bridge.latency import attachment, clock_answer
from mrlab_ros.core.bridge.rules import (
    Congestion,
    Direction,
    TopicQos,
    TopicRule,
    bridge_token,
    topic_token,
)
from mrlab_ros.gateway.lab.definitions import installed_definitions

JOINTS = "sensor_msgs/msg/JointState"
NAMES = [
    f"{joint}_joint"
    for joint in ("shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3")
]
QOS = TopicQos(reliable=True, latched=False, depth=10)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--endpoint", required=True)
    parser.add_argument("--robots", type=int, required=True)
    parser.add_argument("--rate", type=float, required=True, help="Hz")
    arguments = parser.parse_args()
    session = ZenohSession(configuration(listen=(arguments.endpoint,)))
    keys = [f"bench_{i}/joint_states" for i in range(arguments.robots)]
    zid, rule = session.zid, TopicRule("/any", priority=2, congestion=Congestion.DROP)
    held = [session.token(bridge_token(zid))]
    held += [session.token(topic_token(zid, Direction.OUT, key, JOINTS, QOS)) for key in keys]

    def answer(query):
        now = time.time_ns()
        query.reply(clock_answer(now, now))

    held.append(session.queryable("@mrlab/bridge/clock", answer))
    publishers = [session.publisher(key, rule, 0) for key in keys]
    values = {"name": NAMES, "position": [0.5] * 6}
    payload = installed_definitions().encode(JOINTS, {**values, "velocity": [0.1] * 6})
    print("ready", flush=True)
    due, sequence = time.perf_counter(), 0
    while not select.select([sys.stdin], [], [], 0)[0]:
        due += 1 / arguments.rate
        sequence += 1
        for publisher in publishers:
            now = time.time_ns()
            publisher.put(payload, attachment(sequence, now, now))
        wait = due - time.perf_counter()
        if wait > 0:
            time.sleep(wait)
    session.close()


if __name__ == "__main__":
    main()
