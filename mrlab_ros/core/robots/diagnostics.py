"""Diagnostics of joint positions, of the reach of a robot, and of its controller."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

POSITION_COUNT = Code(
    "position_count",
    "There are {count:count position|positions}; expected {joints:integer}, one for each moving "
    "joint.",
    meaning="Joint positions do not fit the robot.",
)
NO_SPHERICAL_WRIST = Code(
    "no_spherical_wrist",
    "The last three axes miss each other by {distance:length}; expected a spherical wrist for "
    "reach_definition wrist_centre.",
    "Write flange instead.",
    meaning="The reach of a robot cannot be measured at the centre of its wrist.",
)
NO_CONTROLLER = Code(
    "no_controller",
    "There is no controller '{found}'[; there are {expected:list}].",
    meaning="A controller manager was asked for a robot that is not in the scene.",
    page=False,
)
CONTROLLER_IN_SYSTEM = Code(
    "controller_in_system",
    "{robot} is driven by the system {system}.",
    "Dissolve the system first.",
    meaning="A controller cannot be activated: a robot system drives its robot.",
    page=False,
)
CONTROLLER_STAYS = Code(
    "controller_stays",
    "The controller of {robot} stays active while the robot is in the scene.",
    meaning="A controller manager was asked to deactivate a robot.",
    page=False,
)
