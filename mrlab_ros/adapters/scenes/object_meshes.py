"""The meshes of the catalogue's objects, read from files with trimesh and checked."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from mrlab_ros.adapters.scenes.diagnostics import (
    OBJECT_MESH_EMPTY,
    OBJECT_MESH_FLAT,
    OBJECT_MESH_MISSING,
    OBJECT_MESH_SIZE,
    OBJECT_MESH_TOO_FINE,
    OBJECT_MESH_UNREADABLE,
    OBJECT_MESH_URI,
)
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.physics.catalogue import Mesh

PREFIX = "package://mrlab_ros/"
FORMATS = (".glb", ".obj", ".stl")
SIZE_RANGE = (0.002, 5.0)  # m, of the largest edge of the bounding box
# More corners of a hull cost time at every step and make it no better.
HULL_CORNERS = 128


class ObjectMeshes:
    """The meshes below `root` that package:// URIs name; see catalogue.Meshes."""

    def __init__(self, root: Path, max_triangles: int) -> None:
        self._root = root
        self._max_triangles = max_triangles

    def find(self, uri: str) -> Path:
        """Return where a mesh is; raise BadInput where there is none of a known format."""
        path = (self._root / uri.removeprefix(PREFIX)).resolve()
        if not uri.startswith(PREFIX) or path.suffix.lower() not in FORMATS:
            raise BadInput(OBJECT_MESH_URI(mesh=uri, prefix=PREFIX, formats=[*FORMATS]))
        if not path.is_file():
            raise BadInput(OBJECT_MESH_MISSING(mesh=uri, path=str(path)))
        return path

    def read(self, uri: str) -> Mesh:
        """Read a mesh.

        Raises BadInput where there is none, where it has more than `max_triangles`, naming the
        number, or where it is no size that an object has.
        """
        # It takes 80 MiB, and most labs have no object that collides with a mesh.
        import trimesh

        path = self.find(uri)
        try:
            mesh: Any = trimesh.load(path, force="mesh", process=False)
        except Exception as error:  # trimesh raises what its parsers happen to raise
            raise BadInput(OBJECT_MESH_UNREADABLE(mesh=uri, why=str(error))) from None
        vertices = np.array(mesh.vertices, dtype=np.float64)
        triangles = np.array(mesh.faces, dtype=np.int32)
        if len(triangles) > self._max_triangles:
            most = self._max_triangles
            raise BadInput(OBJECT_MESH_TOO_FINE(mesh=uri, count=len(triangles), most=most))
        if not len(triangles) or not np.isfinite(vertices).all():
            raise BadInput(OBJECT_MESH_EMPTY(mesh=uri))
        size = float(np.ptp(vertices, axis=0).max())
        low, high = SIZE_RANGE
        if not low <= size <= high:
            raise BadInput(OBJECT_MESH_SIZE(mesh=uri, size=size, low=low, high=high))
        return Mesh(vertices, triangles)

    def hull(self, uri: str) -> Mesh:
        """Return the convex hull of the corners that reach furthest; raise BadInput as read(), or
        where it is flat."""
        import trimesh
        from scipy.spatial import QhullError

        try:
            hull: Any = trimesh.convex.convex_hull(extreme(self.read(uri).vertices))
        except QhullError:
            raise BadInput(OBJECT_MESH_FLAT(mesh=uri)) from None
        return Mesh(np.array(hull.vertices), np.array(hull.faces, dtype=np.int32))


def extreme(vertices: Array) -> Array:
    """Return the vertices that reach furthest, each in one of HULL_CORNERS even directions.

    Directions: a Fibonacci lattice on the sphere.
    """
    k = np.arange(HULL_CORNERS) + 0.5
    z = 1 - 2 * k / HULL_CORNERS
    turn = math.pi * (1 + math.sqrt(5)) * k
    across = np.sqrt(1 - z * z)
    directions = np.stack([across * np.cos(turn), across * np.sin(turn), z])
    kept: Array = vertices[np.unique((vertices @ directions).argmax(axis=0))]
    return kept
