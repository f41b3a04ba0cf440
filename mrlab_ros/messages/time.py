"""ROS times and headers from nanoseconds and back."""

from __future__ import annotations

from builtin_interfaces.msg import Time
from std_msgs.msg import Header

from mrlab_ros.core.base.clock import SECOND


def time_to_message(ns: int) -> Time:
    """Return nanoseconds as a ROS time."""
    return Time(sec=ns // SECOND, nanosec=ns % SECOND)


def time_from_message(time: Time) -> int:
    """Return a ROS time in nanoseconds."""
    return int(time.sec) * SECOND + int(time.nanosec)


def make_header(ns: int, frame_id: str = "") -> Header:
    """Return a header with the stamp `ns`, nanoseconds of the ROS clock."""
    return Header(stamp=time_to_message(ns), frame_id=frame_id)
