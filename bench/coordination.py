"""Robot systems: how far apart members start, how fast they pause, stage and spawn.

Real nodes and services: the lab and the coordinator in one process, the playback host in this
one, where the instants of sending are taken. Marks: start skew p99 < 1 ms, pause to last frame
p99 < 15 ms, staging computed < 200 ms, spawn to first joint state < 1 s.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import rclpy
import report
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from rclpy.node import Node

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories import npz_file
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory
from mrlab_ros.messages import qos
from mrlab_ros.nodes.playback.host import PlaybackHostNode
from mrlab_ros.ros import share
from mrlab_ros.ros.spinning import SpunNode

MODEL = "ur5e"
SECONDS = 20.0


def motion() -> Trajectory:
    model = RobotLibrary(share.directory() / "robots").model(MODEL)
    t = np.arange(round(100 * SECONDS) + 1) / 100
    positions = model.home + 0.2 * np.sin(t)[:, None] * np.ones(len(model.joints))
    zeros = np.zeros_like(positions)
    channels = Channels(zeros.copy(), zeros.copy())
    source = Source("sine.mat", "q", "0" * 64)
    return Trajectory(
        "sine", MODEL, None, model.joint_names, 100.0, positions, None, channels, source
    )


class Bench(Node):
    """Spawns robots, commands the system, notes who sent when."""

    def __init__(self) -> None:
        super().__init__("bench")
        self.systems: list[Any] = []
        self._asked: dict[str, Any] = {}
        self.create_subscription(
            msg.RobotSystems, "/systems", self.systems.append, qos.LATCHED_EVENTS
        )

    def ask(self, kind: Any, service: str, /, **fields: Any) -> Any:
        client = self._asked.get(service)
        if client is None:
            client = self._asked[service] = self.create_client(kind, service)
        if not client.wait_for_service(timeout_sec=20.0):
            raise SystemExit(f"nobody offers {service}")
        future = client.call_async(kind.Request(**fields))
        wait(future.done, f"an answer of {service}")
        answer = future.result()
        if not answer.success:
            raise SystemExit(f"{service}: {answer.message}")
        return answer

    def label(self) -> str:
        systems = self.systems[-1].systems if self.systems else []
        return str(systems[0].label) if systems else ""


def wait(condition: Callable[[], Any], what: str, timeout: float = 60.0) -> None:
    deadline = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > deadline:
            raise SystemExit(f"waited {timeout:g} s in vain for {what}")
        time.sleep(0.0005)


@contextlib.contextmanager
def lab() -> Iterator[None]:
    """Run converter, lab and coordinator in a process of their own, with the motion in them."""
    with tempfile.TemporaryDirectory() as folder:
        kept = Path(folder, "trajectories")
        kept.mkdir()
        with (kept / "sine.npz").open("wb") as file:
            npz_file.write(motion(), file)
        nodes = ("converter", "lab", "coordinator", "--ros-args", "-p", f"state_dir:={folder}")
        process = subprocess.Popen(
            [sys.executable, "-m", "mrlab_ros.processes.host", *nodes],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            yield
        finally:
            process.send_signal(signal.SIGINT)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(5)
            process.kill()


def measure(members: int, rounds: int) -> dict[str, Any]:
    """Measure a system of `members` robots over `rounds` starts and pauses."""
    rclpy.init()
    host, bench = PlaybackHostNode(), Bench()
    spun = [SpunNode(host), SpunNode(bench)]
    sent: dict[str, list[int]] = {}

    def watch(robot: str) -> None:
        """Note the instant at which each streamed joint state of `robot` has left."""
        player, times = host.nodes[robot].player, sent.setdefault(robot, [])
        send = player._send

        def timed(sample: Any) -> None:
            send(sample)
            if sample.streamed:
                times.append(time.monotonic_ns())

        player._send = timed

    with lab():
        spawns = []
        for i in range(members):
            name = f"robot_{i}"
            begin = time.monotonic()
            bench.ask(srv.SpawnRobot, "/lab/spawn_robot", model=MODEL, name=name, automatic=True)
            wait(lambda name=name: name in host.nodes, "the playback node")
            wait(lambda name=name: host.nodes[name].player.last, "a joint state")
            spawns.append(time.monotonic() - begin)
            watch(name)
        bench.ask(
            srv.CreateSystem,
            "/coordinator/create_system",
            name="cell",
            members=[
                msg.SystemMember(robot=f"robot_{i}", trajectory_id="sine") for i in range(members)
            ],
        )
        # The first call of a service also finds it; that is not what is measured.
        for service in ("play", "pause"):
            bench.ask(Trigger, f"/cell/{service}")
        skews, pauses, stagings = [], [], []
        for _ in range(rounds):
            bench.ask(Trigger, "/cell/stop")
            for times in sent.values():
                times.clear()
            begin = time.monotonic()
            bench.ask(Trigger, "/cell/play")
            stagings.append(time.monotonic() - begin)
            wait(lambda: all(len(times) > 20 for times in sent.values()), "frames")
            skews.extend(
                np.ptp([[times[k] for times in sent.values()] for k in range(20)], axis=1)
            )
            begin_ns = time.monotonic_ns()
            bench.ask(Trigger, "/cell/pause")
            pauses.append(max(times[-1] for times in sent.values()) - begin_ns)
            wait(lambda: bench.label() == "PAUSED", "the pause")
    for node in spun:
        node.close()
    skew = report.percentiles([s * 1e-6 for s in skews])
    pause = report.percentiles([max(p, 0) * 1e-6 for p in pauses])
    return {
        "members": members,
        "skew p50 ms": skew["p50"],
        "skew p99 ms": skew["p99"],
        "pause p50 ms": pause["p50"],
        "pause p99 ms": pause["p99"],
        "staging max ms": max(stagings) * 1e3,
        "spawn max ms": max(spawns) * 1e3,
    }


def main() -> None:
    parser = report.options(__doc__)
    parser.add_argument("--members", type=int, help="measure one size, print it as JSON")
    options = parser.parse_args()
    rounds = report.scaled(options, 1, 5, 40)
    if options.members:
        sys.stdout.write(json.dumps(measure(options.members, rounds)))
        sys.stdout.flush()
        os._exit(0)
    rows = []
    for domain, members in enumerate(report.some(options, (2, 13, 50))):
        command = [sys.executable, __file__, "--members", str(members)]
        env = dict(os.environ, ROS_DOMAIN_ID=str(90 + domain))
        done = subprocess.run(
            [*command, *report.scaled(options, ["--touch"], ["--quick"], [])],
            stdout=subprocess.PIPE,
            check=True,
            env=env,
        )
        rows.append(json.loads(done.stdout))
    report.show("Coordination", rows, options.json)


if __name__ == "__main__":
    main()
