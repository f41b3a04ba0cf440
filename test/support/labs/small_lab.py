"""A lab with a catalogue of a few small motions, for the node tests."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from graph import Graph
from mrlab_msgs import msg, srv
from rclpy.node import Node

from mrlab_ros.adapters import share
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.trajectory.diagnostics import NO_TRAJECTORY_OF_NAME
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory
from mrlab_ros.messages import qos, trajectories
from mrlab_ros.messages.texts import tell
from mrlab_ros.nodes.coordinator.node import CoordinatorNode
from mrlab_ros.nodes.lab.node import LabNode
from mrlab_ros.nodes.playback.host import PlaybackHostNode

LIBRARY = RobotLibrary(share.directory() / "robots")


def make(
    model_id: str,
    name: str,
    frames: int = 60,
    gripper: bool = False,
    end_effector: str | None = None,
) -> Trajectory:
    """A small wave around the home pose."""
    model = LIBRARY.model(model_id)
    wave = 0.1 * np.sin(np.linspace(0, 3, frames))[:, None]
    positions = model.home + 0.05 + wave * np.linspace(1, 2, len(model.joints))
    velocities = np.gradient(positions, 0.01, axis=0)
    closed = np.arange(frames) >= frames // 2
    return Trajectory(
        name, model_id, end_effector, model.joint_names, 100.0, positions,
        closed if gripper else None,
        Channels(velocities, np.ones_like(positions)),
        Source("wave.mat", "q", "0" * 64),
    )  # fmt: skip


TRAJECTORIES = {
    "wave": make("ur5e", "wave"),
    "pick": make("ur5e", "pick", gripper=True),
    "long": make("ur5e", "long", frames=1000),
    "tool": make("ur5e", "tool", gripper=True, end_effector="parallel_gripper"),
    "kuka": make("kuka_kr6_r900_sixx", "kuka", frames=90),
}

# Listed, and refused by /converter/get_any.
UNREADABLE: set[str] = set()


class Catalogue(Node):
    """Answers /converter/get_any and /converter/list_any from TRAJECTORIES."""

    def __init__(self, **kwargs) -> None:
        super().__init__("converter", **kwargs)
        self.create_service(srv.GetTrajectory, "~/get_any", self._get)
        self.create_service(srv.ListTrajectories, "~/list_any", self._list)

    def _get(self, request, response):
        name = request.id.partition("@")[0]
        trajectory = None if name in UNREADABLE else TRAJECTORIES.get(name)
        found = trajectory is not None
        tell(response, found, None if found else NO_TRAJECTORY_OF_NAME(id=request.id))
        if trajectory is not None:
            response.trajectory = trajectories.trajectory_to_message(trajectory)
        return response

    def _list(self, request, response):
        response.success = True
        response.trajectories = [
            trajectories.info_to_message(trajectory)
            for trajectory in TRAJECTORIES.values()
            if trajectory.robot_model == request.robot_model
            and trajectory.end_effector in (None, request.end_effector)
        ]
        return response


def start(graph: Graph, **parameters) -> SimpleNamespace:
    """Start the catalogue, the lab, the playback host and the coordinator."""
    graph.add(Catalogue)
    return SimpleNamespace(
        lab=graph.add(LabNode, **parameters),
        host=graph.add(PlaybackHostNode, **parameters),
        coordinator=graph.add(CoordinatorNode, **parameters),
    )


def spawn(graph: Graph, model: str = "ur5e") -> str:
    answer = graph.call(srv.SpawnRobot, "/lab/spawn_robot", model=model, automatic=True)
    assert answer.success, answer.message
    return answer.robot.name


def load(graph: Graph, robot: str, trajectory: str) -> None:
    answer = graph.call(srv.LoadTrajectory, f"/{robot}/load", id=trajectory)
    assert answer.success, answer.message


def labels(inbox) -> list[str]:
    seen: list[str] = []
    for state in inbox:
        if not seen or seen[-1] != state.label:
            seen.append(state.label)
    return seen


def listen_state(graph: Graph, robot: str):
    return graph.listen(msg.PlaybackState, f"/{robot}/playback_state", qos.EVENTS)


def make_system(graph: Graph, members: dict[str, str], name: str = "cell", waits=None, mode=0):
    return graph.call(
        srv.CreateSystem,
        "/coordinator/create_system",
        name=name,
        mode=mode,
        members=[
            msg.SystemMember(robot=r, trajectory_id=t, waits=(waits or {}).get(r, []))
            for r, t in members.items()
        ],
    )


def listen_systems(graph: Graph):
    return graph.listen(msg.RobotSystems, "/systems", qos.LATCHED_EVENTS)


def state_of(systems) -> msg.RobotSystem:
    return systems[-1].systems[0]


def value_of(said, name: str) -> str:
    """Return a value of what an answer or a state says, as the wire has it."""
    return next(each.value for each in said.values if each.key == name)
