"""Playback inside a whole lab: what it costs, and how late joint states leave.

Thirteen robots at 100 Hz with telemetry, read by physics, the bridge, a recording and a client:
first as the lab plays them, then without the playback process's real-time priority, then stopped,
while a process with one plain rclpy timer a robot publishes the same joint states. CPU is each
process's own, in percent of one core; lateness is what telemetry says of every robot ten times a
second, and of the timers that of every joint state.
"""

from __future__ import annotations

import os
import socket
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import psutil
import report
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from playback import in_process
from safety import Bench, motion
from sensor_msgs.msg import JointState

from mrlab_ros.adapters.trajectories.npz_file import write
from mrlab_ros.messages import qos
from mrlab_ros.processes.lab import lab_processes, parameter_file
from mrlab_ros.processes.options import LabOptions, new_lab_id
from mrlab_ros.processes.supervisor import Supervisor

MODEL = "ur5e"
ROBOTS = 13
RATE = 100.0
SETTLE_S = 6.0


def measure(pids: dict[str, int], seconds: float, wait: Callable[[float], Any]) -> dict[str, Any]:
    """Return each process's share of a core, %, while `wait(seconds)` lasts, and what it returns.

    That is under the key "".
    """
    processes = {name: psutil.Process(pid) for name, pid in pids.items()}
    before = {name: sum(p.cpu_times()[:2]) for name, p in processes.items()}
    began = time.monotonic()
    result = wait(seconds)
    taken = time.monotonic() - began
    used = {name: sum(p.cpu_times()[:2]) - before[name] for name, p in processes.items()}
    return {"": result, **{f"{name} %": 100 * used[name] / taken for name in used}}


def row(method: str, late: list[float], own: float, found: dict[str, Any]) -> dict[str, Any]:
    """Return a row. late: ms. own: CPU of the process that publishes, %."""
    share = report.percentiles(late)
    return {
        "joint states by": method,
        "late p50 ms": share["p50"],
        "p99 ms": share["p99"],
        "max ms": share["max"],
        "its CPU %": own,
        **{name: value for name, value in found.items() if name not in ("", "playback %")},
    }


def without_priority(pid: int) -> None:
    """Give every thread of a process the ordinary policy."""
    for thread in psutil.Process(pid).threads():
        os.sched_setscheduler(thread.id, os.SCHED_OTHER, os.sched_param(0))


def run(folder: Path, seconds: float) -> list[dict[str, Any]]:
    (folder / "trajectories").mkdir()
    with (folder / "trajectories" / "short.npz").open("wb") as file:
        write(motion("short", 60_000), file)
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        endpoint = f"tcp/127.0.0.1:{probe.getsockname()[1]}"
    robots = (MODEL,) * ROBOTS
    options = LabOptions(
        parameter_file(None), folder, robots, listen=endpoint, lab_id=new_lab_id()
    )
    processes = lab_processes(options)
    settle, seconds = (SETTLE_S, seconds) if seconds else (0.5, 0.5)
    with Supervisor([p.spec(options) for p in processes], lambda name, line: None) as supervisor:
        bench = Bench()
        late: list[float] = []
        count = [0]

        def on_telemetry(message: Any) -> None:
            late.append(message.deadline_error * 1e3)

        def on_joint_state(data: bytes) -> None:
            count[0] += 1

        names = [f"{MODEL}_{i + 1}" for i in range(ROBOTS)]
        for robot in names:
            bench.ask(srv.LoadTrajectory, f"/{robot}/load", id="short")
            bench.node.create_subscription(
                msg.Telemetry, f"/{robot}/telemetry", on_telemetry, qos.STREAM
            )
            bench.node.create_subscription(
                JointState, f"/{robot}/joint_states", on_joint_state, qos.STREAM, raw=True
            )
        members = [msg.SystemMember(robot=robot) for robot in names]
        bench.ask(srv.CreateSystem, "/coordinator/create_system", name="cell", members=members)
        bench.ask(SetLoop, "/cell/set_loop", loop=True)
        bench.ask(srv.StartRecording, "/recorder/start", bag=str(folder / "bag"))
        bench.ask(Trigger, "/cell/play")
        time.sleep(settle)
        states = zip(processes, supervisor.states, strict=True)
        pids = {process.name: state.pid for process, state in states}
        rows = []
        for method in ("deadline thread", "without priority"):
            if rows:
                without_priority(pids["playback"])
            late.clear()
            before = count[0]
            found = measure(pids, seconds, time.sleep)
            rows.append(row(method, list(late), found["playback %"], found))
            arrived = (count[0] - before) / seconds
            print(f"{method}: {arrived:.0f} joint states a second reached the client")
        bench.ask(Trigger, "/cell/stop")
        found = measure(
            pids, seconds, lambda s: in_process("rclpy timers", ROBOTS, RATE, s, MODEL)
        )
        timers = found[""]
        rows.append(row("rclpy timers", timers["errors_ms"], 100 * timers["cpu"], found))
        bench.close()
    return rows


if __name__ == "__main__":
    report.whole_lab(__doc__, f"{ROBOTS} robots in a whole lab", run, 10.0, 30.0)
