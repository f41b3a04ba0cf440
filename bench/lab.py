"""A lab of real processes, a client of it, and the motions that robots play in it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import rclpy
from mrlab_msgs import msg, srv
from partner import Failed, free_endpoint
from rclpy.client import Client
from rclpy.node import Node

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.adapters.store.objects import open_store
from mrlab_ros.adapters.trajectories.catalogue_writer import CatalogueWriter
from mrlab_ros.core.base.diagnostics import NO_ROBOT_IN_SCENE
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory
from mrlab_ros.messages import qos
from mrlab_ros.processes.announcer import Announcer
from mrlab_ros.processes.lab import PROCESSES, LabProcess, parameter_file
from mrlab_ros.processes.options import LabOptions, new_lab_id
from mrlab_ros.processes.supervisor import Supervisor
from mrlab_ros.ros.calls import call
from mrlab_ros.ros.spinning import SpunNode

ROOT = Path(__file__).resolve().parents[1]
LIBRARY = RobotLibrary(share.directory() / "robots")
MODEL = "ur5e"
# For an answer, and for a state, s.
ANSWER_S, STATE_S = 120.0, 20.0


def trajectory(
    name: str, positions: Any, rate: float = 100.0, *, model: str = MODEL, gripper: Any = None
) -> Trajectory:
    """Return a trajectory. positions: (N, J) rad; gripper: (N,) bool, or None."""
    return Trajectory(
        name, model, None, LIBRARY.model(model).joint_names, rate, positions, gripper,
        Channels(np.gradient(positions, 1 / rate, axis=0), positions.copy()),
        Source("sine.mat", "q", "0" * 64), time.time_ns(),
    )  # fmt: skip


def sine(name: str, frames: int, rate: float = 100.0, *, gripper: bool = False) -> Trajectory:
    """Return slow waves around the home pose of the UR5e."""
    t = np.arange(frames) / rate
    positions = LIBRARY.model(MODEL).home + 0.2 * np.sin(t[:, None] * np.linspace(0.5, 1.0, 6))
    return trajectory(name, positions, rate, gripper=(t % 20) > 10 if gripper else None)


def catalogue(folder: Path, motions: Iterable[Trajectory] = ()) -> CatalogueWriter:
    """Open the catalogue of a lab's folder, and write motions into it."""
    found = CatalogueWriter(open_store(str(folder / "store")))
    found.open()
    for each in motions:
        found.save(each)
    return found


def robot_names(count: int) -> list[str]:
    """Return how a lab names its first robots."""
    return [f"{MODEL}_{i + 1}" for i in range(count)]


class Lab:
    """A client of a lab, and the lab's processes."""

    def __init__(self, supervisor: Supervisor, endpoint: str) -> None:
        self.supervisor, self.endpoint = supervisor, endpoint
        rclpy.init()
        self.node = Node("bench")
        self._spun = SpunNode(self.node)
        self._clients: dict[str, Client] = {}
        self._labels: dict[str, str] = {}
        self._changed = threading.Condition()

    def processes(self) -> dict[str, psutil.Process]:
        """Return the lab's processes by name."""
        children = self.supervisor.children
        return {child.spec.name: psutil.Process(child.state.pid) for child in children}

    def client(self, kind: Any, service: str) -> Client:
        if service not in self._clients:
            self._clients[service] = self.node.create_client(
                kind, service, qos_profile=qos.SERVICES
            )
        return self._clients[service]

    def ask(self, kind: Any, service: str, /, **fields: Any) -> Any:
        """Call a service; raise Failed where it refuses."""
        answer = call(self.client(kind, service), kind.Request(**fields), ANSWER_S)
        if not getattr(answer, "success", True):
            raise Failed(f"{service}: {answer.message}")
        return answer

    def create_system(self, members: Sequence[msg.SystemMember]) -> None:
        """Create the system `cell`, once the coordinator has received the robots as well."""
        end = time.monotonic() + STATE_S
        create = self.client(srv.CreateSystem, "/coordinator/create_system")
        request = srv.CreateSystem.Request(name="cell", members=members)
        while not (answer := call(create, request, ANSWER_S)).success:
            if answer.code != NO_ROBOT_IN_SCENE.code or time.monotonic() > end:
                raise Failed(answer.message)
            time.sleep(0.05)

    def ms(self, kind: Any, service: str, /, **fields: Any) -> float:
        """Return how long a call of a service takes, ms."""
        began = time.perf_counter()
        self.ask(kind, service, **fields)
        return (time.perf_counter() - began) * 1e3

    def subscribe(
        self, kind: Any, topic: str, callback: Callable[[Any], object], quality: Any, **raw: bool
    ) -> None:
        self.node.create_subscription(kind, topic, callback, quality, **raw)

    def heard(self, kind: Any, topic: str, quality: Any) -> list[Any]:
        """Return the list that grows as messages arrive."""
        messages: list[Any] = []
        self.subscribe(kind, topic, messages.append, quality)
        return messages

    def follow(self, robots: Iterable[str]) -> None:
        """Keep the playback states of robots for await_label()."""

        def follow(robot: str) -> None:
            def on_state(message: Any) -> None:
                with self._changed:
                    self._labels[robot] = message.label
                    self._changed.notify_all()

            topic = f"/{robot}/playback_state"
            self.subscribe(msg.PlaybackState, topic, on_state, qos.LATCHED_EVENTS)

        for each in robots:
            follow(each)

    def await_label(self, robot: str, *labels: str) -> None:
        with self._changed:
            if not self._changed.wait_for(lambda: self._labels.get(robot) in labels, STATE_S):
                raise Failed(f"{robot} is {self._labels.get(robot)}; expected {labels}")

    def close(self) -> None:
        self._spun.close()
        rclpy.shutdown()


@contextmanager
def running(
    folder: Path,
    only: Sequence[str] = (),
    *,
    robots: int = 0,
    processes: Sequence[Any] = PROCESSES,
    lab_id: str | None = None,
) -> Iterator[Lab]:
    """Run a lab over a folder and end it afterwards.

    only: names of the processes that are started; all where none is named. robots: how many UR5e
    it begins with. processes: what they are, those of `mrlab up` unless named.
    """
    options = LabOptions(
        parameter_file(None), folder, (MODEL,) * robots, listen=free_endpoint(),
        lab_id=new_lab_id() if lab_id is None else lab_id, socket=str(folder / "lab.sock"),
    )  # fmt: skip
    chosen: list[LabProcess] = [
        p for p in processes if p.wanted(options) and (not only or p.name in only)
    ]
    specs = [process.spec(options) for process in chosen]
    announcer = Announcer(options.lab_id)
    with Supervisor(specs, lambda name, line: None, announcer.announce) as supervisor:
        announcer.open()
        lab = Lab(supervisor, options.listen)
        try:
            yield lab
        finally:
            lab.close()
            announcer.close()
