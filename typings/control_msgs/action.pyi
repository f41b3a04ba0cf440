# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import builtin_interfaces.msg
import control_msgs.msg
import std_msgs.msg
import trajectory_msgs.msg
from typing import ClassVar

class FollowJointTrajectory:
    class Goal:
        trajectory: trajectory_msgs.msg.JointTrajectory
        multi_dof_trajectory: trajectory_msgs.msg.MultiDOFJointTrajectory
        path_tolerance: list[control_msgs.msg.JointTolerance]
        component_path_tolerance: list[control_msgs.msg.JointComponentTolerance]
        goal_tolerance: list[control_msgs.msg.JointTolerance]
        component_goal_tolerance: list[control_msgs.msg.JointComponentTolerance]
        goal_time_tolerance: builtin_interfaces.msg.Duration
        def __init__(self, *, trajectory: trajectory_msgs.msg.JointTrajectory = ..., multi_dof_trajectory: trajectory_msgs.msg.MultiDOFJointTrajectory = ..., path_tolerance: Sequence[control_msgs.msg.JointTolerance] = ..., component_path_tolerance: Sequence[control_msgs.msg.JointComponentTolerance] = ..., goal_tolerance: Sequence[control_msgs.msg.JointTolerance] = ..., component_goal_tolerance: Sequence[control_msgs.msg.JointComponentTolerance] = ..., goal_time_tolerance: builtin_interfaces.msg.Duration = ...) -> None: ...
    class Result:
        GOAL_TOLERANCE_VIOLATED: ClassVar[int]
        INVALID_GOAL: ClassVar[int]
        INVALID_JOINTS: ClassVar[int]
        OLD_HEADER_TIMESTAMP: ClassVar[int]
        PATH_TOLERANCE_VIOLATED: ClassVar[int]
        SUCCESSFUL: ClassVar[int]
        error_code: int
        error_string: str
        def __init__(self, *, error_code: int = ..., error_string: str = ...) -> None: ...
    class Feedback:
        header: std_msgs.msg.Header
        joint_names: list[str]
        desired: trajectory_msgs.msg.JointTrajectoryPoint
        actual: trajectory_msgs.msg.JointTrajectoryPoint
        error: trajectory_msgs.msg.JointTrajectoryPoint
        multi_dof_joint_names: list[str]
        multi_dof_desired: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
        multi_dof_actual: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
        multi_dof_error: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
        def __init__(self, *, header: std_msgs.msg.Header = ..., joint_names: Sequence[str] = ..., desired: trajectory_msgs.msg.JointTrajectoryPoint = ..., actual: trajectory_msgs.msg.JointTrajectoryPoint = ..., error: trajectory_msgs.msg.JointTrajectoryPoint = ..., multi_dof_joint_names: Sequence[str] = ..., multi_dof_desired: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_actual: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_error: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ...) -> None: ...
