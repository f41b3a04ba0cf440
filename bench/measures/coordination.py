"""Robot systems: how far apart members start, and how fast they pause, stage and spawn.

Real nodes and services: the lab and the coordinator in one process, the playback host in this
one, where the instants of sending are taken. Marks: start skew p99 < 1 ms, pause to last frame
p99 < 15 ms, staging < 200 ms, spawn to first joint state < 1 s.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import report
from lab import MODEL, Lab, catalogue, running, sine
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from partner import in_process, until
from size import Size

from mrlab_ros.messages import qos
from mrlab_ros.nodes.playback.host import PlaybackHostNode
from mrlab_ros.ros.spinning import SpunNode

NEEDS = ()
# Joint states that are compared after a start.
COMPARED = 20


class Members:
    """Robots that a host of this process plays, and when each joint state of them left, ns."""

    def __init__(self, lab: Lab, host: PlaybackHostNode) -> None:
        self._lab, self._host = lab, host
        self.sent: dict[str, list[int]] = {}

    def spawn(self, robot: str) -> float:
        """Spawn a robot; return how long that took to its first joint state, s."""
        begin = time.monotonic()
        self._lab.ask(srv.SpawnRobot, "/lab/spawn_robot", model=MODEL, name=robot, automatic=True)
        until(lambda: robot in self._host.nodes, "the playback node")
        player = self._host.nodes[robot].player
        until(lambda: player.last, "a joint state")
        took, times, send = time.monotonic() - begin, self.sent.setdefault(robot, []), player._send

        def timed(sample: Any) -> None:
            send(sample)
            if sample.streamed:
                times.append(time.monotonic_ns())

        player._send = timed
        return took

    def forget(self) -> None:
        for times in self.sent.values():
            times.clear()

    def skews(self) -> list[float]:
        """Return how far apart the first joint states of a start left, ms each."""
        until(lambda: all(len(t) > COMPARED for t in self.sent.values()), "joint states")
        first = np.array([times[:COMPARED] for times in self.sent.values()])
        return list(np.ptp(first, axis=0) * 1e-6)

    def last_ns(self) -> int:
        return max(times[-1] for times in self.sent.values())


def measured(count: int, rounds: int) -> dict[str, Any]:
    """Measure a system of `count` robots over `rounds` starts and pauses."""
    with tempfile.TemporaryDirectory() as name:
        catalogue(Path(name), [sine("sine", 2001)])
        # Without an id: the host of this process has none either.
        with running(Path(name), ("lab",), lab_id="") as lab:
            host = PlaybackHostNode()
            spun = SpunNode(host)
            try:
                return started(lab, Members(lab, host), count, rounds)
            finally:
                spun.close()


def started(lab: Lab, members: Members, count: int, rounds: int) -> dict[str, Any]:
    systems = lab.heard(msg.RobotSystems, "/systems", qos.LATCHED_EVENTS)
    robots = [f"robot_{i}" for i in range(count)]
    spawns = [members.spawn(robot) for robot in robots]
    lab.create_system([msg.SystemMember(robot=robot, trajectory_id="sine") for robot in robots])
    # The first call of a service also finds it, which is not measured.
    for order in ("play", "pause"):
        lab.ask(Trigger, f"/cell/{order}")
    skews, pauses, stagings = [], [], []
    for _ in range(rounds):
        lab.ask(Trigger, "/cell/stop")
        members.forget()
        stagings.append(lab.ms(Trigger, "/cell/play"))
        skews += members.skews()
        begin_ns = time.monotonic_ns()
        lab.ask(Trigger, "/cell/pause")
        pauses.append(max(0, members.last_ns() - begin_ns) * 1e-6)
        until(lambda: systems[-1].systems[0].label == "PAUSED", "the pause")
    skew, pause = report.percentiles(skews), report.percentiles(pauses)
    return {
        "members": count,
        "skew p50 ms": skew["p50 ms"],
        "skew p99 ms": skew["p99 ms"],
        "pause p50 ms": pause["p50 ms"],
        "pause p99 ms": pause["p99 ms"],
        "staging max ms": max(stagings),
        "spawn max ms": max(spawns) * 1e3,
    }


def systems(size: Size) -> list[dict[str, Any]]:
    rounds = size.of(1, 5, 40)
    return [in_process(measured, count, rounds) for count in size.some((2, 13, 50))]


TABLES = {"Coordination": systems}
