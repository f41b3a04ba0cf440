"""Measures sections of a link on a public mesh: `outlines.py ROBOT LINK FILE --sections N`.

Writes them into the robot's table (sections/<ROBOT>.json) in place of those that it has; its box,
axes and silhouettes stay. The mesh is in m and in the link's frame, and may be open: each outline
is filled, hollows that no outline shows are not in it.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import measured
import numpy as np
import shapely
import trimesh
from shapely.geometry import MultiPolygon, Polygon
from shapely.ops import unary_union
from solids import Array

SLIT = 2.0  # mm; edges of an open mesh that are as near meet
POINTS = 40  # of an outline at most
EXACT, WIDER, COARSEST = 0.5, 1.25, 6.0  # mm by which outlines are simplified, first and at most
SMALLEST = 100.0  # mm^2, of an outline
STEP = 0.5  # mm, to which points are rounded
ALIKE = 0.85  # overlap with the outlines that stand in the table


def sections(mesh: trimesh.Trimesh, link: dict[str, Any], count: int) -> list[dict[str, Any]]:
    """Return `count` sections of the mesh, mm, each in the middle of its slab."""
    axis = "xyz".index(link["slice_axis"])
    columns = ["xyz".index(letter) for letter in link["section_axes"]]
    low, high = (corner[axis] for corner in link["box"])
    places = low + (np.arange(count) + 0.5) * (high - low) / count
    found = []
    for place in places:
        outlines = [_simplified(shape) for shape in _filled(mesh, axis, place, columns)]
        found.append({"at": round(float(place), 1), "outlines": outlines})
    return found


def overlap(mesh: trimesh.Trimesh, link: dict[str, Any]) -> float:
    """Return the overlap of a table's sections with those of the mesh: 0 to 1, the median."""
    axis = "xyz".index(link["slice_axis"])
    columns = ["xyz".index(letter) for letter in link["section_axes"]]
    shares = []
    for section in link["sections"]:
        ours = unary_union(_filled(mesh, axis, section["at"], columns))
        flat = [np.array(outline, float).reshape(-1, 2) for outline in section["outlines"]]
        theirs = unary_union([Polygon(points).buffer(0) for points in flat])
        shares.append(ours.intersection(theirs).area / max(ours.union(theirs).area, 1.0))
    return float(np.median(shares))


def _filled(mesh: trimesh.Trimesh, axis: int, place: float, columns: list[int]) -> list[Polygon]:
    """Return what lies within the lines in which a plane meets the mesh, the largest first."""
    across = np.eye(3)[axis]
    lines = trimesh.intersections.mesh_plane(mesh, across, across * place)
    if not len(lines):
        return []
    lines = lines[..., columns]
    lines = lines[np.linalg.norm(lines[:, 0] - lines[:, 1], axis=1) > 1e-6]
    drawn = unary_union(shapely.buffer(shapely.linestrings(lines), SLIT / 2, quad_segs=4))
    whole = unary_union([Polygon(shape.exterior) for shape in _parts(drawn)])
    # Lines of nothing between them, such as a sheet's, leave nothing.
    shapes = _parts(whole.buffer(-SLIT / 2, join_style="mitre", mitre_limit=2))
    large = [Polygon(shape.exterior) for shape in shapes if shape.area > SMALLEST]
    return sorted(large, key=lambda shape: -shape.area)


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


def main() -> None:
    """Measure the sections of one link and write them into its robot's table."""
    parser = argparse.ArgumentParser(description="Measure sections of a link on a mesh.")
    parser.add_argument("robot")
    parser.add_argument("link")
    parser.add_argument("file", type=Path, help="the mesh that the table names as its source")
    parser.add_argument("--sections", type=int, default=60, metavar="N")
    chosen = parser.parse_args()
    path = measured.TABLES / f"{chosen.robot}.json"
    table = json.loads(path.read_text())
    link = table[chosen.link]
    mesh = trimesh.load_scene(chosen.file).to_geometry()
    mesh.apply_scale(1000)
    alike = overlap(mesh, link)
    if alike < ALIKE:
        parser.error(
            f"{chosen.file} overlaps the sections of {chosen.link} by {alike:.2f}, at least "
            f"{ALIKE} is expected: is it {link['source']}, in the frame of the link?"
        )
    link["sections"] = sections(mesh, link, chosen.sections)
    rows = [
        f' "{name}": {json.dumps(each, separators=(",", ":"))}' for name, each in table.items()
    ]
    path.write_text("{\n" + ",\n".join(rows) + "}\n")
    print(f"{chosen.robot} {chosen.link}: {chosen.sections} sections, overlap before {alike:.3f}")


if __name__ == "__main__":
    main()
