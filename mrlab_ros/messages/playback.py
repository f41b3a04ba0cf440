"""State, clock, telemetry, grasp targets, goals and joint commands of a playback as messages.

Telemetry is written as CDR past rclpy, which takes ten times as long. Layout of
a mrlab_msgs/Telemetry: as joint_states.py describes it up to the names; then

    uint32 count, zeros to a multiple of 8, float64 velocities
    uint32 count, zeros to a multiple of 8, float64 effort proxies
    uint32 frame, 4 zeros, float64 position, 2 booleans, 6 zeros, 7 float64 of the pose of tool0
    string held_object, zeros to a multiple of 8
    float64 mass, payload, slip margin, wrist moment, deadline error and its largest
    uint32 frames sent, uint32 frames lost
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Mapping
from functools import lru_cache
from typing import Any

from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory
from mrlab_msgs import msg
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from mrlab_ros.core.base.clock import SECOND, PlaybackClock
from mrlab_ros.core.base.geometry import Array, Pose
from mrlab_ros.core.base.phrase import ended
from mrlab_ros.core.playback import diagnostics as say
from mrlab_ros.core.playback.execution import PlaybackStatus
from mrlab_ros.core.playback.goal import Goal, Point, WrongGoal
from mrlab_ros.core.playback.pursuit import Bounds, Instant, Outcome, Tolerances
from mrlab_ros.core.playback.stream import Sample
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages import cdr
from mrlab_ros.messages.cdr import BODY, COUNT, DOUBLE_SIZE, STAMP
from mrlab_ros.messages.poses import transform_to_pose_message
from mrlab_ros.messages.texts import told
from mrlab_ros.messages.time import make_header, time_from_message, time_to_message


def clock_to_message(clock: PlaybackClock, shifted_ns: int) -> msg.PlaybackClock:
    """shifted_ns: by how much stamps are ahead of the clock's instants."""
    return msg.PlaybackClock(
        stamp=time_to_message(clock.stamp_ns + shifted_ns),
        position=clock.position,
        rate=clock.rate,
    )


def status_to_message(
    now_ns: int,
    robot: str,
    status: PlaybackStatus,
    host: str = "",
    lab: str = "",
    shifted_ns: int = 0,
) -> msg.PlaybackState:
    """Return the state at the instant `now_ns`.

    host: the node that plays the robot. lab: the id of its lab; empty: unknown. shifted_ns: by how
    much stamps are ahead of instants.
    """
    trajectory = status.trajectory
    return msg.PlaybackState(
        header=make_header(now_ns + shifted_ns, robot),
        state=status.state.value,
        label=status.state.name,
        **told(status.message),
        trajectory_id=trajectory.id if trajectory else "",
        trajectory_version=trajectory.version if trajectory else 0,
        clock=clock_to_message(status.clock, shifted_ns),
        frame=status.frame,
        frame_count=trajectory.frame_count if trajectory else 0,
        frame_rate=trajectory.frame_rate if trajectory else 0.0,
        duration=trajectory.duration if trajectory else 0.0,
        rate=status.rate,
        loop=status.loop,
        system=status.system,
        host=host,
        lab=lab,
    )


def targets_to_message(
    now_ns: int, robot: str, trajectory: Trajectory | None, tool0: Callable[[Array], Array]
) -> msg.GraspTargets:
    """Return where the gripper opens and closes along a trajectory; None: nowhere.

    tool0: the forward kinematics, (N, J) rad -> (N, 4, 4) T_base_tool0.
    """
    header = make_header(now_ns, f"{robot}/base_link")
    if trajectory is None or not trajectory.grasp_frames:
        return msg.GraspTargets(header=header, trajectory_id=trajectory.id if trajectory else "")
    frames = [frame for frame, _ in trajectory.grasp_frames]
    poses = tool0(trajectory.positions[frames])
    return msg.GraspTargets(
        header=header,
        trajectory_id=trajectory.id,
        targets=[
            msg.GraspTarget(
                frame=frame,
                time=frame / trajectory.frame_rate,
                close=closed,
                tool0=transform_to_pose_message(pose),
            )
            for (frame, closed), pose in zip(trajectory.grasp_frames, poses, strict=True)
        ],
    )


END = struct.Struct("<6d2I")
NO_GRASP = msg.Grasp()


@lru_cache(maxsize=64)
def _object(name: str) -> bytes:
    """Return the name of an object with the zeros up to the next number."""
    data = cdr.text(name)
    return data + bytes(-len(data) % DOUBLE_SIZE)


