"""What the bridge adds, what it carries, and whether it stays as it is.

Joint states of six joints go from a source process over the bridge to zenoh subscribers in
processes of their own. Beside the bridge stand its two halves alone: DDS from the source to a
subscriber, and zenoh from the source to a subscriber. Age: from the stamp, just before
publishing, to the subscriber's callback. "flat out" publishes as fast as one process can: what
arrives is what the bridge carries while source, bridge and subscriber share the machine; the
messages a second that one core carries follow from the bridge's CPU time a message. With --stock
each run of the bridge is followed by one of `zenoh-bridge-ros2dds`, whose messages have no stamps:
there the parts of the way have no figures.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import report
import zenoh

DOMAIN = os.environ.get("ROS_DOMAIN_ID", "143")
PROCESSES = Path(__file__).parent / "bridge_processes"
# Subscribers that one process holds.
SESSIONS = 10
# Messages a second of a guest who floods a key.
FLOOD = 17_000
RSS_PERIOD = 5.0
STOCK = "stock bridge"


class Process:
    """A process of the benchmark: it is told to go on by a line, and answers by one."""

    def __init__(self, name: str, *arguments: object, within: Sequence[str] = ()) -> None:
        self._process = subprocess.Popen(
            [*within, sys.executable, str(PROCESSES / f"{name}.py"), *map(str, arguments)],
            env=environment(),
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def listen(self) -> str:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if not line:
            raise RuntimeError(f"{self._process.args} has ended; run it by hand to see why")
        return line

    def tell(self) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write("\n")
        self._process.stdin.flush()

    def ask(self) -> dict[str, Any]:
        self.tell()
        answer: dict[str, Any] = json.loads(self.listen())
        return answer

    def cpu(self) -> float:
        """Return the CPU time used so far, s."""
        times = psutil.Process(self._process.pid).cpu_times()
        return float(times.user + times.system)

    def end(self) -> None:
        self._process.kill()
        self._process.wait()


@dataclass
class Bridge:
    endpoint: str
    watched: psutil.Process

    def cpu(self) -> float:
        """Return the CPU time used so far, s."""
        times = self.watched.cpu_times()
        return float(times.user + times.system)

    def rss(self) -> float:
        """Return the resident memory, MB."""
        return float(self.watched.memory_info().rss / 1e6)


@dataclass
class Used:
    """CPU: of a core, by bridge and subscribers; s a message, by the bridge; its memory, MB."""

    bridge: float
    subscribers: float
    message: float
    rss: float


def environment() -> dict[str, str]:
    return os.environ | {
        "ROS_DOMAIN_ID": DOMAIN,
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_DISTRO": "jazzy",
    }


def free_endpoint() -> str:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{probe.getsockname()[1]}"


def until(condition, what: str, seconds: float = 60.0) -> None:
    """Wait for `condition`; raise TimeoutError naming `what` when it does not come true."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(f"waited {seconds:g} s for {what}")
        time.sleep(0.05)


@contextmanager
def bridge(stock: str = "") -> Iterator[Bridge]:
    """Run a bridge in a process of its own; stock: the executable of the stock one."""
    endpoint = free_endpoint()
    ours = (
        f"{sys.executable} -m mrlab_ros.processes.host bridge --ros-args --log-level error "
        f"-p listen:=['{endpoint}']"
    )
    theirs = f"{stock} --no-multicast-scouting -l {endpoint}"
    process = subprocess.Popen(
        (theirs if stock else ours).split(),
        env=environment(),
        stdout=subprocess.DEVNULL,
    )
    host, port = endpoint.removeprefix("tcp/").split(":")

    def listens() -> bool:
        with socket.socket() as probe:
            return probe.connect_ex((host, int(port))) == 0

    try:
        until(listens, f"the bridge to listen on {endpoint}")
        yield Bridge(endpoint, psutil.Process(process.pid))
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(5)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def heard(endpoint: str) -> int:
    """Return how many of the bridge's topics of joint states somebody subscribes to."""
    config = zenoh.Config()
    config.insert_json5("mode", '"client"')
    config.insert_json5("connect/endpoints", json.dumps([endpoint]))
    with zenoh.open(config) as session:
        for reply in session.get("@mrlab/bridge/statistics"):
            if reply.ok is not None:
                keys = json.loads(reply.ok.payload.to_string())["keys"]
                return sum(k.get("heard", False) for n, k in keys.items() if "joint" in n)
    return 0


