"""Matches named columns to a robot's joints: by name, never by place."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.conversion.workspace import Variable
from mrlab_ros.core.diagnostics import Refused, finding
from mrlab_ros.core.robots.model import RobotModel

GRIPPER = "gripper"


def names_joints(variable: Variable, robot: RobotModel) -> bool:
    """Say whether the columns are named as joints; headings of a table may be anything else."""
    return variable.is_message or not set(robot.joint_names).isdisjoint(variable.columns)


def misnamed(variable: Variable, robot: RobotModel) -> Diagnostic | None:
    """Return what keeps named joints from being the robot's, None where there is nothing."""
    if not names_joints(variable, robot):
        return None
    names, joints = variable.columns, robot.joint_names
    missing = [name for name in joints if name not in names]
    repeated = sorted({name for name in names if names.count(name) > 1})
    # a table may have columns for more than the arm; a message commands every joint it names
    unknown = [name for name in names if name not in joints and name != GRIPPER]
    problems = []
    if missing:
        problems.append(f"it lacks {_listed(missing)}")
    if unknown and (missing or variable.is_message):
        problems.append(f"{robot.id} has no {_listed(unknown)}")
    if repeated:
        problems.append(f"it has {_listed(repeated)} more than once")
    if not problems:
        return None
    # columns by number keep the names of a message: they mend no joint that it lacks
    in_vain = variable.is_message and bool(missing or repeated)
    more = {"fixes": (Fix(matlab="save('traj.mat', 'q')"),)} if in_vain else {}
    return finding(
        "joint_names",
        **more,
        variable=variable.path,
        robot=robot.id,
        problem="; ".join(problems),
        joints=", ".join(joints),
        count=len(joints),
    )


def order(variable: Variable, robot: RobotModel) -> tuple[list[int], list[Diagnostic]]:
    """Return the columns, from 0, in the robot's order, a gripper last, and what was done.

    All columns as they are where they do not name joints. Raises Refused where they name joints
    that are not the robot's.
    """
    names = variable.columns
    if not names_joints(variable, robot):
        return list(range(variable.shape[1])), []
    problem = misnamed(variable, robot)
    if problem is not None:
        raise Refused(problem)
    wanted = [*robot.joint_names, *([GRIPPER] if GRIPPER in names else [])]
    indices = [names.index(name) for name in wanted]
    if indices == list(range(len(names))):
        return indices, []
    left_out = [name for name in names if name not in wanted]
    were = "were" if len(left_out) > 1 else "was"
    also = f" {_listed(left_out)} {were} left out." if left_out else ""
    numbers = ", ".join(str(i + 1) for i in indices)
    words = {"order": numbers, "left_out": also, "robot": robot.id}
    return indices, [finding("joints_matched", variable=variable.path, **words)]


def _listed(names: list[str]) -> str:
    more = f" and {len(names) - 8} more" if len(names) > 8 else ""
    return ", ".join(f"'{name}'" for name in names[:8]) + more
