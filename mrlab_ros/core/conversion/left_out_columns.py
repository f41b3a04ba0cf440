"""What the columns that a person left out of a matrix say of those that were taken."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.diagnostics import (
    DOUBTFUL_VALUES,
    VELOCITIES_OF,
    WHOLE_LIKE_POSES,
)
from mrlab_ros.core.conversion.evidence import cartesian, relations
from mrlab_ros.core.conversion.picking import Chosen
from mrlab_ros.core.robots.model import RobotModel

MOST_COLUMNS = 64


def doubts(chosen: Chosen, robot: RobotModel) -> list[Diagnostic]:
    """Return a warning where the whole matrix shows that its part is no joint positions."""
    whole, joints = chosen.stored.values, len(robot.joints)
    if whole is None or whole.ndim != 2 or len(chosen.picked) < joints:
        return []
    width = whole.shape[1]
    if width <= joints or width > MOST_COLUMNS or max(chosen.picked) >= width:
        return []
    path = chosen.variable.path
    poses = cartesian.evidence(whole, robot)
    if poses.strong is not None:
        return [DOUBTFUL_VALUES(variable=path, why=[WHOLE_LIKE_POSES(why=poses.strong)])]
    picked = chosen.picked[:joints]
    part = relations.busiest(whole[:, picked])
    taken = relations.course(whole[:, picked], part)
    for first in range(width - joints + 1):
        block = list(range(first, first + joints))
        if taken is None or block == picked:
            continue
        other = relations.course(whole[:, block], part)
        if other is not None and relations.derivative_rate(other, taken) is not None:
            why = VELOCITIES_OF(columns=f"{first + 1}:{first + joints}")
            return [DOUBTFUL_VALUES(variable=path, why=[why])]
    return []
