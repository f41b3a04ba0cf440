"""What the physics node costs and how soon it halts an arm: measured through the graph.

The node runs as `mrlab up` runs it, in a process of its own; lab and playback run in this one.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
import psutil
import rclpy
from geometry_msgs.msg import Point
from geometry_msgs.msg import Pose as PoseMessage
from mrlab_msgs import msg, srv
from mrlab_msgs.srv import Trigger
from rclpy.node import Node
from sensor_msgs.msg import JointState

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory
from mrlab_ros.messages import qos
from mrlab_ros.messages.time import time_from_message
from mrlab_ros.messages.trajectories import trajectory_to_message
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode
from mrlab_ros.ros import share
from mrlab_ros.ros.calls import call
from mrlab_ros.ros.spinning import SpunNode

LIBRARY = RobotLibrary(share.directory() / "robots")
RATE = 100.0
# How long objects take to come to rest and fall asleep, s.
SETTLE = 5.0


def trajectory(name: str, model: RobotModel, positions: Any) -> Trajectory:
    """Return a trajectory at RATE; positions: (N, J) rad."""
    zeros = np.zeros_like(positions)
    return Trajectory(
        name, model.id, None, model.joint_names, RATE, positions, None,
        Channels(np.gradient(positions, 1 / RATE, axis=0), zeros),
        Source("q.mat", "q", "0" * 64),
    )  # fmt: skip


class Converter(Node):
    """Hands out trajectories that no file has."""

    def __init__(self, trajectories: Sequence[Trajectory]) -> None:
        super().__init__("converter")
        self._known = {t.id: t for t in trajectories}
        self.create_service(srv.GetTrajectory, "~/get_any", self._get)

    def _get(self, request: Any, response: Any) -> Any:
        response.success = True
        response.trajectory = trajectory_to_message(self._known[request.id])
        return response


class Graph:
    """A lab with a physics node, and a client of it. process: that of the physics node."""

    def __init__(self, process: psutil.Process, client: Node) -> None:
        self.process = process
        self._client = client

    def ask(self, kind: Any, name: str, /, **fields: Any) -> Any:
        service = self._client.create_client(kind, name)
        answer = call(service, kind.Request(**fields), 30.0)
        self._client.destroy_client(service)
        if not answer.success:
            raise SystemExit(f"{name}: {answer.message}")
        return answer

    def spawn(self, model: str, place: tuple[float, float, float]) -> str:
        """Put a robot at a place, m; return its name."""
        x, y, z = place
        pose = PoseMessage(position=Point(x=x, y=y, z=z))
        name: str = self.ask(srv.SpawnRobot, "/lab/spawn_robot", model=model, pose=pose).robot.name
        return name

    def heard(self, kind: Any, topic: str, quality: Any) -> list[Any]:
        """Return the list that grows as messages arrive."""
        messages: list[Any] = []
        self._client.create_subscription(kind, topic, messages.append, quality)
        return messages


@contextmanager
def graph(trajectories: Sequence[Trajectory]) -> Iterator[Graph]:
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    command = [sys.executable, "-m", "mrlab_ros.processes.host", "physics"]
    physics = subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    spun: list[SpunNode] = []
    try:
        rclpy.init()
        client = Node("bench")
        for node in (Converter(trajectories), LabNode(), PlaybackHostNode(), client):
            spun.append(SpunNode(node))
        yield Graph(psutil.Process(physics.pid), client)
    finally:
        for each in spun:
            each.close()
        physics.terminate()
        physics.wait(20)


def until(condition: Callable[[], Any], what: str, seconds: float = 30.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            raise SystemExit(f"waited {seconds:g} s for {what} in vain")
        time.sleep(0.01)


def node_load(models: Sequence[str], kinds: Sequence[str], seconds: float) -> list[dict[str, Any]]:
    """Return what the node costs while all robots play, and while they stand."""
    t = np.arange(round(RATE * (seconds + 4 * SETTLE))) / RATE
    motions = []
    for model in map(LIBRARY.model, sorted(set(models))):
        wave = 0.3 * np.sin(t[:, None] + np.arange(len(model.joints)))
        # From rest: the wave comes up within a second.
        motions.append(trajectory(model.id, model, model.home + np.clip(t, 0, 1)[:, None] * wave))
    with graph(motions) as lab:
        names, states = [], []
        for i, model_id in enumerate(models):
            names.append(lab.spawn(model_id, (3.5 * (i % 4), 3.5 * (i // 4), 0.0)))
            states.append(lab.heard(msg.PlaybackState, f"/{names[-1]}/playback_state", qos.EVENTS))
        for i, kind in enumerate(kinds):
            at = Point(x=3.5 * (i % 4) + 1.2 + 0.15 * (i // 8), y=1.0 + 0.2 * (i // 4), z=0.5)
            lab.ask(
                srv.SpawnObject, "/physics/spawn_object",
                type=kind, pose=PoseMessage(position=at), automatic=True,
            )  # fmt: skip
        time.sleep(SETTLE)
        rows = [_load(lab.process, "standing", names, kinds, seconds / 2)]
        for name, model_id in zip(names, models, strict=True):
            lab.ask(srv.LoadTrajectory, f"/{name}/load", id=model_id)
        for name in names:
            lab.ask(Trigger, f"/{name}/play")
        until(lambda: all(s and s[-1].label == "PLAYING" for s in states), "all robots to play")
        time.sleep(SETTLE)
        rows.append(_load(lab.process, "playing, 100 Hz", names, kinds, seconds))
        halted = [n for n, s in zip(names, states, strict=True) if s[-1].label != "PLAYING"]
        if halted:
            raise SystemExit(f"{', '.join(halted)} did not play to the end")
    return rows


def _load(
    process: psutil.Process, what: str, names: Sequence[str], kinds: Sequence[str], seconds: float
) -> dict[str, Any]:
    before, begin = process.cpu_times(), time.perf_counter()
    time.sleep(seconds)
    after, wall = process.cpu_times(), time.perf_counter() - begin
    used = after.user + after.system - before.user - before.system
    return {
        "robots": what,
        "count": len(names),
        "objects": len(kinds),
        "node % of a core": 100 * used / wall,
        "memory MiB": process.memory_info().rss / 2**20,
    }


def halt_latencies(runs: int) -> list[float]:
    """Halt an arm again and again; return contact to last moving joint state, ms."""
    model = LIBRARY.model("ur5e")
    pan = 0.5 * np.arange(301) / RATE
    positions = model.home + pan[:, None] * np.array([1, 0, 0, 0, 0, 0])
    x, y, z = (float(v) for v in model.chain.tool0(positions[120])[:3, 3])
    with graph([trajectory("sweep", model, positions)]) as lab:
        robot = lab.spawn("ur5e", (0.0, 0.0, 0.0))
        states = lab.heard(msg.PlaybackState, f"/{robot}/playback_state", qos.EVENTS)
        joints = lab.heard(JointState, f"/{robot}/joint_states", qos.STREAM)
        collisions = lab.heard(msg.Collision, f"/{robot}/collision", qos.EVENTS)
        lab.ask(srv.LoadTrajectory, f"/{robot}/load", id="sweep")
        above = PoseMessage(position=Point(x=x, y=y, z=3.0))
        box = lab.ask(
            srv.SpawnObject, "/physics/spawn_object", type="cube_large", pose=above
        ).object.name

        def put(height: float) -> None:
            place = PoseMessage(position=Point(x=x, y=y, z=height))
            lab.ask(srv.MoveObject, "/physics/move_object", name=box, held=True, pose=place)

        def once() -> float:
            put(3.0)
            until(lambda: states[-1].label in ("READY", "PAUSED"), "clearance")
            lab.ask(srv.Seek, f"/{robot}/seek", position=0.6)
            put(z)
            collisions.clear()
            lab.ask(Trigger, f"/{robot}/play")
            until(lambda: states[-1].label == "COLLISION_HALT" and collisions, "the halt")
            contact_ns = time_from_message(collisions[0].header.stamp)
            time.sleep(0.1)
            last = next(j for j in reversed(joints) if np.any(j.velocity))
            return (time_from_message(last.header.stamp) - contact_ns) * 1e-6

        return [once() for _ in range(runs)]
