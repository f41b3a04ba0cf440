"""Measures sections of links on public meshes: `outlines.py CLONES ROBOT...`.

Writes them into the robot's dense table (sections/dense/<ROBOT>.json), of which what pages draw
is made; box, axes and silhouettes are those that are there. CLONES holds clones of the
repositories that the tables name; a link whose mesh is not there, or does not overlap what was
measured before, stays as it is. A mesh may be open: each outline is filled, hollows that no
outline shows are not in it.
"""

from __future__ import annotations

import argparse
import json
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import measured
import numpy as np
import shapely
import trimesh
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from shapely.geometry import MultiPolygon, Polygon
from shapely.ops import unary_union
from solids import Array

from mrlab_ros.core.base.geometry import transform_from_xyz_rpy

SLIT = 2.0  # mm; edges of an open mesh that are as near meet
LEAKS = (12.0, 40.0, 90.0)  # mm; wider gaps that are closed where what lies behind them is inside
WAYS = 96  # in which a point looks out
ENCLOSED = 0.12  # of them; of a point inside a casting fewer lead out, through its gaps
TRIES = 5  # points of an area that is doubted
POINTS = 64  # of an outline at most
EXACT, WIDER, COARSEST = 0.5, 1.25, 6.0  # mm by which outlines are simplified, first and at most
SMALLEST = 100.0  # mm^2, of an outline
STEP = 0.5  # mm, to which points are rounded
APART, COUNTS = 6.0, (20, 72)  # mm, between sections; their number
DEEP = 8.0  # mm below the outlines that were measured before
AROUND = 3.0  # mm, around the boxes of what is left out
ALIKE = 0.85  # overlap with the outlines that stand in the table


def sections(mesh: trimesh.Trimesh, link: dict[str, Any], count: int) -> list[dict[str, Any]]:
    """Return `count` sections of the mesh, mm, each in the middle of its slab.

    What lies deep inside the sections that the table has is inside: a wall may be missing.
    """
    axis = "xyz".index(link["slice_axis"])
    columns = ["xyz".index(letter) for letter in link["section_axes"]]
    low, high = (corner[axis] for corner in link["box"])
    places = low + (np.arange(count) + 0.5) * (high - low) / count
    found = []
    enclosed = Enclosed(mesh)
    for place in places:
        shape = _whole(mesh, axis, place, columns, enclosed).union(core(link, place))
        outlines = [_simplified(part) for part in _outer(shape)]
        found.append({"at": round(float(place), 1), "outlines": outlines})
    return found


def overlap(mesh: trimesh.Trimesh, link: dict[str, Any]) -> float:
    """Return the overlap of a table's sections with those of the mesh: 0 to 1, the median."""
    axis = "xyz".index(link["slice_axis"])
    columns = ["xyz".index(letter) for letter in link["section_axes"]]
    shares = []
    for section in link["sections"]:
        ours = unary_union(_filled(mesh, axis, section["at"], columns))
        theirs = _drawn(section["outlines"])
        shares.append(ours.intersection(theirs).area / max(ours.union(theirs).area, 1.0))
    return float(np.median(shares))


class Enclosed:
    """Tells of points whether they lie inside a mesh that may be open: few ways lead out."""

    def __init__(self, mesh: trimesh.Trimesh) -> None:
        self._scene = EmbreeScene()
        TriangleMesh(self._scene, mesh.vertices[mesh.faces].astype(np.float32))
        number = np.arange(WAYS) + 0.5
        up, turn = 1 - 2 * number / WAYS, number * np.pi * (3 - np.sqrt(5))
        across = np.sqrt(1 - up**2)
        self._ways = np.column_stack([across * np.cos(turn), across * np.sin(turn), up])

    def __call__(self, points: Array) -> Array:
        """Return for each point, (N, 3) mm, whether it lies inside."""
        starts = np.repeat(points, WAYS, axis=0).astype(np.float32)
        ways = np.tile(self._ways, (len(points), 1)).astype(np.float32)
        out = self._scene.run(starts, ways, output=True)["primID"] < 0
        return np.asarray(out.reshape(-1, WAYS).mean(axis=1) < ENCLOSED)


def _whole(
    mesh: trimesh.Trimesh, axis: int, place: float, columns: list[int], enclosed: Enclosed
) -> Any:
    """Return what lies inside the mesh on a plane.

    Where a wall has a gap, the lines on the plane do not close: what wider slits would close is
    taken where its points lie inside.
    """
    found = unary_union(_filled(mesh, axis, place, columns))
    random = np.random.default_rng(3)
    for slit in LEAKS:
        more = unary_union(_filled(mesh, axis, place, columns, slit)).difference(found.buffer(0.1))
        for shape in _parts(more):
            if shape.area < SMALLEST or shape.buffer(-SLIT).is_empty:
                continue
            tries: Array = np.empty((0, 2))
            low, high = np.array(shape.bounds).reshape(2, 2)
            while len(tries) < TRIES:
                points = random.uniform(low, high, (64, 2))
                inside = shapely.contains_xy(shape, points[:, 0], points[:, 1])
                tries = np.concatenate([tries, points[inside]])[:TRIES]
            spots = np.full((TRIES, 3), place)
            spots[:, columns] = tries
            if enclosed(spots).mean() > 0.5:
                found = found.union(shape.buffer(0.2))
    return found


def core(link: dict[str, Any], place: float) -> Any:
    """Return what is deep inside the table's sections on both sides of a plane."""
    near = sorted(link.get("sections", ()), key=lambda one: abs(one["at"] - place))[:2]
    if len(near) < 2:
        return Polygon()
    one, other = (_drawn(section["outlines"]) for section in near)
    return one.intersection(other).buffer(-DEEP)


