"""Checks a URDF before it becomes a robot of the lab."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import numpy as np

from mrlab_ros.adapters import urdf
from mrlab_ros.core.diagnostics import Diagnostic, Severity
from mrlab_ros.core.errors import BadInput

MOST_JOINTS = 16
# No arm is larger than this, m; what seems to be is in millimetres.
LARGEST_ARM = 20.0
MESH_FORMATS = (".stl", ".dae", ".obj", ".glb", ".gltf")
Resolve = Callable[[str], Path]


def check(text: str, origin: str, resolve: Resolve) -> tuple[Diagnostic, ...]:
    """Return what is wrong or remarkable; `resolve` turns a mesh URI into a path.

    Raises BadInput where the text is no URDF at all.
    """
    root = urdf.parse(text, origin)
    joints = urdf.joints(root, origin)
    return (
        *_check_tree(root, joints),
        *_check_joints(joints),
        *_check_inertias(root),
        *_check_meshes(root, resolve),
    )


def errors(found: tuple[Diagnostic, ...]) -> tuple[Diagnostic, ...]:
    """Return the findings that keep a robot out of the lab."""
    return tuple(one for one in found if one.severity is Severity.ERROR)


def _error(code: str, message: str, remedy: str, where: str) -> Diagnostic:
    return Diagnostic(code, Severity.ERROR, message, remedy, where=where)


def _warning(code: str, message: str, remedy: str, where: str) -> Diagnostic:
    return Diagnostic(code, Severity.WARNING, message, remedy, where=where)


def _check_tree(root: ET.Element, joints: tuple[urdf.UrdfJoint, ...]) -> list[Diagnostic]:
    found = []
    links = [str(element.get("name")) for element in root.iterfind("link")]
    for joint in joints:
        for end in (joint.parent, joint.child):
            if end not in links:
                message = f"joint '{joint.name}' names link '{end}', which is not there"
                found.append(
                    _error("robot.no_link", message, "add the link or mend the name", joint.name)
                )
    roots = sorted(set(links) - {joint.child for joint in joints})
    if len(roots) != 1:
        message = f"the root links are {', '.join(roots) or 'none'}; expected exactly one"
        found.append(_error("robot.roots", message, "connect the links by fixed joints", ""))
    moving = [joint for joint in joints if joint.moves and joint.mimic is None]
    if not 1 <= len(moving) <= MOST_JOINTS:
        message = f"{len(moving)} joints move; expected 1 to {MOST_JOINTS}"
        found.append(
            _error("robot.joints", message, "fix the joints that the arm does not need", "")
        )
    return found


def _check_joints(joints: tuple[urdf.UrdfJoint, ...]) -> list[Diagnostic]:
    found = []
    for joint in joints:
        where = f"joint {joint.name}"
        if max(abs(value) for value in joint.xyz) > LARGEST_ARM:
            message = f"the origin of '{joint.name}' is {joint.xyz} m away; that is no arm's size"
            remedy = "the file seems to be in millimetres: export it in metres"
            found.append(_error("robot.millimetres", message, remedy, where))
        if not joint.moves:
            continue
        if joint.mimic is not None:
            message = f"'{joint.name}' follows '{joint.mimic}'; the lab moves it along with it"
            found.append(Diagnostic("robot.mimic", Severity.INFO, message, where=where))
        limit = joint.limit
        if limit is None or "velocity" not in limit:
            message = f"'{joint.name}' has no limits"
            remedy = "add <limit lower= upper= velocity= effort=> from the data sheet"
            found.append(_error("robot.no_limits", message, remedy, where))
            continue
        lower, upper = limit.get("lower", 0.0), limit.get("upper", 0.0)
        if joint.kind != "continuous" and not lower < upper:
            message = f"the limits of '{joint.name}' are {lower:g} to {upper:g}"
            remedy = "the lower limit must be below the upper one"
            found.append(_error("robot.limits", message, remedy, where))
        if joint.kind == "revolute" and max(abs(lower), abs(upper)) > 8 * np.pi:
            message = f"the limits of '{joint.name}' are {lower:g} to {upper:g} rad"
            found.append(
                _error("robot.degrees", message, "these seem to be degrees: write radians", where)
            )
        if not limit["velocity"] > 0:
            message = f"the velocity limit of '{joint.name}' is {limit['velocity']:g}"
            found.append(
                _error("robot.velocity", message, "write the largest speed, rad/s or m/s", where)
            )
        if not limit.get("effort", 0.0) > 0:
            message = f"the largest effort of '{joint.name}' is not known"
            found.append(Diagnostic("robot.effort", Severity.INFO, message, where=where))
    return found


def _check_inertias(root: ET.Element) -> list[Diagnostic]:
    found = []
    for link in root.iterfind("link"):
        inertial = link.find("inertial")
        if inertial is None:
            continue
        where = f"link {link.get('name')}"
        mass = inertial.find("mass")
        tensor = inertial.find("inertia")
        if mass is None or tensor is None or not float(mass.get("value", "0")) > 0:
            message = f"the inertial of '{link.get('name')}' has no positive mass or no inertia"
            found.append(_warning("robot.mass", message, "give both, or leave it out", where))
            continue
        value = {key: float(number) for key, number in tensor.items()}
        matrix = np.array(
            [
                [value.get("ixx", 0), value.get("ixy", 0), value.get("ixz", 0)],
                [value.get("ixy", 0), value.get("iyy", 0), value.get("iyz", 0)],
                [value.get("ixz", 0), value.get("iyz", 0), value.get("izz", 0)],
            ]
        )
        moments = np.linalg.eigvalsh(matrix)
        if not moments[0] > 0 or moments[2] > (moments[0] + moments[1]) * 1.001:
            listed = ", ".join(f"{moment:.3g}" for moment in moments)
            message = f"the principal moments of '{link.get('name')}' are {listed} kg*m^2"
            remedy = "no body has these: each is positive and none exceeds the sum of the others"
            found.append(_warning("robot.inertia", message, remedy, where))
    return found


def meshes(root: ET.Element) -> list[ET.Element]:
    """Return the <mesh> elements of a URDF."""
    return list(root.iterfind("link/*/geometry/mesh"))


def _check_meshes(root: ET.Element, resolve: Resolve) -> list[Diagnostic]:
    found = []
    for uri in sorted({str(mesh.get("filename")) for mesh in meshes(root)}):
        try:
            path = resolve(uri)
        except BadInput as error:
            remedy = "give its folder with --package NAME=FOLDER"
            found.append(_error("robot.no_mesh", str(error), remedy, uri))
            continue
        if not path.is_file():
            remedy = "install the package that holds it"
            found.append(_error("robot.no_mesh", f"mesh {uri} is missing", remedy, uri))
        elif path.suffix.lower() not in MESH_FORMATS:
            remedy = f"convert it to one of {', '.join(MESH_FORMATS)}"
            message = f"mesh {uri} is of a format that the lab does not draw"
            found.append(_error("robot.mesh_format", message, remedy, uri))
    scales = {
        str(mesh.get("filename")): float(str(mesh.get("scale", "1")).split()[0])
        for mesh in meshes(root)
    }
    for uri, scale in scales.items():
        size = _mesh_size(uri, resolve) * scale
        if size > LARGEST_ARM:
            message = f"mesh {uri} is {size:.0f} m large"
            remedy = 'it seems to be in millimetres: add scale="0.001 0.001 0.001"'
            found.append(_error("robot.millimetres", message, remedy, uri))
    return found


def _mesh_size(uri: str, resolve: Resolve) -> float:
    """Return the longest side of a mesh in its file's unit; 0 where it cannot be read."""
    import trimesh

    try:
        bounds = trimesh.load(resolve(uri)).bounds
    except Exception:  # every mesh reader has errors of its own; a missing file is told above
        return 0.0
    return 0.0 if bounds is None else float(np.ptp(bounds, axis=0).max())
