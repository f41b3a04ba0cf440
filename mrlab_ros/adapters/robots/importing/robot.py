"""Imports a robot from a URDF or a xacro of the user."""

from __future__ import annotations

import re
import shutil
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from math import degrees
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
import yaml

from mrlab_ros.adapters.diagnostics import FILE_UNREADABLE
from mrlab_ros.adapters.robots import checks, mesh_copies, urdf
from mrlab_ros.adapters.robots.drawing import Assembly
from mrlab_ros.adapters.robots.importing.arm_and_hand import Finger, Groups, Split, fingers, split
from mrlab_ros.adapters.robots.importing.diagnostics import (
    BAD_ROBOT_ID,
    ROBOT_ID_TAKEN,
    ROBOT_SPEED,
    ROBOT_STILL,
)
from mrlab_ros.adapters.robots.importing.source import (
    MeshFinder,
    description_text,
    packages_around,
)
from mrlab_ros.adapters.robots.library import MESH_PREFIX, TIP, RobotLibrary
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.robots.model import Joint, RobotModel
from mrlab_ros.core.robots.reach import reach

# Of a continuous joint that states none, rad/s: slower than any arm of a few kilogrammes.
ASSUMED_SPEED = np.pi
# Share of a joint's range by which its home is away from the ends at least.
HOME_MARGIN = 0.05
ID = re.compile(r"[a-z][a-z0-9_]{0,47}")


@dataclass(frozen=True)
class Face:
    """A face that pulls what it touches. kind: of `core.physics.grasp.kinds`; force: N; radius: m,
    of its lip."""

    kind: str
    force: float
    radius: float


@dataclass(frozen=True)
class Imported:
    """A robot description as the lab understands it.

    findings: an error among them means that nothing was installed; the rest is then None.
    """

    findings: tuple[Diagnostic, ...]
    split: Split | None = None
    fingers: tuple[Finger, ...] = ()


def import_robot(
    source: Path,
    robot_id: str,
    library: RobotLibrary,
    packages: Mapping[str, Path],
    *,
    arguments: Sequence[str] = (),
    tip: str = "",
    srdf: Path | None = None,
    speed: float = 0.0,
    face: Face | None = None,
) -> Imported:
    """Read a URDF or a xacro, tell the arm from the hand, and install it under `robot_id`.

    packages: folders of package:// URIs and of xacro's $(find), before those in whose source tree
    the file lies and the installed ones. arguments: of the xacro, NAME:=VALUE. tip: the last link
    of the arm; empty: found. srdf: a file whose planning groups name the arm; None: the one
    beside the description, if any. speed: rad/s or m/s, of the arm's joints that state none; 0:
    only a continuous joint may leave it out. face: what it holds with in place of fingers, at its
    tip and along the axis z of that; None: with its fingers, if any. With a finding that is an
    error nothing is installed. Raises BadInput for an id that is malformed or already used, and
    where the file cannot be understood.
    """
    if not ID.fullmatch(robot_id):
        raise BadInput(BAD_ROBOT_ID(robot=robot_id))
    if robot_id in library.ids():
        raise BadInput(ROBOT_ID_TAKEN(robot=robot_id))
    root, find = opened(source, packages, arguments)
    if not root.get("name"):
        # Bullet loads no robot without one.
        root.set("name", robot_id)
    tree = checks.check_tree(root, source.name)
    if checks.errors(tree):
        return Imported(tree)
    parts = split(root, source.name, tip, _groups(source, srdf, root))
    if face is not None and not any(link.get("name") == TIP for link in root.iterfind("link")):
        ET.SubElement(root, "link", name=TIP)
        frame = ET.SubElement(root, "joint", name=f"{parts.tip}-{TIP}", type="fixed")
        ET.SubElement(frame, "parent", link=parts.tip)
        ET.SubElement(frame, "child", link=TIP)
        parts = replace(parts, tip=TIP)
    assumed = keep_still(root, parts.still) + _state_speeds(root, parts, speed)
    hand = frozenset(joint.name for joint in parts.hand)
    with new_folder(library.imported / robot_id) as folder:
        files, missing = checks.find_meshes(root, find)
        taken = mesh_copies.take(root, files, find.folders, folder / "meshes")
        found = (
            *assumed,
            *checks.check_root(root, source.name, hand),
            *missing,
            *checks.check_sizes(root, taken),
        )
        if checks.errors(found):
            return Imported(found)
        mesh_copies.name_copies(root, taken, f"{MESH_PREFIX}{robot_id}/meshes")
        middles = centres(root, hand, lambda uri: folder / "meshes" / Path(uri).name)
        closing = fingers(parts.below, middles, source.name) if hand else ()
        turn_fingers(root, closing)
        ET.indent(root)
        body = ET.tostring(root, encoding="unicode")
        (folder / "robot.urdf").write_text(f'<?xml version="1.0"?>\n{body}\n', encoding="utf-8")
        facts = _facts(root, robot_id, parts, source)
        if face is not None:
            facts |= {"gripper": face.kind, "force": face.force, "lip_radius": face.radius}
        facts["notes"] += [one.message for one in found if one.severity is not Severity.INFO]
        (folder / "robot.yaml").write_text(
            yaml.safe_dump(facts, sort_keys=False, allow_unicode=True), encoding="utf-8"
        )
    return Imported(found, parts, closing)


