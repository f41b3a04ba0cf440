"""What the bridge adds, what it carries, and what becomes of motion on a bad link.

Joint states of six joints go from a source process over the bridge to zenoh subscribers in
processes of their own; "direct": the source puts them on zenoh itself, by the bridge's socket, as
a playback does. The baselines are its two halves alone: DDS from the source to a
subscriber, and zenoh from the source to a subscriber; with --stock also `zenoh-bridge-ros2dds`,
whose messages have no stamps, so that the parts of its way have no figures. Age: from the stamp,
just before publishing, to the subscriber's callback. "flat out" publishes as fast as one process
can.

Bad links: lab and client are in network namespaces of their own; between them packets pass through
this program, which delays and loses them both ways. That needs Linux and root's rights.
"""

from __future__ import annotations

import fcntl
import json
import os
import random
import shutil
import struct
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import psutil
import zenoh
from partner import HOST, LeftOut, Partner, await_listener, cpu_s, free_endpoint, program, until
from partners.bridge import flood, over_dds, over_zenoh, source, witness
from partners.zenoh_client import client_config
from size import Size

NEEDS = ()
RATE = 100.0
# Subscribers that one process holds, and those of the question with many.
SESSIONS, MANY = 10, 50
# Messages a second of a guest who floods a key.
FLOOD = 17_000
RSS_PERIOD_S = 5.0
NOTHING = [np.nan] * 4
# Documentation's own addresses (RFC 5737); they are within the namespaces only.
LAB, CLIENT, PORT = "192.0.2.1", "192.0.2.2", 7447
TUNSETIFF, IFF_TUN, IFF_NO_PI = 0x400454CA, 0x0001, 0x1000
# Of liveliness: the bridge, its two reports and every robot's motion.
TOKENS = 3
HEALED_S = 30.0


@contextmanager
def bridge(stock: str = "", socket: str = "") -> Iterator[tuple[str, psutil.Popen]]:
    """Run a bridge; yield its endpoint and process. stock: the executable of the stock one."""
    endpoint = free_endpoint()
    parameters = ("-p", f"listen:=['{endpoint}']", "-p", f"socket:='{socket}'")
    ours = (*HOST, "bridge", "--ros-args", "--log-level", "error", *parameters)
    command = (stock, "--no-multicast-scouting", "-l", endpoint) if stock else ours
    environment = os.environ | {"ROS_DISTRO": "jazzy"}
    with program(*command, env=environment, stdout=subprocess.DEVNULL) as process:
        await_listener(endpoint)
        yield endpoint, process


def heard(endpoint: str) -> int:
    """Return how many of the bridge's topics of joint states somebody subscribes to."""
    with zenoh.open(client_config(endpoint)) as session:
        for reply in session.get("@mrlab/bridge/statistics"):
            if reply.ok is not None:
                keys = json.loads(reply.ok.payload.to_string())["keys"]
                return sum(k.get("heard", False) for n, k in keys.items() if "joint" in n)
    return 0


@dataclass(frozen=True)
class Journey:
    """Messages of robots on their way to subscribers. rate: Hz, 0: flat out."""

    way: str
    robots: int
    rate: float
    sent: int
    said: list[dict[str, Any]]
    subscribers: int = 1

    def row(self, bridge: dict[str, float], *, parts: bool = True) -> dict[str, Any]:
        """Return the figures; bridge: those of its process; parts: the way is stamped within."""
        received = sum(each["count"] for each in self.said)
        first = self.said[0]
        age = first.get("age", NOTHING)
        return {
            "way": self.way,
            "robots": self.robots,
            "Hz": f"{self.rate:g}" if self.rate else "flat out",
            "subscr.": self.subscribers,
            "sent": self.sent,
            "lost %": 100 * (1 - received / (self.sent * self.subscribers)),
            **dict(zip(("age p50 ms", "p95 ms", "p99 ms", "max ms"), age, strict=True)),
            "to bridge p50 ms": first.get("before", NOTHING)[0] if parts else np.nan,
            "from it p50 ms": first.get("after", NOTHING)[0] if parts else np.nan,
            **{key: bridge.get(key, np.nan) for key in COSTS},
        }