@contextmanager
def processes(*made: Process) -> Iterator[None]:
    try:
        yield
    finally:
        for process in made:
            process.end()


def run(source: Process, receivers: list[Process], seconds: float) -> tuple[int, list[Any]]:
    """Let the source send; return how much, and what the receivers say."""
    source.tell()
    sent = json.loads(source.listen())["sent"]
    # What is still under way; a stream that arrives later than that has failed.
    time.sleep(min(1.0, seconds))
    return sent, [receiver.ask() for receiver in receivers]


def alone(way: str, robots: int, rate: float, seconds: float) -> dict[str, Any]:
    """Measure one half of the way without the bridge."""
    if way == "zenoh":
        endpoint = free_endpoint()
        source = Process("source", *options(robots, rate, seconds), "--zenoh", endpoint)
        # The source listens, so that subscribers of both kinds connect to the same side.
        port = int(endpoint.rsplit(":", 1)[1])
        until(lambda: listening(port), "the source to listen")
        receiver = Process("subscriber", "--zenoh", endpoint)
    else:
        source = Process("source", *options(robots, rate, seconds))
        receiver = Process("subscriber", "--dds", robots)
    with processes(source, receiver):
        receiver.listen()
        source.listen()
        sent, (heard_of,) = run(source, [receiver], seconds)
    return row(f"{way} alone", robots, rate, sent, [heard_of], 1, None)


