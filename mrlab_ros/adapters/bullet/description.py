"""A robot description prepared for Bullet: prescribed, force-driven and fixed links."""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from mrlab_ros.adapters.bullet.diagnostics import NO_COLLISION_MESH, NO_MOVING_JOINT
from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.diagnostics import ROOT_LINKS
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Vector
from mrlab_ros.core.physics.engine import Arm, Finger

PRESCRIBED_MASS = 1e6  # kg, and kg*m^2, of every link that joint states prescribe
LINK_SIZE = 0.15  # m, what a link reaches beyond its frame
LEAST_MASS = 0.05  # kg, of a finger without an <inertial>
MESH_FORMATS = (".obj", ".stl")
FINGER_VELOCITY = 0.1  # m/s or rad/s, where the description has none
FINGER_FORCE = 50.0  # N or N*m, where the description has none


class Description:
    """The links and joints of a description, sorted into prescribed, finger and fixed ones.

    joints: the prescribed ones, in order. Raises BadInput where the description lacks one.
    """

    def __init__(self, text: str, joints: tuple[str, ...], robot: str) -> None:
        origin = f"the description of {robot}"
        self._root = urdf.parse(text, origin)
        everything = urdf.joints(self._root, origin)
        named = {joint.name: joint for joint in everything}
        missing = [name for name in joints if name not in named or not named[name].moves]
        if missing:
            raise BadInput(NO_MOVING_JOINT(robot=robot, missing=missing, known=[*named]))
        children = {joint.child for joint in everything}
        links = [str(link.get("name")) for link in self._root.iterfind("link")]
        roots = [link for link in links if link not in children]
        if len(roots) != 1:
            raise BadInput(ROOT_LINKS(file=origin, links=roots))
        self.base = roots[0]
        self._by_name, self._prescribed = named, joints
        self.links = links
        self._parent = {joint.child: joint for joint in everything}
        fingers = [j for j in everything if j.moves and j.name not in joints]
        self.fingers = tuple(_finger(joint) for joint in fingers)
        self.couplings = _couplings(fingers)
        # A body that is rigidly fixed to a finger, such as a pad, is that finger.
        moved = {joint.child for joint in fingers}
        self.finger_of = {link: self._group(link) for link in links if self._group(link) in moved}
        self.finger_links = set(self.finger_of)
        self.fixed_links = {link for link in links if self._group(link) == self.base}
        tip = "tool0" if "tool0" in links else links[-1]
        self.tool_links = {link for link in links if tip in self._above(link)}
        shaped = {
            str(link.get("name"))
            for link in self._root.iterfind("link")
            if link.find("collision") is not None
        }
        self.tool = tip
        if fingers:
            self.hand = next(j for j in fingers if self._group(j.parent) not in moved).parent
        else:
            self.hand = next((x for x in reversed(links) if x in self.tool_links & shaped), tip)
        rigid = {link for link in links if self._group(link) == self._group(self.hand)}
        self.grip_links = rigid | self.finger_links
        self._masses = {
            str(link.get("name")): float(mass.get("value", 0))
            for link in self._root.iterfind("link")
            if (mass := link.find("inertial/mass")) is not None
        }

    def _above(self, link: str) -> list[str]:
        above = []
        while link in self._parent:
            link = self._parent[link].parent
            above.append(link)
        return above

    def _group(self, link: str) -> str:
        """Return the topmost link that `link` is rigidly fixed to."""
        while link in self._parent and not self._parent[link].moves:
            link = self._parent[link].parent
        return link

    def neighbours(self) -> Iterator[tuple[str, str]]:
        """Yield each pair of links that may overlap: one rigid group, joined by one joint, or both
        of the hand, whose fingers may close on each other and on the palm."""
        for i, a in enumerate(self.links):
            for b in self.links[i + 1 :]:
                ga, gb = self._group(a), self._group(b)
                joined = any(
                    x in self._parent and self._group(self._parent[x].parent) == y
                    for x, y in ((ga, gb), (gb, ga))
                )
                if ga == gb or joined or {a, b} <= self.grip_links:
                    yield a, b

    def _below(self, link: str) -> float:
        """Return the longest way from `link` to an end of the chain, m; LINK_SIZE at the end."""
        ways = [
            math.hypot(*joint.xyz) + self._below(joint.child)
            for joint in self._parent.values()
            if joint.parent == link
        ]
        return max(ways, default=LINK_SIZE)

    def _lever(self, joint: str) -> float:
        """Return how far, m, the arm's end moves at most while a joint moves by 1 rad or 1 m."""
        return 1.0 if self.axis(joint)[1] else self._below(self._by_name[joint].child)

    def chain(self, link: str) -> list[str]:
        """Return the finger joints that move `link`, from the hand outwards."""
        found = []
        own = {finger.joint for finger in self.fingers}
        for above in (link, *self._above(link)):
            joint = self._parent.get(above)
            if joint is not None and joint.name in own:
                found.append(joint.name)
        return found[::-1]

    def axis(self, joint: str) -> tuple[Vector, bool]:
        """Return a joint's unit axis in the frame of its link, and whether it slides along it."""
        x, y, z = self._by_name[joint].axis
        size = math.hypot(x, y, z) or 1.0
        return (x / size, y / size, z / size), self._by_name[joint].kind == "prismatic"

    def facts(self, closes: Sequence[float]) -> Arm:
        """closes: of each finger, 1 where its upper limit is closed, -1 where its lower one is."""
        fingers = tuple(
            replace(finger, closes=way) for finger, way in zip(self.fingers, closes, strict=True)
        )
        return Arm(
            fingers,
            self.hand,
            frozenset(self.tool_links),
            frozenset(self.fixed_links),
            tuple(self._lever(name) for name in self._prescribed),
            self.tool,
            frozenset(self.grip_links),
            self._grip_force(),
            sum(self._masses.get(link, 0.0) for link in self.tool_links),
            sum(self._masses.get(x, 0.0) for x in self.links if x not in self.fixed_links),
        )

    def _grip_force(self) -> float:
        """Return what the fingers press with together, N: each chain of finger joints with the
        force of its first joint, or with its torque on the lever to its end."""
        total = 0.0
        for finger in self.fingers:
            if self.chain(finger.link)[0] != finger.joint:
                continue
            lever = 1.0 if self.axis(finger.joint)[1] else self._below(finger.link)
            total += finger.max_force / lever
        return total

    def text(self, resolve: Callable[[str], Path]) -> str:
        """Return the URDF that Bullet reads: masses, collision meshes with paths, no visuals.

        Raises BadInput where a mesh is missing.
        """
        for joint in self._root.iterfind("joint"):
            for mimic in joint.findall("mimic"):
                joint.remove(mimic)
            if joint.get("name") in self._prescribed and joint.get("type") == "revolute":
                # Joint states are not limited here, and a limit costs a constraint in each step.
                joint.set("type", "continuous")
        for link in self._root.iterfind("link"):
            for element in link.findall("visual"):
                link.remove(element)
            _weigh(link, link.get("name") not in self.finger_links)
            for mesh in link.iter("mesh"):
                uri = mesh.get("filename", "")
                path = resolve(uri)
                if path.suffix.lower() not in MESH_FORMATS or not path.is_file():
                    raise BadInput(
                        NO_COLLISION_MESH(
                            mesh=uri, link=link.get("name", ""), formats=[*MESH_FORMATS]
                        )
                    )
                mesh.set("filename", os.fspath(path))
        return ET.tostring(self._root, encoding="unicode")


