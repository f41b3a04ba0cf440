"""A motion that brings an arm from where it stands to where a trajectory begins."""

from __future__ import annotations

from typing import Protocol

from mrlab_ros.core.geometry import Array
from mrlab_ros.core.robots.model import RobotModel


class Motion(Protocol):
    """A planned motion, sampled by the time since its start."""

    @property
    def duration(self) -> float:
        """Time from start to standstill, s."""
        ...

    def at(self, elapsed: float) -> tuple[Array, Array]:
        """Return joint positions and velocities, (J,) rad and rad/s, `elapsed` s after the start.

        Before 0 that is the start, after the duration the goal, both at rest.
        """
        ...


class MotionPlanner(Protocol):
    """Plans rest-to-rest motions inside a robot's velocity limits."""

    def plan(self, model: RobotModel, start: Array, goal: Array) -> Motion:
        """Plan from `start` to `goal`, both (J,) rad; raise BadInput where there is none."""
        ...
