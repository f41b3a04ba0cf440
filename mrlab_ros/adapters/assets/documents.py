"""Documents about robots and objects for clients: what there is, and where its pictures are."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict
from typing import Any

from mrlab_ros.adapters.assets.diagnostics import MODEL_LEFT_OUT
from mrlab_ros.adapters.assets.files import PACKAGE, THUMBNAIL, AssetFiles
from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.end_effectors import END_EFFECTORS, EndEffector
from mrlab_ros.adapters.robots.library import TIP, RobotLibrary
from mrlab_ros.core.base.errors import LabError
from mrlab_ros.core.bridge.assets import asset_key, key_of_uri
from mrlab_ros.core.physics.catalogue import Catalogue, ObjectType
from mrlab_ros.core.robots.model import Joint


def robots(library: RobotLibrary, files: AssetFiles) -> dict[str, Any]:
    """Return what assets/robots.json says: all models and end effectors.

    A model or an end effector that cannot be read is left out and named in `problems`.
    """
    tools, left_out = library.sound_end_effectors()
    found, problems = [], list(map(str, left_out))
    for robot_id in library.ids():
        try:
            found.append(_robot(library, files, robot_id, tools))
        except (LabError, KeyError, ValueError) as error:
            why = error.diagnostic if isinstance(error, LabError) else repr(error)
            problems.append(str(MODEL_LEFT_OUT(robot=robot_id, why=why)))
    return {
        "robots": found,
        "end_effectors": [_end_effector(files, tool) for tool in tools.values()],
        "problems": problems,
    }


def objects(catalogue: Catalogue, files: AssetFiles) -> dict[str, Any]:
    """Return what assets/objects.json says: all types of objects."""
    return {"objects": [_object(catalogue.get(kind), files) for kind in catalogue.ids]}


def _robot(
    library: RobotLibrary, files: AssetFiles, robot_id: str, tools: Iterable[str]
) -> dict[str, Any]:
    model, facts = library.model(robot_id), library.facts(robot_id)
    origin = f"{robot_id}/robot.urdf"
    root = urdf.parse(library.own_description(robot_id), origin)
    kinds = {joint.name: joint.kind for joint in urdf.joints(root, origin)}
    return {
        "id": robot_id,
        "name": f"{model.manufacturer} {model.product}",
        "maker": model.manufacturer,
        "product": model.product,
        "class": model.robot_class,
        "payload": model.payload,
        "reach": model.reach,
        "joints": [_joint(joint, kinds[joint.name]) for joint in model.joints],
        "home": model.home.tolist(),
        "tip_link": facts.get("tip_link", TIP),
        # A robot with a hand of its own takes no end effector.
        "end_effectors": [] if library.hand(robot_id) else list(tools),
        "hand": sorted(library.hand(robot_id)),
        "thumbnail": _thumbnail(files, f"robots/{robot_id}/{THUMBNAIL}"),
        "urdf": asset_key(f"robots/{robot_id}.urdf"),
    }


def _end_effector(files: AssetFiles, read: EndEffector) -> dict[str, Any]:
    facts, tool = read.facts, read.facts.id
    joints = urdf.joints(read.root, tool)
    return {
        "id": tool,
        "name": facts.name,
        "class": facts.kind,
        "stroke": facts.stroke,
        "force": facts.force,
        "joints": [
            {
                **_joint(joint.limits(tool), joint.kind),
                "mimic": joint.mimic and asdict(joint.mimic),
            }
            for joint in joints
            if joint.moves
        ],
        "thumbnail": _thumbnail(files, f"robots/{END_EFFECTORS}/{tool}/{THUMBNAIL}"),
    }


def _joint(joint: Joint, kind: str) -> dict[str, Any]:
    return {
        "name": joint.name,
        "kind": kind,
        "lower": joint.lower,
        "upper": joint.upper,
        "max_velocity": joint.max_velocity,
        "max_effort": joint.max_effort,
    }


def _object(kind: ObjectType, files: AssetFiles) -> dict[str, Any]:
    solid = kind.solid
    return {
        "id": kind.id,
        "about": kind.about,
        "size": kind.size,
        "mass": kind.mass,
        "color": kind.color,
        "shape": solid and {"kind": solid.shape.value, "size": solid.size},
        "mesh": key_of_uri(kind.mesh) if kind.mesh else None,
        "thumbnail": _thumbnail(files, f"config/objects/{kind.id}.webp"),
    }


def _thumbnail(files: AssetFiles, place: str) -> str | None:
    path = f"{PACKAGE}/{place}"
    return asset_key(path) if files.find(path) else None
