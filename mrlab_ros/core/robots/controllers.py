"""The robots of a scene as ros2_control has them: a controller each, whose joints are its own.

A controller manager cannot load or end them: robots come and go with the scene.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.robots import diagnostics as say

TYPE = "joint_trajectory_controller/JointTrajectoryController"
BASE_CLASS = "controller_interface::ControllerInterface"


@dataclass(frozen=True)
class Controller:
    """A robot. joint_names: as all robots' are named. system: that drives it; empty: none, and
    the controller is active."""

    name: str
    joint_names: tuple[str, ...]
    system: str = ""


def check_switch(
    controllers: Iterable[Controller], activate: Sequence[str], deactivate: Sequence[str]
) -> None:
    """Raise Misuse where a controller is not already as asked for: here none is switched."""
    known = {each.name: each for each in controllers}
    for name in (*activate, *deactivate):
        if name not in known:
            raise Misuse(say.NO_CONTROLLER(found=name, expected=list(known)))
    for name in activate:
        if known[name].system:
            raise Misuse(say.CONTROLLER_IN_SYSTEM(robot=name, system=known[name].system))
    for name in deactivate:
        if not known[name].system:
            raise Misuse(say.CONTROLLER_STAYS(robot=name))
