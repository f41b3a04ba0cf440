"""How long a pause and a collision halt take, while the lab around them is busy or stopped.

A real lab: the converter, the lab and the playback host in processes of their own, twelve robots
that play with telemetry, one that loads a million frames again and again. Times are those of a
client: from the call of /ROBOT/pause to its answer, and from publishing /ROBOT/collision to the
state COLLISION_HALT. Mark: p99 < 10 ms in every case.
"""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import report
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import SetLoop, Trigger
from rclpy.client import Client
from rclpy.node import Node

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.trajectories.npz_file import write
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory
from mrlab_ros.messages import qos
from mrlab_ros.processes.lab import LabProcess, parameter_file
from mrlab_ros.processes.options import LabOptions
from mrlab_ros.processes.supervisor import Supervisor
from mrlab_ros.ros import share
from mrlab_ros.ros.calls import NoAnswer, call
from mrlab_ros.ros.spinning import SpunNode

MODEL = "ur5e"
ROBOTS = 13
FRAMES = {"short": 6_000, "million": 1_000_000}
PROCESSES = (
    LabProcess("converter", ("converter",)),
    LabProcess("lab", ("lab",)),
    LabProcess("playback", ("playback",)),
)


def motion(name: str, frames: int) -> Trajectory:
    model = RobotLibrary(share.directory() / "robots").model(MODEL)
    t = np.arange(frames) / 100
    positions = model.home + 0.2 * np.sin(t)[:, None] * np.ones(len(model.joints))
    zeros = np.zeros_like(positions)
    return Trajectory(
        name, MODEL, None, model.joint_names, 100.0, positions, None,
        Channels(zeros, zeros), Source("sine.mat", "q", "0" * 64),
    )  # fmt: skip


class Bench:
    """A client of the lab."""

    def __init__(self) -> None:
        self.node = Node("bench")
        self._spun = SpunNode(self.node)
        self._clients: dict[str, Client] = {}
        self.labels: dict[str, str] = {}
        self.changed = threading.Condition()

    def client(self, kind: Any, service: str) -> Client:
        if service not in self._clients:
            self._clients[service] = self.node.create_client(
                kind, service, qos_profile=qos.SERVICES
            )
        return self._clients[service]

    def ask(self, kind: Any, service: str, **fields: Any) -> Any:
        answer = call(self.client(kind, service), kind.Request(**fields), 60.0)
        if not answer.success:
            raise SystemExit(f"{service}: {answer.message}")
        return answer

    def follow(self, robot: str) -> None:
        def on_state(message: Any) -> None:
            with self.changed:
                self.labels[robot] = message.label
                self.changed.notify_all()

        self.node.create_subscription(
            msg.PlaybackState, f"/{robot}/playback_state", on_state, qos.LATCHED_EVENTS
        )

    def await_label(self, robot: str, label: str) -> None:
        with self.changed:
            if not self.changed.wait_for(lambda: self.labels.get(robot) == label, 20.0):
                raise SystemExit(f"{robot} is {self.labels.get(robot)}; expected {label}")

    def close(self) -> None:
        self._spun.close()


class Measured:
    """One robot that is paused and halted, over and over."""

    def __init__(self, bench: Bench, robot: str) -> None:
        self._bench, self._robot = bench, robot
        self._collision = bench.node.create_publisher(
            msg.Collision, f"/{robot}/collision", qos.LATCHED
        )

    def pause(self) -> float:
        began = time.perf_counter()
        self._bench.ask(Trigger, f"/{self._robot}/pause")
        took = time.perf_counter() - began
        self._play()
        return took

    def halt(self) -> float:
        began = time.perf_counter()
        contact = msg.Contact(link="forearm_link", other="wall")
        self._collision.publish(msg.Collision(colliding=True, contact=contact))
        self._bench.await_label(self._robot, "COLLISION_HALT")
        took = time.perf_counter() - began
        self._collision.publish(msg.Collision(colliding=False))
        self._bench.await_label(self._robot, "PAUSED")
        self._play()
        return took

    def _play(self) -> None:
        self._bench.await_label(self._robot, "PAUSED")
        self._bench.ask(Trigger, f"/{self._robot}/play")
        self._bench.await_label(self._robot, "PLAYING")


@contextmanager
def loading(bench: Bench, robot: str) -> Iterator[list[str]]:
    """Load a million frames on `robot` again and again; yield what the loads answered."""
    answers: list[str] = []
    stop = threading.Event()

    def work() -> None:
        names = ("million", "short")
        while not stop.is_set():
            request = srv.LoadTrajectory.Request(id=names[len(answers) % 2])
            try:
                answer = call(bench.client(srv.LoadTrajectory, f"/{robot}/load"), request, 30.0)
                answers.append("loaded" if answer.success else answer.message)
            except NoAnswer as error:
                answers.append(str(error))

    thread = threading.Thread(target=work)
    thread.start()
    try:
        yield answers
    finally:
        stop.set()
        thread.join()


def measure(measured: Measured, case: str, seconds: float) -> list[dict[str, Any]]:
    took: dict[str, list[float]] = {"pause": [], "collision halt": []}
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        took["pause"].append(measured.pause() * 1e3)
        took["collision halt"].append(measured.halt() * 1e3)
        time.sleep(0.02)
    rows = []
    for what, values in took.items():
        found = report.percentiles(values)
        rows.append(
            {
                "case": case,
                "what": what,
                "count": len(values),
                "p50 ms": found["p50"],
                "p99 ms": found["p99"],
                "max ms": found["max"],
            }
        )
    return rows


def run(folder: Path, seconds: float) -> list[dict[str, Any]]:
    store = folder / "trajectories"
    store.mkdir()
    for name, frames in FRAMES.items():
        with (store / f"{name}.npz").open("wb") as file:
            write(motion(name, frames), file)
    options = LabOptions(parameter_file(None), folder, (MODEL,) * ROBOTS)
    specs = [process.spec(options) for process in PROCESSES]
    specs[1] = LabProcess("lab", ("lab",), lambda o: {"lab:robots": o.robots}).spec(options)
    rows: list[dict[str, Any]] = []
    seconds = seconds or 0.5
    with Supervisor(specs, lambda name, line: None) as supervisor:
        bench = Bench()
        robots = [f"{MODEL}_{i + 1}" for i in range(ROBOTS)]
        for robot in robots:
            bench.follow(robot)
        for robot in robots:
            bench.ask(srv.LoadTrajectory, f"/{robot}/load", id="short")
            bench.ask(SetLoop, f"/{robot}/set_loop", loop=True)
        loader, players = robots[0], robots[1:]
        for robot in players:
            bench.ask(Trigger, f"/{robot}/play")
        for robot in players:
            bench.await_label(robot, "PLAYING")
        bench.ask(SetLoop, f"/{loader}/set_loop", loop=False)
        measured = Measured(bench, players[0])
        rows += measure(measured, "quiet", seconds)
        with loading(bench, loader) as answers:
            rows += measure(measured, f"another robot loads {FRAMES['million']:,} frames", seconds)
        if "loaded" not in answers:
            raise SystemExit(f"nothing was loaded: {answers[:3]}")
        pid = supervisor.states[0].pid
        assert pid is not None
        os.kill(pid, signal.SIGSTOP)
        try:
            with loading(bench, loader):
                rows += measure(measured, "the converter is stopped, a load waits", seconds)
        finally:
            os.kill(pid, signal.SIGCONT)
        bench.close()
    return rows


if __name__ == "__main__":
    report.whole_lab(__doc__, "Safety path: what a client waits for", run, 8.0, 30.0)
