"""Diagnostics of joint positions and of the reach of a robot."""

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
