"""The library of robot models and end effectors: one folder each, composed into one URDF.

What a description says to those that draw it: packed levels of detail, and hoses that bend.

Both are elements beside the links, which readers of URDF skip:

    <level_of_detail near="package://.../ur5e/lod/near.glb" far="package://.../ur5e/lod/far.glb"/>
    <hose radius="0.02" length="0.9">
      <end link="link_1" xyz="0 0 0" direction="0 0 1"/>
      <end link="link_3" xyz="0 0 0" direction="1 0 0"/>
    </hose>

A robot as a page needs it: its URDF and its moving joints with their limits.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from mrlab_ros.adapters.diagnostics import FILE_UNREADABLE
from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.diagnostics import (
    END_EFFECTOR_LEFT_OUT,
    HAND_OF_ITS_OWN,
    HOME_SIZE,
    NO_END_EFFECTOR,
    NO_ROBOT_MODEL,
    ROBOT_MESH_URI,
    SAME_NAMES,
)
from mrlab_ros.adapters.robots.end_effectors import (
    ABOVE_PLATE,
    BELOW_PLATE,
    END_EFFECTORS,
    FACTS,
    PLATE,
    EndEffector,
    read_folder,
)
from mrlab_ros.adapters.share import imported_folder
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.checks import bad_value
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.diagnostics import FIELD, ONE_OF
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.physics.grasp import kinds
from mrlab_ros.core.physics.grasp.kinds import KINDS, Gripper
from mrlab_ros.core.physics.grasp.load import Tool
from mrlab_ros.core.robots.model import RobotModel, ShownJoint, ShownRobot

TIP = "tool0"
MESH_PREFIX = "package://mrlab_ros/robots/"
ADAPTER_THICKNESS = 0.012  # m


class RobotLibrary:
    """The models below a folder: <id>/robot.{yaml,urdf}, end_effectors/<id>/...

    imported: a second folder with the same layout, for imported robots; None: the user's own.
    """

    def __init__(self, folder: Path, imported: Path | None = None) -> None:
        self.folder = folder
        self.imported = imported_folder() if imported is None else imported
        # Models do not change while a lab runs, so each is read once.
        self._model = cache(self._read_model)

    def ids(self) -> tuple[str, ...]:
        """Return the ids of the robots, sorted."""
        own = _folders_with(self.folder, "robot.yaml")
        return tuple(sorted({*own, *_folders_with(self.imported, "robot.yaml")}))

    def end_effectors(self) -> tuple[str, ...]:
        """Return the ids of the end effectors, sorted."""
        places = (folder / END_EFFECTORS for folder in (self.folder, self.imported))
        return tuple(sorted({i for place in places for i in _folders_with(place, FACTS)}))

    def model(self, robot_id: str) -> RobotModel:
        """Return a robot model; raise BadInput that names the known ids."""
        return self._model(robot_id)

    def facts(self, robot_id: str) -> dict[str, Any]:
        """Return the content of robot.yaml."""
        return read_yaml(self._robot_folder(robot_id) / "robot.yaml")

    def description(self, robot_id: str, end_effector: str | None = None) -> str:
        """Return the URDF of a robot with its end effector (None or empty: bare flange)."""
        text = self.own_description(robot_id)
        override = self.imported / robot_id / "robot.urdf"
        beside: list[ET.Element] = []
        facts = self.facts(robot_id)
        if override.is_file():
            text = _read(override)
            beside += levels(override.parent, f"{MESH_PREFIX}{robot_id}", VENDOR)
        else:
            folder = self._robot_folder(robot_id)
            beside += levels(folder, f"{MESH_PREFIX}{robot_id}") + hoses(facts)
        if not end_effector:
            return added(text, beside)
        robot = urdf.parse(text, f"{robot_id}/robot.urdf")
        tool = self.end_effector(end_effector).root
        if facts.get("hand"):
            raise BadInput(HAND_OF_ITS_OWN(robot=robot_id))
        place = f"{END_EFFECTORS}/{end_effector}"
        beside += levels(self._end_effector_folder(end_effector), f"{MESH_PREFIX}{place}")
        return added(_composed(robot, tool, facts, end_effector), beside)

    def own_description(self, robot_id: str) -> str:
        """Return the bare robot's URDF with the lab's own meshes, ignoring imported ones."""
        return _read(self._robot_folder(robot_id) / "robot.urdf")

    def hand(self, robot_id: str) -> frozenset[str]:
        """Return the joints of a robot's own hand; empty where it has none."""
        return frozenset(map(str, self.facts(robot_id).get("hand", ())))

    def mesh_path(self, uri: str) -> Path:
        """Return the file that a mesh URI of one of the library's URDFs names."""
        if not uri.startswith(MESH_PREFIX):
            raise BadInput(ROBOT_MESH_URI(mesh=uri, prefix=MESH_PREFIX))
        place = uri.removeprefix(MESH_PREFIX)
        own = self.folder / place
        return own if own.is_file() else self.imported / place

    def end_effector(self, end_effector: str) -> EndEffector:
        """Return an end effector; raise BadInput that names the known ids, or its mistakes."""
        return read_folder(self._end_effector_folder(end_effector), self.mesh_path)

    def sound_end_effectors(self) -> tuple[dict[str, EndEffector], list[Diagnostic]]:
        """Return the end effectors by id, and why others cannot be carried."""
        sound, problems = {}, []
        for tool in self.end_effectors():
            try:
                sound[tool] = self.end_effector(tool)
            except BadInput as error:
                why = error.diagnostic
                problems.append(END_EFFECTOR_LEFT_OUT(end_effector=tool, why=why))
        return sound, problems

    def gripper(self, robot_id: str, end_effector: str) -> Gripper:
        """Return how an end effector holds; empty: what the robot has of its own, if any.

        Raises BadInput for an unknown id, and where a file does not say a way that there is.
        """
        if end_effector:
            return self.end_effector(end_effector).facts.gripper
        said = self.facts(robot_id).get("gripper", kinds.FINGERS.name)
        if said not in KINDS:
            what = FIELD(place=f"{robot_id}/robot.yaml", key="gripper")
            raise bad_value(what, said, ONE_OF(choices=[*KINDS]))
        return KINDS[said]

    def hand_facts(self, robot_id: str, end_effector: str) -> Tool:
        """Return what is stated of a robot's hand; raise BadInput for an unknown id."""
        robot = self.facts(robot_id)
        force, radius = float(robot.get("force", 0.0)), float(robot.get("lip_radius", 0.0))
        if end_effector:
            facts = self.end_effector(end_effector).facts
            force, radius = facts.force, facts.lip_radius
        payload = float(robot.get("payload") or 0.0)
        return Tool(payload, force, radius, str(robot.get("tip_link", "")))

    def collision_description(self, robot_id: str, end_effector: str | None = None) -> str:
        """Return the URDF without visuals and with mesh paths in place of URIs.

        That is what a physics engine reads: convex hulls, and a mass for every link, since an
        engine takes 1 kg for a frame that has none.
        """
        root = urdf.parse(self.description(robot_id, end_effector), robot_id)
        for link in root.iterfind("link"):
            for visual in link.findall("visual"):
                link.remove(visual)
        state_masses(root)
        for mesh in root.iterfind("link/collision/geometry/mesh"):
            mesh.set("filename", str(self.mesh_path(str(mesh.get("filename")))))
        return ET.tostring(root, encoding="unicode")

    def never_touch(self, robot_id: str) -> frozenset[frozenset[str]]:
        """Return `never_touch` of robot.yaml: pairs of links whose hulls may overlap.

        Raises BadInput for an unknown robot.
        """
        return frozenset(frozenset(pair) for pair in self.facts(robot_id).get("never_touch", ()))

    def touching_links(
        self, robot_id: str, end_effector: str | None = None
    ) -> frozenset[frozenset[str]]:
        """Return the pairs of links whose contacts are ignored.

        Each link with collision geometry and the next one in the chain, which always touch, and
        the pairs of `never_touch`.
        """
        root = urdf.parse(self.description(robot_id, end_effector), robot_id)
        solid = {e.get("name") for e in root.iterfind("link") if e.find("collision") is not None}
        above = {joint.child: joint.parent for joint in urdf.joints(root, robot_id)}
        pairs = set(self.never_touch(robot_id))
        for link in above:
            parent = above[link]
            while parent not in solid and parent in above:
                parent = above[parent]
            if link in solid and parent in solid:
                pairs.add(frozenset((link, parent)))
        return frozenset(pairs)

    def _robot_folder(self, robot_id: str) -> Path:
        known = self.ids()
        if robot_id not in known:
            close = close_to(robot_id, known)
            raise BadInput(NO_ROBOT_MODEL(robot=robot_id, known=[*known], close=close))
        own = self.folder / robot_id
        return own if own.is_dir() else self.imported / robot_id

    def _end_effector_folder(self, end_effector: str) -> Path:
        known = self.end_effectors()
        if end_effector not in known:
            close = close_to(end_effector, known)
            raise BadInput(NO_END_EFFECTOR(end_effector=end_effector, known=[*known], close=close))
        own = self.folder / END_EFFECTORS / end_effector
        return own if own.is_dir() else self.imported / END_EFFECTORS / end_effector

    def _read_model(self, robot_id: str) -> RobotModel:
        folder = self._robot_folder(robot_id)
        facts = self.facts(robot_id)
        origin = f"{robot_id}/robot.urdf"
        root = urdf.parse(_read(folder / "robot.urdf"), origin)
        chain, joints = urdf.chain(root, facts.get("tip_link", TIP), origin)
        home_deg = facts["home_deg"]
        if len(home_deg) != len(joints):
            file = f"{robot_id}/robot.yaml"
            raise BadInput(HOME_SIZE(file=file, count=len(home_deg), joints=len(joints)))
        home = np.array([math.radians(angle) for angle in home_deg])
        home.setflags(write=False)
        return RobotModel(
            id=robot_id,
            manufacturer=str(facts["manufacturer"]),
            product=str(facts["product"]),
            robot_class=str(facts["class"]),
            payload=float(facts["payload"]),
            reach=float(facts["reach"]),
            joints=joints,
            home=home,
            chain=chain,
            others=tuple(other for other in self.ids() if other != robot_id),
        )


