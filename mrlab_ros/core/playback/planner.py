"""The port of the motion planner: motions from one standing pose to another."""

from __future__ import annotations

from typing import Protocol

from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.robots.model import RobotModel


class Motion(Protocol):
    """A planned motion, sampled by the time since its start."""

    @property
    def duration(self) -> float:
        """Time from the start until the arm stands at the goal, s."""
        ...

    def at(self, elapsed: float) -> tuple[Array, Array]:
        """Return joint positions and velocities, (J,) rad and rad/s, `elapsed` s after the start.

        Before 0 the arm is at rest at the start, after the duration at rest at the goal.
        """
        ...


class MotionPlanner(Protocol):
    """Plans rest-to-rest motions inside a robot's velocity limits."""

    def plan(self, model: RobotModel, start: Array, goal: Array) -> Motion:
        """Plan from `start` to `goal`, both (J,) rad; raise BadInput where no motion exists."""
        ...
