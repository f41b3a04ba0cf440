"""What a class that uploads at once does to the rest of the lab.

Launched processes: converter, lab and coordinator in one, playback in another, as `mrlab up`
starts them; a robot plays. 150 submissions of 600 x 6 are sent to /converter/convert at once.
Meanwhile /lab/list_scenes and /converter/list are called again and again, and the robot is paused
and plays on; the longest gap between two joint states of the playing robot is measured as well.
"idle" is the same without uploads. Goals: other services below 100 ms, a pause below 100 ms.

"cold" is the first conversion of a process that is not running yet, "warm" the median of those
after it.
"""

from __future__ import annotations

import io
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import report
import scipy.io
from mrlab_msgs import srv
from mrlab_msgs.srv import SetLoop, Trigger
from sensor_msgs.msg import JointState

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories.files import load_coefficients
from mrlab_ros.adapters.workspaces.reader import WorkspaceReader, in_memory
from mrlab_ros.adapters.workspaces.results import Task
from mrlab_ros.commands.demo.lab import claim_free_domain
from mrlab_ros.core.conversion.options import Options
from mrlab_ros.messages import qos
from mrlab_ros.ros import share
from mrlab_ros.ros.graph_node import Graph

CLASS = 150
SERVICES = {"/lab/list_scenes": srv.ListScenes, "/converter/list": srv.ListTrajectories}
LIMIT = 300.0  # s


def submission(number: int, rows: int = 600) -> bytes:
    """Return a workspace with a motion that the robot can follow."""
    u = np.linspace(0, 1, rows)[:, None]
    q = (10 * u**3 - 15 * u**4 + 6 * u**5) * np.linspace(0.2, 0.9, 6) - 0.1 - number * 1e-4
    file = io.BytesIO()
    scipy.io.savemat(file, {"q": q, "fs": 100.0}, do_compression=True)
    return file.getvalue()


def upload(number: int) -> srv.ConvertTrajectory.Request:
    return srv.ConvertTrajectory.Request(
        data=submission(number), file_name=f"student{number}.mat", robot_model="ur5e"
    )


def measured(graph: Graph, robot: str, states: list[float], going: Callable[[], bool]) -> Any:
    """Call services and pause the robot while `going`; return a row of figures, ms."""
    taken: dict[str, list[float]] = {name: [] for name in (*SERVICES, "pause")}
    gaps: list[float] = []
    while going():
        for name, kind in SERVICES.items():
            taken[name].append(timed(graph, kind, name))
        begin = len(states)
        until = time.monotonic() + 0.3
        while time.monotonic() < until:
            time.sleep(0.02)
        gaps += list(np.diff(states[begin:]) * 1e3)
        taken["pause"].append(timed(graph, Trigger, f"/{robot}/pause"))
        timed(graph, Trigger, f"/{robot}/play")
    row: dict[str, Any] = {"calls": len(taken["pause"])}
    for name, values in taken.items():
        row[f"{name} p50 ms"] = float(np.median(values))
        row[f"{name} p95 ms"] = float(np.percentile(values, 95))
    row["longest gap ms"] = max(gaps, default=0.0)
    return row


def timed(graph: Graph, kind: Any, service: str) -> float:
    begin = time.perf_counter()
    graph.call(kind, service, kind.Request(), timeout=60.0, find_timeout=30.0)
    return (time.perf_counter() - begin) * 1e3


def while_uploading(folder: Path) -> list[dict[str, Any]]:
    """Return the figures of an idle lab and of one in which a class uploads."""
    run_file, domain = claim_free_domain()
    os.environ |= {"ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    host = [sys.executable, "-m", "mrlab_ros.processes.host"]
    state = ["--ros-args", "-p", f"state_dir:={folder}"]
    commands = [[*host, "converter", "lab", "coordinator", *state], [*host, "playback"]]
    processes = [subprocess.Popen(c, stderr=subprocess.DEVNULL) for c in commands]
    try:
        with Graph() as graph, Graph() as sender:
            graph.robots(timeout=60.0)
            spawn = srv.SpawnRobot.Request(model="ur5e", automatic=True)
            robot = graph.order(srv.SpawnRobot, "/lab/spawn_robot", spawn, 60.0).robot.name
            first = sender.call(
                srv.ConvertTrajectory, "/converter/convert", upload(CLASS), 60.0, 30.0
            )
            load = srv.LoadTrajectory.Request(id=first.trajectory.id)
            graph.order(srv.LoadTrajectory, f"/{robot}/load", load, 60.0)
            states: list[float] = []
            topic = f"/{robot}/joint_states"
            graph.subscribe(
                JointState, topic, lambda _: states.append(time.monotonic()), qos.STREAM
            )
            graph.order(SetLoop, f"/{robot}/set_loop", SetLoop.Request(loop=True), 30.0)
            timed(graph, Trigger, f"/{robot}/play")
            end = time.monotonic() + 5.0
            idle = measured(graph, robot, states, lambda: time.monotonic() < end)
            client = sender.node.create_client(
                srv.ConvertTrajectory, "/converter/convert", qos_profile=qos.SERVICES
            )
            client.wait_for_service(30.0)
            begin = time.monotonic()
            asked = [client.call_async(upload(i)) for i in range(CLASS)]
            busy = measured(
                graph,
                robot,
                states,
                lambda: not all(f.done() for f in asked) and time.monotonic() < begin + LIMIT,
            )
            busy["all answered s"] = time.monotonic() - begin
            idle["all answered s"] = 0.0
            wrong = [f for f in asked if not (f.done() and f.result().success)]
            if wrong:
                raise SystemExit(f"{len(wrong)} of {CLASS} uploads were not accepted")
            return [{"lab": "idle", **idle}, {"lab": f"{CLASS} uploads", **busy}]
    finally:
        for process in processes:
            process.send_signal(signal.SIGINT)
        for process in processes:
            process.wait(20)
        run_file.release()


def warm_and_cold(repeats: int) -> dict[str, Any]:
    """Return how long the first conversion of a process takes, and those after it, ms."""
    robot = RobotLibrary(share.directory() / "robots").model("ur5e")
    coefficients = load_coefficients(share.directory() / "config" / "torque_proxy.yaml")
    task = Task("s.mat", Options(), robot, coefficients, None, "", 0, 100.0)
    taken = []
    with WorkspaceReader() as reader:
        for i in range(repeats + 1):
            begin = time.perf_counter()
            with in_memory(submission(i)) as source, tempfile.TemporaryFile() as stored:
                assert reader.convert(source, task, stored).head is not None
            taken.append((time.perf_counter() - begin) * 1e3)
    return {"cold ms": taken[0], "warm ms": float(np.median(taken[1:]))}


def main() -> None:
    options = report.options(__doc__).parse_args()
    row = warm_and_cold(report.scaled(options, 1, 5, 30))
    report.show("A small file, N = 600 x 6, in a cold and in a warm process", [row], options.json)
    with tempfile.TemporaryDirectory() as folder:
        rows = while_uploading(Path(folder))
    transposed = [
        {"figure": key, **{row["lab"]: row[key] for row in rows}}
        for key in rows[0]
        if key != "lab"
    ]
    report.show("The rest of the lab while a class uploads", transposed, options.json)


if __name__ == "__main__":
    main()