def state_masses(root: ET.Element) -> None:
    """Give each link without one a mass of almost nothing: engines take 1 kg for a frame."""
    for link in root.iterfind("link"):
        if link.find("inertial") is None:
            inertial = ET.SubElement(link, "inertial")
            ET.SubElement(inertial, "mass", value="1e-06")
            moments = {"ixx": 1e-9, "iyy": 1e-9, "izz": 1e-9, "ixy": 0, "ixz": 0, "iyz": 0}
            ET.SubElement(inertial, "inertia", {k: str(v) for k, v in moments.items()})


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        why = error.strerror or str(error)
        raise BadInput(FILE_UNREADABLE(file=str(path), why=why)) from None


def _folders_with(folder: Path, file: str) -> tuple[str, ...]:
    return tuple(sorted(path.parent.name for path in folder.glob(f"*/{file}")))


def _composed(
    robot: ET.Element, tool: ET.Element, facts: dict[str, Any], end_effector: str
) -> str:
    """Attach the tool below the robot's tip link, on an adapter plate as wide as the flange."""
    taken = {element.get("name") for tag in ("link", "joint") for element in robot.iterfind(tag)}
    ours = {element.get("name") for tag in ("link", "joint") for element in tool.iterfind(tag)}
    both = sorted(str(name) for name in taken & ours)
    if both:
        raise BadInput(SAME_NAMES(robot=facts["id"], end_effector=end_effector, names=both))
    children = {joint.child for joint in urdf.joints(tool, end_effector)}
    (root,) = (str(e.get("name")) for e in tool.iterfind("link") if e.get("name") not in children)
    tip = facts.get("tip_link", TIP)
    radius = float(facts.get("flange_diameter", 0.063)) / 2
    robot.append(_adapter_plate(radius))
    _fixed(robot, ABOVE_PLATE, tip, PLATE, 0.0)
    _fixed(robot, BELOW_PLATE, PLATE, root, ADAPTER_THICKNESS)
    for element in tool:
        if element.tag in ("link", "joint"):
            robot.append(element)
    ET.indent(robot)
    return '<?xml version="1.0"?>\n' + ET.tostring(robot, encoding="unicode") + "\n"


