#!/usr/bin/env python3
"""Measures how long the lab's messages take to this machine, and reports it to the lab.

    python mrlab_latency.py --name my_laptop
    python mrlab_latency.py '*/joint_states' contacts

Once a second it prints the delays and sends them on latency/clients; `mrlab status` shows them
and a recording keeps them. The bridge attaches to every message its sequence number, when it was
published in the graph and when the bridge put it. This machine's clock is compared with the
bridge's by asking the bridge for the time.
"""

from __future__ import annotations

import argparse
import socket
import struct
import sys
import threading
import time
from collections import defaultdict, deque
from pathlib import Path
from typing import Any

import zenoh
from mrlab_client import connect, schema, typestore
from rosbags.typesys.store import Typestore

LATENCY = "mrlab_msgs/msg/Latency"
HOP = "mrlab_msgs/msg/LatencyHop"
ATTACHMENT = struct.Struct("<qqq")  # sequence, published ns, bridged ns
CLOCK = struct.Struct("<qq")  # asked ns, answered ns, both by the bridge's clock
SECOND = 1_000_000_000
PERIOD = 1.0


class Clock:
    """The bridge's clock, as it is known from questions and answers (RFC 5905, section 8)."""

    def __init__(self, session: zenoh.Session, key: str) -> None:
        self._session = session
        self._key = key
        # Round trip and offset of the last exchanges, ns; the quickest is the best.
        self._exchanges: deque[tuple[int, int]] = deque(maxlen=20)

    def ask(self) -> None:
        """Ask for the time once; without an answer nothing changes."""
        sent = time.time_ns()
        for reply in self._session.get(self._key, timeout=2.0):
            if reply.ok is not None:
                received = time.time_ns()
                asked, answered = CLOCK.unpack_from(reply.ok.payload.to_bytes())
                offset = (asked - sent + answered - received) // 2
                self._exchanges.append((received - sent - (answered - asked), offset))

    @property
    def known(self) -> bool:
        return bool(self._exchanges)

    @property
    def offset_ns(self) -> int:
        """What to add to this machine's time to have the bridge's."""
        return min(self._exchanges)[1]

    @property
    def error_ns(self) -> int:
        """How wrong the offset can be: half of the round trip."""
        return min(self._exchanges)[0] // 2


class Arrivals:
    """What arrived since the last report."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._began = time.time_ns()
        self._seen: dict[str, int] = {}
        self._stamps: dict[str, list[tuple[int, int, int]]] = defaultdict(list)
        self._lost: dict[str, int] = defaultdict(int)

    def note(self, sample: zenoh.Sample) -> None:
        received = time.time_ns()
        key = str(sample.key_expr)
        if sample.attachment is None or len(sample.attachment) < ATTACHMENT.size:
            return
        sequence, published, bridged = ATTACHMENT.unpack_from(sample.attachment.to_bytes())
        with self._lock:
            before = self._seen.get(key, sequence - 1)
            self._seen[key] = sequence
            # A smaller number: the bridge was started again.
            self._lost[key] += max(0, sequence - before - 1)
            self._stamps[key].append((published, bridged, received))

    def take(self, offset_ns: int) -> tuple[dict[str, list[tuple[int, int, int]]], dict[str, int]]:
        """Return by key (published, bridged, received), bridge's ns, and how many were lost.

        A message from before this program began, of a latched topic, is left out.
        """
        with self._lock:
            stamps, self._stamps = self._stamps, defaultdict(list)
            lost, self._lost = self._lost, defaultdict(int)
        began = self._began + offset_ns
        moved = {
            key: [(p, b, r + offset_ns) for p, b, r in rows if b >= began]
            for key, rows in stamps.items()
        }
        return {key: rows for key, rows in moved.items() if rows}, lost


def hops(
    store: Typestore, moved: dict[str, list[tuple[int, int, int]]], prefix: str
) -> list[tuple[Any, str]]:
    """Return a LatencyHop and what to call it: of all keys first, then of each key."""
    kind: Any = store.types[HOP]
    ways = (
        (kind.BRIDGED_TO_RECEIVED, "bridge to here", lambda row: row[2] - row[1]),
        (kind.PUBLISHED_TO_RECEIVED, "graph to here", lambda row: row[2] - row[0]),
    )
    everything = [row for rows in moved.values() for row in rows]
    found = []
    for key, rows in [("", everything), *sorted(moved.items())] if moved else []:
        for hop, name, delay in ways:
            delays = sorted(map(delay, rows))
            p50, p95, largest = (
                delays[min(int(len(delays) * level), len(delays) - 1)] / SECOND
                for level in (0.5, 0.95, 1.0)
            )
            topic = f"/{key.removeprefix(prefix)}" if key else ""
            found.append(
                (
                    kind(hop=hop, topic=topic, count=len(rows), p50=p50, p95=p95, max=largest),
                    name,
                )
            )
    return found


def report(store: Typestore, observer: str, clock: Clock, window: float, measured: Any) -> bytes:
    """Return the CDR of a Latency message."""
    now = time.time_ns() + clock.offset_ns
    stamp = store.types["builtin_interfaces/msg/Time"](sec=now // SECOND, nanosec=now % SECOND)
    message = store.types[LATENCY](
        header=store.types["std_msgs/msg/Header"](stamp=stamp, frame_id=""),
        observer=observer,
        window=window,
        clock_error=clock.error_ns / SECOND,
        hops=[hop for hop, _ in measured],
    )
    return bytes(store.serialize_cdr(message, LATENCY))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("keys", nargs="*", default=["*/joint_states"])
    parser.add_argument("--name", default=socket.gethostname(), help="what the lab calls this")
    parser.add_argument("--prefix", default="", help="of the lab's keys, such as lab_1")
    parser.add_argument("--connect", default="", help="endpoint of the lab")
    parser.add_argument("--config", type=Path, help="file for a lab with keys: NAME.json5")
    parser.add_argument("--count", type=int, default=0, help="reports to send; 0: no end")
    arguments = parser.parse_args()
    prefix = f"{arguments.prefix}/" if arguments.prefix else ""
    with connect(arguments.connect, arguments.config) as session:
        store = typestore(*schema(session, prefix))
        clock = Clock(session, f"{prefix}@mrlab/bridge/clock")
        arrivals = Arrivals()
        for key in arguments.keys:
            session.declare_subscriber(f"{prefix}{key}", arrivals.note)
        reports = session.declare_publisher(f"{prefix}latency/clients")
        sent, began = 0, time.monotonic()
        while not arguments.count or sent < arguments.count:
            time.sleep(max(0.0, began + PERIOD - time.monotonic()))
            now = time.monotonic()
            window, began = now - began, now
            clock.ask()
            if not clock.known:
                print(
                    "the bridge has no clock service: is it the stock one?",
                    file=sys.stderr,
                )
                continue
            moved, lost = arrivals.take(clock.offset_ns)
            measured = hops(store, moved, prefix)
            for hop, name in measured:
                print(
                    f"{hop.topic or 'all':<30} {name:<15} {hop.count:6} messages, "
                    f"p50 {1e3 * hop.p50:.3f}, p95 {1e3 * hop.p95:.3f}, "
                    f"max {1e3 * hop.max:.3f} ms",
                    flush=True,
                )
            print(
                f"clock: {clock.offset_ns / 1e6:+.3f} ms, known to {clock.error_ns / 1e6:.3f} ms; "
                f"lost: {sum(lost.values())}",
                flush=True,
            )
            reports.put(report(store, arguments.name, clock, window, measured))
            sent += 1
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(0)
