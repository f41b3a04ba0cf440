"""Playback inside a whole lab: what it costs, and how late joint states leave.

Thirteen robots at 100 Hz with telemetry, read by physics, the bridge, a recording and a client.
CPU is each process's own, in percent of one core; lateness is what telemetry says of every robot
ten times a second. `--no-priority` takes the real-time priority away from the playback process.
"""

from __future__ import annotations

import os
import socket
import tempfile
import time
from pathlib import Path
from typing import Any

import psutil
import rclpy
import report
from mrlab_msgs import msg, srv
from safety import Bench, motion
from sensor_msgs.msg import JointState
from std_srvs.srv import SetBool, Trigger

from mrlab_ros.adapters.trajectories.npz_file import write
from mrlab_ros.messages import qos
from mrlab_ros.processes.lab import lab_processes, parameter_file
from mrlab_ros.processes.options import LabOptions, new_lab_id
from mrlab_ros.processes.supervisor import Supervisor

MODEL = "ur5e"
ROBOTS = 13
SETTLE_S = 6.0


def measure(
    names: list[str], pids: list[int], late: list[float], seconds: float
) -> list[dict[str, Any]]:
    """Return each process's share of a core, and how late joint states left, ms."""
    processes = [psutil.Process(pid) for pid in pids]
    late.clear()
    before, began = [sum(p.cpu_times()[:2]) for p in processes], time.monotonic()
    time.sleep(seconds)
    taken = time.monotonic() - began
    found = report.percentiles(late)
    rows = []
    for name, process, used in zip(names, processes, before, strict=True):
        here = name == "playback"
        rows.append(
            {
                "process": name,
                "CPU %": 100 * (sum(process.cpu_times()[:2]) - used) / taken,
                "late p50 ms": found["p50"] if here else "",
                "p99 ms": found["p99"] if here else "",
                "max ms": found["max"] if here else "",
            }
        )
    return rows


def without_priority(pid: int) -> None:
    """Give every thread of a process the ordinary policy."""
    for thread in psutil.Process(pid).threads():
        os.sched_setscheduler(thread.id, os.SCHED_OTHER, os.sched_param(0))


def run(folder: Path, seconds: float, *, priority: bool, record: bool) -> list[dict[str, Any]]:
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
        bench.ask(SetBool, "/cell/set_loop", data=True)
        if record:
            bench.ask(srv.StartRecording, "/recorder/start", bag=str(folder / "bag"))
        bench.ask(Trigger, "/cell/play")
        time.sleep(SETTLE_S)
        pids = [state.pid for state in supervisor.states]
        if not priority:
            without_priority(pids[[p.name for p in processes].index("playback")])
        before = count[0]
        rows = measure([p.name for p in processes], pids, late, seconds)
        print(f"{(count[0] - before) / seconds:.0f} joint states a second reached the client")
        bench.close()
    return rows


def main() -> None:
    parser = report.options(__doc__)
    parser.add_argument("--no-priority", action="store_true")
    parser.add_argument("--no-recording", action="store_true")
    options = parser.parse_args()
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    rclpy.init()
    with tempfile.TemporaryDirectory() as folder:
        rows = run(
            Path(folder),
            10.0 if options.quick else 30.0,
            priority=not options.no_priority,
            record=not options.no_recording,
        )
    title = f"{ROBOTS} robots in a whole lab" + ", no priority" * options.no_priority
    report.show(title, rows, options.json)
    rclpy.shutdown()


if __name__ == "__main__":
    main()
