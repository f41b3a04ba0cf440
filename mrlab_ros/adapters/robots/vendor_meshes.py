"""Replaces the meshes of a library robot by those of its vendor's description."""

from __future__ import annotations

import shutil
import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from mrlab_ros.adapters.robots import checks, drawing, mesh_copies, urdf
from mrlab_ros.adapters.robots.diagnostics import (
    ANOTHER_SHAPE,
    MESHES_NEED,
    NO_CLONE,
    NO_SHARED_LINK,
    NOT_IMPORTED,
    NOT_OF_LIBRARY,
    ROBOT_FRAME,
)
from mrlab_ros.adapters.robots.drawing import Assembly
from mrlab_ros.adapters.robots.importing.source import (
    MeshFinder,
    description_text,
    packages_around,
)
from mrlab_ros.adapters.robots.library import MESH_PREFIX, RobotLibrary
from mrlab_ros.adapters.robots.vendor_sources import NOTICE, TEXTS, Clone, Pinned
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array

LARGEST_SHIFT = 1e-4  # m, between the same link's frames in both descriptions
LARGEST_TURN = 1e-4  # rad
ALIKE = 0.85  # of the silhouettes of the lab's body and a vendor's


def use_meshes(
    source: Path,
    robot_id: str,
    library: RobotLibrary,
    packages: Mapping[str, Path],
    *,
    arguments: Sequence[str] = (),
    collision: bool = False,
) -> tuple[Diagnostic, ...]:
    """Install the meshes of `source`, a URDF or a xacro, for the links with the same names.

    Kinematics, limits and masses stay those of the library, and so do the convex hulls unless
    `collision` is true; physics then takes the convex hull of each collision mesh. With a finding
    that is an error nothing is installed. Raises BadInput if no link has a counterpart, or if
    the robot is not one of the library.
    """
    if not (library.folder / robot_id / "robot.urdf").is_file():
        raise BadInput(NOT_OF_LIBRARY(robot=robot_id))
    ours = urdf.parse(library.own_description(robot_id), robot_id)
    packages = packages_around(source) | dict(packages)
    theirs = urdf.parse(description_text(source, packages, arguments), source.name)
    find = MeshFinder(source.parent, packages)
    shared = _shared(ours, theirs, robot_id, source.name)
    taken = ("visual", "collision") if collision else ("visual",)
    meshed = ET.Element("robot")
    for link in shared.values():
        meshed.append(link)
        for shape in [*link]:
            if shape.tag not in taken:
                link.remove(shape)
    folder = library.imported / robot_id
    aside = folder.with_name(f".{robot_id}.new")
    shutil.rmtree(aside, ignore_errors=True)
    (aside / "meshes").mkdir(parents=True)
    files, missing = checks.find_meshes(meshed, find)
    looks = mesh_copies.take(meshed, files, find.folders, aside / "meshes", "vendor_")
    found = (
        *_frames(ours, theirs, shared, robot_id, source.name),
        *missing,
        *checks.check_sizes(meshed, looks),
    )
    if checks.errors(found):
        shutil.rmtree(aside)
        return found
    mesh_copies.name_copies(meshed, looks, f"{MESH_PREFIX}{robot_id}/meshes")
    for link in ours.iterfind("link"):
        other = shared.get(str(link.get("name")))
        for tag in taken:
            shapes = [] if other is None else other.findall(tag)
            if shapes:
                for old in link.findall(tag):
                    link.remove(old)
                link.extend(shapes)
    ET.indent(ours)
    text = f'<?xml version="1.0"?>\n{ET.tostring(ours, encoding="unicode")}\n'
    (aside / "robot.urdf").write_text(text, encoding="utf-8")
    shutil.rmtree(folder, ignore_errors=True)
    aside.rename(folder)
    return found


def dress(
    robot_id: str, source: Pinned, clone: Clone, library: RobotLibrary, before_and_after: Path
) -> Worn:
    """Let a robot wear the meshes of the description that it was taken from, packed for pages.

    Licence and notices of the repository are kept beside the meshes, with its address and commit.
    before_and_after: a folder for the picture of both bodies. With a finding that is an error the
    robot keeps the body that it has. Raises BadInput as `use_meshes` does, and where a
    package that packs meshes is missing.
    """
    try:
        import embreex  # noqa: F401
        import fast_simplification  # noqa: F401

        from mrlab_ros.adapters.robots import vendor_levels
    except ModuleNotFoundError as error:
        raise BadInput(MESHES_NEED(package=str(error.name))) from None
    names = clone.files()
    texts = [name for name in names if name.endswith(TEXTS) or NOTICE.search(name)]
    before = drawing.bodies(RobotLibrary(library.folder, library.imported / "none"), robot_id)
    with tempfile.TemporaryDirectory(prefix="mrlab-") as made:
        tree = Path(made, source.repository.rpartition("/")[2])
        clone.copy(texts, tree)
        path = next((tree / name for name in source.names if (tree / name).is_file()), None)
        if path is None:
            raise BadInput(NO_CLONE(repository=source.repository, folder=str(clone.folder)))
        packages = packages_around(path)
        text = description_text(path, packages, source.arguments)
        wanted = _seen_folders(urdf.parse(text, path.name), packages, tree)
        clone.copy([name for name in names if name.rpartition("/")[0] in wanted], tree)
        found = use_meshes(path, robot_id, library, packages, arguments=source.arguments)
        if checks.errors(found):
            return Worn(found)
        folder = library.imported / robot_id
        share = vendor_levels.overlap(library, robot_id)
        if share < ALIKE:
            shutil.rmtree(folder)
            return Worn((*found, ANOTHER_SHAPE(robot=robot_id, share=share, least=ALIKE)))
        made_of = {"repository": source.address, "commit": clone.commit or source.commit}
        triangles = vendor_levels.write(library, robot_id, made_of)
        notices = [name for name in names if NOTICE.search(name) and _applies(name, wanted)]
        for name in notices:
            kept = folder / "licence" / name
            kept.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(tree / name, kept)
    origin = [source.address, f"commit {made_of['commit']}", source.path, source.licence]
    (folder / "licence").mkdir(exist_ok=True)
    (folder / "licence" / "SOURCE.txt").write_text("\n".join([*origin, ""]), encoding="utf-8")
    picture = before_and_after / f"{robot_id}.png"
    vendor_levels.picture(library, robot_id, before, picture)
    files = vendor_levels.sizes(folder)
    return Worn(found, triangles, files, share, tuple(notices), picture)


