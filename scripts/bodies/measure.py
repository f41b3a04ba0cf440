"""Measures bodies against measured shapes: `measure.py [--library DIR] [--drawn] [ID ...]`.

Prints for each robot the overlap of silhouettes (intersection over union, mean over poses and
views) and for each link the distance between the surfaces, 95th percentile of both ways, mm. The
shapes are the outlines of scripts/bodies/sections. Parts named hose or cable are left out.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import kuka
import measured
import numpy as np
import picture
import trimesh
from manifold3d import CrossSection, FillRule, JoinType, Manifold, OpType
from PIL import Image, ImageDraw
from scipy.spatial import cKDTree

from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.geometry import Array

ROOT = Path(__file__).resolve().parents[2]
VIEWS = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0.75, -1, 0.4]])
POSES = 4
OVERLAP = 0.5  # mm, of the slabs: the places of sections are rounded
PIXELS = 420  # along the longer side of a picture
POINTS = 6000  # on each link
IOU = 0.92
LEAST_MM, SHARE = 15.0, 0.04  # of the longest side of a link, between the surfaces
FLEXIBLE = ("hose", "cable")


def solid(link: dict[str, Any]) -> trimesh.Trimesh:
    """Return the slabs between the sections of a link, within its silhouettes; mm.

    Slits between pieces of a collision mesh, up to its `gap`, are closed: the casting has none.
    """
    gap = link.get("gap", 0)
    axes, axis = link["section_axes"], "xyz".index(link["slice_axis"])
    low, high = np.array(link["box"], float)
    sections = link["sections"]
    thick = (high[axis] - low[axis]) / len(sections)
    slabs = [
        _extruded(
            axes,
            section["outlines"],
            section["at"] - thick / 2 - OVERLAP,
            thick + 2 * OVERLAP,
            gap,
        )
        for section in sections
        if section["outlines"]
    ]
    whole = Manifold.batch_boolean(slabs, OpType.Add)
    for plane, outline in link["silhouettes"].items():
        along = 3 - sum("xyz".index(letter) for letter in plane)
        length = high[along] - low[along] + 2
        seen = _extruded(plane, outline["outer"], low[along] - 1, length, gap)
        if outline.get("holes"):
            seen -= _extruded(plane, outline["holes"], low[along] - 2, length + 2)
        whole ^= seen
    mesh = whole.to_mesh()
    return trimesh.Trimesh(mesh.vert_properties[:, :3], mesh.tri_verts)


def _extruded(
    axes: str, outlines: list[list[float]], start: float, length: float, gap: float = 0.0
) -> Manifold:
    flat = [np.array(outline, float).reshape(-1, 2) for outline in outlines]
    # Either sense of rotation counts as filled.
    flat = [p if _area(p) > 0 else p[::-1] for p in flat]
    section = CrossSection(flat, FillRule.NonZero)
    if gap:
        section = section.offset(gap / 2, JoinType.Miter).offset(-gap / 2, JoinType.Miter)
    body = Manifold.extrude(section, length)
    columns = ["xyz".index(letter) for letter in axes]
    columns.append(3 - sum(columns))
    turn = np.zeros((3, 4))
    turn[columns, [0, 1, 2]] = 1
    turn[columns[2], 3] = start
    return body.transform(turn)


def _area(points: Array) -> float:
    x, y = points.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1))


def body(path: Path) -> trimesh.Trimesh:
    """Return the mesh of a link without its hoses and cables, m."""
    parts = []
    for name, part in trimesh.load_scene(path).geometry.items():
        words = f"{name} {part.visual.material.name}".lower()
        if not any(word in words for word in FLEXIBLE):
            parts.append(part)
    return trimesh.util.concatenate(parts)


def drawn_body(made: Path, link: str) -> trimesh.Trimesh:
    """Return what pages draw of a link nearby, m."""
    parts = picture.drawn(made / "lod" / "near.glb", {link: np.eye(4)})
    return trimesh.util.concatenate([trimesh.Trimesh(p.vertices, p.faces) for p in parts])


def silhouette(meshes: list[trimesh.Trimesh], view: Array, low: Array, size: float) -> Array:
    """Return the picture, True where a mesh is, seen along `view`; low, size: of the window."""
    image = Image.new("1", (PIXELS, PIXELS))
    draw = ImageDraw.Draw(image)
    across = _across(view)
    for mesh in meshes:
        flat = (mesh.vertices @ across.T - low) / size * (PIXELS - 1)
        for triangle in flat[mesh.faces].reshape(-1, 6).tolist():
            draw.polygon(triangle, fill=1)
    return np.asarray(image)


def _across(view: Array) -> Array:
    ahead = view / np.linalg.norm(view)
    up = np.array([0.0, 0, 1]) if abs(ahead[2]) < 0.9 else np.array([0.0, 1, 0])
    right = np.cross(ahead, up)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(right, ahead)])


def distance(one: trimesh.Trimesh, other: trimesh.Trimesh) -> float:
    """Return the 95th percentile of the distances between two surfaces, both ways."""
    samples = [trimesh.sample.sample_surface(mesh, POINTS * 5, seed=1)[0] for mesh in (one, other)]
    trees = [cKDTree(points) for points in samples]
    ways = [trees[1].query(samples[0][::5])[0], trees[0].query(samples[1][::5])[0]]
    return max(float(np.percentile(way, 95)) for way in ways)


def poses(library: RobotLibrary, robot: str) -> Array:
    """Return the poses that are compared, (N, J) rad: home, zero, and others by chance."""
    model = library.model(robot)
    joints = [segment for segment in model.chain.segments if segment.axis is not None]
    random = np.random.default_rng(5)
    turns = random.uniform(-1.2, 1.2, (POSES - 2, len(joints)))
    return np.concatenate([[model.home, np.zeros(len(joints))], turns])


def compare(
    library: RobotLibrary, robot: str, links: dict[str, Any], made: Path, drawn: bool = False
) -> tuple[float, dict[str, tuple[float, float]]]:
    """Return the overlap and, for each link, the distance and its bound, mm.

    made: the robot's folder; drawn: what pages draw nearby instead of the meshes.
    """
    truth = {name: solid(link) for name, link in links.items()}
    for mesh in truth.values():
        mesh.apply_scale(0.001)
    ours = {
        name: drawn_body(made, name) if drawn else body(made / "meshes" / f"{name}.glb")
        for name in links
    }
    chain = library.model(robot).chain
    overlaps = []
    for pose in poses(library, robot):
        frames = chain.links(pose)
        placed = [
            [mesh.copy().apply_transform(frames[name]) for name, mesh in meshes.items()]
            for meshes in (ours, truth)
        ]
        points = np.concatenate([mesh.vertices for meshes in placed for mesh in meshes])
        for view in VIEWS:
            flat = points @ _across(view).T
            low = flat.min(axis=0)
            size = float((flat.max(axis=0) - low).max())
            a, b = (silhouette(meshes, view, low, size) for meshes in placed)
            overlaps.append((a & b).sum() / (a | b).sum())
    found = {}
    for name, link in links.items():
        bound = max(LEAST_MM, SHARE * float(np.ptp(np.array(link["box"]), axis=0).max()))
        found[name] = (distance(ours[name], truth[name]) * 1000, bound)
    return float(np.mean(overlaps)), found


def main() -> None:
    """Print a row for each robot, then one for each link that is further off than it may be."""
    parser = argparse.ArgumentParser(description="Measure bodies against measured shapes.")
    parser.add_argument("--library", type=Path, default=ROOT / "robots", help="bodies to measure")
    parser.add_argument("--table", action="store_true", help="print rows of a page's table")
    parser.add_argument("--drawn", action="store_true", help="what pages draw, not the meshes")
    parser.add_argument("ids", nargs="*", metavar="ID", help="robots; none: all with outlines")
    chosen = parser.parse_args()
    library = RobotLibrary(ROOT / "robots", ROOT / "robots" / "none imported")
    for robot in chosen.ids or kuka.ROBOTS:
        tables = {link: measured.table(robot, link, chosen.drawn) for link in kuka.ROBOTS[robot]}
        made = chosen.library / robot
        overlap, links = compare(library, robot, tables, made, chosen.drawn)
        if chosen.table:
            values = " | ".join(f"{value:.0f}" for value, _ in links.values())
            print(f"| `{robot}` | {overlap:.3f} | {values} |", flush=True)
            continue
        note = "" if overlap >= IOU else f"  below {IOU}"
        values = " ".join(f"{value:5.1f}" for value, _ in links.values())
        print(f"{robot:22} IoU {overlap:.3f}  p95 mm {values}{note}", flush=True)
        for name, (value, bound) in links.items():
            if value > bound:
                print(f"    {name}: {value:.1f} mm, at most {bound:.1f}")


if __name__ == "__main__":
    main()
