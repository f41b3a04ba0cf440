"""Pieces of a link as they are packed: meshes of one material with their light."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mrlab_ros.adapters.robots.packing.surfaces import Faces, Material, Mesh
from mrlab_ros.core.base.geometry import Array


@dataclass(frozen=True, eq=False)
class Piece:
    """A mesh of one material and the light at its vertices, (V,) 0 to 1.

    drawing: the number in the atlas of what is drawn on it; places: (V, 2) of its vertices there,
    0 to 1 from the left top.
    """

    material: Material
    mesh: Mesh
    light: Array
    drawing: int | None = None
    places: Array | None = None


def rows_of(piece: Piece) -> Array:
    """Return the vertices of a piece, (V, 7): place, normal, light."""
    mesh = piece.mesh
    return np.column_stack([mesh.vertices, mesh.normals, piece.light])


def piece_of(material: Material, rows: Array, faces: Faces, drawing: int | None) -> Piece:
    """Return the piece of some faces, with the vertices that they use."""
    used, index = np.unique(faces, return_inverse=True)
    rows = rows[used]
    normals = rows[:, 3:6] / np.maximum(np.linalg.norm(rows[:, 3:6], axis=1, keepdims=True), 1e-9)
    mesh = Mesh(rows[:, :3], index.reshape(-1, 3), normals)
    return Piece(material, mesh, np.clip(rows[:, 6], 0, 1), drawing)
