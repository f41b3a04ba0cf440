"""Generate robot.urdf and meshes/ of robots and end effectors: `generate.py [--out DIR] [ID ...]`.

The same description gives the same bytes on one machine, and on every machine the same surfaces
within the tolerances of test/support/data/generated_meshes.py: processors sum in different orders,
and the last bits decide which edge the thinning removes first.
"""

from __future__ import annotations

import argparse
import shutil
import struct
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import cobots
import convex
import cuts
import glb
import hulls
import kuka
import materials
import measured
import numpy as np
import tools
import yaml
from body import Body
from facets import joined
from figure import figure
from materials import BLACK, SKIN
from mesher import contour
from solids import Array, Solid
from urdf_writer import LinkFiles, urdf

from mrlab_ros.adapters.robots.hulls import samples
from mrlab_ros.adapters.robots.packing.surfaces import GRID, Material, Mesh, creased, decimated
from mrlab_ros.core.base.geometry import inverse_transform, transform_from_xyz_rpy

ROBOTS = Path(__file__).resolve().parents[2] / "robots"
TRIANGLES = 14_700  # a model
TRIANGLES_TOOL = 4_983
LARGE = 2.0  # m of reach, from which a robot is a large one
TRIANGLES_LARGE = 17_800  # the files of a large one stay below 400 kB, too
CASTINGS = 0.76  # of a model's triangles; their many edges need more corners
SEEN = 0.01  # m, between the points of a drawn casting that its hulls hold
HELD = 0.008  # m, between the points at which that is measured again
CELLS = 56  # along the longest side of a part
FIGURE = "figure"  # the person of 1.8 m beside the robots in pictures

BODIES: dict[str, Callable[[], Body]] = {
    "ur5e": cobots.ur5e,
    "parallel_gripper": tools.parallel_gripper,
    "centric_gripper": tools.centric_gripper,
    "vacuum_cup": tools.vacuum_cup,
    "holding_magnet": tools.holding_magnet,
}


def zero_poses(figures: dict[str, Any]) -> dict[str, Array]:
    """Return T_base_link of every link with all joints at zero."""
    joints = figures["joints"]
    poses = {joints[0]["parent"]: np.eye(4)}
    for joint in joints:
        poses[joint["child"]] = poses[joint["parent"]] @ transform_from_xyz_rpy(
            joint["xyz"], joint["rpy"]
        )
    return poses


def _area(mesh: Mesh) -> float:
    a, b, c = (mesh.vertices[mesh.faces[:, i]] for i in range(3))
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())


def _placed(mesh: Mesh, pose: Array) -> Mesh:
    vertices = mesh.vertices @ pose[:3, :3].T + pose[:3, 3]
    return replace(
        mesh,
        vertices=np.round(vertices / GRID) * GRID + 0.0,
        normals=np.round(mesh.normals @ pose[:3, :3].T, 4) + 0.0,
    )


def _stl(path: Path, triangles: Array) -> None:
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    record = np.zeros(
        len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("extra", "<u2")]
    )
    record["normal"], record["corners"] = np.round(normal, 4) + 0.0, triangles
    path.write_bytes(
        b"convex hull".ljust(80, b"\0") + struct.pack("<I", len(record)) + record.tobytes()
    )


def _written(folder: Path, link: str, corners: list[Array], pose: Array) -> list[str]:
    names = []
    for number, vertices in enumerate(corners):
        placed = vertices @ pose[:3, :3].T + pose[:3, 3]
        names.append(f"{link}_hull_{number}.stl")
        _stl(folder / names[-1], convex.triangles(np.round(placed, 5) + 0.0))
    return names


@dataclass(frozen=True, eq=False)
class Shape:
    """A link as it is written: its pieces in its own frame, and what its hulls must hold.

    shells: solids with the triangles of their surfaces; seen: lists of points of what is drawn,
    one of each part; pose: from the frame of shells and seen to the link's frame.
    """

    pieces: list[tuple[Material, Mesh]]
    shells: list[tuple[Solid, Array]]
    seen: list[Array]
    pose: Array


def described(body: Body, poses: dict[str, Array], budget: float) -> dict[str, Shape]:
    """Return the shapes of a body that is modelled in the base frame."""
    raw = []
    for link, parts in body.links.items():
        for part in parts:
            cell = max(float((part.solid.high - part.solid.low).max()) / CELLS, 0.0006)
            raw.append((link, part, contour(part.solid, cell)))
    weight = np.array([_area(mesh) ** 0.5 for _, _, mesh in raw])
    shapes: dict[str, Shape] = {}
    for link in body.links:
        shape = Shape([], [], [], inverse_transform(poses[link]))
        groups: dict[str, tuple[Material, list[Mesh]]] = {}
        for (owner, part, mesh), share in zip(raw, weight / weight.sum(), strict=True):
            if owner == link:
                small = creased(decimated(mesh, max(int(share * budget), 60)))
                shape.seen.append(small.vertices)
                shape.shells.append((part.solid, mesh.vertices[mesh.faces]))
                group = groups.setdefault(part.material.name, (part.material, []))
                group[1].append(_placed(small, shape.pose))
        shape.pieces.extend((material, joined(meshes)) for material, meshes in groups.values())
        shapes[link] = shape
    return shapes


