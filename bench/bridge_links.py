"""What becomes of motion on a link that is slow, loses packets, or breaks and comes back.

The lab and a client are in network namespaces of their own. Between them packets pass through
this program, which delays and loses them as it is told, both ways. It needs Linux, the right to
make namespaces and /dev/net/tun; where it has not, it says so and measures nothing.
"""

from __future__ import annotations

import fcntl
import os
import random
import shutil
import signal
import struct
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import bridge
import report

# Documentation's own addresses (RFC 5737); they are within the namespaces only.
LAB, CLIENT = "192.0.2.1", "192.0.2.2"
PORT = 7447
TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
# A token each: the bridge, its two reports and every robot's motion.
TOKENS = 3
PATIENCE = 30.0


class Wire:
    """Two TUN devices and what lies between them."""

    def __init__(self, lab: int, client: int) -> None:
        self.delay = 0.0
        self.loss = 0.0
        self.broken = False
        self._stopped = False
        for one, other in ((lab, client), (client, lab)):
            way: deque[tuple[float, bytes]] = deque()
            arrived = threading.Condition()
            for target in (self._read, self._write):
                threading.Thread(
                    target=target,
                    args=(one if target == self._read else other, way, arrived),
                    daemon=True,
                ).start()

    def stop(self) -> None:
        self._stopped = True

    def _read(self, device: int, way: deque[Any], arrived: threading.Condition) -> None:
        while not self._stopped:
            packet = os.read(device, 65536)
            if self.broken or random.random() < self.loss:
                continue
            with arrived:
                way.append((time.monotonic() + self.delay, packet))
                arrived.notify()

    def _write(self, device: int, way: deque[Any], arrived: threading.Condition) -> None:
        while not self._stopped:
            with arrived:
                while not way:
                    arrived.wait()
                due, packet = way.popleft()
            time.sleep(max(0.0, due - time.monotonic()))
            if not self.broken:
                os.write(device, packet)


def ip(*arguments: str) -> None:
    subprocess.run(["ip", *arguments], check=True, capture_output=True)


@contextmanager
def namespace(name: str, address: str) -> Iterator[int]:
    """Make a namespace with one TUN device; yield the device's other end."""
    ip("netns", "add", name)
    try:
        device = os.open("/dev/net/tun", os.O_RDWR)
        link = f"tun{os.getpid() % 10_000}{address[-1]}"
        fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH", link.encode(), IFF_TUN | IFF_NO_PI))
        ip("link", "set", link, "netns", name)
        ip("-n", name, "address", "add", f"{address}/24", "dev", link)
        ip("-n", name, "link", "set", link, "up")
        ip("-n", name, "link", "set", "lo", "up")
        yield device
    finally:
        ip("netns", "del", name)


@contextmanager
def lab(stack: ExitStack, robots: int) -> Iterator[tuple[Wire, bridge.Process, bridge.Process]]:
    """Run bridge and source in one namespace, a witness in the other."""
    here, there = f"mrlab_lab_{os.getpid()}", f"mrlab_client_{os.getpid()}"
    wire = Wire(
        stack.enter_context(namespace(here, LAB)), stack.enter_context(namespace(there, CLIENT))
    )
    endpoint = f"tcp/{LAB}:{PORT}"
    inside, outside = (("ip", "netns", "exec", name) for name in (here, there))
    arguments = f"--log-level error -p listen:=['{endpoint}'] -p insecure:=true".split()
    carried = subprocess.Popen(
        [
            *inside,
            sys.executable,
            "-m",
            "mrlab_ros.processes.host",
            "bridge",
            "--ros-args",
            *arguments,
        ],
        env=bridge.environment(),
        stdout=subprocess.DEVNULL,
    )
    stack.callback(stop, carried)
    # Ends by the benchmark's own end.
    source = bridge.Process("source", *bridge.options(robots, 100.0, 3600.0), within=inside)
    stack.callback(source.end)
    # The bridge takes from the graph what somebody wants.
    witness = bridge.Process("witness", endpoint, within=outside)
    stack.callback(witness.end)
    witness.listen()
    source.listen()
    source.tell()
    yield wire, source, witness
    wire.stop()


