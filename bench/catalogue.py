"""How long a robot takes to load a trajectory: from the call of `load` to its answer.

Launched nodes: converter, lab and coordinator in one process, playback in another, as `mrlab up`
starts them. The files are written into the catalogue before the start. "first": the file was not
read since it was written; "again": the median of the loads after it; "message": the same frames
as one answer of /converter/get, which is what a client on another machine gets. Beside them the
time at which JSON would be read, which is what the catalogue kept before.

Goals: 360,000 x 6 in 200 ms, 1,000,000 x 7 (six joints and a gripper) in 500 ms.

Listing: ENTRIES trajectories, half of them shared, in a folder. "http": GET /api/trajectories of a
gateway, all of them, answered and received; "page": a thousand of /converter/list_any; "list": all
of them as one answer; "announce": from the answer of a change to the latched message on
/trajectories, and its size; "start": reading the whole catalogue; "follow": a reader that asks
what one change was. Goal: http in 100 ms.
"""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import report
from mrlab_msgs import msg, srv

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.store.objects import open_store
from mrlab_ros.adapters.trajectories import formats
from mrlab_ros.adapters.trajectories.catalogue import Catalogue
from mrlab_ros.adapters.trajectories.catalogue_writer import CatalogueWriter
from mrlab_ros.adapters.trajectories.files import TrajectoryFiles, load_coefficients
from mrlab_ros.commands.demo.lab import claim_free_domain
from mrlab_ros.commands.up.web import opening_url, users_file
from mrlab_ros.core.trajectory.channels import derive
from mrlab_ros.core.trajectory.trajectory import Source, Trajectory
from mrlab_ros.messages import qos
from mrlab_ros.ros import share
from mrlab_ros.ros.graph_node import Graph

GOALS_MS = {"10,000 x 6": 100.0, "360,000 x 6": 200.0, "1,000,000 x 7": 500.0}
ENTRIES = 10_000
GOAL_LIST_MS = 100.0


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
    data = b"".join(bytes(c) for c in formats.chunks(trajectory))
    begin = time.perf_counter()
    formats.parse(data, "bench")
    return (time.perf_counter() - begin) * 1e3


def ms_of(work: Callable[[], Any], repeats: int = 5) -> float:
    """Return the median time of a call, ms."""
    taken = []
    for _ in range(repeats):
        begin = time.perf_counter()
        work()
        taken.append((time.perf_counter() - begin) * 1e3)
    return float(np.median(taken))


def fill(store: Path, entries: int) -> None:
    """Write a catalogue of short trajectories of a hundred users, every second one shared."""
    kept = CatalogueWriter(open_store(str(store)))
    kept.open()
    short = motion(50, False)
    for i in range(entries):
        kept.save(replace(short, id=f"user{i % 100}/m{i}"), shared=i % 2 == 0)


@contextlib.contextmanager
def gateway(folder: Path) -> Iterator[httpx.Client]:
    """Run a gateway without a lab over the store of a state folder; yield its local user."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address = f"http://127.0.0.1:{port}"
    command = [sys.executable, "-m", "mrlab_ros.gateway", "--http", f"127.0.0.1:{port}"]
    command += ["--state-dir", str(folder), "--zenoh", "tcp/127.0.0.1:9"]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        with httpx.Client(base_url=address, timeout=60.0, follow_redirects=True) as client:
            end = time.monotonic() + 60.0
            while time.monotonic() < end:
                with contextlib.suppress(httpx.HTTPError):
                    if client.get("/healthz").status_code == 200:
                        break
                time.sleep(0.1)
            client.get(opening_url(address, users_file(folder, None)))
            yield client
    finally:
        process.send_signal(signal.SIGINT)
        process.wait(20)


def listing(graph: Graph, folder: Path, entries: int) -> dict[str, Any]:
    """Measure a catalogue of many entries."""
    kept = (srv.ListTrajectories, "/converter/list_any")
    timed(graph, *kept, count=1)
    page = ms_of(lambda: timed(graph, *kept, count=1000))
    whole = ms_of(lambda: timed(graph, *kept))
    _, answer = timed(graph, *kept)
    assert answer.total == entries, answer.total
    received: list[tuple[float, int]] = []

    def take(data: bytes) -> None:
        received.append((time.perf_counter(), len(data)))

    subscription = graph.node.create_subscription(
        msg.TrajectoryCatalogue, "/trajectories", take, qos.LATCHED, raw=True
    )
    change = srv.ShareTrajectory.Request(id="user1/m1", shared=True)
    while not received:
        time.sleep(0.01)
    announced, reader = [], Catalogue(open_store(str(folder / "store")))
    start = ms_of(lambda: Catalogue(open_store(str(folder / "store"))).refresh(), 1)
    reader.refresh()
    follow = []
    for _ in range(5):
        time.sleep(0.3)  # what one change costs, not a burst
        change.shared = not change.shared
        before, count = time.perf_counter(), len(received)
        graph.call(srv.ShareTrajectory, "/converter/share", change, timeout=20.0)
        follow.append(ms_of(reader.refresh, 1))
        while len(received) == count:
            time.sleep(0.001)
        announced.append((received[-1][0] - before) * 1e3)
    graph.node.destroy_subscription(subscription)
    with gateway(folder) as client:
        http = ms_of(lambda: client.get("/api/trajectories").content)
        size = len(client.get("/api/trajectories").content)
        assert client.get("/api/trajectories").text.count('"id":') == entries
    return {
        "entries": entries,
        "goal ms": GOAL_LIST_MS,
        "http ms": http,
        "http MB": size / 1e6,
        "page ms": page,
        "list ms": whole,
        "announce ms": float(np.median(announced)),
        "announce MB": received[-1][1] / 1e6,
        "start ms": start,
        "follow ms": float(np.median(follow)),
    }


def main() -> None:
    parser = report.options(__doc__)
    options = parser.parse_args()
    repeats = report.scaled(options, 1, 3, 9)
    entries = report.scaled(options, 20, ENTRIES // 10, ENTRIES)
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        fill(folder / "store", entries)
        kept = CatalogueWriter(open_store(str(folder / "store")))
        kept.open()
        files = TrajectoryFiles(kept.store, folder / "fetched")
        kept.save(motion(100, False))
        sizes = {"10,000 x 6": 10_000, "360,000 x 6": 360_000, "1,000,000 x 7": 1_000_000}
        sizes = dict(report.some(options, list(sizes.items())))
        for label, frames in sizes.items():
            trajectory = motion(frames, label.endswith("7"))
            begin = time.perf_counter()
            _, version = kept.save(trajectory)
            rows.append(
                {
                    "frames": label,
                    "goal ms": GOALS_MS[label],
                    "write ms": (time.perf_counter() - begin) * 1e3,
                    "MB": files.path(version).stat().st_size / 1e6,
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
            many = listing(graph, folder, entries + 1 + len(sizes))
    report.show("Loading a trajectory", rows, options.json)
    report.show("A catalogue of many trajectories", [many], options.json)


if __name__ == "__main__":
    main()
