"""Diagnostics of a file to convert."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

ROBOT_NOT_NAMED = Code(
    "robot_not_named",
    "'{file}' does not say which robot it is for.",
    "Name its robot, one of {known:list}.",
)
