"""The one document of the lab: robots, objects, surfaces and systems, checked when read.

A saved scene is one, with all parts. The lab keeps one with robots and systems, physics one with
objects and surfaces, so that both are there again after a restart. A cell is one with systems
alone; as a file it may be the mapping of a single system.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from mrlab_ros.core.base.checks import (
    FILLED_TEXT,
    FLAG,
    NAME,
    TEXT,
    Matrix,
    Numbers,
    Words,
    bad_value,
    between,
)
from mrlab_ros.core.base.diagnostics import A_MAPPING
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import WORLD_SIZE, Pose
from mrlab_ros.core.base.names import checked_name
from mrlab_ros.core.base.records import Record, entry_place, raise_all, unknown_field
from mrlab_ros.core.scene.diagnostics import (
    BAD_PLACE_NAME,
    CELL_NOT_SCENE,
    HELD_IN_PART,
    HOLDS_TWO,
    MEMBER_TWICE,
    NAMED_TWICE,
    NO_SYSTEM_IN_CELL,
    ROBOT_NOT_AMONG,
    SCENE_NOT_CELL,
)
from mrlab_ros.core.scene.surfaces import Surface
from mrlab_ros.core.systems.cell_file import (
    POSITION,
    RATE,
    SYSTEM_FIELDS,
    MemberEntry,
    SystemEntry,
    plain_system,
    read_system,
)

__all__ = ["MemberEntry", "ObjectEntry", "Place", "RobotEntry", "SceneDocument", "SystemEntry"]

T = TypeVar("T")

PARTS = ("about", "robots", "objects", "surfaces", "systems", "place")
PLACE_FIELDS = ("id", "name")
POSE_FIELDS = ("position", "orientation")
ROBOT_FIELDS = (
    "name", "model", "end_effector", *POSE_FIELDS, "trajectory", "at", "rate", "loop",
)  # fmt: skip
OBJECT_FIELDS = ("name", "type", "automatic", *POSE_FIELDS, "held_by", "in_hand")
SURFACE_FIELDS = ("name", "label", "source", *POSE_FIELDS, "vertices", "triangles")
# Characters of a place's name or id, at most.
LONGEST = 64
VECTOR, QUATERNION = Numbers(3), Numbers(4)
PLACE = Numbers(3, between(-WORLD_SIZE, WORLD_SIZE), "m")
VERTICES, TRIANGLES = Matrix(3), Matrix(3, whole=True)


@dataclass(frozen=True)
class RobotEntry:
    """end_effector: its id, empty for none. pose: T_world_base. trajectory: id of what is loaded,
    empty for nothing; at: position on it, s; rate, loop: how it plays."""

    name: str
    model: str
    end_effector: str
    pose: Pose
    trajectory: str = ""
    at: float = 0.0
    rate: float = 1.0
    loop: bool = False


@dataclass(frozen=True)
class ObjectEntry:
    """automatic: on the nearest surface below the pose. held_by: the robot that holds it, and
    in_hand: T_hand_object, in the frame of the link that holds it; empty and None: free."""

    name: str
    type: str
    pose: Pose
    automatic: bool = False
    held_by: str = ""
    in_hand: Pose | None = None


@dataclass(frozen=True)
class Place:
    """A real room with an origin that its headsets share. id: never used again. name: for people,
    may be empty. Raises BadInput where one of them cannot be."""

    id: str
    name: str = ""

    def __post_init__(self) -> None:
        checked_text(self.id)
        if self.name:
            checked_text(self.name)


def checked_text(text: str) -> str:
    """Return a name or id of a place; raise BadInput where it cannot be one."""
    if not (text.strip() and len(text) <= LONGEST and text.isprintable()):
        raise BadInput(BAD_PLACE_NAME(name=text[:LONGEST], count=len(text), most=LONGEST))
    return text


@dataclass(frozen=True)
class SceneDocument:
    """Contents of a scene, or of a cell, which has systems alone. about: a sentence for people.
    place: where its robots stand; None: wherever the lab is."""

    robots: tuple[RobotEntry, ...] = ()
    objects: tuple[ObjectEntry, ...] = ()
    surfaces: tuple[Surface, ...] = ()
    systems: tuple[SystemEntry, ...] = ()
    about: str = ""
    place: Place | None = None

    @property
    def driven(self) -> frozenset[str]:
        """The robots that are members of a system."""
        return frozenset(member.robot for system in self.systems for member in system.members)


def parse(document: object, origin: str, *, whole: bool = True) -> SceneDocument:
    """Read what a YAML or JSON file holds; raise BadInput that names `origin` and all mistakes.

    whole: every robot that an object or a system names must be among the document's robots, and
    every system needs a name; a cell names robots of the running lab.
    """
    scene, mistakes = _read(document, origin, whole)
    raise_all(mistakes, origin)
    return scene


def parse_intact(
    document: object, origin: str, *, whole: bool = True
) -> tuple[SceneDocument, tuple[Words, ...]]:
    """Read as parse() does, but leave out what is damaged; return the mistakes, too.

    Raises BadInput where the document as a whole is none.
    """
    scene, mistakes = _read(document, origin, whole)
    return scene, tuple(mistakes)


def parse_cell(document: object, origin: str) -> tuple[SystemEntry, ...]:
    """Read the systems of a cell; raise BadInput where it has other parts or none at all."""
    scene = parse(document, origin, whole=False)
    others = [part for part in PARTS[1:4] if getattr(scene, part)]
    if others:
        raise BadInput(SCENE_NOT_CELL(place=origin, parts=others))
    if not scene.systems:
        raise BadInput(NO_SYSTEM_IN_CELL(place=origin))
    return scene.systems


def plain(scene: SceneDocument) -> dict[str, Any]:
    """Return the scene as mappings, lists and numbers, which parse() reads."""
    result: dict[str, Any] = {"about": scene.about} if scene.about else {}
    if scene.place is not None:
        result["place"] = {"id": scene.place.id, "name": scene.place.name}
    result["robots"] = [_plain_robot(robot) for robot in scene.robots]
    result["objects"] = [_plain_object(thing) for thing in scene.objects]
    result["surfaces"] = [
        {
            "name": s.name,
            "label": s.label,
            **({"source": s.source} if s.source else {}),
            **_plain_pose(s.pose),
            "vertices": s.vertices.tolist(),
            "triangles": s.triangles.tolist(),
        }
        for s in scene.surfaces
    ]
    result["systems"] = [plain_system(system) for system in scene.systems]
    return result


def _plain_robot(robot: RobotEntry) -> dict[str, Any]:
    result: dict[str, Any] = {
        "name": robot.name,
        "model": robot.model,
        "end_effector": robot.end_effector,
    }
    result |= _plain_pose(robot.pose)
    if robot.trajectory:
        result |= {"trajectory": robot.trajectory, "at": robot.at}
    return result | {"rate": robot.rate, "loop": robot.loop}


def _plain_object(thing: ObjectEntry) -> dict[str, Any]:
    result: dict[str, Any] = {"name": thing.name, "type": thing.type, **_plain_pose(thing.pose)}
    if thing.automatic:
        result["automatic"] = True
    if thing.held_by and thing.in_hand is not None:
        result |= {"held_by": thing.held_by, "in_hand": _plain_pose(thing.in_hand)}
    return result


def _plain_pose(pose: Pose) -> dict[str, list[float]]:
    return {"position": list(pose.position), "orientation": list(pose.orientation)}


# reading ------------------------------------------------------------------------------------


def _read(document: object, origin: str, whole: bool) -> tuple[SceneDocument, list[Words]]:
    """Return what is intact of a document, and its mistakes."""
    if isinstance(document, list) and any(map(_names_model, document)):
        # The lab's state file, before it knew more than robots.
        document = {"robots": document}
    if document is None or document == []:
        fields = PARTS if whole else SYSTEM_FIELDS
        raise bad_value(origin, None, A_MAPPING(fields=[*fields]))
    if not isinstance(document, Mapping) or (document and {*PARTS}.isdisjoint(document)):
        if not whole:
            return SceneDocument(systems=(read_system(document, origin),)), []
        if not isinstance(document, Mapping):
            raise bad_value(origin, document, A_MAPPING(fields=[*PARTS]))
        if "members" in document:
            raise BadInput(CELL_NOT_SCENE(place=origin))
    mistakes: list[Words] = [
        unknown_field(origin, key, PARTS) for key in document if key not in PARTS
    ]
    record = Record({k: v for k, v in document.items() if k in PARTS}, origin, PARTS)

    def part(key: str, one: str, read: Callable[[object, Words], T]) -> list[T]:
        found = []
        try:
            entries = record.entries(key)
        except BadInput as error:
            mistakes.append(error.diagnostic)
            return []
        for i, entry in enumerate(entries, 1):
            try:
                found.append(read(entry, entry_place(origin, one, i)))
            except BadInput as error:
                mistakes.append(error.diagnostic)
        return found

    about, place = "", None
    try:
        about = record.value("about", TEXT, "")
        entry = record.record("place", PLACE_FIELDS)
        if entry is not None:
            place = _place(entry)
    except BadInput as error:
        mistakes.append(error.diagnostic)
    scene = SceneDocument(
        tuple(part("robots", "robot", _robot)),
        tuple(part("objects", "object", _object)),
        tuple(part("surfaces", "surface", _surface)),
        tuple(part("systems", "system", read_system)),
        about,
        place,
    )
    return _consistent(scene, origin, whole, mistakes), mistakes


def _names_model(entry: object) -> bool:
    return isinstance(entry, Mapping) and "name" in entry and "model" in entry


def _consistent(
    scene: SceneDocument, origin: str, whole: bool, mistakes: list[Words]
) -> SceneDocument:
    """Leave out what clashes with an earlier entry or names a robot that is not there."""

    def intact(entries: Iterable[T], check: Callable[[T], None]) -> tuple[T, ...]:
        kept = []
        for entry in entries:
            try:
                check(entry)
            except BadInput as error:
                mistakes.append(error.diagnostic)
            else:
                kept.append(entry)
        return tuple(kept)

    def named(what: str, taken: set[str]) -> Callable[[Any], None]:
        def check(entry: Any) -> None:
            if entry.name in taken:
                raise BadInput(NAMED_TWICE(place=origin, what=what, name=entry.name))
            if entry.name or whole:
                if what != "surface":
                    checked_name(entry.name, frozenset(), what)
                taken.add(entry.name)

        return check

    robots = intact(scene.robots, named("robot", set()))
    present = {robot.name for robot in robots}
    # Objects and systems may share a name with each other, but not with a robot.
    objects = intact(scene.objects, named("object", set(present)))
    systems = intact(scene.systems, named("system", set(present)))
    surfaces = intact(scene.surfaces, named("surface", set()))

    def of_robot(name: str, robot: str) -> None:
        if whole and robot not in present:
            known = sorted(present)
            raise BadInput(ROBOT_NOT_AMONG(place=origin, name=name, robot=robot, known=known))

    holders: set[str] = set()
    members: set[str] = set()

    def held(thing: ObjectEntry) -> None:
        if thing.held_by:
            of_robot(thing.name, thing.held_by)
            if thing.held_by in holders:
                raise BadInput(HOLDS_TWO(place=origin, robot=thing.held_by))
            holders.add(thing.held_by)

    def manned(system: SystemEntry) -> None:
        wanted = [member.robot for member in system.members]
        for robot in wanted:
            of_robot(system.name, robot)
            if robot in members or wanted.count(robot) > 1:
                raise BadInput(MEMBER_TWICE(place=origin, robot=robot))
        members.update(wanted)

    return replace(
        scene,
        robots=robots,
        objects=intact(objects, held),
        surfaces=surfaces,
        systems=intact(systems, manned),
    )


def _pose(entry: Record, position: Numbers = VECTOR) -> Pose:
    x, y, z = entry.value("position", position, (0.0, 0.0, 0.0))
    a, b, c, d = entry.value("orientation", QUATERNION, (0.0, 0.0, 0.0, 1.0))
    try:
        return Pose((x, y, z), (a, b, c, d))
    except BadInput as error:
        raise entry.error(error.diagnostic) from None


def _place(entry: Record) -> Place:
    id, name = entry.required("id", FILLED_TEXT), entry.value("name", TEXT, "")
    try:
        return Place(id, name)
    except BadInput as error:
        raise entry.error(error.diagnostic) from None


def _robot(value: object, place: Words) -> RobotEntry:
    entry = Record(value, place, ROBOT_FIELDS)
    return RobotEntry(
        entry.required("name", NAME),
        entry.required("model", NAME),
        entry.value("end_effector", TEXT, ""),
        _pose(entry, PLACE),
        entry.value("trajectory", TEXT, ""),
        entry.value("at", POSITION, 0.0),
        entry.value("rate", RATE, 1.0),
        entry.value("loop", FLAG, False),
    )


def _object(value: object, place: Words) -> ObjectEntry:
    entry = Record(value, place, OBJECT_FIELDS)
    holder, in_hand = entry.value("held_by", TEXT, ""), entry.record("in_hand", POSE_FIELDS)
    if bool(holder) != (in_hand is not None):
        raise entry.error(HELD_IN_PART())
    return ObjectEntry(
        entry.required("name", NAME),
        entry.required("type", NAME),
        _pose(entry),
        entry.value("automatic", FLAG, False),
        holder,
        None if in_hand is None else _pose(in_hand),
    )


def _surface(value: object, place: Words) -> Surface:
    entry = Record(value, place, SURFACE_FIELDS)
    nothing = np.zeros((0, 3))
    return Surface(
        entry.required("name", FILLED_TEXT),
        entry.value("label", TEXT, ""),
        _pose(entry),
        entry.value("vertices", VERTICES, nothing),
        entry.value("triangles", TRIANGLES, nothing.astype(np.int32)),
        entry.value("source", TEXT, ""),
    )
