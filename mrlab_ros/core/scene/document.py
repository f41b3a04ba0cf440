"""A scene as a file holds it: robots, objects, surfaces and systems, checked when read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.geometry import Pose, Quaternion, Vector
from mrlab_ros.core.naming import NAME, checked_name
from mrlab_ros.core.physics.surfaces import Surface
from mrlab_ros.core.systems.waits import parse as parsed_wait

# The rates a playback has, and the longest that a place on a timeline or a dwell can be, s.
RATES = (0.1, 4.0)
LONGEST = 1e6
PARTS = ("about", "robots", "objects", "surfaces", "systems")
POSE = ("position", "orientation")


@dataclass(frozen=True)
class RobotEntry:
    """trajectory: what it has loaded, empty for nothing; at: where it stood on that, s."""

    name: str
    model: str
    end_effector: str
    pose: Pose
    trajectory: str = ""
    at: float = 0.0


@dataclass(frozen=True)
class ObjectEntry:
    """automatic: on the nearest surface below the pose. held_by: the robot that holds it, and
    in_hand its pose in the frame of that robot's hand; empty and None: free."""

    name: str
    type: str
    pose: Pose
    automatic: bool = False
    held_by: str = ""
    in_hand: Pose | None = None


@dataclass(frozen=True)
class MemberEntry:
    """dwell: s; waits: each as in mrlab_msgs/SystemMember."""

    robot: str
    trajectory: str
    dwell: float = 0.0
    waits: tuple[str, ...] = ()


@dataclass(frozen=True)
class SystemEntry:
    """mode, policy: as in mrlab_msgs/RobotSystem. at: where it stood on its timeline, s."""

    name: str
    members: tuple[MemberEntry, ...]
    mode: int = 0
    policy: int = 0
    loop: bool = False
    rate: float = 1.0
    at: float = 0.0


@dataclass(frozen=True)
class SceneDocument:
    robots: tuple[RobotEntry, ...] = ()
    objects: tuple[ObjectEntry, ...] = ()
    surfaces: tuple[Surface, ...] = ()
    systems: tuple[SystemEntry, ...] = ()
    about: str = ""


def parse(document: object, origin: str) -> SceneDocument:
    """Read a scene from what its YAML file holds; raise BadInput, naming `origin`."""
    if document is None:
        document = {}
    if not isinstance(document, Mapping) or set(document) - set(PARTS):
        found = sorted(set(document) - set(PARTS)) if isinstance(document, Mapping) else document
        raise BadInput(f"{origin} holds {found}; expected {', '.join(PARTS)}")
    scene = SceneDocument(
        tuple(_robot(e, w) for e, w in _entries(document, "robots", origin)),
        tuple(_object(e, w) for e, w in _entries(document, "objects", origin)),
        tuple(_surface(e, w) for e, w in _entries(document, "surfaces", origin)),
        tuple(_system(e, w) for e, w in _entries(document, "systems", origin)),
        str(document.get("about", "")),
    )
    _consistent(scene, origin)
    return scene


def _consistent(scene: SceneDocument, origin: str) -> None:
    """Raise BadInput where names clash or a part names a robot that the scene does not have."""
    robots = {robot.name for robot in scene.robots}
    parts = (("robot", scene.robots), ("object", scene.objects), ("system", scene.systems))
    for what, entries in parts:
        # Objects and systems may share a name with each other, but not with a robot.
        taken = set() if what == "robot" else set(robots)
        for entry in entries:
            if entry.name in taken:
                raise BadInput(f"{origin} names the {what} {entry.name} twice; rename one")
            checked_name(entry.name, frozenset(), f"{what} of {origin}")
            taken.add(entry.name)
    surfaces = [surface.name for surface in scene.surfaces]
    if len(set(surfaces)) != len(surfaces):
        raise BadInput(f"{origin} has two surfaces of one name; give each its own")
    needed = [(thing.name, thing.held_by) for thing in scene.objects if thing.held_by]
    driven = [(system.name, m.robot) for system in scene.systems for m in system.members]
    for name, robot in needed + driven:
        if robot not in robots:
            known = ", ".join(sorted(robots)) or "none"
            raise BadInput(
                f"{origin}: {name} names the robot '{robot}'; the robots of the scene: {known}"
            )
    for names, what in ((needed, "holds two objects"), (driven, "is a member twice")):
        several = [robot for _, robot in names]
        twice = sorted({robot for robot in several if several.count(robot) > 1})
        if twice:
            raise BadInput(f"{origin}: {', '.join(twice)} {what}; leave one out")


