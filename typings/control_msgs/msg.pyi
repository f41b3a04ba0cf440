# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import std_msgs.msg
import trajectory_msgs.msg
from typing import ClassVar

class JointComponentTolerance:
    ROTATION: ClassVar[int]
    TRANSLATION: ClassVar[int]
    X_AXIS: ClassVar[int]
    Y_AXIS: ClassVar[int]
    Z_AXIS: ClassVar[int]
    joint_name: str
    component: int
    position: float
    velocity: float
    acceleration: float
    def __init__(self, *, joint_name: str = ..., component: int = ..., position: float = ..., velocity: float = ..., acceleration: float = ...) -> None: ...

class JointTolerance:
    name: str
    position: float
    velocity: float
    acceleration: float
    def __init__(self, *, name: str = ..., position: float = ..., velocity: float = ..., acceleration: float = ...) -> None: ...

class JointTrajectoryControllerState:
    header: std_msgs.msg.Header
    joint_names: list[str]
    reference: trajectory_msgs.msg.JointTrajectoryPoint
    feedback: trajectory_msgs.msg.JointTrajectoryPoint
    error: trajectory_msgs.msg.JointTrajectoryPoint
    output: trajectory_msgs.msg.JointTrajectoryPoint
    multi_dof_joint_names: list[str]
    multi_dof_reference: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_feedback: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_error: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    multi_dof_output: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint
    speed_scaling_factor: float
    def __init__(self, *, header: std_msgs.msg.Header = ..., joint_names: Sequence[str] = ..., reference: trajectory_msgs.msg.JointTrajectoryPoint = ..., feedback: trajectory_msgs.msg.JointTrajectoryPoint = ..., error: trajectory_msgs.msg.JointTrajectoryPoint = ..., output: trajectory_msgs.msg.JointTrajectoryPoint = ..., multi_dof_joint_names: Sequence[str] = ..., multi_dof_reference: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_feedback: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_error: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_output: trajectory_msgs.msg.MultiDOFJointTrajectoryPoint = ..., speed_scaling_factor: float = ...) -> None: ...
