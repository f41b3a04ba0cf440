"""Robots as tables: a measured casting for each link, painted by regions, with parts on top.

Everything here is in the frame of the link, so that a table can be compared with its source.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from body import Part
from casting import casting
from drums import turned_true
from fairing import faired
from mesher import contour, smoothed
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from solids import Array, Solid

from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh, decimated
from mrlab_ros.core.base.geometry import transform_from_xyz_rpy

TABLES = Path(__file__).parent / "sections"  # of meshes and hulls
DENSE_TABLES = TABLES / "dense"  # of what pages draw
SAMPLES, SAMPLES_DENSE = 2e6, 4e6  # of the box of a casting
DENSE = 0.009  # m, between sections: what is as near shows edges, and they stay
SHARP = 0.003  # m, the largest fillet of edges that sections show
SHRED = 0.03  # of the area of a casting; a piece apart from it is larger
FINEST = 0.0018  # m
MOST = 40_000  # triangles of a surface; more cost time and show nothing


@dataclass(frozen=True)
class Region:
    """A box of the link's frame, mm, in which the casting has another material."""

    material: Material
    low: Sequence[float]
    high: Sequence[float]


@dataclass(frozen=True, eq=False)
class Link:
    """A casting of one material, its regions of another (the last one counts) and its parts."""

    material: Material
    regions: tuple[Region, ...] = ()
    parts: tuple[Part, ...] = field(default=())


@cache
def table(robot: str, link: str, dense: bool = False) -> dict[str, Any]:
    """Return the measured outlines of a link, those of a like one where the table names it.

    dense: those in DENSE_TABLES where there are such.
    """
    place = DENSE_TABLES / f"{robot}.json"
    tables = json.loads(place.read_text()) if dense and place.is_file() else {}
    tables = tables if link in tables else json.loads((TABLES / f"{robot}.json").read_text())
    found: dict[str, Any] = tables[link]
    return table(*found["as"].split("/"), dense) if "as" in found else found


def surface(
    robot: str, link: str, axes: Sequence[Array], dense: bool = False
) -> tuple[Solid, Mesh]:
    """Return a link's faired casting, and its surface with exact drums about the joints' axes.

    axes: poses (4, 4) whose z axes are those; dense: from the sections in DENSE_TABLES.
    """
    # Robots of a family share links: one table, one surface.
    key = id(table(robot, link, dense)), np.round(axes, 6).tobytes(), dense
    if key not in _SURFACES:
        _SURFACES[key] = _surface(table(robot, link, dense), axes, dense)
    return _SURFACES[key]


_SURFACES: dict[tuple[int, bytes, bool], tuple[Solid, Mesh]] = {}


def _surface(outlines: dict[str, Any], axes: Sequence[Array], dense: bool) -> tuple[Solid, Mesh]:
    body = casting(outlines)
    along = "xyz".index(outlines["slice_axis"])
    dense &= (body.high - body.low)[along] < DENSE * len(outlines["sections"])
    samples = SAMPLES_DENSE if dense else SAMPLES
    cell = max(float(np.cbrt(np.prod(body.high - body.low) / samples)), FINEST)
    body = turned = faired(body, cell, SHARP if dense else None)
    for pose in axes:
        turned = turned_true(turned, pose)
    return body, decimated(smoothed(whole(contour(turned, cell))), MOST)


def surfaces(
    figures: dict[str, Any], links: Mapping[str, Link], dense: bool = False
) -> dict[str, tuple[Solid, Mesh]]:
    """Return the castings of a robot's links with their surfaces, each in its link's frame."""
    found = {}
    for link in links:
        own = [] if link == figures["joints"][0]["parent"] else [np.eye(4)]
        axes = own + [
            transform_from_xyz_rpy(joint["xyz"], joint["rpy"])
            for joint in figures["joints"]
            if joint["parent"] == link and joint["type"] != "fixed"
        ]
        found[link] = surface(figures["id"], link, axes, dense)
    return found


def whole(mesh: Mesh) -> Mesh:
    """Return the mesh without what hangs in mid-air: shreds of hoses between two sections."""
    faces = mesh.faces
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]]]).T
    graph = coo_matrix((np.ones(edges.shape[1]), edges), shape=(len(mesh.vertices),) * 2)
    piece = connected_components(graph, directed=False)[1][faces[:, 0]]
    a, b, c = (mesh.vertices[faces[:, i]] for i in range(3))
    area = np.bincount(piece, weights=np.linalg.norm(np.cross(b - a, c - a), axis=1))
    faces = faces[(area > SHRED * area.sum())[piece]]
    used, index = np.unique(faces, return_inverse=True)
    return Mesh(mesh.vertices[used], index.reshape(-1, 3), mesh.normals)


