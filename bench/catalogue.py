"""How long a robot takes to load a trajectory: from the call of `load` to its answer.

Launched nodes: converter, lab and coordinator in one process, playback in another, as `mrlab up`
starts them. The files are written into the catalogue before the start. "first": the file was not
read since it was written; "again": the median of the loads after it; "message": the same frames
as one answer of /converter/get, which is what a client on another machine gets. Beside them the
time at which JSON would be read, which is what the catalogue kept before.

Goals: 360,000 x 6 in 200 ms, 1,000,000 x 7 (six joints and a gripper) in 500 ms.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import report
from mrlab_msgs import srv

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories import json_file
from mrlab_ros.adapters.trajectories.coefficients import load_coefficients
from mrlab_ros.adapters.trajectories.store import TrajectoryStore
from mrlab_ros.commands.demo.lab import claim_free_domain
from mrlab_ros.core.trajectory.channels import derive
from mrlab_ros.core.trajectory.trajectory import Source, Trajectory
from mrlab_ros.ros import share
from mrlab_ros.ros.graph import Graph

GOALS_MS = {"10,000 x 6": 100.0, "360,000 x 6": 200.0, "1,000,000 x 7": 500.0}
ENTRIES = 1000


def motion(frames: int, gripper: bool) -> Trajectory:
    model = RobotLibrary(share.directory() / "robots").model("ur5e")
    t = np.arange(frames) / 100
    positions = model.home + 0.2 * np.sin(t[:, None] * np.linspace(0.2, 0.7, 6))
    coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
    return Trajectory(
        f"m{frames}",
        "ur5e",
        None,
        model.joint_names,
        100.0,
        positions,
        (t % 20) > 10 if gripper else None,
        derive(positions, 100.0, coefficients),
        Source("sine.mat", "q", "0" * 64),
        time.time_ns(),
    )


@contextlib.contextmanager
def launched(folder: Path) -> Iterator[Graph]:
    """Run the converter's and the playback's process; yield a client of their graph."""
    run_file, domain = claim_free_domain()
    os.environ |= {"ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    host = [sys.executable, "-m", "mrlab_ros.processes.host"]
    state = ["--ros-args", "-p", f"state_dir:={folder}"]
    commands = [[*host, "converter", "lab", "coordinator", *state], [*host, "playback"]]
    processes = [subprocess.Popen(c, stderr=subprocess.DEVNULL) for c in commands]
    try:
        with Graph() as graph:
            graph.robots(timeout=60.0)
            yield graph
    finally:
        for process in processes:
            process.send_signal(signal.SIGINT)
        for process in processes:
            process.wait(20)
        run_file.release()


def timed(graph: Graph, kind: Any, service: str, **fields: Any) -> tuple[float, Any]:
    """Return how long a call took, ms, and its answer."""
    request = kind.Request(**fields)
    begin = time.perf_counter()
    answer = graph.call(kind, service, request, timeout=120.0, find_timeout=30.0)
    taken = (time.perf_counter() - begin) * 1e3
    if not getattr(answer, "success", True):
        raise SystemExit(f"{service}: {answer.message}")
    return taken, answer


def json_ms(trajectory: Trajectory) -> float:
    """Return the time to read the trajectory from JSON, ms."""
    data = b"".join(bytes(c) for c in json_file.chunks(trajectory))
    begin = time.perf_counter()
    json_file.parse(data, "bench")
    return (time.perf_counter() - begin) * 1e3


def main() -> None:
    parser = report.options(__doc__)
    options = parser.parse_args()
    repeats = 3 if options.quick else 9
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        kept = TrajectoryStore(folder / "trajectories")
        for i in range(ENTRIES):
            kept.save(motion(2 + i, False))
        sizes = {"10,000 x 6": 10_000, "360,000 x 6": 360_000, "1,000,000 x 7": 1_000_000}
        for label, frames in sizes.items():
            trajectory = motion(frames, label.endswith("7"))
            begin = time.perf_counter()
            path = kept.save(trajectory)
            rows.append(
                {
                    "frames": label,
                    "goal ms": GOALS_MS[label],
                    "write ms": (time.perf_counter() - begin) * 1e3,
                    "MB": path.stat().st_size / 1e6,
                    "JSON ms": json_ms(trajectory),
                }
            )
            del trajectory
        with launched(folder) as graph:
            spawn = srv.SpawnRobot.Request(model="ur5e", automatic=True)
            robot = graph.order(srv.SpawnRobot, "/lab/spawn_robot", spawn, 60.0).robot.name
            load = (srv.LoadTrajectory, f"/{robot}/load")
            timed(graph, *load, id="m100")
            for row, frames in zip(rows, sizes.values(), strict=True):
                first, _ = timed(graph, *load, id=f"m{frames}")
                again = []
                for _ in range(repeats):
                    timed(graph, *load, id="m100")  # what was loaded is forgotten
                    again.append(timed(graph, *load, id=f"m{frames}")[0])
                get = (srv.GetTrajectory, "/converter/get")
                timed(graph, *get, id="m100")
                message, _ = timed(graph, *get, id=f"m{frames}")
                row |= {
                    "first ms": first,
                    "again ms": float(np.median(again)),
                    "max ms": max(again),
                }
                row |= {"message ms": message}
            timed(graph, srv.ListTrajectories, "/converter/list")
            listing, answer = timed(graph, srv.ListTrajectories, "/converter/list")
        begin = time.perf_counter()
        again = TrajectoryStore(folder / "trajectories")
        for trajectory_id in again.ids():
            again.head(trajectory_id)
        heads = (time.perf_counter() - begin) * 1e3
    report.show("Loading a trajectory", rows, options.json)
    entries = {"entries": len(answer.trajectories), "list ms": listing, "start ms": heads}
    report.show("Listing the catalogue", [entries], options.json)


if __name__ == "__main__":
    main()
