"""The castings of a robot as finely as they are seen at arm's length.

The meshes of links, which other programs read, are too coarse for that where a robot is large.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import details
import kuka
import measured
import numpy as np
from materials import BLACK
from measured import Region
from scipy.spatial import cKDTree
from solids import Array

from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh, creased, together

NEIGHBOURS = 10  # vertices of the casting that tell a normal
SPREAD = 0.003  # m, at which a neighbour counts half
ALIKE = 0.8  # cosine between normals of one wall
LEFT_OUT = replace(BLACK, name="left out")


class Castings:
    """The castings of a robot of `kuka.ROBOTS`, made anew from its measured outlines.

    pieces: the meshes of its links, of which the parts on top of the castings are taken.
    """

    def __init__(
        self, figures: dict[str, Any], pieces: dict[str, list[tuple[Material, Mesh]]]
    ) -> None:
        self._links = kuka.ROBOTS[figures["id"]]
        found = measured.surfaces(figures, self._links, dense=True)
        self._surfaces = {link: mesh for link, (_, mesh) in found.items()}
        self._walls = {link: creased(mesh) for link, mesh in self._surfaces.items()}
        self._parts = {
            link: pieces[link][len(pieces[link]) - len(own.parts) :]
            for link, own in self._links.items()
        }
        without = details.table(figures["id"]).get("without", [])
        self._painted = {
            link: replace(own, regions=(*own.regions, *_left_out(without, link)))
            for link, own in self._links.items()
        }

    def thinned(self, triangles: float) -> dict[str, list[tuple[Material, Mesh]]]:
        """Return the bodies of so many triangles in all, evenly exact on all links."""
        parts = sum(len(mesh.faces) for own in self._parts.values() for _, mesh in own)
        thin = together(list(self._surfaces.values()), int(triangles) - parts)
        result = {}
        for (link, own), mesh in zip(self._painted.items(), thin, strict=True):
            painted = [
                (material, shaded(creased(piece), self._walls[link]))
                for material, piece in measured.painted(mesh, own)
                if material is not LEFT_OUT
            ]
            result[link] = [*painted, *self._parts[link]]
        return result


def _left_out(boxes: list[dict[str, Any]], link: str) -> list[Region]:
    return [Region(LEFT_OUT, box["low"], box["high"]) for box in boxes if box["link"] == link]


def shaded(mesh: Mesh, wall: Mesh) -> Mesh:
    """Return the mesh with normals of the finer one, where that has such a wall nearby."""
    away, near = cKDTree(wall.vertices).query(mesh.vertices, NEIGHBOURS)
    others = wall.normals[near]
    alike = np.einsum("nkc,nc->nk", others, mesh.normals)
    weight = np.where(alike > ALIKE, 1 / (1 + (away / SPREAD) ** 2), 0.0)
    told: Array = (weight[..., None] * others).sum(axis=1)
    length = np.linalg.norm(told, axis=1, keepdims=True)
    normals = np.where(length > 1e-3, told / np.maximum(length, 1e-9), mesh.normals)
    return Mesh(mesh.vertices, mesh.faces, np.round(normals, 4))