class TelemetryEncoder:
    """Writes the telemetry of one robot."""

    def __init__(self, robot: str, joint_names: tuple[str, ...]) -> None:
        self._head = bytearray(cdr.head(robot, joint_names))
        self._joints = joints = len(joint_names)
        begin = len(self._head)
        gap = cdr.doubles_at(begin, joints) - begin - COUNT.size
        self._values = struct.Struct(f"<I{gap}x{joints}dI4x{joints}dI4xd??6x7d")

    def encode(
        self,
        now_ns: int,
        trajectory: Trajectory,
        sample: Sample,
        tool0: Pose,
        grasp: msg.Grasp | None,
        *,
        sent: int,
        lost: int,
        error_ns: int,
        error_max_ns: int,
    ) -> bytes:
        """Return the CDR of the display values of a joint state.

        tool0: in the robot's base_link. grasp: what physics said last of the gripper; None: there
        is no physics. sent, lost: frames of this run. error_ns, error_max_ns: how late the last
        joint state was published, and the latest of the run.
        """
        closed = trajectory.gripper_at(sample.position)
        STAMP.pack_into(self._head, BODY, now_ns // SECOND, now_ns % SECOND)
        values = self._values.pack(
            self._joints,
            *sample.velocities.tolist(),
            self._joints,
            *trajectory.channels.effort_proxy[sample.frame].tolist(),
            sample.frame,
            sample.position,
            closed is not None,
            bool(closed),
            *tool0.position,
            *tool0.orientation,
        )
        bears = grasp or NO_GRASP
        end = END.pack(
            bears.mass,
            bears.payload,
            bears.slip_margin,
            bears.wrist_moment,
            error_ns * 1e-9,
            error_max_ns * 1e-9,
            sent,
            lost,
        )
        return b"".join((self._head, values, _object(bears.object), end))


def own_names(names: Iterable[str], own: Mapping[str, str]) -> tuple[str, ...]:
    """Return the names of a robot's joints; own: them by their names among all robots' joints."""
    return tuple(own.get(name, name) for name in names)


def goal_from_message(message: JointTrajectory, own: Mapping[str, str]) -> Goal:
    """own: as own_names() takes it."""
    return Goal(
        own_names(message.joint_names, own),
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


def bounds_from_goal(goal: Any, own: Mapping[str, str]) -> Bounds:
    """Return the tolerances of a FollowJointTrajectory.Goal; raise WrongGoal for components.

    own: as own_names() takes it.
    """
    for name in ("component_path_tolerance", "component_goal_tolerance"):
        if getattr(goal, name):
            raise WrongGoal(say.HAS_MULTI_DOF(field=name))
    return Bounds(
        _by_joint(goal.path_tolerance, own),
        _by_joint(goal.goal_tolerance, own),
        _seconds(goal.goal_time_tolerance),
    )


def feedback_to_message(now_ns: int, robot: str, joints: Iterable[str], instant: Instant) -> Any:
    return FollowJointTrajectory.Feedback(
        header=make_header(now_ns, robot),
        joint_names=list(joints),
        desired=point(instant, instant.desired, instant.desired_velocities),
        actual=point(instant, instant.actual, instant.actual_velocities),
        error=point(instant, instant.errors[0], instant.errors[1]),
    )


def result_to_message(outcome: Outcome) -> Any:
    """Return the result, whose sentence is the reason, then the figures."""
    said = filter(None, (outcome.said, outcome.figures))
    return FollowJointTrajectory.Result(
        error_code=outcome.code.value, error_string=" ".join(ended(str(each)) for each in said)
    )


def _by_joint(tolerances: Iterable[Any], own: Mapping[str, str]) -> Tolerances:
    return {
        own.get(each.name, each.name): (each.position, each.velocity, each.acceleration)
        for each in tolerances
    }


def _seconds(duration: Duration) -> float:
    return float(duration.sec + duration.nanosec / SECOND)


def point(
    instant: Instant, positions: Array, velocities: Array | None = None
) -> JointTrajectoryPoint:
    whole = int(instant.elapsed * SECOND)
    return JointTrajectoryPoint(
        positions=positions.tolist(),
        velocities=[] if velocities is None else velocities.tolist(),
        time_from_start=Duration(sec=whole // SECOND, nanosec=whole % SECOND),
    )
