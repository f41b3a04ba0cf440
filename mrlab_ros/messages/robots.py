"""The robots of the scene as messages."""

from __future__ import annotations

from collections.abc import Iterable

from mrlab_msgs import msg
from std_msgs.msg import String

from mrlab_ros.core.scene.robots import PlacedRobot
from mrlab_ros.messages.poses import pose_to_message
from mrlab_ros.messages.time import make_header


def robot_to_message(robot: PlacedRobot) -> msg.Robot:
    return msg.Robot(
        name=robot.name,
        model=robot.model,
        end_effector=robot.end_effector or "",
        pose=pose_to_message(robot.pose),
        joint_names=list(robot.joint_names),
    )


def robots_to_message(now_ns: int, robots: Iterable[PlacedRobot], lab: str = "") -> msg.Robots:
    """lab: the id of the lab they stand in; empty: unknown."""
    return msg.Robots(
        header=make_header(now_ns, "world"),
        robots=[robot_to_message(robot) for robot in robots],
        lab=lab,
    )


def text_to_message(text: str) -> String:
    """Return a text, such as a robot's URDF, as a message."""
    return String(data=text)