def _drawn(outlines: list[list[float]]) -> Any:
    flat = [np.array(outline, float).reshape(-1, 2) for outline in outlines]
    return unary_union([Polygon(points).buffer(0) for points in flat])


def _outer(shape: Any) -> list[Polygon]:
    """Return the parts of a shape without their holes, the largest first."""
    large = [Polygon(part.exterior) for part in _parts(shape) if part.area > SMALLEST]
    return sorted(large, key=lambda part: -part.area)


def _filled(
    mesh: trimesh.Trimesh, axis: int, place: float, columns: list[int], slit: float = SLIT
) -> list[Polygon]:
    """Return what lies within the lines in which a plane meets the mesh, the largest first."""
    across = np.eye(3)[axis]
    lines = trimesh.intersections.mesh_plane(mesh, across, across * place)
    if not len(lines):
        return []
    lines = lines[..., columns]
    lines = lines[np.linalg.norm(lines[:, 0] - lines[:, 1], axis=1) > 1e-6]
    drawn = unary_union(shapely.buffer(shapely.linestrings(lines), slit / 2, quad_segs=4))
    whole = unary_union([Polygon(shape.exterior) for shape in _parts(drawn)])
    # Lines of nothing between them, such as a sheet's, leave nothing.
    shapes = _parts(whole.buffer(-slit / 2, join_style="mitre", mitre_limit=2))
    return _outer(MultiPolygon(shapes))


def _parts(shape: Any) -> list[Polygon]:
    return list(shape.geoms) if isinstance(shape, MultiPolygon) else [shape]


def _simplified(shape: Polygon) -> list[float]:
    by = EXACT
    while True:
        simple = shape.simplify(by)
        if len(simple.exterior.coords) - 1 <= POINTS or by > COARSEST:
            break
        by *= WIDER
    points: Array = np.round(np.array(simple.exterior.coords)[:-1] / STEP) * STEP
    return [int(value) if value == int(value) else float(value) for value in points.ravel()]


def located(clones: Path, link: dict[str, Any]) -> tuple[Path, Array]:
    """Return the mesh that a table names, and its pose (4, 4) in the link's frame, m.

    The pose is the table's own where it states one, as of a sibling's part, else that of the
    description which names the mesh.
    """
    repository, path = link["source"].split(";")[0].split(" ")[:2]
    package, _, inside = path.partition("/")
    folder = clones / repository.split("/")[1] / package
    if "pose" in link:
        xyz, rpy = np.array(link["pose"][:3]) * 0.001, np.radians(link["pose"][3:])
        return folder / inside, transform_from_xyz_rpy(xyz, rpy)
    for description in sorted(folder.glob("urdf/*.xacro")):
        for element in ET.parse(description).getroot().iter("visual"):
            named = element.find("geometry/mesh")
            origin = element.find("origin")
            if named is not None and str(named.get("filename")).endswith(f"/{inside}"):
                stated = {} if origin is None else origin.attrib
                xyz, rpy = (
                    [float(value) for value in stated.get(key, "0 0 0").split()]
                    for key in ("xyz", "rpy")
                )
                return folder / inside, transform_from_xyz_rpy(xyz, rpy)
    return folder / inside, np.eye(4)


def read(clones: Path, link: dict[str, Any]) -> trimesh.Trimesh:
    """Return the mesh that a table names, mm in the link's frame, without what it leaves out."""
    file, pose = located(clones, link)
    whole = trimesh.load_scene(file).to_geometry().apply_transform(pose).apply_scale(1000)
    # Corners that only a normal or a picture parts are one.
    bare = trimesh.Trimesh(whole.vertices, whole.faces)
    bare.merge_vertices()
    boxes = np.array(link.get("left_out", np.empty((0, 2, 3))), float)
    kept = []
    for part in bare.split(only_watertight=False):
        low, high = part.bounds
        inside = (low >= boxes[:, 0] - AROUND) & (high <= boxes[:, 1] + AROUND)
        if not inside.all(axis=1).any():
            kept.append(part)
    return trimesh.util.concatenate(kept)


def main() -> None:
    """Measure the links whose meshes are there, and write them into the tables of their robots."""
    parser = argparse.ArgumentParser(description="Measure sections of links on public meshes.")
    parser.add_argument("clones", type=Path, help="the folder with the clones of the sources")
    parser.add_argument("ids", nargs="+", metavar="ID", help="robots")
    chosen = parser.parse_args()
    for robot in chosen.ids:
        path = measured.DENSE_TABLES / f"{robot}.json"
        known = path if path.is_file() else measured.TABLES / path.name
        tables = json.loads(known.read_text())
        for name, link in tables.items():
            if "as" in link or "gap" in link or not located(chosen.clones, link)[0].is_file():
                continue
            before = measured.table(robot, name)
            mesh = read(chosen.clones, link)
            alike = overlap(mesh, before)
            if alike < ALIKE:
                print(f"{robot} {name}: overlaps {link['source']} by {alike:.2f}: left as it is")
                continue
            axis = "xyz".index(link["slice_axis"])
            count = int(np.clip((link["box"][1][axis] - link["box"][0][axis]) / APART, *COUNTS))
            link["sections"] = sections(mesh, before, count)
            print(f"{robot} {name}: {count} sections, overlap before {alike:.3f}", flush=True)
        rows = [
            f' "{name}": {json.dumps(each, separators=(",", ":"))}'
            for name, each in tables.items()
        ]
        path.write_text("{\n" + ",\n".join(rows) + "}\n")


if __name__ == "__main__":
    main()
