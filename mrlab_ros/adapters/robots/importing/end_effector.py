"""Imports the description of a hand alone as an end effector, which any robot can carry."""

from __future__ import annotations

import shutil
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh
import yaml

from mrlab_ros.adapters.robots import checks, mesh_copies, urdf
from mrlab_ros.adapters.robots.drawing import Assembly
from mrlab_ros.adapters.robots.end_effectors import DESCRIPTION, END_EFFECTORS, FACTS, TCP
from mrlab_ros.adapters.robots.importing.arm_and_hand import (
    TIP_NAME,
    Finger,
    closing_only,
    fingers,
    middles_of,
    palm_and_ends,
)
from mrlab_ros.adapters.robots.importing.diagnostics import (
    BAD_ROBOT_ID,
    HAND_BACKWARDS,
    ROBOT_ID_TAKEN,
)
from mrlab_ros.adapters.robots.importing.robot import (
    ID,
    Face,
    centres,
    keep_still,
    new_folder,
    opened,
    turn_fingers,
)
from mrlab_ros.adapters.robots.library import MESH_PREFIX, RobotLibrary
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.physics.grasp import kinds


@dataclass(frozen=True)
class ImportedTool:
    """findings: an error among them means that nothing was installed. fingers: as they close."""

    findings: tuple[Diagnostic, ...]
    fingers: tuple[Finger, ...] = ()


def import_end_effector(
    source: Path,
    tool_id: str,
    library: RobotLibrary,
    packages: Mapping[str, Path],
    *,
    arguments: Sequence[str] = (),
    speed: float = 0.0,
    force: float = 0.0,
    face: Face | None = None,
) -> ImportedTool:
    """Install a URDF or a xacro of a hand under `tool_id`: all its joints that move are fingers.

    speed: rad/s or m/s of fingers that state none. force: N of all together where their joints
    state none. face: as for a robot. The rest is as in import_robot(). Its links and joints get
    names that begin with the id, since a robot may have others of the same names. Raises BadInput.
    """
    if not ID.fullmatch(tool_id):
        raise BadInput(BAD_ROBOT_ID(robot=tool_id))
    if tool_id in (*library.ids(), *library.end_effectors()):
        raise BadInput(ROBOT_ID_TAKEN(robot=tool_id))
    root, find = opened(source, packages, arguments)
    product = root.get("name") or tool_id
    root.set("name", tool_id)
    found = checks.check_tree(root, source.name)
    if checks.errors(found):
        return ImportedTool(found)
    _rename(root, f"{tool_id}_")
    place = library.imported / END_EFFECTORS / tool_id
    with new_folder(place, FACTS) as folder:
        files, missing = checks.find_meshes(root, find)
        taken = mesh_copies.take(root, files, find.folders, folder / "meshes")
        found = (*missing, *checks.check_sizes(root, taken))
        if checks.errors(found):
            return ImportedTool(found)
        mesh_copies.name_copies(root, taken, f"{MESH_PREFIX}{END_EFFECTORS}/{tool_id}/meshes")

        def resolve(uri: str) -> Path:
            return folder / "meshes" / Path(uri).name

        joints, kept = closing_only(_parents_first(root, source.name))
        still = keep_still(root, kept)
        hand = frozenset(joint.name for joint in joints if joint.moves)
        middles = centres(root, hand, resolve)
        closing = fingers(joints, middles, source.name) if hand else ()
        turn_fingers(root, closing)
        stated = _drive(root, closing, speed, force)
        reach = _add_tcp(root, closing, middles, tool_id, resolve)
        if reach < 0:
            found = (*found, HAND_BACKWARDS(link=joints[0].parent, behind=-reach))
        found = (*still, *found, *checks.check_parts(root, source.name))
        if checks.errors(found):
            return ImportedTool(found)
        kind = kinds.FINGERS if closing else kinds.NONE
        sliding = {joint.name for joint in joints if joint.kind == "prismatic"}
        facts = {
            "id": tool_id,
            "name": product,
            "class": "imported hand",
            "gripper": face.kind if face is not None else kind.name,
            "force": face.force if face is not None else stated,
            "stroke": sum(f.upper - f.lower for f in closing if f.name in sliding),
            "lip_radius": face.radius if face is not None else 0.0,
            "notes": [f"Imported from {source.name}."],
        }
        ET.indent(root)
        body = ET.tostring(root, encoding="unicode")
        (folder / DESCRIPTION).write_text(f'<?xml version="1.0"?>\n{body}\n', encoding="utf-8")
        (folder / FACTS).write_text(
            yaml.safe_dump(facts, sort_keys=False, allow_unicode=True), encoding="utf-8"
        )
    try:
        library.end_effector(tool_id)
    except BadInput:
        shutil.rmtree(place, ignore_errors=True)
        raise
    return ImportedTool(found, closing)


