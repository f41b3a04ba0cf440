"""Surfaces as triangles and what they are made of: thinned, and with normals that keep edges."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from mrlab_ros.core.base.geometry import Array

Faces = NDArray[np.int64]
CREASE_DEG = 38.0
GRID = 1e-5  # m; positions are rounded to it, so that the last bits of a sum do not matter
APART = 5.0  # m, between surfaces that are thinned together


@dataclass(frozen=True)
class Material:
    """A name and the glTF metallic-roughness values; colour is sRGB, 0 to 1; alpha 1: opaque."""

    name: str
    colour: tuple[float, float, float]
    metalness: float
    roughness: float
    alpha: float = 1.0


@dataclass(frozen=True, eq=False)
class Mesh:
    """vertices (V, 3) m, faces (F, 3), counter-clockwise from outside; normals (V, 3) or empty."""

    vertices: Array
    faces: Faces
    normals: Array


def linear(srgb: float) -> float:
    """Return the light of an sRGB value, 0 to 1."""
    return srgb / 12.92 if srgb <= 0.04045 else ((srgb + 0.055) / 1.055) ** 2.4


def srgb(light: float) -> float:
    """Return the sRGB value of a light, 0 to 1."""
    return light * 12.92 if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055


def decimated(mesh: Mesh, triangles: int) -> Mesh:
    """Return the mesh with about `triangles` faces, quadric error smallest first."""
    if len(mesh.faces) <= triangles:
        return mesh
    import fast_simplification

    points, faces = fast_simplification.simplify(
        mesh.vertices.astype(np.float32),
        mesh.faces.astype(np.int32),
        target_count=triangles,
        agg=4,
    )
    return Mesh(points.astype(np.float64), faces.astype(np.int64), np.empty((0, 3)))


def together(meshes: list[Mesh], triangles: int) -> list[Mesh]:
    """Return the meshes of so many triangles in all: the smallest error goes first in any."""
    shift = [np.array([APART * number, 0.0, 0.0]) for number in range(len(meshes))]
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    whole = Mesh(
        np.concatenate([mesh.vertices + by for mesh, by in zip(meshes, shift, strict=True)]),
        np.concatenate([mesh.faces + start for mesh, start in zip(meshes, starts, strict=False)]),
        np.empty((0, 3)),
    )
    thin = decimated(whole, triangles)
    owner = np.round(thin.vertices[thin.faces[:, 0], 0] / APART).astype(int)
    result = []
    for number, by in enumerate(shift):
        used, faces = np.unique(thin.faces[owner == number], return_inverse=True)
        result.append(Mesh(thin.vertices[used] - by, faces.reshape(-1, 3), np.empty((0, 3))))
    return result


def creased(mesh: Mesh) -> Mesh:
    """Return the mesh with normals: smooth, but split where faces meet at more than CREASE_DEG."""
    vertices = np.round(mesh.vertices / GRID) * GRID
    faces = mesh.faces
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    area = np.cross(b - a, c - a)
    size = np.linalg.norm(area, axis=1)
    keep = size > 1e-12
    faces, area, size = faces[keep], area[keep], size[keep]
    unit = area / size[:, None]
    corner = np.arange(faces.size).reshape(-1, 3)
    # Two corners at one vertex share a normal where a smooth edge joins their faces.
    edges = np.concatenate([np.sort(faces[:, [i, (i + 1) % 3]], axis=1) for i in range(3)])
    owner = np.tile(np.arange(len(faces)), 3)
    sides = np.concatenate([corner[:, [i, (i + 1) % 3]] for i in range(3)])
    flipped = np.concatenate([faces[:, i] > faces[:, (i + 1) % 3] for i in range(3)])
    sides = np.where(flipped[:, None], sides[:, ::-1], sides)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    one, two = order[:-1], order[1:]
    same = (edges[one] == edges[two]).all(axis=1)
    flat = (unit[owner[one]] * unit[owner[two]]).sum(axis=1) > np.cos(np.radians(CREASE_DEG))
    one, two = one[same & flat], two[same & flat]
    links = (sides[one].ravel(), sides[two].ravel())
    graph = coo_matrix((np.ones(len(links[0])), links), shape=(faces.size, faces.size))
    count, index = connected_components(graph, directed=False)
    normal: Array = np.zeros((count, 3))
    np.add.at(normal, index, np.repeat(area, 3, axis=0))
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    vertex = np.empty(count, dtype=np.int64)
    vertex[index] = faces.ravel()
    return Mesh(vertices[vertex], index.reshape(-1, 3), np.asarray(np.round(normal, 4)))
