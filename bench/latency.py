"""How old a joint state is when it reaches a zenoh subscriber in another process.

The stamp is taken just before publishing. From there on: DDS, the bridge, zenoh, and a callback
in this process. "flat out" publishes as fast as one process can: what arrives is what the bridge
carries on this machine with publisher, bridge and subscriber sharing it.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import socket
import struct
import subprocess
import sys
import time
from typing import Any

import psutil
import report
import zenoh

DOMAIN = "143"
SETTLE = 1.0


def publish(robots: int, rate: float, seconds: float) -> None:
    """Publish joint states of six joints for `robots` robots at `rate` Hz; 0: flat out."""
    import rclpy
    from rclpy.serialization import serialize_message
    from sensor_msgs.msg import JointState

    from mrlab_ros import qos

    rclpy.init()
    node = rclpy.create_node("bench_latency")
    topics = [f"/bench_{i}/joint_states" for i in range(robots)]
    publishers = [node.create_publisher(JointState, topic, qos.STREAM) for topic in topics]
    message = JointState(name=[f"joint_{i}" for i in range(6)], position=[0.5] * 6)
    message.velocity = [0.1] * 6
    frame = bytearray(serialize_message(message))
    until(lambda: all(p.get_subscription_count() for p in publishers), "the bridge to subscribe")
    print("matched", flush=True)
    sys.stdin.readline()
    due = time.perf_counter()
    end, sent = due + seconds, 0
    while (now := time.perf_counter()) < end:
        if rate and now < due:
            time.sleep(due - now)
        due += 1 / rate if rate else 0
        for publisher in publishers:
            stamp = time.time_ns()
            struct.pack_into("<iI", frame, 4, stamp // 1_000_000_000, stamp % 1_000_000_000)
            publisher.publish(bytes(frame))
        sent += robots
    print(sent, flush=True)
    sys.stdin.readline()
    node.destroy_node()
    rclpy.shutdown()


def until(condition, what: str, seconds: float = 20.0) -> None:
    """Wait for `condition`; raise TimeoutError naming `what` when it does not come true."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(f"waited {seconds:g} s for {what}")
        time.sleep(0.02)


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def measure(robots: int, rate: float, seconds: float) -> dict[str, Any]:
    """Run publisher and bridge in processes of their own and receive here."""
    environment = os.environ | {
        "ROS_DOMAIN_ID": DOMAIN,
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    endpoint = f"tcp/127.0.0.1:{free_port()}"
    bridge = subprocess.Popen(
        f"{sys.executable} -m mrlab_ros.host bridge --ros-args --log-level error "
        f"-p listen:=['{endpoint}']".split(),
        env=environment,
    )
    arguments = [str(robots), str(rate), str(seconds + SETTLE)]
    source = subprocess.Popen(
        [sys.executable, __file__, "--publish", *arguments],
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        session = connected(endpoint)
        ages: list[tuple[int, int]] = []
        stamp = struct.Struct("<iI")

        def receive(sample: zenoh.Sample) -> None:
            now = time.time_ns()
            seconds_, nanoseconds = stamp.unpack_from(sample.payload.to_bytes(), 4)
            ages.append((now, now - seconds_ * 1_000_000_000 - nanoseconds))

        subscriber = session.declare_subscriber("*/joint_states", receive)
        assert source.stdout is not None
        assert source.stdin is not None
        source.stdout.readline()
        until(lambda: heard(session) == robots, "the bridge to hear of the subscriber")
        watched = psutil.Process(bridge.pid)
        before = watched.cpu_times()
        began = time.monotonic()
        source.stdin.write("go\n")
        source.stdin.flush()
        sent = int(source.stdout.readline())
        took = time.monotonic() - began
        after = watched.cpu_times()
        busy = after.user + after.system - before.user - before.system
        time.sleep(0.2)
        subscriber.undeclare()
        session.close()
        source.stdin.write("end\n")
        source.stdin.flush()
        source.wait(10)
    finally:
        for process in (source, bridge):
            process.send_signal(signal.SIGINT)
        for process in (source, bridge):
            try:
                process.wait(5)
            except subprocess.TimeoutExpired:
                process.kill()
    # Discovery still goes on in the first second.
    first = ages[0][0] + SETTLE * 1_000_000_000 if ages else 0
    steady = [age / 1e6 for arrived, age in ages if arrived >= first]
    if not steady:
        sys.exit("latency: nothing arrived at the subscriber; run it again with the lab stopped")
    return {
        "robots": robots,
        "rate_hz": f"{rate:g}" if rate else "flat out",
        "sent": sent,
        "lost": sent - len(ages),
        "received_per_s": round(len(ages) / took),
        **{f"{name}_ms": value for name, value in report.percentiles(steady).items()},
        "bridge_cpu_percent": round(100 * busy / took, 1),
    }


def connected(endpoint: str) -> zenoh.Session:
    """Open a session once the bridge listens."""
    host, port = endpoint.removeprefix("tcp/").split(":")

    def listens() -> bool:
        with socket.socket() as probe:
            return probe.connect_ex((host, int(port))) == 0

    until(listens, f"the bridge to listen on {endpoint}")
    config = zenoh.Config()
    config.insert_json5("mode", '"client"')
    config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    return zenoh.open(config)


def heard(session: zenoh.Session) -> int:
    """Return how many of the bridge's keys somebody subscribes to."""
    for reply in session.get("@mrlab/bridge/statistics"):
        if reply.ok is not None:
            keys = json.loads(reply.ok.payload.to_string())["keys"]
            return sum(count.get("heard", False) for count in keys.values())
    return 0


def main() -> None:
    parser = report.options(__doc__.splitlines()[0])
    parser.add_argument("--publish", nargs=3, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.publish:
        robots, rate, seconds = arguments.publish
        publish(int(robots), float(rate), float(seconds))
        return
    seconds = 5.0 if arguments.quick else 30.0
    cases = ((1, 100.0), (13, 100.0), (50, 100.0), (1, 0.0))
    rows = [measure(*case, seconds) for case in cases]
    report.show("Stamp to zenoh subscriber in another process", rows, arguments.json)


if __name__ == "__main__":
    main()
