"""Goals, feedback and results of FollowJointTrajectory, and joint commands."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from mrlab_ros.core.base.clock import SECOND
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.playback.goal import Goal, Point
from mrlab_ros.core.playback.pursuit import Bounds, Instant, Outcome
from mrlab_ros.messages.time import make_header, time_from_message


def goal_from_message(message: JointTrajectory) -> Goal:
    return Goal(
        tuple(message.joint_names),
        tuple(
            Point(
                _seconds(point.time_from_start),
                point.positions,
                point.velocities,
                point.accelerations,
                point.effort,
            )
            for point in message.points
        ),
        time_from_message(message.header.stamp),
    )


def bounds_from_goal(goal: Any) -> Bounds:
    """Return the tolerances of a FollowJointTrajectory.Goal."""
    return Bounds(
        _positions(goal.path_tolerance),
        _positions(goal.goal_tolerance),
        _seconds(goal.goal_time_tolerance),
    )


def feedback_to_message(now_ns: int, robot: str, joints: Iterable[str], instant: Instant) -> Any:
    return FollowJointTrajectory.Feedback(
        header=make_header(now_ns, robot),
        joint_names=list(joints),
        desired=_point(instant, instant.desired, instant.desired_velocities),
        actual=_point(instant, instant.actual),
        error=_point(instant, instant.desired - instant.actual),
    )


def result_to_message(outcome: Outcome) -> Any:
    return FollowJointTrajectory.Result(
        error_code=outcome.code.value, error_string=str(outcome.said)
    )


def _positions(tolerances: Iterable[Any]) -> dict[str, float]:
    return {tolerance.name: tolerance.position for tolerance in tolerances}


def _seconds(duration: Duration) -> float:
    return float(duration.sec + duration.nanosec / SECOND)


def _point(
    instant: Instant, positions: Array, velocities: Array | None = None
) -> JointTrajectoryPoint:
    whole = int(instant.elapsed * SECOND)
    return JointTrajectoryPoint(
        positions=positions.tolist(),
        velocities=[] if velocities is None else velocities.tolist(),
        time_from_start=Duration(sec=whole // SECOND, nanosec=whole % SECOND),
    )
