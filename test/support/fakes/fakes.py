"""Small stand-ins for the ports of the core."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.robots.model import Joint, RobotModel
from mrlab_ros.core.trajectory.trajectory import Channels, Source, Trajectory

SECOND = 1_000_000_000


@dataclass(frozen=True)
class StraightMotion:
    start: Array
    goal: Array
    duration: float

    def at(self, elapsed: float) -> tuple[Array, Array]:
        share = min(max(elapsed / self.duration, 0.0), 1.0) if self.duration else 1.0
        return self.start + share * (self.goal - self.start), np.zeros_like(self.start)


@dataclass
class StraightPlanner:
    """Goes straight to the goal in a fixed time, s."""

    duration: float = 0.5

    def plan(self, model: RobotModel, start: Array, goal: Array) -> StraightMotion:
        return StraightMotion(start, goal, self.duration)


def make_model(joints: int = 2, home: float = 0.0) -> RobotModel:
    names = [f"joint_{i + 1}" for i in range(joints)]
    return RobotModel(
        id="fake",
        manufacturer="Nobody",
        product="Fake 1",
        robot_class="fake",
        payload=1.0,
        reach=1.0,
        joints=tuple(Joint(name, -3.0, 3.0, 2.0) for name in names),
        home=np.full(joints, home),
        chain=None,  # type: ignore[arg-type]
    )


def make_trajectory(
    positions: Array | None = None,
    *,
    frame_rate: float = 100.0,
    gripper: list[bool] | None = None,
    joint_names: tuple[str, ...] = ("joint_1", "joint_2"),
    robot_model: str = "fake",
    trajectory_id: str = "wave",
) -> Trajectory:
    if positions is None:
        t = np.linspace(0, 1, 11)
        positions = np.column_stack([np.sin(t), np.cos(t)])
    zeros = np.zeros_like(positions)
    return Trajectory(
        id=trajectory_id,
        robot_model=robot_model,
        end_effector=None,
        joint_names=joint_names,
        frame_rate=frame_rate,
        positions=positions,
        gripper=None if gripper is None else np.array(gripper),
        channels=Channels(zeros.copy(), zeros.copy()),
        source=Source("wave.mat", "q", "0" * 64),
    )