def painted(mesh: Mesh, link: Link) -> list[tuple[Material, Mesh]]:
    """Return the mesh split along the borders of the regions, by material."""
    for region in link.regions:
        low, high = np.array(region.low) * 0.001, np.array(region.high) * 0.001
        for axis in range(3):
            for place in (low[axis], high[axis]):
                mesh = _split(mesh, axis, place, low, high)
    middle = mesh.vertices[mesh.faces].mean(axis=1) * 1000
    owner = np.zeros(len(mesh.faces), dtype=int)
    for number, region in enumerate(link.regions, 1):
        owner[((middle > region.low) & (middle < region.high)).all(axis=1)] = number
    materials = [link.material, *(region.material for region in link.regions)]
    groups: dict[str, tuple[Material, list[int]]] = {}
    for number, material in enumerate(materials):
        groups.setdefault(material.name, (material, []))[1].append(number)
    pieces = []
    for material, numbers in groups.values():
        faces = mesh.faces[np.isin(owner, numbers)]
        if len(faces):
            pieces.append((material, Mesh(mesh.vertices, faces, mesh.normals)))
    return pieces


def _split(mesh: Mesh, axis: int, place: float, low: Array, high: Array) -> Mesh:
    """Return the mesh with its triangles that cross a side of the box cut in two there."""
    height = mesh.vertices[:, axis] - place
    height = np.where(np.abs(height) < 1e-5, 0.0, height)
    side = np.sign(height)[mesh.faces]
    corners = mesh.vertices[mesh.faces]
    near = ((corners.max(axis=1) >= low) & (corners.min(axis=1) <= high)).all(axis=1)
    crossing = near & (side.min(axis=1) < 0) & (side.max(axis=1) > 0)
    vertices = list(mesh.vertices)
    known: dict[tuple[int, int], int] = {}

    def between(a: int, b: int) -> int:
        edge = (min(a, b), max(a, b))
        if edge not in known:
            share = height[edge[0]] / (height[edge[0]] - height[edge[1]])
            known[edge] = len(vertices)
            vertices.append(vertices[edge[0]] * (1 - share) + vertices[edge[1]] * share)
        return known[edge]

    # Neighbours outside the box share the cut edges, so that no gap opens.
    faces = [mesh.faces[~crossing]]
    for face in mesh.faces[crossing]:
        faces.append(_pieces([int(v) for v in face], height, between))
    cut = Mesh(np.array(vertices), np.concatenate(faces), mesh.normals)
    return _closed(cut, known)


def _pieces(face: list[int], height: Array, between: Any) -> Array:
    ring: list[int] = []
    on: list[int] = []
    for n in range(3):
        a, b = face[n], face[(n + 1) % 3]
        ring.append(a)
        if height[a] == 0:
            on.append(len(ring) - 1)
        if height[a] * height[b] < 0:
            ring.append(between(a, b))
            on.append(len(ring) - 1)
    first, second = on[:2]
    one = ring[first : second + 1]
    other = ring[second:] + ring[: first + 1]
    fans = [
        [part[0], part[n], part[n + 1]] for part in (one, other) for n in range(1, len(part) - 1)
    ]
    return np.array(fans, dtype=np.int64)


def _closed(mesh: Mesh, cut: dict[tuple[int, int], int]) -> Mesh:
    """Return the mesh with whole triangles beside a cut edge split at the same point."""
    faces = []
    for face in mesh.faces.tolist():
        edges = [(min(a, b), max(a, b)) for a, b in zip(face, face[1:] + face[:1], strict=True)]
        hit = [n for n, edge in enumerate(edges) if edge in cut]
        if not hit:
            faces.append(face)
            continue
        ring = []
        for n in range(3):
            ring.append(face[n])
            if n in hit:
                ring.append(cut[edges[n]])
        start = ring.index(cut[edges[hit[0]]])
        ring = ring[start:] + ring[:start]
        faces += [[ring[0], ring[n], ring[n + 1]] for n in range(1, len(ring) - 1)]
    return Mesh(mesh.vertices, np.array(faces, dtype=np.int64), mesh.normals)