def plain(scene: SceneDocument) -> dict[str, Any]:
    """Return the scene as mappings, lists and numbers, for a YAML file."""
    result: dict[str, Any] = {"about": scene.about} if scene.about else {}
    result["robots"] = [_plain_robot(robot) for robot in scene.robots]
    result["objects"] = [_plain_object(thing) for thing in scene.objects]
    result["surfaces"] = [
        {
            "name": s.name,
            "label": s.label,
            **_plain_pose(s.pose),
            "vertices": s.vertices.tolist(),
            "triangles": s.triangles.tolist(),
        }
        for s in scene.surfaces
    ]
    result["systems"] = [
        {
            "name": s.name,
            "members": [
                {
                    "robot": m.robot,
                    "trajectory": m.trajectory,
                    "dwell": m.dwell,
                    "waits": list(m.waits),
                }
                for m in s.members
            ],
            "mode": s.mode,
            "policy": s.policy,
            "loop": s.loop,
            "rate": s.rate,
            "at": s.at,
        }
        for s in scene.systems
    ]
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
    return result


def _plain_object(thing: ObjectEntry) -> dict[str, Any]:
    result: dict[str, Any] = {"name": thing.name, "type": thing.type, **_plain_pose(thing.pose)}
    if thing.automatic:
        result["automatic"] = True
    if thing.held_by and thing.in_hand is not None:
        result |= {"held_by": thing.held_by, "in_hand": _plain_pose(thing.in_hand)}
    return result


def _entries(
    document: Mapping[str, Any], part: str, origin: str
) -> list[tuple[Mapping[str, Any], str]]:
    entries = document.get(part) or ()
    if not isinstance(entries, Sequence) or not all(isinstance(e, Mapping) for e in entries):
        raise BadInput(f"{origin}: '{part}' is {entries!r}; expected a list of mappings")
    return [(e, f"{origin}, {part}[{i}]") for i, e in enumerate(entries)]


def _name(entry: Mapping[str, Any], key: str, where: str) -> str:
    value = entry.get(key)
    if not isinstance(value, str) or not NAME.fullmatch(value):
        raise BadInput(f"{where}: {key} is {value!r}; expected a name such as cube_1")
    return value


def _floats(entry: Mapping[str, Any], key: str, default: list[float], where: str) -> list[float]:
    value = entry.get(key, default)
    numbers = isinstance(value, Sequence) and all(type(v) in (int, float) for v in value)
    if not numbers or len(value) != len(default):
        raise BadInput(f"{where}: {key} is {value!r}; expected {len(default)} numbers")
    return [float(v) for v in value]


def _pose(entry: Mapping[str, Any], where: str) -> Pose:
    x, y, z = _floats(entry, "position", [0.0] * 3, where)
    a, b, c, d = _floats(entry, "orientation", [0.0, 0.0, 0.0, 1.0], where)
    position: Vector = (x, y, z)
    orientation: Quaternion = (a, b, c, d)
    try:
        return Pose(position, orientation)
    except BadInput as error:
        raise BadInput(f"{where}: {error}") from None


def _matrix(entry: Mapping[str, Any], key: str, where: str, kind: Any) -> Any:
    try:
        rows = np.array(entry.get(key) or np.zeros((0, 3)), dtype=kind)
    except (TypeError, ValueError):
        rows = np.zeros(1)
    if rows.ndim != 2 or rows.shape[1] != 3:
        raise BadInput(f"{where}: {key} is no list of three numbers each")
    return rows