def opened(
    source: Path, packages: Mapping[str, Path], arguments: Sequence[str]
) -> tuple[ET.Element, MeshFinder]:
    """Return a description without empty shapes, and what finds its meshes. Raises BadInput."""
    packages = packages_around(source) | dict(packages)
    root = urdf.parse(description_text(source, packages, arguments), source.name)
    _drop_nothing(root)
    return root, MeshFinder(source.parent, packages)


def _drop_nothing(root: ET.Element) -> None:
    """Drop shapes of no size at all, which exporters write for links without a shape."""
    for link in root.iterfind("link"):
        for shape in (*link.findall("visual"), *link.findall("collision")):
            sizes = " ".join(
                solid.get(name, "")
                for solid in shape.iterfind("geometry/*")
                for name in checks.SIZES
            ).split()
            if sizes and all(size.strip("0.") == "" for size in sizes):
                link.remove(shape)


@contextmanager
def new_folder(folder: Path, last: str = "robot.yaml") -> Iterator[Path]:
    """Yield a folder that takes its name where its last file was written."""
    aside = folder.with_name(f".{folder.name}.new")
    shutil.rmtree(aside, ignore_errors=True)
    (aside / "meshes").mkdir(parents=True)
    try:
        yield aside
        if (aside / last).is_file():
            aside.rename(folder)
    finally:
        shutil.rmtree(aside, ignore_errors=True)


def _groups(source: Path, srdf: Path | None, root: ET.Element) -> Groups | None:
    """Return the planning groups of the SRDF given, or of the one of this robot nearby."""
    if srdf is not None:
        return Groups(_read(srdf), srdf.name)
    folders = (source.parent, *(source.parent.parent / n for n in ("srdf", "config")))
    for file in sorted(f for folder in folders for f in folder.glob("*.srdf")):
        with suppress(ET.ParseError):
            if ET.fromstring(_read(file)).get("name") == root.get("name"):
                return Groups(_read(file), file.name)
    return None


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise BadInput(FILE_UNREADABLE(file=str(path), why=why)) from None


def _elements(root: ET.Element) -> dict[str, ET.Element]:
    return {str(element.get("name")): element for element in root.iterfind("joint")}


def keep_still(root: ET.Element, still: Iterable[urdf.UrdfJoint]) -> tuple[Diagnostic, ...]:
    """Fix joints that move neither the arm nor the hand."""
    elements = _elements(root)
    found = []
    for joint in still:
        found.append(ROBOT_STILL(where=f"joint {joint.name}", joint=joint.name))
        element = elements[joint.name]
        element.set("type", "fixed")
        for tag in ("axis", "limit", "mimic", "dynamics", "safety_controller", "calibration"):
            for child in element.findall(tag):
                element.remove(child)
    return tuple(found)