def _fixed(robot: ET.Element, name: str, parent: str, child: str, z: float) -> None:
    joint = ET.SubElement(robot, "joint", name=name, type="fixed")
    ET.SubElement(joint, "parent", link=parent)
    ET.SubElement(joint, "child", link=child)
    ET.SubElement(joint, "origin", xyz=f"0 0 {z!r}", rpy="0 0 0")


def _adapter_plate(radius: float) -> ET.Element:
    """Return a link: an aluminium disc of the flange's radius, m, with z out of the flange."""
    thickness = ADAPTER_THICKNESS
    link = ET.Element("link", name=PLATE)
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "origin", xyz=f"0 0 {thickness / 2!r}", rpy="0 0 0")
    mass = 2700 * math.pi * radius**2 * thickness
    ET.SubElement(inertial, "mass", value=f"{mass:.6g}")
    across = mass * (3 * radius**2 + thickness**2) / 12
    moments = {"ixx": across, "iyy": across, "izz": mass * radius**2 / 2}
    tensor = {k: f"{moments.get(k, 0.0):.6g}" for k in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")}
    ET.SubElement(inertial, "inertia", tensor)
    for tag in ("visual", "collision"):
        part = ET.SubElement(link, tag)
        ET.SubElement(part, "origin", xyz=f"0 0 {thickness / 2!r}", rpy="0 0 0")
        geometry = ET.SubElement(part, "geometry")
        ET.SubElement(geometry, "cylinder", radius=f"{radius:.6g}", length=f"{thickness:.6g}")
        if tag == "visual":
            material = ET.SubElement(part, "material", name="adapter_plate")
            ET.SubElement(material, "color", rgba="0.6 0.61 0.63 1")
    return link


LEVELS = ("near", "far")
VENDOR = "vendor_"  # the lab's own file of a name is found before an imported one


def levels(folder: Path, uri: str, prefix: str = "") -> list[ET.Element]:
    """Return the packed levels of a model's folder; none where one is missing.

    uri: of the folder. They stand for all meshes below <uri>/meshes/, which is not named: clients
    fetch whatever a description names as package://. prefix: of the files' names.
    """
    names = {level: f"lod/{prefix}{level}.glb" for level in LEVELS}
    if not all((folder / name).is_file() for name in names.values()):
        return []
    return [ET.Element("level_of_detail", {level: f"{uri}/{names[level]}" for level in names})]


def vendor_levels(folder: Path) -> dict[str, Path]:
    """Return the files of the packed levels of a vendor's meshes, by level."""
    return {level: folder / "lod" / f"{VENDOR}{level}.glb" for level in LEVELS}


def hoses(facts: Mapping[str, Any]) -> list[ET.Element]:
    """Return the hoses of a robot.yaml: `hoses`, each with radius, length and two ends."""
    found = []
    for stated in facts.get("hoses", ()):
        hose = ET.Element(
            "hose", radius=repr(float(stated["radius"])), length=repr(float(stated["length"]))
        )
        for end in stated["ends"]:
            ET.SubElement(
                hose,
                "end",
                link=str(end["link"]),
                xyz=_numbers(end["xyz"]),
                direction=_numbers(end["direction"]),
            )
        found.append(hose)
    return found


def added(text: str, elements: Iterable[ET.Element]) -> str:
    """Return a URDF with elements beside its links."""
    lines = [f"  {ET.tostring(element, encoding='unicode')}\n" for element in elements]
    head, end, rest = text.rpartition("</robot>")
    return f"{head}{''.join(lines)}{end}{rest}"


def _numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


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
    facts = library.facts(model)
    description = library.description(model, end_effector)
    tip = str(facts.get("tip_link", TIP))
    shown = shown_robot(model, end_effector or "", description, tip)
    return replace(shown, product=str(facts["product"]))


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
