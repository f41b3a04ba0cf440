"""Checks a URDF before it is imported."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from mrlab_ros.adapters.robots import diagnostics, mesh_files, urdf
from mrlab_ros.adapters.robots.diagnostics import (
    ELEMENT_UNNAMED,
    GEOMETRY_EMPTY,
    GEOMETRY_UNKNOWN,
    NAME_UNPRINTABLE,
    NO_ZERO,
    SHAPE_LACKS,
    SIZES_ABOVE_ZERO,
    TOO_MANY_LINKS,
    TWICE_IN_URDF,
    URDF_LINK,
)
from mrlab_ros.adapters.robots.mesh_files import Look
from mrlab_ros.core.base.checks import bad_value
from mrlab_ros.core.base.diagnostic import Code, Diagnostic, Severity, from_plain
from mrlab_ros.core.base.diagnostics import FIELD
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.foreign_text import for_table

MOST_JOINTS = 16
MOST_LINKS = 300
# No arm is larger than this, m; a larger one was probably exported in millimetres.
LARGEST_ARM = 20.0
# No link is heavier than this, kg.
HEAVIEST_LINK = 1e5
Resolve = Callable[[str], Path]


def check(
    text: str, origin: str, resolve: Resolve, hand: frozenset[str] = frozenset()
) -> tuple[Diagnostic, ...]:
    """Return the findings on a URDF; `resolve` returns the file of a mesh URI.

    hand: joints that the trajectory does not prescribe. Raises BadInput where the text is not a
    URDF, or a number or an attribute is not as expected.
    """
    from mrlab_ros.adapters.robots.mesh_copies import look

    root = urdf.parse(text, origin)
    found = check_root(root, origin, hand)
    files, missing = find_meshes(root, resolve)
    looks = {uri: look(path) for uri, path in files.items()}
    return (*found, *missing, *check_sizes(root, looks))


def check_root(
    root: ET.Element, origin: str, hand: frozenset[str] = frozenset()
) -> tuple[Diagnostic, ...]:
    """Return the findings on a URDF that was parsed, without its meshes; see check()."""
    joints = urdf.joints(root, origin)
    arm = tuple(joint for joint in joints if joint.name not in hand)
    return (*check_parts(root, origin, hand), *_check_count(arm))


def check_parts(
    root: ET.Element, origin: str, hand: frozenset[str] = frozenset()
) -> tuple[Diagnostic, ...]:
    """Return the findings on links and joints, however many of them move; as check_root()."""
    joints = urdf.joints(root, origin)
    _check_numbers(root, origin)
    arm = tuple(joint for joint in joints if joint.name not in hand)
    return (*check_tree(root, origin), *_check_joints(arm), *_check_inertias(root))


def errors(found: tuple[Diagnostic, ...]) -> tuple[Diagnostic, ...]:
    """Return the findings that prevent an import."""
    return tuple(one for one in found if one.severity is Severity.ERROR)


# The numbers in the elements of a link: tag, attribute, how many.
NUMBERS = (
    ("origin", "xyz", 3),
    ("origin", "rpy", 3),
    ("mass", "value", 1),
    *(("inertia", name, 1) for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")),
    ("mesh", "scale", 3),
    ("box", "size", 3),
    ("cylinder", "radius", 1),
    ("cylinder", "length", 1),
    ("sphere", "radius", 1),
    ("color", "rgba", 4),
)
SIZES = ("size", "radius", "length")
SHAPES: dict[str, tuple[str, ...]] = {
    "mesh": ("filename",),
    "box": ("size",),
    "cylinder": ("radius", "length"),
    "sphere": ("radius",),
}


def _check_numbers(root: ET.Element, origin: str) -> None:
    """Raise BadInput where a link has a number or a shape that cannot be read."""
    for link in root.iterfind("link"):
        if not link.get("name"):
            raise BadInput(ELEMENT_UNNAMED(file=origin, element="link"))
        where = URDF_LINK(file=origin, link=link.get("name"))
        for tag, name, count in NUMBERS:
            for element in link.iter(tag):
                value = element.get(name)
                if value is not None:
                    named = f"{tag} {name}"
                    read = urdf.numbers(value, count, where, named)
                    if name == "scale" and not all(read):
                        raise bad_value(FIELD(place=where, key=named), value, NO_ZERO())
                    if name in SIZES and not min(read) > 0:
                        expected = SIZES_ABOVE_ZERO(count=count)
                        raise bad_value(FIELD(place=where, key=named), value, expected)
        for geometry in link.iter("geometry"):
            shape = next(iter(geometry), None)
            if shape is None or shape.tag not in SHAPES:
                known = [f"<{tag}>" for tag in SHAPES]
                if shape is None:
                    raise BadInput(GEOMETRY_EMPTY(place=where, known=known))
                raise BadInput(GEOMETRY_UNKNOWN(place=where, tag=shape.tag, known=known))
            missing = [name for name in SHAPES[shape.tag] if not shape.get(name)]
            if missing:
                raise BadInput(SHAPE_LACKS(place=where, tag=shape.tag, missing=missing))


def check_tree(root: ET.Element, origin: str) -> tuple[Diagnostic, ...]:
    """Return the findings on what is joined to what: without an error it is one tree of links.

    Raises BadInput where two have one name, a link hangs on two joints or below itself, or there
    are more links than a robot has.
    """
    joints = urdf.joints(root, origin)
    links = [str(element.get("name")) for element in root.iterfind("link")]
    for name in (*links, *(joint.name for joint in joints)):
        if not name.isprintable() or for_table(name) != name:
            raise BadInput(NAME_UNPRINTABLE(file=origin, name=name))
    if len(links) > MOST_LINKS:
        raise BadInput(TOO_MANY_LINKS(file=origin, count=len(links), most=MOST_LINKS))
    _once([joint.name for joint in joints], origin, "joint")
    _once(links, origin, "link")
    _once([joint.child for joint in joints], origin, "child")
    for joint in joints:
        urdf.path_to(joint.child, joints)
    found = [
        diagnostics.ROBOT_NO_LINK(where=f"joint {joint.name}", joint=joint.name, link=end)
        for joint in joints
        for end in (joint.parent, joint.child)
        if end not in links
    ]
    roots = sorted(set(links) - {joint.child for joint in joints})
    if len(roots) != 1:
        found.append(diagnostics.ROBOT_ROOTS(count=len(roots), roots=roots))
    return tuple(found)


def _once(names: list[str], origin: str, what: str) -> None:
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise BadInput(TWICE_IN_URDF(file=origin, what=what, name=twice))


def _check_count(joints: tuple[urdf.UrdfJoint, ...]) -> list[Diagnostic]:
    moving = [joint for joint in joints if joint.moves and joint.mimic is None]
    if not 1 <= len(moving) <= MOST_JOINTS:
        return [diagnostics.ROBOT_JOINTS(count=len(moving), most=MOST_JOINTS)]
    return []


def _check_joints(joints: tuple[urdf.UrdfJoint, ...]) -> list[Diagnostic]:
    found = []
    for joint in joints:
        name, where = joint.name, f"joint {joint.name}"
        furthest = max(abs(value) for value in joint.xyz)
        if furthest > LARGEST_ARM:
            found.append(diagnostics.ROBOT_MILLIMETRES(where=where, joint=name, size=furthest))
        if not joint.moves:
            continue
        if joint.mimic is not None:
            found.append(diagnostics.ROBOT_MIMIC(where=where, joint=name, other=joint.mimic.joint))
        limit = joint.limit
        if limit is None or "velocity" not in limit:
            found.append(diagnostics.ROBOT_NO_LIMITS(where=where, joint=name))
            continue
        lower, upper = limit.get("lower", 0.0), limit.get("upper", 0.0)
        if joint.kind != "continuous" and not lower < upper:
            found.append(_range(diagnostics.ROBOT_LIMITS, name, lower, upper))
        if joint.kind == "revolute" and max(abs(lower), abs(upper)) > 8 * np.pi:
            found.append(_range(diagnostics.ROBOT_DEGREES, name, lower, upper))
        if not limit["velocity"] > 0:
            value = limit["velocity"]
            found.append(diagnostics.ROBOT_VELOCITY(where=where, joint=name, value=value))
        if not limit.get("effort", 0.0) > 0:
            found.append(diagnostics.ROBOT_EFFORT(where=where, joint=name))
    return found


def _range(code: Code, joint: str, lower: float, upper: float) -> Diagnostic:
    return code(where=f"joint {joint}", joint=joint, lower=lower, upper=upper)


def _check_inertias(root: ET.Element) -> list[Diagnostic]:
    found = []
    for link in root.iterfind("link"):
        inertial = link.find("inertial")
        if inertial is None:
            continue
        where = f"link {link.get('name')}"
        mass = inertial.find("mass")
        tensor = inertial.find("inertia")
        stated = float(mass.get("value", "0")) if mass is not None else 0.0
        if not 0 <= stated <= HEAVIEST_LINK:
            name = link.get("name")
            found.append(diagnostics.ROBOT_NO_MASS(where=where, link=name, mass=stated))
            continue
        if tensor is None or not stated > 0:
            found.append(diagnostics.ROBOT_MASS(where=where, link=link.get("name")))
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
            least, middle, most = map(float, moments)
            found.append(
                diagnostics.ROBOT_INERTIA(
                    where=where, link=link.get("name"), least=least, middle=middle, most=most
                )
            )
    return found


def meshes(root: ET.Element) -> list[ET.Element]:
    """Return the <mesh> elements of a URDF."""
    return list(root.iterfind("link/*/geometry/mesh"))


def find_meshes(
    root: ET.Element, resolve: Resolve
) -> tuple[dict[str, Path], tuple[Diagnostic, ...]]:
    """Return the mesh files of the links below `root` by URI, and findings on the others."""
    files, found = {}, []
    for uri in sorted({str(mesh.get("filename")) for mesh in meshes(root)}):
        try:
            path = resolve(uri)
        except BadInput as error:
            found.append(diagnostics.ROBOT_NO_MESH(where=uri, uri=uri, why=error))
            continue
        if not path.is_file():
            found.append(diagnostics.ROBOT_NO_MESH(where=uri, uri=uri))
        elif path.suffix.lower() not in mesh_files.FORMATS:
            formats = list(mesh_files.FORMATS)
            found.append(diagnostics.ROBOT_MESH_FORMAT(where=uri, uri=uri, formats=formats))
        else:
            files[uri] = path
    return files, tuple(found)


def check_sizes(root: ET.Element, looks: Mapping[str, Look]) -> tuple[Diagnostic, ...]:
    """Return the findings on meshes that were looked at, by URI."""
    found = []
    scales = {
        str(mesh.get("filename")): urdf.numbers(mesh.get("scale", "1 1 1"), 3, "mesh", "scale")
        for mesh in meshes(root)
    }
    for uri, look in looks.items():
        if look.problem is not None:
            why = from_plain(look.problem)
            found.append(diagnostics.ROBOT_MESH_UNREADABLE(where=uri, uri=uri, why=why))
            continue
        found += [
            diagnostics.ROBOT_NO_TEXTURE(where=uri, uri=uri, file=file) for file in look.missing
        ]
        size = look.size * max(map(abs, scales[uri]))
        if size > LARGEST_ARM:
            found.append(diagnostics.ROBOT_MILLIMETRES(where=uri, mesh=uri, size=size))
    return tuple(found)
