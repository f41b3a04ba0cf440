"""A playback's state, clock, telemetry and grasp targets as messages."""

from __future__ import annotations

from collections.abc import Callable

from mrlab_msgs import msg

from mrlab_ros.core.base.clock import PlaybackClock
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.playback.execution import PlaybackStatus
from mrlab_ros.core.trajectory.trajectory import Trajectory
from mrlab_ros.messages.poses import transform_to_pose_message
from mrlab_ros.messages.texts import told
from mrlab_ros.messages.time import make_header, time_to_message


def clock_to_message(clock: PlaybackClock) -> msg.PlaybackClock:
    return msg.PlaybackClock(
        stamp=time_to_message(clock.stamp_ns), position=clock.position, rate=clock.rate
    )


def status_to_message(
    now_ns: int, robot: str, status: PlaybackStatus, host: str = "", lab: str = ""
) -> msg.PlaybackState:
    """host: the node that plays the robot. lab: the id of its lab; empty: unknown."""
    trajectory = status.trajectory
    return msg.PlaybackState(
        header=make_header(now_ns, robot),
        state=status.state.value,
        label=status.state.name,
        **told(status.message),
        trajectory_id=trajectory.id if trajectory else "",
        trajectory_version=trajectory.version if trajectory else 0,
        clock=clock_to_message(status.clock),
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
