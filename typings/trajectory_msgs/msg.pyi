# Generated from the message definitions by `make docs`.
from collections.abc import Sequence
import builtin_interfaces.msg
import geometry_msgs.msg
import std_msgs.msg
from message_bases import Numbers
from message_bases import NumbersField

class JointTrajectory:
    header: std_msgs.msg.Header
    joint_names: list[str]
    points: list[JointTrajectoryPoint]
    def __init__(self, *, header: std_msgs.msg.Header = ..., joint_names: Sequence[str] = ..., points: Sequence[JointTrajectoryPoint] = ...) -> None: ...

class JointTrajectoryPoint:
    positions: NumbersField[float]
    velocities: NumbersField[float]
    accelerations: NumbersField[float]
    effort: NumbersField[float]
    time_from_start: builtin_interfaces.msg.Duration
    def __init__(self, *, positions: Numbers[float] = ..., velocities: Numbers[float] = ..., accelerations: Numbers[float] = ..., effort: Numbers[float] = ..., time_from_start: builtin_interfaces.msg.Duration = ...) -> None: ...

class MultiDOFJointTrajectory:
    header: std_msgs.msg.Header
    joint_names: list[str]
    points: list[MultiDOFJointTrajectoryPoint]
    def __init__(self, *, header: std_msgs.msg.Header = ..., joint_names: Sequence[str] = ..., points: Sequence[MultiDOFJointTrajectoryPoint] = ...) -> None: ...

class MultiDOFJointTrajectoryPoint:
    transforms: list[geometry_msgs.msg.Transform]
    velocities: list[geometry_msgs.msg.Twist]
    accelerations: list[geometry_msgs.msg.Twist]
    time_from_start: builtin_interfaces.msg.Duration
    def __init__(self, *, transforms: Sequence[geometry_msgs.msg.Transform] = ..., velocities: Sequence[geometry_msgs.msg.Twist] = ..., accelerations: Sequence[geometry_msgs.msg.Twist] = ..., time_from_start: builtin_interfaces.msg.Duration = ...) -> None: ...
