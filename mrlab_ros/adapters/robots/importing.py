"""Imports a robot from a URDF of the user."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path

import yaml
from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

from mrlab_ros.adapters.robots import checks, mesh_files, urdf
from mrlab_ros.adapters.robots.library import MESH_PREFIX, TIP, RobotLibrary
from mrlab_ros.core.diagnostics import Diagnostic
from mrlab_ros.core.errors import BadInput

ID = re.compile(r"[a-z][a-z0-9_]{0,47}")


def find_urdf(source: str) -> Path:
    """Return the URDF for a path or for the name of an installed ROS package."""
    path = Path(source)
    if path.is_file():
        if path.suffix == ".xacro":
            raise BadInput(
                f"{path.name} is a xacro; run `xacro {path.name} -o robot.urdf` and import that"
            )
        return path
    try:
        share = Path(get_package_share_directory(source))
    except (PackageNotFoundError, ValueError):
        raise BadInput(
            f"'{source}' is neither a file nor an installed ROS package; give the path of a URDF"
        ) from None
    found = sorted(share.rglob("*.urdf"))
    if len(found) != 1:
        names = ", ".join(str(file.relative_to(share)) for file in found) or "none"
        raise BadInput(
            f"package '{source}' holds these URDFs: {names}; give the path of the one you want"
        )
    return found[0]


class MeshFinder:
    """Resolves mesh URIs: in the given package folders first, then in installed packages."""

    def __init__(self, base: Path, packages: Mapping[str, Path]) -> None:
        self.base = base
        self.packages = packages

    def __call__(self, uri: str) -> Path:
        """Return the path that the URI names; raise BadInput where its package is unknown."""
        if uri.startswith("package://"):
            package, _, rest = uri.removeprefix("package://").partition("/")
            if package in self.packages:
                return self.packages[package] / rest
            try:
                return Path(get_package_share_directory(package)) / rest
            except PackageNotFoundError:
                raise BadInput(f"package '{package}' of mesh {uri} is not installed") from None
        return self.base / uri.removeprefix("file://")


def import_robot(
    source: Path, robot_id: str, library: RobotLibrary, packages: Mapping[str, Path]
) -> tuple[Diagnostic, ...]:
    """Check the URDF and install it under `robot_id`; return the findings.

    With a finding that is an error nothing is installed. Raises BadInput for an id that is
    malformed or already used.
    """
    if not ID.fullmatch(robot_id):
        raise BadInput(
            f"the id is '{robot_id}'; expected small letters, digits and _, such as my_robot"
        )
    if robot_id in library.ids():
        raise BadInput(f"there is a robot '{robot_id}' already; choose another id with --id")
    try:
        text = source.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{source} cannot be read: {error}; expected a URDF") from None
    find = MeshFinder(source.parent, packages)
    found = checks.check(text, source.name, find)
    if checks.errors(found):
        return found
    root = urdf.parse(text, source.name)
    tip = _tip(root, source.name)
    folder = library.imported / robot_id
    (folder / "meshes").mkdir(parents=True, exist_ok=True)
    names: dict[str, str] = {}
    for mesh in checks.meshes(root):
        uri = str(mesh.get("filename"))
        if uri not in names:
            names[uri] = mesh_files.copy(find(uri), folder / "meshes", f"{len(names):02d}")
        mesh.set("filename", f"{MESH_PREFIX}{robot_id}/meshes/{names[uri]}")
    ET.indent(root)
    body = ET.tostring(root, encoding="unicode")
    (folder / "robot.urdf").write_text(f'<?xml version="1.0"?>\n{body}\n', encoding="utf-8")
    (folder / "robot.yaml").write_text(_facts(root, robot_id, tip, source), encoding="utf-8")
    return found


def _tip(root: ET.Element, origin: str) -> str:
    """Return tool0 if the robot has it, else the leaf link below the most moving joints."""
    joints = urdf.joints(root, origin)
    links = [str(element.get("name")) for element in root.iterfind("link")]
    if TIP in links:
        return TIP
    parents = {joint.parent for joint in joints}
    leaves = [link for link in links if link not in parents]
    return max(
        leaves,
        key=lambda leaf: sum(j.moves and not j.mimic for j in urdf.path_to(leaf, joints)[1]),
    )


def _facts(root: ET.Element, robot_id: str, tip: str, source: Path) -> str:
    """Return the text of robot.yaml; home is 0 if the limits allow it, else their middle."""
    from math import degrees

    _, joints = urdf.chain(root, tip, source.name)
    home = [0.0 if j.lower <= 0 <= j.upper else (j.lower + j.upper) / 2 for j in joints]
    facts = {
        "id": robot_id,
        "manufacturer": "imported",
        "product": root.get("name", robot_id),
        "class": "imported robot",
        "payload": 0.0,
        "reach": 0.0,
        "reach_definition": "flange",
        "tip_link": tip,
        "home_deg": [round(degrees(angle), 6) for angle in home],
        "sources": [{"file": source.name}],
        "notes": ["Payload and reach are unknown: write them here from the data sheet."],
    }
    return yaml.safe_dump(facts, sort_keys=False)
