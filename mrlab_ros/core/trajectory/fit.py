"""Whether a trajectory was made for a robot."""

from __future__ import annotations

from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory.diagnostics import (
    OF_ANOTHER_END_EFFECTOR,
    OF_ANOTHER_MODEL,
    OF_OTHER_JOINTS,
)

# A model, its joints in order (empty: unknown), and an end effector (empty: none).
Arm = tuple[str, tuple[str, ...], str]


def check_fits(trajectory_id: str, made_for: Arm, robot: Arm) -> None:
    """Raise BadInput where a trajectory that was made for one arm cannot be played on another."""
    model, joints, end_effector = made_for
    found, found_joints, carried = robot
    if model != found:
        raise BadInput(OF_ANOTHER_MODEL(id=trajectory_id, made_for=model, robot_model=found))
    if joints and joints != found_joints:
        raise BadInput(OF_OTHER_JOINTS(id=trajectory_id, found=joints, expected=found_joints))
    if end_effector not in ("", carried):
        raise BadInput(
            OF_ANOTHER_END_EFFECTOR(id=trajectory_id, made_for=end_effector, carried=carried)
        )
