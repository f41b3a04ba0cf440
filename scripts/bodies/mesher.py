"""Turns solids into triangle meshes: dual contouring, smoothing."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from solids import Array, Solid

from mrlab_ros.adapters.robots.packing.surfaces import Faces, Mesh

ALIKE_DEG = 22.0  # between faces that are smoothed together; sharper edges stay
SMOOTHINGS, FITTINGS = 18, 18  # rounds of normals, then of vertices


def contour(solid: Solid, cell: float) -> Mesh:
    """Return the surface of `solid`, with its sharp edges, sampled on a grid of `cell`."""
    low = solid.low - 1.5 * cell
    counts = np.ceil((solid.high + 1.5 * cell - low) / cell).astype(int) + 1
    axes = [low[i] + cell * np.arange(counts[i]) for i in range(3)]
    values = np.empty(counts)
    for x, layer in enumerate(axes[0]):
        grid = np.stack(np.meshgrid([layer], axes[1], axes[2], indexing="ij"), axis=-1)
        values[x] = solid.distance(grid.reshape(-1, 3)).reshape(counts[1:])
    ends = [np.take(values, (0, -1), axis) for axis in range(3)]
    if any((end < 0).any() for end in ends):  # it stands out of the box it states
        return contour(Solid(solid.distance, solid.low - 2 * cell, solid.high + 2 * cell), cell)
    cells = np.zeros(counts, dtype=np.int64)
    places, owners, quads = [], [], []
    for axis in range(3):
        here = [slice(None)] * 3
        there = [slice(None)] * 3
        here[axis], there[axis] = slice(None, -1), slice(1, None)
        a, b = values[tuple(here)], values[tuple(there)]
        index = np.argwhere((a < 0) != (b < 0))
        va, vb = a[tuple(index.T)], b[tuple(index.T)]
        start = low + index * cell
        share = va / (va - vb)
        step = np.zeros(3)
        step[axis] = cell
        # Distances are not linear near edges; two secant steps settle the crossing.
        t0, t1, f0, f1 = np.zeros(len(va)), np.ones(len(va)), va, vb
        for _ in range(3):
            f = solid.distance(start + share[:, None] * step)
            below = (f < 0) == (f0 < 0)
            t0, f0 = np.where(below, share, t0), np.where(below, f, f0)
            t1, f1 = np.where(below, t1, share), np.where(below, f1, f)
            share = t0 + (t1 - t0) * np.clip(f0 / (f0 - f1 + 1e-30), 0.02, 0.98)
        j, k = (axis + 1) % 3, (axis + 2) % 3
        around = []
        for dj, dk in ((0, 0), (-1, 0), (-1, -1), (0, -1)):
            cell_index = index.copy()
            cell_index[:, j] += dj
            cell_index[:, k] += dk
            around.append(np.ravel_multi_index(tuple(cell_index.T), cells.shape))
        around_array = np.stack(around, axis=1)
        places.append(start + share[:, None] * step)
        owners.append(around_array)
        quads.append(np.where((va < 0)[:, None], around_array, around_array[:, ::-1]))
    points, owner = np.concatenate(places), np.concatenate(owners)
    normals = gradient(solid, points, cell * 1e-3)
    names, numbered = np.unique(owner, return_inverse=True)
    numbered = numbered.reshape(owner.shape)
    corner = low + np.column_stack(np.unravel_index(names, cells.shape)) * cell
    vertices = _feature_points(points, normals, numbered, len(names), corner, cell)
    place = np.full(cells.size, -1)
    place[names] = np.arange(len(names))
    quad = place[np.concatenate(quads)]
    return Mesh(vertices, _split(quad, vertices), np.empty((0, 3)))


def gradient(solid: Solid, points: Array, step: float) -> Array:
    """Return the unit gradient of the distance at the points."""
    result = np.empty_like(points)
    for i in range(3):
        shift = np.zeros(3)
        shift[i] = step
        result[:, i] = solid.distance(points + shift) - solid.distance(points - shift)
    return result / np.maximum(np.linalg.norm(result, axis=1, keepdims=True), 1e-30)


def _feature_points(
    points: Array, normals: Array, owner: Faces, count: int, corner: Array, cell: float
) -> Array:
    """Place one vertex per cell at the least-squares intersection of its tangent planes."""
    flat = owner.ravel()
    p, n = np.repeat(points, 4, axis=0), np.repeat(normals, 4, axis=0)

    def total(values: Array) -> Array:
        return np.bincount(flat, weights=values, minlength=count)

    hits = total(np.ones(len(flat)))
    middle = np.column_stack([total(p[:, i]) for i in range(3)]) / hits[:, None]
    offset = (n * (p - middle[flat])).sum(axis=1)
    matrix = np.empty((count, 3, 3))
    right = np.empty((count, 3))
    for i in range(3):
        right[:, i] = total(n[:, i] * offset)
        for k in range(3):
            matrix[:, i, k] = total(n[:, i] * n[:, k])
    matrix += 0.02 * np.eye(3) * hits[:, None, None]
    shift = np.linalg.solve(matrix, right[:, :, None])[:, :, 0]
    return np.clip(middle + shift, corner, corner + cell)


def _split(quad: Faces, vertices: Array) -> Faces:
    """Return two triangles per quad, split along the diagonal with the smaller dihedral angle."""
    a, b, c, d = (vertices[quad[:, i]] for i in range(4))

    def bend(n1: Array, n2: Array) -> Array:
        scale = np.linalg.norm(n1, axis=1) * np.linalg.norm(n2, axis=1)
        return (n1 * n2).sum(axis=1) / np.maximum(scale, 1e-30)

    first = bend(np.cross(b - a, c - a), np.cross(c - a, d - a))
    second = bend(np.cross(b - a, d - a), np.cross(c - b, d - b))
    straight = (first >= second)[:, None]
    one = np.where(straight, quad[:, [0, 1, 2]], quad[:, [0, 1, 3]])
    two = np.where(straight, quad[:, [0, 2, 3]], quad[:, [1, 2, 3]])
    faces = np.concatenate([one, two])
    return faces[(faces != np.roll(faces, 1, axis=1)).all(axis=1)]


def smoothed(mesh: Mesh) -> Mesh:
    """Return the mesh with walls made even and edges kept.

    Each face's normal becomes the mean of those around it that point alike; then the vertices
    move to where the faces have these normals.
    """
    faces, vertices, count = mesh.faces, mesh.vertices.copy(), len(mesh.faces)
    of_vertex = coo_matrix(
        (np.ones(faces.size), (np.repeat(np.arange(count), 3), faces.ravel())),
        shape=(count, len(vertices)),
    ).tocsr()
    beside = of_vertex @ of_vertex.T
    row = np.repeat(np.arange(count), np.diff(beside.indptr))
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1)
    normal /= np.maximum(area, 1e-30)[:, None]
    alike = 2 * (1 - np.cos(np.radians(ALIKE_DEG)))
    for _ in range(SMOOTHINGS):
        off = ((normal[row] - normal[beside.indices]) ** 2).sum(axis=1)
        beside.data = area[beside.indices] * np.exp(-off / alike)
        normal = beside @ normal
        normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    degree = np.bincount(faces.ravel(), minlength=len(vertices))[:, None]
    for _ in range(FITTINGS):
        middle = vertices[faces].mean(axis=1)
        shift = np.zeros_like(vertices)
        for i in range(3):
            height = ((middle - vertices[faces[:, i]]) * normal).sum(axis=1)
            for k in range(3):
                shift[:, k] += np.bincount(
                    faces[:, i], weights=height * normal[:, k], minlength=len(vertices)
                )
        vertices += shift / np.maximum(degree, 1)
    return Mesh(vertices, faces, mesh.normals)
