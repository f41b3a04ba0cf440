"""A scene as a file holds it: robots, objects, surfaces and systems, checked when read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.physics.poses import Quaternion, Vector
from mrlab_ros.core.physics.surfaces import Surface
from mrlab_ros.core.scene import NAME, Pose

PARTS = ("about", "robots", "objects", "surfaces", "systems")


@dataclass(frozen=True)
class RobotEntry:
    name: str
    model: str
    end_effector: str
    pose: Pose


@dataclass(frozen=True)
class ObjectEntry:
    """automatic: on the nearest surface below the pose."""

    name: str
    type: str
    pose: Pose
    automatic: bool = False


@dataclass(frozen=True)
class SystemEntry:
    """members: robot and trajectory id of each. mode, policy: as in mrlab_msgs/RobotSystem."""

    name: str
    members: tuple[tuple[str, str], ...]
    mode: int = 0
    policy: int = 0
    loop: bool = False


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
    robots = tuple(
        RobotEntry(
            _name(e, "name", w),
            _name(e, "model", w),
            str(e.get("end_effector") or ""),
            _pose(e, w),
        )
        for e, w in _entries(document, "robots", origin)
    )
    objects = tuple(
        ObjectEntry(
            _name(e, "name", w), _name(e, "type", w), _pose(e, w), e.get("automatic") is True
        )
        for e, w in _entries(document, "objects", origin)
    )
    surfaces = tuple(
        Surface(
            _name(e, "name", w),
            str(e.get("label", "")),
            _pose(e, w),
            _matrix(e, "vertices", w, np.float64),
            _matrix(e, "triangles", w, np.int32),
        )
        for e, w in _entries(document, "surfaces", origin)
    )
    systems = tuple(_system(e, w) for e, w in _entries(document, "systems", origin))
    for what, entries in (("robot", robots), ("object", objects), ("surface", surfaces)):
        names = [entry.name for entry in entries]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise BadInput(f"{origin} names the {what} {', '.join(twice)} twice; rename one")
    return SceneDocument(robots, objects, surfaces, systems, str(document.get("about", "")))


def plain(scene: SceneDocument) -> dict[str, Any]:
    """Return the scene as mappings, lists and numbers, for a YAML file."""
    result: dict[str, Any] = {"about": scene.about} if scene.about else {}
    result["robots"] = [
        {"name": r.name, "model": r.model, "end_effector": r.end_effector, **_plain_pose(r.pose)}
        for r in scene.robots
    ]
    result["objects"] = [
        {"name": o.name, "type": o.type, **_plain_pose(o.pose)} for o in scene.objects
    ]
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
            "members": [{"robot": r, "trajectory_id": t} for r, t in s.members],
            "mode": s.mode,
            "policy": s.policy,
            "loop": s.loop,
        }
        for s in scene.systems
    ]
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


def _system(entry: Mapping[str, Any], where: str) -> SystemEntry:
    members = tuple(
        (_name(m, "robot", w), str(m.get("trajectory_id", "")))
        for m, w in _entries(entry, "members", where)
    )
    mode, policy = entry.get("mode", 0), entry.get("policy", 0)
    if mode not in (0, 1) or policy not in (0, 1):
        raise BadInput(f"{where}: mode {mode!r}, policy {policy!r}; expected 0 or 1 each")
    return SystemEntry(
        _name(entry, "name", where), members, mode, policy, entry.get("loop") is True
    )


def _plain_pose(pose: Pose) -> dict[str, list[float]]:
    return {"position": list(pose.position), "orientation": list(pose.orientation)}