def stop(process: subprocess.Popen[bytes]) -> None:
    process.send_signal(signal.SIGINT)
    try:
        process.wait(5)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def quality(
    wire: Wire, witness: bridge.Process, robots: int, delay: float, loss: float, seconds: float
) -> dict[str, Any]:
    """Measure motion over a link with `delay`, s, and `loss`, 0 to 1, each way."""
    wire.delay, wire.loss = delay, loss
    time.sleep(3.0)
    witness.ask()
    time.sleep(seconds)
    said = witness.ask()
    wire.delay, wire.loss = 0.0, 0.0
    return {
        "robots": robots,
        "delay, ms": 1000 * delay,
        "packet loss, %": 100 * loss,
        "messages/s": said["count"] / seconds,
        "left out, %": 100 * said["lost"] / max(said["lost"] + said["count"], 1),
        "age p50, ms": said["age"][0],
        "p95": said["age"][1],
        "p99": said["age"][2],
        "max": said["age"][3],
    }


def outage(
    wire: Wire, witness: bridge.Process, robots: int, seconds: float, delay: float, loss: float
) -> dict[str, Any]:
    """Break the link for `seconds`; measure how soon after that motion arrives again."""
    wire.delay, wire.loss = delay, loss
    time.sleep(1.0)
    wire.broken = True
    # What is under way arrives no more.
    time.sleep(0.2)
    witness.ask()
    time.sleep(max(0.0, seconds - 0.2))
    gone = witness.ask()["gone"]
    back = time.time_ns()
    wire.broken = False
    first, tokens, healed = None, 0, float("nan")
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline and (first is None or tokens < robots + TOKENS):
        time.sleep(0.05)
        said = witness.ask()
        first, tokens = first or said["first"], said["tokens"]
        gone += said["gone"]
    if first is not None:
        healed = (first - back) / 1e9
    wire.delay, wire.loss = 0.0, 0.0
    time.sleep(1.0)
    return {
        "broken for, s": seconds,
        "delay, ms": 1000 * delay,
        "packet loss, %": 100 * loss,
        "motion again after, s": healed,
        "tokens that vanished": gone,
        "tokens now": tokens,
        "tokens expected": robots + TOKENS,
    }


def why_not() -> str:
    """Return why nothing can be measured here; empty: it can."""
    if not sys.platform.startswith("linux") or not shutil.which("ip"):
        return "it needs Linux and the command ip (package iproute2)"
    if os.geteuid() != 0 or not Path("/dev/net/tun").exists():
        return "it needs root's rights and /dev/net/tun to make network namespaces"
    return ""


def main() -> None:
    parser = report.options(__doc__.splitlines()[0])
    arguments = parser.parse_args()
    reason = why_not()
    if reason:
        print(f"bridge_links: nothing measured; {reason}")
        return
    seconds = report.scaled(arguments, 0.5, 4.0, 20.0)
    qualities, outages = [], []
    for robots in report.some(arguments, (2, 13)):
        with ExitStack() as stack:
            wire, _, witness = stack.enter_context(lab(stack, robots))
            links = report.some(arguments, ((0.0, 0.0), (0.05, 0.0), (0.05, 0.1)))
            for delay, loss in links:
                qualities.append(quality(wire, witness, robots, delay, loss, seconds))
            if robots != 2:
                continue
            lengths = report.scaled(arguments, (0.5,), (0.5, 5.0), (0.5, 2.0, 5.0, 30.0))
            for length in lengths:
                outages.append(outage(wire, witness, robots, length, 0.0, 0.0))
            if not arguments.touch:
                outages.append(outage(wire, witness, robots, 5.0, 0.05, 0.1))
    report.show("Motion at 100 Hz over a bad link", qualities, arguments.json)
    report.show("A link that breaks and comes back", outages, arguments.json)


if __name__ == "__main__":
    main()
