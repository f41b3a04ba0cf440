"""Whether a trajectory was made for a robot."""

from __future__ import annotations

from mrlab_ros.core.errors import BadInput

# A model, its joints in order (empty: unknown), and an end effector (empty: none).
Arm = tuple[str, tuple[str, ...], str]


def check_fits(trajectory_id: str, made_for: Arm, robot: Arm) -> None:
    """Raise BadInput where a trajectory that was made for one arm cannot be played on another."""
    model, joints, end_effector = made_for
    found, found_joints, carried = robot
    if model != found:
        raise BadInput(
            f"trajectory '{trajectory_id}' was made for {model}, this robot is a {found}; "
            f"convert the file again for {found}"
        )
    if joints and joints != found_joints:
        raise BadInput(
            f"trajectory '{trajectory_id}' has the joints {', '.join(joints)}; expected "
            f"{', '.join(found_joints)}; convert the file again"
        )
    if end_effector not in ("", carried):
        raise BadInput(
            f"trajectory '{trajectory_id}' was made for the end effector {end_effector}, this "
            f"robot carries {carried or 'none'}; exchange the end effector, or convert the file "
            "again"
        )
