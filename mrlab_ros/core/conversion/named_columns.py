"""Matches named columns to a robot's joints: by name, never by place."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Diagnostic, Fix
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.conversion.diagnostics import JOINT_NAMES, JOINTS_MATCHED
from mrlab_ros.core.conversion.workspace import Variable, shortened
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
    unknown = unknown if missing or variable.is_message else []
    if not (missing or unknown or repeated):
        return None
    # columns by number keep the names of a message: they mend no joint that it lacks
    in_vain = variable.is_message and bool(missing or repeated)
    by_number = Fix("columns", f"1:{len(joints)}")
    return JOINT_NAMES(
        variable=variable.path,
        model=robot.id,
        missing=shortened(missing),
        unknown=shortened(unknown),
        repeated=shortened(repeated),
        joints=list(joints),
        fixes=(Fix(matlab="save('traj.mat', 'q')") if in_vain else by_number,),
    )


def order(variable: Variable, robot: RobotModel) -> tuple[list[int], list[Diagnostic]]:
    """Return the columns, from 0, in the robot's order, a gripper last, and what was done.

    All columns as they are where they do not name joints. Raises BadInput where they name joints
    that are not the robot's.
    """
    names = variable.columns
    if not names_joints(variable, robot):
        return list(range(variable.shape[1])), []
    problem = misnamed(variable, robot)
    if problem is not None:
        raise BadInput(problem)
    wanted = [*robot.joint_names, *([GRIPPER] if GRIPPER in names else [])]
    indices = [names.index(name) for name in wanted]
    if indices == list(range(len(names))):
        return indices, []
    left_out = [name for name in names if name not in wanted]
    done = JOINTS_MATCHED(
        variable=variable.path,
        model=robot.id,
        order=[i + 1 for i in indices],
        left_out=shortened(left_out),
    )
    return indices, [done]