def _rename(root: ET.Element, prefix: str) -> None:
    """Let the names of links and joints begin with `prefix`."""
    named = [(element, "name") for tag in ("link", "joint") for element in root.iterfind(tag)]
    for joint in root.iterfind("joint"):
        named += [(end, "link") for tag in ("parent", "child") for end in joint.findall(tag)]
        named += [(mimic, "joint") for mimic in joint.findall("mimic")]
    for element, key in named:
        name = element.get(key, "")
        if not name.startswith(prefix):
            element.set(key, f"{prefix}{name}")


def _parents_first(root: ET.Element, origin: str) -> tuple[urdf.UrdfJoint, ...]:
    joints = urdf.joints(root, origin)
    return tuple(sorted(joints, key=lambda joint: len(urdf.path_to(joint.child, joints)[1])))


def _drive(root: ET.Element, closing: Sequence[Finger], speed: float, force: float) -> float:
    """State the speed and the force of fingers that state none; return that of all, N."""
    elements = {str(element.get("name")): element for element in root.iterfind("joint")}
    limits = [elements[finger.name].find("limit") for finger in closing]
    total = 0.0
    for limit in limits:
        assert limit is not None
        if not float(limit.get("velocity", "0")) > 0 and speed:
            limit.set("velocity", repr(speed))
        if not float(limit.get("effort", "0")) > 0:
            limit.set("effort", repr(force / len(closing)))
        total += float(limit.get("effort", "0"))
    return total


def _add_tcp(
    root: ET.Element,
    closing: Sequence[Finger],
    middles: Mapping[str, Array],
    tool_id: str,
    resolve: checks.Resolve,
) -> float:
    """Add the frame tcp: at one that is named so, else amid the ends of the fingers half closed,
    else at the far end. Return how far in front of the root it is, m."""
    links = [str(link.get("name")) for link in root.iterfind("link")]
    name = f"{tool_id}_{TCP}"
    joints = _parents_first(root, tool_id)
    base = joints[0].parent if joints else links[0]
    moved = {joint.child for joint in joints if joint.moves}
    frames = [link for link in links if TIP_NAME.search(link.removeprefix(f"{tool_id}_"))]
    frames = [link for link in frames if link != base and link not in moved]
    seen, solid = (Assembly(root, tool_id, resolve, collision=hulls) for hulls in (False, True))
    at = np.zeros(3)
    if frames:
        at = seen.poses()[frames[-1]][:3, 3]
    elif closing:
        amid = {finger.name: (finger.lower + finger.upper) / 2 for finger in closing}
        at = middles_of(joints, middles, amid, palm_and_ends(joints)[1]).mean(axis=0)
    else:
        # Corners of each shape's box in the frame of the base.
        tops = [
            trimesh.transform_points(mesh.bounds, pose)[:, 2].max()
            for _, mesh, pose in (*solid.meshes(), *seen.meshes())
        ]
        at[2] = max(tops, default=0.0)
    if name in links:
        return float(at[2])
    ET.SubElement(root, "link", name=name)
    joint = ET.SubElement(root, "joint", name=f"{base}-{TCP}", type="fixed")
    ET.SubElement(joint, "parent", link=base)
    ET.SubElement(joint, "child", link=name)
    ET.SubElement(joint, "origin", xyz=" ".join(repr(float(value)) for value in at), rpy="0 0 0")
    return float(at[2])
