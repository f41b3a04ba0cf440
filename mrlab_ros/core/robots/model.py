"""A robot model: joints, limits, home pose, kinematics."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.robots.kinematics import KinematicChain


@dataclass(frozen=True)
class Joint:
    """One moving joint: limits in rad (m where prismatic), rad/s, N*m or None if unknown."""

    name: str
    lower: float
    upper: float
    max_velocity: float
    max_effort: float | None = None


@dataclass(frozen=True, eq=False)
class RobotModel:
    """A robot model of the library.

    home: (J,) rad, in joint order. payload: kg. reach: m, as its vendor defines it. chain leads
    from base_link through all joints to tool0.
    """

    id: str
    manufacturer: str
    product: str
    robot_class: str
    payload: float
    reach: float
    joints: tuple[Joint, ...]
    home: Array
    chain: KinematicChain

    @cached_property
    def joint_names(self) -> tuple[str, ...]:
        return tuple(joint.name for joint in self.joints)