@dataclass(frozen=True)
class Worn:
    """What came of dressing a robot.

    triangles and sizes (bytes) by level; share: of the silhouettes that both bodies have; notices:
    the files of the repository that are kept; None and empty where nothing was installed.
    """

    findings: tuple[Diagnostic, ...]
    triangles: Mapping[str, int] = field(default_factory=dict)
    sizes: Mapping[str, int] = field(default_factory=dict)
    share: float = 0.0
    notices: tuple[str, ...] = ()
    picture: Path | None = None


def _seen_folders(root: ET.Element, packages: Mapping[str, Path], tree: Path) -> set[str]:
    """Return the folders of the repository that hold what is seen: meshes, their pictures."""
    found = set()
    for mesh in root.iterfind("link/visual/geometry/mesh"):
        package, _, inside = str(mesh.get("filename")).removeprefix("package://").partition("/")
        place = Path(str(mesh.get("filename")).removeprefix("file://"))
        if package in packages:
            place = packages[package] / inside
        if place.is_relative_to(tree):
            found.add(place.relative_to(tree).parent.as_posix())
    return found


def _applies(notice: str, folders: set[str]) -> bool:
    """Return whether a notice is of one of the folders, or of one that holds it."""
    above, _, _ = notice.rpartition("/")
    return (
        any(folder == above or folder.startswith(f"{above}/") for folder in folders) or not above
    )


def remove(robot_id: str, library: RobotLibrary) -> None:
    """Remove an imported robot, or the vendor's meshes of a library robot."""
    folder = library.imported / robot_id
    if not robot_id or not (folder / "robot.urdf").is_file():
        raise BadInput(NOT_IMPORTED(robot=robot_id))
    shutil.rmtree(folder)


def _shared(
    ours: ET.Element, theirs: ET.Element, robot_id: str, origin: str
) -> dict[str, ET.Element]:
    """Return their links that have meshes and a link of ours by the same name."""
    names = {link.get("name") for link in ours.iterfind("link")}
    meshed = {
        str(link.get("name")): link
        for link in theirs.iterfind("link")
        if link.find("*/geometry/mesh") is not None
    }
    shared = {name: link for name, link in meshed.items() if name in names}
    if not shared:
        links = sorted(map(str, names))
        raise BadInput(NO_SHARED_LINK(file=origin, meshed=[*meshed], robot=robot_id, links=links))
    return shared


def _frames(
    ours: ET.Element,
    theirs: ET.Element,
    shared: Mapping[str, ET.Element],
    robot_id: str,
    origin: str,
) -> list[Diagnostic]:
    """Compare the poses of the shared links, relative to the first one, in two configurations."""
    found: dict[str, Diagnostic] = {}
    joints = [joint.name for joint in urdf.joints(ours, robot_id) if joint.moves]
    first = next(iter(shared))
    robots = Assembly(ours, robot_id), Assembly(theirs, origin)
    for angle in (0.0, 0.4):
        positions = {name: angle * (number + 1) / 2 for number, name in enumerate(joints)}
        for robot in robots:
            robot.move(positions)
        one, other = (robot.poses() for robot in robots)
        for name in shared:
            between = np.linalg.solve(_between(one, first, name), _between(other, first, name))
            distance = float(np.linalg.norm(between[:3, 3]))
            turn = between[:3, :3]
            angle_off = float(np.arccos(np.clip((np.trace(turn) - 1) / 2, -1, 1)))
            # arccos is inexact near 0; there the angle comes from the skew-symmetric part.
            skew = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0]])
            angle_off = max(angle_off if angle_off > 0.01 else 0.0, float(np.abs(skew).max()) / 2)
            if distance > LARGEST_SHIFT or angle_off > LARGEST_TURN:
                found[name] = ROBOT_FRAME(
                    where=f"link {name}",
                    link=name,
                    origin=origin,
                    robot=robot_id,
                    distance=distance,
                    angle=angle_off,
                )
    return list(found.values())


def _between(poses: Mapping[str, Array], first: str, name: str) -> Array:
    return np.asarray(np.linalg.solve(poses[first], poses[name]))
