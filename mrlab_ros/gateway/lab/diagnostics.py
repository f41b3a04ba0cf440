"""Diagnostics of the lab behind the gateway, and of messages by their definitions."""

from __future__ import annotations

from mrlab_ros.core.base.diagnostic import Code

LAB_UNCONNECTED = Code(
    "lab_unconnected",
    "The gateway has no connection to the lab.",
    "Check that the lab runs, and the gateway's endpoint.",
)
NOBODY_ANSWERS = Code(
    "nobody_answers",
    "Nobody answers {key}: its node does not run, the robot is not there, or the gateway's key "
    "may not call it.",
    meaning="A call over the web was answered by nobody of the lab.",
)
CALL_TIMED_OUT = Code(
    "call_timed_out",
    "{key} did not answer within {timeout:time}.",
    "Check whether its node runs, then try again.",
)
UNKNOWN_TYPE = Code(
    "unknown_message_type",
    "{type} is no known message type.",
    "Expected a standard type or one of mrlab_msgs, such as mrlab_msgs/msg/Robots or "
    "mrlab_msgs/srv/Seek_Request.",
)
NO_SUCH_FIELD = Code(
    "no_such_field", "{type} has no field {names:either}[; it has {fields:list}]."
)
NOT_OF_TYPE = Code(
    "not_of_type",
    "{found} is no {type}: {why:problem}.",
    "Give each field a value of its type.",
)
BYTES_NOT_OF_TYPE = Code(
    "bytes_not_of_type",
    "{size:bytes} are no {type}: {why:problem}.",
    "Check that both sides have the same message definitions.",
)
PACKAGE_MISSING = Code(
    "package_missing",
    "The package {package} is not installed here.",
    "Build it with `make`, or with colcon on a ROS machine.",
)