@dataclass(frozen=True)
class Coupling:
    """A finger that follows another: position = multiplier * (position of `leader`) + offset.

    leader, follower: their places among the fingers.
    """

    leader: int
    follower: int
    multiplier: float
    offset: float


def _couplings(fingers: list[urdf.UrdfJoint]) -> tuple[Coupling, ...]:
    """Return how fingers follow each other; one that mimics no finger is driven by itself."""
    place = {joint.name: i for i, joint in enumerate(fingers)}
    return tuple(
        Coupling(place[mimic.joint], i, mimic.multiplier, mimic.offset)
        for i, joint in enumerate(fingers)
        if (mimic := joint.mimic) is not None and mimic.joint in place and mimic.multiplier
    )


def _finger(joint: urdf.UrdfJoint) -> Finger:
    limit = joint.limit or {}
    return Finger(
        joint.name,
        joint.child,
        limit.get("lower", 0.0),
        limit.get("upper", 0.0),
        limit.get("velocity", 0.0) or FINGER_VELOCITY,
        limit.get("effort", 0.0) or FINGER_FORCE,
    )


def _weigh(link: ET.Element, prescribed: bool) -> None:
    """Set the mass: PRESCRIBED_MASS, or LEAST_MASS of a finger without <inertial>."""
    inertial = link.find("inertial")
    if inertial is not None:
        if not prescribed:
            return
        link.remove(inertial)
    mass = PRESCRIBED_MASS if prescribed else LEAST_MASS
    moment = mass if prescribed else mass * 0.05**2
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "mass", value=repr(mass))
    moments = dict.fromkeys(("ixx", "iyy", "izz"), repr(moment))
    ET.SubElement(inertial, "inertia", moments | dict.fromkeys(("ixy", "ixz", "iyz"), "0"))
