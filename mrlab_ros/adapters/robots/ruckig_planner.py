"""Motions with bounded jerk, planned by ruckig."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from ruckig import InputParameter, Result, Ruckig, Synchronization, Trajectory

from mrlab_ros.adapters.robots.diagnostics import MOTION_SIZE, NO_MOTION_LEADS
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.robots.model import RobotModel


@dataclass(frozen=True)
class StagingLimits:
    """Limits of the motion to a trajectory's first frame.

    velocity_share: share of each joint's velocity limit, 0 to 1; acceleration: rad/s^2;
    jerk: rad/s^3. Vendors publish velocity limits but rarely the other two; the defaults are
    gentle for all of the lab's arms.
    """

    velocity_share: float = 0.5
    acceleration: float = 6.0
    jerk: float = 30.0


class RuckigMotion:
    """A motion planned by ruckig; its ends are exactly `start` and `goal`."""

    def __init__(self, trajectory: Trajectory, start: Array, goal: Array) -> None:
        self._trajectory = trajectory
        self._start = start
        self._goal = goal

    @property
    def duration(self) -> float:
        return float(self._trajectory.duration)

    def at(self, elapsed: float) -> tuple[Array, Array]:
        if elapsed >= self.duration:
            return self._goal, np.zeros_like(self._goal)
        if elapsed <= 0:
            return self._start, np.zeros_like(self._start)
        position, velocity, _ = self._trajectory.at_time(elapsed)
        return np.asarray(position), np.asarray(velocity)


class RuckigPlanner:
    """Plans time-optimal motions within the limits; all joints arrive at the same time."""

    def __init__(self, limits: StagingLimits | None = None) -> None:
        self.limits = limits or StagingLimits()

    def plan(self, model: RobotModel, start: Array, goal: Array) -> RuckigMotion:
        count = len(model.joints)
        if start.shape != (count,) or goal.shape != (count,):
            raise BadInput(
                MOTION_SIZE(robot=model.id, start=start.size, goal=goal.size, joints=count)
            )
        limits = self.limits
        target = InputParameter(count)
        target.current_position, target.target_position = start.tolist(), goal.tolist()
        target.max_velocity = [limits.velocity_share * j.max_velocity for j in model.joints]
        target.max_acceleration = [limits.acceleration] * count
        target.max_jerk = [limits.jerk] * count
        target.synchronization = Synchronization.Phase
        trajectory = Trajectory(count)
        result = Ruckig(count).calculate(target, trajectory)
        if result not in (Result.Working, Result.Finished):
            raise BadInput(
                NO_MOTION_LEADS(
                    robot=model.id,
                    start=np.round(start, 4).tolist(),
                    goal=np.round(goal, 4).tolist(),
                    why=f"ruckig: {result}",
                )
            )
        return RuckigMotion(trajectory, start, goal)