def listening(port: int) -> bool:
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def bridged(
    robots: int,
    rate: float,
    seconds: float,
    subscribers: int = 1,
    rss: list[float] | None = None,
    flood: int = 0,
    stock: str = "",
) -> dict[str, Any]:
    """Measure the whole way; `rss` collects the bridge's memory, MB, meanwhile.

    flood: messages a second that a guest sends all the time on a key that comes in. stock: the
    executable of the stock bridge, in place of ours.
    """
    with bridge(stock) as carried:
        counts = [SESSIONS] * (subscribers // SESSIONS)
        counts += [subscribers % SESSIONS] if subscribers % SESSIONS else []
        source = Process("source", *options(robots, rate, seconds))
        receivers = [
            Process("subscriber", "--zenoh", carried.endpoint, "--sessions", count)
            for count in counts
        ]
        guests = [Process("flood", carried.endpoint, flood)] if flood else []
        with processes(source, *receivers, *guests):
            for receiver in receivers:
                receiver.listen()
            source.listen()
            # The source is ready once each topic has a subscription, which is the stock bridge's.
            if not stock:
                until(
                    lambda: heard(carried.endpoint) == robots, "the bridge to hear of subscribers"
                )
            before, began = carried.cpu(), time.monotonic()
            theirs = sum(receiver.cpu() for receiver in receivers)
            source.tell()
            while rss is not None and time.monotonic() < began + seconds - RSS_PERIOD:
                rss.append(carried.rss())
                time.sleep(RSS_PERIOD)
            sent = json.loads(source.listen())["sent"]
            took, busy = time.monotonic() - began, carried.cpu() - before
            theirs = sum(receiver.cpu() for receiver in receivers) - theirs
            time.sleep(1.0)
            said = [receiver.ask() for receiver in receivers]
            carried_messages = min(sent, said[0]["count"] // counts[0])
            resident = carried.rss()
    return row(
        STOCK if stock else f"bridge, {flood:,}/s from a guest" if flood else "bridge",
        robots,
        rate,
        sent,
        said,
        subscribers,
        Used(busy / took, theirs / took, busy / max(carried_messages, 1), resident),
    )


def options(robots: int, rate: float, seconds: float) -> tuple[object, ...]:
    return ("--robots", robots, "--rate", rate, "--seconds", seconds)


def row(
    way: str,
    robots: int,
    rate: float,
    sent: int,
    said: list[dict[str, Any]],
    subscribers: int,
    used: Used | None,
) -> dict[str, Any]:
    """Return one line of the table."""
    received = sum(each["count"] for each in said)
    nothing = [float("nan")] * 4
    age = said[0].get("age", nothing)
    used_by = used or Used(*nothing)
    stamped = used is not None and way != STOCK
    return {
        "way": way,
        "robots": robots,
        "Hz": f"{rate:g}" if rate else "flat out",
        "subscr.": subscribers,
        "sent": sent,
        "lost, %": 100 * (1 - received / (sent * subscribers)),
        "age p50, ms": age[0],
        "p95": age[1],
        "p99": age[2],
        "max": age[3],
        "to bridge p50": said[0].get("before_bridged", nothing)[0] if stamped else float("nan"),
        "from it p50": said[0].get("after_bridged", nothing)[0] if stamped else float("nan"),
        "bridge CPU, %": 100 * used_by.bridge,
        "us/msg": 1e6 * used_by.message,
        "RSS, MB": used_by.rss,
        "subscr. CPU, %": 100 * used_by.subscribers,
    }


def soak(minutes: float, robots: int, subscribers: int) -> dict[str, Any]:
    """Carry for `minutes`; tell by how much the bridge's memory has grown."""
    rss: list[float] = []
    figures = bridged(robots, 100.0, 60 * minutes, subscribers, rss)
    # The first fifth fills caches; from there a line is fitted.
    steady = rss[len(rss) // 5 :]
    hours = np.arange(len(steady)) * RSS_PERIOD / 3600
    slope = float(np.polyfit(hours, steady, 1)[0]) if len(steady) > 2 else float("nan")
    return {
        "minutes": minutes,
        "subscribers": subscribers,
        "lost, %": figures["lost, %"],
        "age p50, ms": figures["age p50, ms"],
        "p99": figures["p99"],
        "bridge CPU, %": figures["bridge CPU, %"],
        "RSS begin, MB": steady[0] if steady else float("nan"),
        "RSS end": steady[-1] if steady else float("nan"),
        "RSS max": max(rss, default=float("nan")),
        "growth, MB/h": slope,
    }


def main() -> None:
    parser = report.options(__doc__.splitlines()[0])
    parser.add_argument("--subscribers", type=int, default=50, help="of the test with many")
    parser.add_argument("--robots", type=int, default=13, help="of the test with many")
    parser.add_argument("--soak", type=float, metavar="MINUTES", help="only this, with many")
    parser.add_argument("--stock", metavar="PATH", help="zenoh-bridge-ros2dds, measured beside")
    arguments = parser.parse_args()
    stock = [shutil.which(arguments.stock)] if arguments.stock else []
    if None in stock:
        parser.error(f"{arguments.stock} is no executable; expected zenoh-bridge-ros2dds")
    if arguments.soak:
        rows = [soak(arguments.soak, arguments.robots, arguments.subscribers)]
        report.show("The bridge over time", rows, arguments.json)
        return
    seconds = report.scaled(arguments, 0.5, 4.0, 30.0)

    def bridges(robots: int, rate: float) -> list[dict[str, Any]]:
        return [bridged(robots, rate, seconds, stock=each or "") for each in ("", *stock)]

    if arguments.touch:
        rows = [alone("DDS", 1, 100.0, seconds), alone("zenoh", 1, 100.0, seconds)]
        report.show("Joint states, to see that it runs", [*rows, *bridges(1, 100.0)], None)
        return
    rows = [
        alone("DDS", 13, 100.0, seconds),
        alone("zenoh", 13, 100.0, seconds),
        *bridges(1, 100.0),
        *bridges(13, 100.0),
        bridged(13, 100.0, seconds, flood=FLOOD),
        *bridges(50, 100.0),
        *bridges(1, 0.0),
    ]
    report.show("Joint states from a stamp to a subscriber's callback", rows, arguments.json)
    rows = [
        bridged(arguments.robots, 100.0, seconds, count) for count in (1, arguments.subscribers)
    ]
    report.show("With many subscribers, ten a process", rows, arguments.json)


if __name__ == "__main__":
    main()
