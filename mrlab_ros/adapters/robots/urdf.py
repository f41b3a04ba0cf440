"""Reads the kinematics and the limits out of a URDF.

The nodes need no more of a robot, and no meshes; `assembly` reads whole robots with yourdfpy.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from mrlab_ros.adapters.robots.diagnostics import (
    A_URDF,
    DOCUMENT_TYPE,
    ELEMENT_LACKS,
    ELEMENT_UNNAMED,
    FINITE_COUNT,
    JOINT_AXIS,
    JOINT_NO_VELOCITY,
    JOINT_TYPE,
    LINK_CIRCLE,
    NAME_TOO_LONG,
    NO_LINK_IN_FILE,
    NOT_URDF,
    NOT_XML,
    ROOT_LINKS,
    STILL_XACRO,
    URDF_JOINT,
)
from mrlab_ros.core.base.checks import Words, bad_value
from mrlab_ros.core.base.diagnostics import FIELD
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Pose, quaternion_from_rpy, transform_from_xyz_rpy
from mrlab_ros.core.robots.frames import FixedFrame, LinkFrames, MovingFrame
from mrlab_ros.core.robots.model import Joint, KinematicChain, Segment

MOVING = ("revolute", "continuous", "prismatic")
# Of joints and links, characters: Bullet ends the process on one of a few thousand.
LONGEST_NAME = 200
# Of a line that is shown in an error, characters.
LONGEST_LINE = 80
# Prefixes of elements and attributes, and those that are declared.
PREFIX = re.compile(r"(?:</?|\s)([A-Za-z_][\w.-]*):[A-Za-z_][\w.-]*(?=[\s=/>])")
DECLARED = re.compile(r"xmlns:([A-Za-z_][\w.-]*)\s*=")
XACRO = "{http://www.ros.org/wiki/xacro}"


def parse(text: str, origin: str) -> ET.Element:
    """Return the root element of a URDF; `origin` names it in errors.

    Raises BadInput for text that is not XML, is not a URDF, declares a document type (whose
    entities can expand without end), or still holds xacro elements.
    """
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise BadInput(DOCUMENT_TYPE(file=origin))
    if not text.strip():
        raise bad_value(origin, None, A_URDF())
    try:
        root = ET.fromstring(_bound(text))
    except ET.ParseError as error:
        raise not_xml(origin, error, text) from None
    if root.tag != "robot":
        raise BadInput(NOT_URDF(file=origin, tag=root.tag))
    xacro = next((e.tag for e in root.iter() if str(e.tag).startswith(XACRO)), None)
    if xacro is not None:
        tag, name = xacro.removeprefix(XACRO), Path(origin).name
        raise BadInput(STILL_XACRO(file=origin, tag=tag, name=name))
    return root


def _bound(text: str) -> str:
    """Return a URDF whose prefixes all have a namespace: simulators' own elements often lack it,
    and the parsers of ROS do not mind."""
    used = set(PREFIX.findall(text)) - {"xacro", "xml", "xmlns", *DECLARED.findall(text)}
    names = "".join(f' xmlns:{prefix}="{prefix}"' for prefix in sorted(used))
    return text.replace("<robot", f"<robot{names}", 1) if names else text


def not_xml(origin: str, error: ET.ParseError, text: str) -> BadInput:
    """Return the error for a text that is no XML, with the line where that was noticed."""
    what = str(error).partition(": line")[0]
    row, lines = error.position[0], text.splitlines()
    line = lines[row - 1].strip() if 0 < row <= len(lines) else ""
    shown = line if len(line) <= LONGEST_LINE else f"{line[:LONGEST_LINE]} ..."
    return BadInput(NOT_XML(file=origin, why=what, line=row, found=shown))


def _attribute(element: ET.Element, tag: str, name: str, origin: str) -> str:
    child = element.find(tag)
    value = None if child is None else child.get(name)
    if value is None:
        given = element.get("name", "")
        raise BadInput(
            ELEMENT_LACKS(file=origin, element=element.tag, name=given, tag=tag, attribute=name)
        )
    return value


def numbers(text: str, count: int, place: Words, name: str) -> list[float]:
    """Return the `count` finite numbers in `text`, the value of `name`; raise BadInput."""
    try:
        values = [float(part) for part in text.split()]
    except ValueError:
        values = []
    if len(values) != count or not np.isfinite(values).all():
        what = FIELD(place=place, key=name)
        raise bad_value(what, text, FINITE_COUNT(count=count)) from None
    return values


@dataclass(frozen=True)
class Mimic:
    """position = multiplier * (position of `joint`) + offset"""

    joint: str
    multiplier: float
    offset: float


@dataclass(frozen=True)
class UrdfJoint:
    """A joint as the URDF has it; `limit` is None without a <limit> element."""

    name: str
    kind: str
    parent: str
    child: str
    xyz: list[float]
    rpy: list[float]
    axis: list[float]
    limit: dict[str, float] | None
    mimic: Mimic | None

    @property
    def moves(self) -> bool:
        return self.kind in MOVING

    @property
    def unit_axis(self) -> tuple[float, float, float]:
        length = float(np.linalg.norm(self.axis))
        x, y, z = (value / length for value in self.axis)
        return x, y, z

    @property
    def origin(self) -> Pose:
        """The joint's frame in the parent link's at position 0."""
        x, y, z = self.xyz
        roll, pitch, yaw = self.rpy
        return Pose((x, y, z), quaternion_from_rpy(roll, pitch, yaw))

    def segment(self) -> Segment:
        """Return the joint as a segment of a kinematic chain."""
        axis = None
        if self.moves:
            axis = np.array(self.unit_axis)
        return Segment(
            self.child, transform_from_xyz_rpy(self.xyz, self.rpy), axis, self.kind == "prismatic"
        )

    def limits(self, origin: str) -> Joint:
        """Return the joint's limits; a continuous joint's are one turn either way."""
        limit = self.limit
        if limit is None or "velocity" not in limit:
            place = URDF_JOINT(file=origin, joint=self.name)
            raise BadInput(JOINT_NO_VELOCITY(place=place))
        lower, upper = limit.get("lower", 0.0), limit.get("upper", 0.0)
        if self.kind == "continuous":
            lower, upper = -2 * np.pi, 2 * np.pi
        return Joint(self.name, lower, upper, limit["velocity"], limit.get("effort") or None)


def joints(root: ET.Element, origin: str) -> tuple[UrdfJoint, ...]:
    """Return the joints of a URDF in the order of the file."""
    return tuple(_joint(element, origin) for element in root.iterfind("joint"))


def _joint(element: ET.Element, origin: str) -> UrdfJoint:
    name, kind = element.get("name", ""), element.get("type", "")
    parent, child = (_attribute(element, end, "link", origin) for end in ("parent", "child"))
    if not name:
        raise BadInput(ELEMENT_UNNAMED(file=origin, element="joint", parent=parent, child=child))
    for given in (name, parent, child):
        if len(given) > LONGEST_NAME:
            raise BadInput(
                NAME_TOO_LONG(file=origin, count=len(given), name=given[:40], most=LONGEST_NAME)
            )
    where = URDF_JOINT(file=origin, joint=name)
    if kind not in (*MOVING, "fixed"):
        raise BadInput(JOINT_TYPE(place=where, type=kind, known=["fixed", *MOVING]))
    place = element.find("origin")
    xyz, rpy = "0 0 0", "0 0 0"
    if place is not None:
        xyz, rpy = place.get("xyz", xyz), place.get("rpy", rpy)
    axis = element.find("axis")
    limit = element.find("limit")
    mimic = element.find("mimic")
    direction = "1 0 0" if axis is None else axis.get("xyz", "1 0 0")
    joint = UrdfJoint(
        name=name,
        kind=kind,
        parent=parent,
        child=child,
        xyz=numbers(xyz, 3, where, "origin xyz"),
        rpy=numbers(rpy, 3, where, "origin rpy"),
        axis=numbers(direction, 3, where, "axis"),
        limit=None
        if limit is None
        else {key: numbers(value, 1, where, key)[0] for key, value in limit.items()},
        mimic=None if mimic is None else _mimic(mimic, where),
    )
    if joint.moves and not np.linalg.norm(joint.axis) > 1e-9:
        raise BadInput(JOINT_AXIS(place=where, axis=direction))
    return joint


def _mimic(element: ET.Element, where: Words) -> Mimic:
    multiplier, offset = (
        numbers(element.get(name, default), 1, where, f"mimic {name}")[0]
        for name, default in (("multiplier", "1"), ("offset", "0"))
    )
    return Mimic(element.get("joint", ""), multiplier, offset)


def path_to(tip: str, all_joints: tuple[UrdfJoint, ...]) -> tuple[str, tuple[UrdfJoint, ...]]:
    """Return the root link above `tip` and the joints that lead from it to `tip`."""
    by_child = {joint.child: joint for joint in all_joints}
    path: list[UrdfJoint] = []
    link = tip
    while link in by_child:
        joint = by_child[link]
        if joint in path:
            raise BadInput(LINK_CIRCLE(link=link))
        path.append(joint)
        link = joint.parent
    return link, tuple(reversed(path))


def chain(root: ET.Element, tip: str, origin: str) -> tuple[KinematicChain, tuple[Joint, ...]]:
    """Return the chain from the root link to `tip`, and its moving joints, base first."""
    all_joints = joints(root, origin)
    links = {element.get("name") for element in root.iterfind("link")}
    if tip not in links:
        known = sorted(map(str, links))
        raise BadInput(NO_LINK_IN_FILE(file=origin, link=tip, known=known))
    base, path = path_to(tip, all_joints)
    segments = tuple(joint.segment() for joint in path)
    return KinematicChain(base, segments), tuple(j.limits(origin) for j in path if j.moves)


def frames(root: ET.Element, origin: str) -> LinkFrames:
    """Return the frames of all links of a URDF, named as the links are.

    Raises BadInput where the links are no one tree.
    """
    all_joints = joints(root, origin)
    links = [str(element.get("name")) for element in root.iterfind("link")]
    children = {joint.child for joint in all_joints}
    roots = [link for link in links if link not in children]
    if len(roots) != 1:
        raise BadInput(ROOT_LINKS(file=origin, links=roots))
    for link in links:
        path_to(link, all_joints)  # refuses a circle
    return LinkFrames(
        roots[0],
        [FixedFrame(j.parent, j.child, j.origin) for j in all_joints if not j.moves],
        [_moving_frame(j) for j in all_joints if j.moves],
    )


def _moving_frame(joint: UrdfJoint) -> MovingFrame:
    mimic = joint.mimic or Mimic(joint.name, 1.0, 0.0)
    return MovingFrame(
        joint.parent,
        joint.child,
        joint.origin,
        joint.unit_axis,
        joint.kind == "prismatic",
        mimic.joint,
        mimic.multiplier,
        mimic.offset,
    )