def _robot(entry: Mapping[str, Any], where: str) -> RobotEntry:
    _known(entry, ("name", "model", "end_effector", "trajectory", "at", *POSE), where)
    return RobotEntry(
        _name(entry, "name", where),
        _name(entry, "model", where),
        str(entry.get("end_effector") or ""),
        _pose(entry, where),
        str(entry.get("trajectory") or ""),
        _number(entry, "at", 0.0, (0.0, LONGEST), where),
    )


def _object(entry: Mapping[str, Any], where: str) -> ObjectEntry:
    _known(entry, ("name", "type", "automatic", "held_by", "in_hand", *POSE), where)
    holder, in_hand = str(entry.get("held_by") or ""), entry.get("in_hand")
    if bool(holder) != isinstance(in_hand, Mapping):
        raise BadInput(f"{where}: held_by and in_hand belong together; leave out both or none")
    return ObjectEntry(
        _name(entry, "name", where),
        _name(entry, "type", where),
        _pose(entry, where),
        _flag(entry, "automatic", where),
        holder,
        _pose(in_hand, f"{where}, in_hand") if isinstance(in_hand, Mapping) else None,
    )


def _surface(entry: Mapping[str, Any], where: str) -> Surface:
    _known(entry, ("name", "label", "vertices", "triangles", *POSE), where)
    return Surface(
        _name(entry, "name", where),
        str(entry.get("label", "")),
        _pose(entry, where),
        _matrix(entry, "vertices", where, np.float64),
        _matrix(entry, "triangles", where, np.int32),
    )


def _system(entry: Mapping[str, Any], where: str) -> SystemEntry:
    _known(entry, ("name", "members", "mode", "policy", "loop", "rate", "at"), where)
    mode, policy = entry.get("mode", 0), entry.get("policy", 0)
    if mode not in (0, 1) or policy not in (0, 1):
        raise BadInput(f"{where}: mode {mode!r}, policy {policy!r}; expected 0 or 1 each")
    members = tuple(_member(m, w) for m, w in _entries(entry, "members", where))
    if not members:
        raise BadInput(f"{where} has no members; expected a robot and a trajectory at least")
    return SystemEntry(
        _name(entry, "name", where),
        members,
        mode,
        policy,
        _flag(entry, "loop", where),
        _number(entry, "rate", 1.0, RATES, where),
        _number(entry, "at", 0.0, (0.0, LONGEST), where),
    )


def _member(entry: Mapping[str, Any], where: str) -> MemberEntry:
    _known(entry, ("robot", "trajectory", "dwell", "waits"), where)
    trajectory, waits = entry.get("trajectory"), entry.get("waits") or []
    if not isinstance(trajectory, str) or not trajectory:
        raise BadInput(f"{where}: trajectory is {trajectory!r}; expected an id of the catalogue")
    if not isinstance(waits, list):
        raise BadInput(f"{where}: waits is {waits!r}; expected a list of waits")
    dwell = _number(entry, "dwell", 0.0, (0.0, LONGEST), where)
    texts = tuple(parsed_wait(str(wait)).text for wait in waits)
    return MemberEntry(_name(entry, "robot", where), trajectory, dwell, texts)


def _known(entry: Mapping[str, Any], keys: Sequence[str], where: str) -> None:
    unknown = [str(key) for key in entry if key not in keys]
    if unknown:
        raise BadInput(f"{where} has {', '.join(unknown)}; expected {', '.join(keys)}")


def _flag(entry: Mapping[str, Any], key: str, where: str) -> bool:
    value = entry.get(key, False)
    if not isinstance(value, bool):
        raise BadInput(f"{where}: {key} is {value!r}; expected true or false")
    return value


def _number(
    entry: Mapping[str, Any],
    key: str,
    default: float,
    limits: tuple[float, float],
    where: str,
) -> float:
    value, (low, high) = entry.get(key, default), limits
    if type(value) not in (int, float) or not low <= value <= high:
        raise BadInput(f"{where}: {key} is {value!r}; expected a number of {low:g} to {high:g}")
    return float(value)


def _plain_pose(pose: Pose) -> dict[str, list[float]]:
    return {"position": list(pose.position), "orientation": list(pose.orientation)}