def from_outlines(
    links: dict[str, measured.Link], figures: dict[str, Any], budget: float
) -> dict[str, Shape]:
    """Return the shapes of a robot whose castings are measured, each in its link's frame."""
    castings = measured.surfaces(figures, links)
    weight = {link: _area(mesh) ** 0.5 for link, (_, mesh) in castings.items()}
    shapes = {}
    for link, (solid, mesh) in castings.items():
        small = decimated(mesh, int(budget * CASTINGS * weight[link] / sum(weight.values())))
        pieces = [
            (material, creased(piece)) for material, piece in measured.painted(small, links[link])
        ]
        seen = samples(small.vertices[small.faces], SEEN)
        shape = Shape(pieces, [(solid, mesh.vertices[mesh.faces])], [seen], np.eye(4))
        for part in links[link].parts:
            cell = max(float((part.solid.high - part.solid.low).max()) / CELLS, 0.0006)
            part_mesh = contour(part.solid, cell)
            drawn = creased(decimated(part_mesh, 400))
            shape.pieces.append((part.material, drawn))
            shape.shells.append((part.solid, part_mesh.vertices[part_mesh.faces]))
            shape.seen.append(drawn.vertices)
        shapes[link] = shape
    return shapes


def make(place: Path, source: str, target: str, out: Path) -> None:
    """Generate the meshes and the URDF of one model from its figures and its body.

    place: the model's folder, relative to the library; source, target: the names of its figures
    and its URDF; out: the library that the files are written to.
    """
    folder = out / place
    figures = yaml.safe_load((ROBOTS / place / source).read_text())
    name = figures["id"]
    budget = TRIANGLES if source == "robot.yaml" else TRIANGLES_TOOL
    if figures.get("reach", 0) > LARGE:
        budget = TRIANGLES_LARGE
    if name in kuka.ROBOTS:
        shapes = from_outlines(kuka.ROBOTS[name], figures, budget)
    else:
        shapes = described(BODIES[name](), zero_poses(figures), budget)
    # Written aside and renamed at the end: a model is complete at any time.
    meshes = folder / "meshes.new"
    shutil.rmtree(meshes, ignore_errors=True)
    meshes.mkdir(parents=True)
    files: dict[str, LinkFiles] = {}
    for link, shape in shapes.items():
        glb.write(meshes / f"{link}.glb", shape.pieces)
        if link in figures.get("boxes", {}):
            # Pad and slide are boxes of the URDF; the jaw is convex, so it is its own hull.
            parts = BODIES[name]().links[link]
            own = [vertices for part, vertices in zip(parts, shape.seen, strict=True)
                   if part.material is BLACK]  # fmt: skip
            names = _written(meshes, link, own, shape.pose)
        else:
            cover = cuts.cover_all if name in kuka.ROBOTS else hulls.cover_all
            corners = cover(shape.shells, np.concatenate(shape.seen))
            if name in kuka.ROBOTS:
                drawn = [mesh.vertices[mesh.faces] for _, mesh in shape.pieces]
                corners = convex.held(corners, samples(np.concatenate(drawn), HELD))
            names = _written(meshes, link, corners, shape.pose)
        files[link] = LinkFiles(f"{link}.glb", tuple(names))
    text = urdf(figures, files, f"package://mrlab_ros/robots/{place.as_posix()}/meshes")
    shutil.rmtree(folder / "meshes", ignore_errors=True)
    meshes = meshes.rename(folder / "meshes")
    (folder / target).write_text(text)
    size = sum(file.stat().st_size for file in meshes.glob("*.glb"))
    count = sum(len(file.collision) for file in files.values())
    triangles = sum(len(mesh.faces) for shape in shapes.values() for _, mesh in shape.pieces)
    print(f"{name}: {triangles} triangles, {size / 1e3:.0f} kB, {count} hulls")


def paint(name: str, out: Path) -> None:
    """Give the present meshes of a model the materials of the table; their surfaces stay."""
    known = {each.name: each for each in vars(materials).values() if isinstance(each, Material)}
    for file in sorted(out.glob(f"**/{name}/meshes/*.glb")):
        glb.write(file, [(known[material.name], mesh) for material, mesh in glb.read(file)])


def main() -> None:
    """Generate the models named on the command line, or all of them and the person."""
    parser = argparse.ArgumentParser(description="Generate the bodies of robots.")
    parser.add_argument("ids", nargs="*", metavar="ID", help="models, or figure; none: all")
    parser.add_argument("--out", type=Path, default=ROBOTS, help="the library to write to")
    parser.add_argument(
        "--paint",
        action="store_true",
        help="only take the materials anew",
    )
    chosen = parser.parse_args()
    known = [*kuka.ROBOTS, *BODIES, FIGURE]
    unknown = sorted(set(chosen.ids) - set(known))
    if unknown:
        parser.error(f"no body is described for {', '.join(unknown)}; known: {', '.join(known)}")
    chosen.out.mkdir(parents=True, exist_ok=True)
    for name in chosen.ids or known:
        if name == FIGURE:
            person = creased(decimated(contour(figure(), 0.014), 3000))
            glb.write(chosen.out / f"{FIGURE}.glb", [(SKIN, person)])
        elif chosen.paint:
            paint(name, chosen.out)
        elif (ROBOTS / name).is_dir():
            make(Path(name), "robot.yaml", "robot.urdf", chosen.out)
        else:
            tool = Path("end_effectors") / name
            make(tool, "end_effector.yaml", "end_effector.urdf", chosen.out)


if __name__ == "__main__":
    main()