def _state_speeds(root: ET.Element, parts: Split, speed: float) -> tuple[Diagnostic, ...]:
    """Give joints of the arm that state no speed the one that the user, or the lab, assumes."""
    elements = _elements(root)
    found = []
    for joint in parts.arm:
        limit = joint.limit or {}
        if limit.get("velocity", 0.0) > 0:
            continue
        if not speed and (joint.kind != "continuous" or "velocity" in limit):
            continue  # the check of the joints says so
        element = elements[joint.name].find("limit")
        if element is None:
            element = ET.SubElement(elements[joint.name], "limit", effort="0")
        element.set("velocity", repr(speed or ASSUMED_SPEED))
        where = f"joint {joint.name}"
        assumed, unit = speed, "m/s"
        if joint.kind != "prismatic":
            assumed, unit = speed or ASSUMED_SPEED, "rad/s"
        found.append(ROBOT_SPEED(where=where, joint=joint.name, value=assumed, unit=unit))
    return tuple(found)


def centres(root: ET.Element, hand: frozenset[str], find: checks.Resolve) -> dict[str, Array]:
    """Return the middle of the shapes of the links at the hand's joints, m, in the link's frame.

    With all joints at 0 a link's frame is where the tree puts it.
    """
    assembly = Assembly(root, "the hand", find)
    poses = assembly.poses()
    joints = [joint for joint in urdf.joints(root, "the hand") if joint.name in hand]
    wanted = {link for joint in joints for link in (joint.parent, joint.child)}
    boxes: dict[str, list[Array]] = {}
    for link, mesh, pose in assembly.meshes():
        if link in wanted:
            boxes.setdefault(link, []).append(trimesh.transform_points(mesh.bounds, pose))
    found = {}
    for link, corners in boxes.items():
        every = np.concatenate(corners)
        middle = np.append((every.min(axis=0) + every.max(axis=0)) / 2, 1.0)
        found[link] = (np.linalg.inv(poses[link]) @ middle)[:3]
    return found


def turn_fingers(root: ET.Element, closing: Sequence[Finger]) -> None:
    """Write the hand's joints as the lab has them: closing from the lower to the upper limit."""
    elements = _elements(root)
    for finger in closing:
        element = elements[finger.name]
        axis = element.find("axis")
        if finger.flipped:
            if axis is None:
                axis = ET.SubElement(element, "axis", xyz="1 0 0")
            xyz = urdf.numbers(axis.get("xyz", "1 0 0"), 3, finger.name, "axis")
            axis.set("xyz", " ".join(repr(-value + 0.0) for value in xyz))
        limit = element.find("limit")
        if limit is None:
            limit = ET.SubElement(element, "limit", effort="0")
        limit.set("lower", repr(finger.lower))
        limit.set("upper", repr(finger.upper))
        limit.set("velocity", repr(finger.velocity))
        if finger.mimics:
            mimic = element.find("mimic")
            assert mimic is not None
            mimic.set("joint", finger.mimics)
            mimic.set("multiplier", repr(finger.multiplier))
            mimic.set("offset", repr(finger.offset))


def _home(joint: Joint) -> float:
    """Return 0, or the middle of the limits where 0 is not well inside them.

    At the end of its range a joint often folds the arm into itself.
    """
    margin = (joint.upper - joint.lower) * HOME_MARGIN
    inside = joint.lower + margin <= 0 <= joint.upper - margin
    return 0.0 if inside else (joint.lower + joint.upper) / 2


def _facts(root: ET.Element, robot_id: str, parts: Split, source: Path) -> dict[str, Any]:
    """Return the content of robot.yaml."""
    chain, joints = urdf.chain(root, parts.tip, source.name)
    home = [_home(joint) for joint in joints]
    model = RobotModel(robot_id, "", "", "", 0.0, 0.0, joints, np.array(home), chain)
    facts: dict[str, Any] = {
        "id": robot_id,
        "manufacturer": "imported",
        "product": root.get("name", robot_id),
        "class": "imported robot",
        "payload": 0.0,
        "reach": round(reach(model, "flange"), 4),
        "reach_definition": "flange",
        "tip_link": parts.tip,
        "arm": str(parts.why),
        "home_deg": [round(degrees(angle), 6) for angle in home],
        "sources": [{"file": source.name}],
        "notes": [
            "The payload is unknown: write it here from the data sheet. The reach is computed."
        ],
    }
    if parts.hand:
        facts["hand"] = [joint.name for joint in parts.hand]
    return facts