COSTS = ("bridge CPU %", "us/message", "RSS MB", "source CPU %", "subscr. CPU %")


def alone(way: str, robots: int, seconds: float) -> dict[str, Any]:
    """Measure one half of the way without the bridge."""
    with ExitStack() as stack:
        if way == "zenoh":
            endpoint = free_endpoint()
            sender = stack.enter_context(Partner(source, robots, RATE, seconds, endpoint))
            # The source listens, so that subscribers of both kinds connect to the same side.
            await_listener(endpoint)
            receiver = stack.enter_context(Partner(over_zenoh, endpoint))
        else:
            sender = stack.enter_context(Partner(source, robots, RATE, seconds))
            receiver = stack.enter_context(Partner(over_dds, robots))
        receiver.receive()
        sender.receive()
        sent = sender.ask()
        # What is still under way; a stream that arrives later than that has failed.
        time.sleep(min(1.0, seconds))
        journey = Journey(f"{way} alone", robots, RATE, sent, [receiver.ask()])
    return journey.row({}, parts=False)


def bridged(
    robots: int,
    rate: float,
    seconds: float,
    subscribers: int = 1,
    *,
    memory: list[float] | None = None,
    guest: int = 0,
    stock: str = "",
    direct: bool = False,
) -> dict[str, Any]:
    """Measure the whole way; `memory` collects the bridge's, MB, meanwhile.

    guest: messages a second that a guest sends all the time on a key that comes in. stock: the
    executable of the stock bridge, in place of ours. direct: the source puts them on zenoh itself.
    """
    with ExitStack() as stack:
        folder = stack.enter_context(TemporaryDirectory())
        socket = f"{folder}/bridge.sock" if direct else ""
        endpoint, carrier = stack.enter_context(bridge(stock, socket))
        counts = [SESSIONS] * (subscribers // SESSIONS)
        counts += [subscribers % SESSIONS] if subscribers % SESSIONS else []
        sender = stack.enter_context(Partner(source, robots, rate, seconds, "", "", socket))
        receivers = [stack.enter_context(Partner(over_zenoh, endpoint, n)) for n in counts]
        if guest:
            stack.enter_context(Partner(flood, endpoint, guest))
        for partner in (*receivers, sender):
            partner.receive()
        # The source is ready once each topic has a subscription, which is the stock bridge's.
        if not stock:
            until(lambda: heard(endpoint) == robots, "the bridge to hear of subscribers")

        def used() -> tuple[float, float, float]:
            theirs = sum(cpu_s(receiver.pid) for receiver in receivers)
            return time.monotonic(), cpu_s(carrier), cpu_s(sender.pid), theirs

        before = used()
        sender.send()
        while memory is not None and time.monotonic() < before[0] + seconds - RSS_PERIOD_S:
            memory.append(carrier.memory_info().rss / 1e6)
            time.sleep(RSS_PERIOD_S)
        sent = sender.receive(seconds + 60.0)
        took, busy, source_s, theirs = (
            now - then for now, then in zip(used(), before, strict=True)
        )
        time.sleep(1.0)
        said = [receiver.ask() for receiver in receivers]
        carried = max(1, min(sent, said[0]["count"] // counts[0]))
        costs = (100 * busy / took, 1e6 * busy / carried, carrier.memory_info().rss / 1e6)
        figures = dict(
            zip(COSTS, (*costs, 100 * source_s / took, 100 * theirs / took), strict=True)
        )
    way = "stock bridge" if stock else "direct" if direct else "bridge"
    way += f", {guest:,}/s from a guest" if guest else ""
    journey = Journey(way, robots, rate, sent, said, subscribers)
    return journey.row(figures, parts=not stock)


def journeys(size: Size) -> list[dict[str, Any]]:
    seconds = size.of(0.5, 4.0, 30.0)
    robots = size.of(1, 13, 13)

    def bridges(robots: int, rate: float) -> list[dict[str, Any]]:
        stocks = ("", size.stock) if size.stock else ("",)
        return [
            *(bridged(robots, rate, seconds, stock=stock) for stock in stocks),
            bridged(robots, rate, seconds, direct=True),
        ]

    rows = [alone("DDS", robots, seconds), alone("zenoh", robots, seconds), *bridges(1, RATE)]
    if size.name == "touch":
        return rows
    return [
        *rows,
        *bridges(13, RATE),
        bridged(13, RATE, seconds, guest=FLOOD),
        *bridges(50, RATE),
        *bridges(1, 0.0),
    ]


def many(size: Size) -> list[dict[str, Any]]:
    robots, seconds = size.of(1, 13, 13), size.of(0.5, 4.0, 30.0)
    ways = [(count, direct) for count in size.some((1, MANY)) for direct in (False, True)]
    return [bridged(robots, RATE, seconds, count, direct=direct) for count, direct in ways]


def soak(size: Size) -> list[dict[str, Any]]:
    """Carry for `size.soak` minutes; tell by how much the bridge's memory has grown."""
    memory: list[float] = []
    figures = bridged(13, RATE, 60 * size.soak, MANY, memory=memory)
    # The first fifth fills caches; from there a line is fitted.
    steady = memory[len(memory) // 5 :] or [np.nan]
    hours = np.arange(len(steady)) * RSS_PERIOD_S / 3600
    slope = float(np.polyfit(hours, steady, 1)[0]) if len(steady) > 2 else np.nan
    kept = ("subscr.", "lost %", "age p50 ms", "p99 ms", "bridge CPU %")
    return [
        {
            "minutes": size.soak,
            **{key: figures[key] for key in kept},
            "RSS begin MB": steady[0],
            "RSS end MB": steady[-1],
            "RSS max MB": max(memory, default=np.nan),
            "growth MB/h": slope,
        }
    ]


class Wire:
    """Two TUN devices and what lies between them. delay: s; loss: 0 to 1, each way."""

    def __init__(self, lab: int, client: int) -> None:
        self.delay = 0.0
        self.loss = 0.0
        self.broken = False
        for one, other in ((lab, client), (client, lab)):
            way: deque[tuple[float, bytes]] = deque()
            arrived = threading.Condition()
            for work, device in ((self._read, one), (self._write, other)):
                threading.Thread(target=work, args=(device, way, arrived), daemon=True).start()

    def _read(self, device: int, way: deque[Any], arrived: threading.Condition) -> None:
        # A device ends with its namespace.
        with suppress(OSError):
            while True:
                packet = os.read(device, 65536)
                if self.broken or random.random() < self.loss:
                    continue
                with arrived:
                    way.append((time.monotonic() + self.delay, packet))
                    arrived.notify()

    def _write(self, device: int, way: deque[Any], arrived: threading.Condition) -> None:
        with suppress(OSError):
            while True:
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


class Link:
    """A bridge and a source in one namespace, a witness in the other, a wire between."""

    def __init__(self, stack: ExitStack, robots: int) -> None:
        if not sys.platform.startswith("linux") or not shutil.which("ip"):
            raise LeftOut("it needs Linux and the command ip (package iproute2)")
        if os.geteuid() != 0 or not Path("/dev/net/tun").exists():
            raise LeftOut("it needs root's rights and /dev/net/tun to make network namespaces")
        here, there = f"mrlab_lab_{os.getpid()}", f"mrlab_client_{os.getpid()}"
        self.robots = robots
        self.wire = Wire(
            stack.enter_context(namespace(here, LAB)),
            stack.enter_context(namespace(there, CLIENT)),
        )
        endpoint = f"tcp/{LAB}:{PORT}"
        options = f"--ros-args --log-level error -p listen:=['{endpoint}'] -p insecure:=true"
        command = ("ip", "netns", "exec", here, *HOST, "bridge", *options.split())
        stack.enter_context(program(*command, stdout=subprocess.DEVNULL))
        sender = stack.enter_context(Partner(source, robots, RATE, 3600.0, "", here))
        # The bridge takes from the graph what somebody wants.
        self._witness = stack.enter_context(Partner(witness, endpoint, there))
        self._witness.receive()
        sender.receive()
        sender.send()

    def came(self) -> dict[str, Any]:
        """Return what has come since this was called last."""
        found: dict[str, Any] = self._witness.ask("ask")
        return found

    def make(self, delay: float, loss: float, settle: float) -> None:
        self.wire.delay, self.wire.loss = delay, loss
        time.sleep(settle)

    def quality(self, delay: float, loss: float, seconds: float) -> dict[str, Any]:
        """Measure motion over a link with `delay`, s, and `loss`, 0 to 1, each way."""
        self.make(delay, loss, 3.0)
        self.came()
        time.sleep(seconds)
        said = self.came()
        return {
            "robots": self.robots,
            "delay ms": 1000 * delay,
            "packet loss %": 100 * loss,
            "messages/s": said["count"] / seconds,
            "left out %": 100 * said["lost"] / max(said["lost"] + said["count"], 1),
            **dict(zip(("age p50 ms", "p95 ms", "p99 ms", "max ms"), said["age"], strict=True)),
        }

    def outage(self, seconds: float, delay: float, loss: float) -> dict[str, Any]:
        """Break the link for `seconds`; measure how soon after that motion arrives again."""
        self.make(delay, loss, 1.0)
        self.wire.broken = True
        # What is under way arrives no more.
        time.sleep(0.2)
        self.came()
        time.sleep(max(0.0, seconds - 0.2))
        gone, expected = self.came()["gone"], self.robots + TOKENS
        back, first, tokens = time.time_ns(), None, 0
        self.wire.broken = False
        end = time.monotonic() + HEALED_S
        while time.monotonic() < end and (first is None or tokens < expected):
            time.sleep(0.05)
            said = self.came()
            first, tokens, gone = first or said["first"], said["tokens"], gone + said["gone"]
        self.make(0.0, 0.0, 1.0)
        return {
            "broken for s": seconds,
            "delay ms": 1000 * delay,
            "packet loss %": 100 * loss,
            "motion again after s": np.nan if first is None else (first - back) / 1e9,
            "tokens that vanished": gone,
            "tokens now": tokens,
            "tokens expected": expected,
        }


def bad_links(size: Size) -> list[dict[str, Any]]:
    seconds, rows = size.of(0.5, 4.0, 20.0), []
    for robots in size.some((2, 13)):
        with ExitStack() as stack:
            link = Link(stack, robots)
            for delay, loss in size.some(((0.0, 0.0), (0.05, 0.0), (0.05, 0.1))):
                rows.append(link.quality(delay, loss, seconds))
    return rows


def outages(size: Size) -> list[dict[str, Any]]:
    lengths = size.of((0.5,), (0.5, 5.0), (0.5, 2.0, 5.0, 30.0))
    cases = [*((length, 0.0, 0.0) for length in lengths), (5.0, 0.05, 0.1)]
    with ExitStack() as stack:
        link = Link(stack, 2)
        return [link.outage(*case) for case in size.some(cases)]


TABLES = {
    "Joint states from a stamp to a subscriber's callback": journeys,
    "With many subscribers, ten a process": many,
    "Motion at 100 Hz over a bad link": bad_links,
    "A link that breaks and comes back": outages,
}
SOAKS = {"The bridge over time": soak}
