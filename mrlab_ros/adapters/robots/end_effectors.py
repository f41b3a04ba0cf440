"""The folder of an end effector: what it says, and whether a robot can carry it."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mrlab_ros.adapters.diagnostics import FILE_UNREADABLE, NOT_UTF8
from mrlab_ros.adapters.robots import checks, urdf
from mrlab_ros.adapters.robots.diagnostics import FINGERS_STILL, LAB_NAMES, NO_TCP
from mrlab_ros.adapters.yaml_files import read_yaml
from mrlab_ros.core.base.checks import (
    Choice,
    Number,
    Text,
    Words,
    above,
    bad_value,
    between,
    checked,
)
from mrlab_ros.core.base.diagnostics import FIELD, IN_PLACE, ONE_OF
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.records import field, mistakes_of, raise_all, read
from mrlab_ros.core.physics.grasp.kinds import KINDS, Gripper

END_EFFECTORS = "end_effectors"
FACTS, DESCRIPTION = "end_effector.yaml", "end_effector.urdf"
TCP = "tcp"
# What lies between a robot and its end effector; their own links and joints have other names.
PLATE, ABOVE_PLATE, BELOW_PLATE = "adapter_plate", "tool0-adapter_plate", "adapter_plate-tool"
FORCE = Number(between(0.0, 1e5), "N")
RADIUS = Number(between(0.0, 1.0), "m")


class _Anything:
    """What scripts/bodies/generate.py reads, and notes for people."""

    @property
    def expected(self) -> str:
        return "anything"

    def read(self, value: object) -> object:
        return value


@dataclass(frozen=True)
class Facts:
    """The content of end_effector.yaml; SI units. stroke: of its fingers; force: of them together,
    or with which its face pulls; lip_radius: of that face."""

    id: str = field(Text(), "Name of its folder.")
    name: str = field(Text(), "For people.")
    kind: str = field(Text(), "For people.", name="class")
    gripper: Gripper = field(Choice(KINDS), "How it holds.")
    force: float = field(FORCE, "N.")
    stroke: float = field(Number(between(0.0, 2.0), "m"), "m.", 0.0)
    lip_radius: float = field(RADIUS, "m.", 0.0)
    notes: Any = field(_Anything(), "For people.", None)
    joints: Any = field(_Anything(), "Of a shipped one.", None)
    boxes: Any = field(_Anything(), "Of a shipped one.", None)
    inertials: Any = field(_Anything(), "Of a shipped one.", None)


@dataclass(frozen=True, eq=False)
class EndEffector:
    """facts: of its file. root: its URDF."""

    facts: Facts
    root: ET.Element


def read_folder(folder: Path, mesh_path: checks.Resolve) -> EndEffector:
    """Read and check the folder of an end effector; raise BadInput that names all its mistakes.

    mesh_path: returns the file of a mesh URI.
    """
    place = f"{END_EFFECTORS}/{folder.name}"
    mistakes: list[Words] = []
    facts, root = None, None
    try:
        facts = _facts(folder, f"{place}/{FACTS}")
    except BadInput as error:
        mistakes += mistakes_of(error)
    try:
        root = _description(folder / DESCRIPTION, f"{place}/{DESCRIPTION}", mesh_path)
    except BadInput as error:
        mistakes += mistakes_of(error)
    if facts is not None and root is not None and facts.gripper.closes:
        joints = urdf.joints(root, place)
        if not any(joint.moves for joint in joints):
            mistakes.append(FINGERS_STILL(file=f"{place}/{DESCRIPTION}", facts=FACTS))
    raise_all(mistakes, place)
    assert facts is not None
    assert root is not None
    return EndEffector(facts, root)


def _facts(folder: Path, file: str) -> Facts:
    facts = read(Facts, read_yaml(folder / FACTS), file)
    if facts.id != folder.name:
        raise bad_value(FIELD(place=file, key="id"), facts.id, ONE_OF(choices=[folder.name]))
    if facts.gripper.closes or facts.gripper.pulls:
        checked(FIELD(place=file, key="force"), facts.force, Number(above(0.0, 1e5), "N"))
    if facts.gripper.pulls:
        radius = Number(above(0.0, 1.0), "m")
        checked(FIELD(place=file, key="lip_radius"), facts.lip_radius, radius)
    return facts


def _description(path: Path, file: str, mesh_path: checks.Resolve) -> ET.Element:
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        why = error.strerror or str(error)
        raise BadInput(FILE_UNREADABLE(file=str(path), why=why)) from None
    except UnicodeDecodeError:
        raise BadInput(NOT_UTF8(file=str(path))) from None
    root = urdf.parse(text, file)
    found = (*checks.check_parts(root, file), *checks.find_meshes(root, mesh_path)[1])
    links = [str(link.get("name")) for link in root.iterfind("link")]
    names = {*links, *(str(joint.get("name")) for joint in root.iterfind("joint"))}
    mistakes: list[Words] = [IN_PLACE(place=file, why=one) for one in checks.errors(found)]
    if taken := sorted(names & {PLATE, ABOVE_PLATE, BELOW_PLATE}):
        mistakes.append(LAB_NAMES(file=file, names=taken))
    if not any(link == TCP or link.endswith(f"_{TCP}") for link in links):
        mistakes.append(NO_TCP(file=file, links=links))
    raise_all(mistakes, file)
    return root
