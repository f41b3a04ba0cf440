"""Follows joint states and the lab's tokens over a link that breaks, for the bridge's benchmark.

Says "ready" when motion arrives; at each line on stdin says as JSON what came since the last one.
"""

from __future__ import annotations

import json
import struct
import sys
import threading
import time
from typing import Any

import numpy as np
import zenoh

STAMPS = struct.Struct("<qqq")


class Witness:
    """What came since it was last asked."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self.there: set[str] = set()
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

    def note(self, sample: zenoh.Sample) -> None:
        with self._lock:
            if sample.kind == zenoh.SampleKind.PUT:
                self.there.add(str(sample.key_expr))
            else:
                self.there.discard(str(sample.key_expr))
                self._gone += 1

    def report(self) -> dict[str, Any]:
        with self._lock:
            ages = self._ages or [float("nan")]
            said = {
                "count": len(self._ages),
                "lost": self._lost,
                "first": self._first,
                "tokens": len(self.there),
                "gone": self._gone,
                "age": np.percentile(ages, [50, 95, 99, 100]).tolist(),
            }
            self._forget()
        return said


def main() -> None:
    config = zenoh.Config()
    config.insert_json5("mode", '"client"')
    config.insert_json5("connect/endpoints", json.dumps([sys.argv[1]]))
    config.insert_json5("scouting/multicast/enabled", "false")
    config.insert_json5("transport/link/tx/lease", "1500")
    config.insert_json5("transport/unicast/open_timeout", "2000")
    config.insert_json5(
        "connect/retry",
        json.dumps({"period_init_ms": 250, "period_max_ms": 500, "period_increase_factor": 1.5}),
    )
    # The bridge may begin to listen after this.
    config.insert_json5("connect/timeout_ms", "30000")
    witness = Witness()
    with zenoh.open(config) as session:
        session.declare_subscriber("*/joint_states", witness.move)
        session.liveliness().declare_subscriber("@/*/@ros2_lv/**", witness.note, history=True)
        print("ready", flush=True)
        while sys.stdin.readline():
            print(json.dumps(witness.report()), flush=True)


if __name__ == "__main__":
    main()
