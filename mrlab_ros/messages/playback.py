"""The state of a playback and its clock as messages."""

from __future__ import annotations

from mrlab_msgs import msg

from mrlab_ros.core.clock import PlaybackClock
from mrlab_ros.core.playback.playback import PlaybackStatus
from mrlab_ros.messages.time import make_header, time_to_message


def clock_to_message(clock: PlaybackClock) -> msg.PlaybackClock:
    return msg.PlaybackClock(
        stamp=time_to_message(clock.stamp_ns), position=clock.position, rate=clock.rate
    )


def status_to_message(now_ns: int, robot: str, status: PlaybackStatus) -> msg.PlaybackState:
    trajectory = status.trajectory
    return msg.PlaybackState(
        header=make_header(now_ns, robot),
        state=status.state.value,
        label=status.state.name,
        message=status.message,
        trajectory_id=trajectory.id if trajectory else "",
        clock=clock_to_message(status.clock),
        frame=status.frame,
        frame_count=trajectory.frame_count if trajectory else 0,
        frame_rate=trajectory.frame_rate if trajectory else 0.0,
        duration=trajectory.duration if trajectory else 0.0,
        rate=status.rate,
        loop=status.loop,
        system=status.system,
    )
