"""A robot as a page needs it: its URDF and its moving joints with their limits."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.library import TIP, RobotLibrary
from mrlab_ros.core.show.document import ShownJoint, ShownRobot


def shown_robot(model: str, end_effector: str, description: str, tip: str = TIP) -> ShownRobot:
    """Return the robot of a URDF, end effector included; its joints lead to the link `tip`.

    Raises BadInput where the text is not a URDF or has no such link.
    """
    origin = f"{model}/robot.urdf"
    joints = joints_to(urdf.parse(description, origin), tip, origin)
    return ShownRobot(model, end_effector, description, joints)


def joints_to(root: ET.Element, tip: str, origin: str) -> tuple[ShownJoint, ...]:
    """Return the moving joints that lead to the link `tip`, base first; raise BadInput."""
    _, path = urdf.path_to(tip, urdf.joints(root, origin))
    return tuple(_joint(joint) for joint in path if joint.moves)


def from_library(library: RobotLibrary, model: str, end_effector: str | None) -> ShownRobot:
    """Return a robot of the library; raise BadInput for an unknown id."""
    tip = str(library.facts(model).get("tip_link", TIP))
    description = library.description(model, end_effector)
    return shown_robot(model, end_effector or "", description, tip)


def _joint(joint: urdf.UrdfJoint) -> ShownJoint:
    limit = joint.limit or {}
    bounded = joint.kind != "continuous" and joint.limit is not None
    return ShownJoint(
        name=joint.name,
        kind=joint.kind,
        lower=limit.get("lower", 0.0) if bounded else None,
        upper=limit.get("upper", 0.0) if bounded else None,
        velocity=limit.get("velocity"),
    )
