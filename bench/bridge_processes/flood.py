"""A guest that publishes small reports of latency without end: ENDPOINT, messages a second."""

import json
import sys
import time

import zenoh
from mrlab_msgs.msg import Latency
from rclpy.serialization import serialize_message

KEY = "latency/clients"
# s of a burst; shorter ones cannot be kept in time.
PERIOD = 0.01


def main() -> None:
    endpoint, rate = sys.argv[1], int(sys.argv[2])
    config = zenoh.Config()
    config.insert_json5("mode", '"client"')
    config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    payload = bytes(serialize_message(Latency(observer="flood")))
    with zenoh.open(config) as session:
        publisher = session.declare_publisher(
            KEY, congestion_control=zenoh.CongestionControl.BLOCK
        )
        due = time.monotonic()
        while True:
            for _ in range(round(rate * PERIOD)):
                publisher.put(payload)
            due += PERIOD
            time.sleep(max(0.0, due - time.monotonic()))


if __name__ == "__main__":
    main()
