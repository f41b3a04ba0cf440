"""Meshes of few triangles with the edges of machined parts: bevelled boxes, turned parts.

Faces keep their normals to their edges and bevels turn between them, as weighted normals do: an
edge of one or two triangles looks round.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import numpy as np
from scipy.spatial import ConvexHull
from solids import AXES, Array

from mrlab_ros.adapters.robots.packing.surfaces import Mesh, creased

CREASE = np.cos(np.radians(31.0))  # between two cones that are shaded as one


def bevelled(low: Sequence[float], high: Sequence[float], edge: float) -> Mesh:
    """Return a box between two corners with bevels of `edge`, m: 44 triangles."""
    a, b = np.minimum(low, high), np.maximum(low, high)
    middle, half = (a + b) / 2, (b - a) / 2
    edge = min(edge, float(half.min()) * 0.98)
    signs = np.array(list(product((-1, 1), repeat=3)))
    # Vertex 3 c + axis is corner c on the face across that axis.
    vertices, normals = [], []
    for sign in signs:
        for axis in range(3):
            inward = np.full(3, edge)
            inward[axis] = 0.0
            vertices.append(middle + sign * (half - inward))
            normals.append(np.eye(3)[axis] * sign)
    faces: list[list[int]] = []
    number = {tuple(sign): 3 * n for n, sign in enumerate(signs.tolist())}
    for axis, side in product(range(3), (-1, 1)):
        ring = []
        for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            corner = [0, 0, 0]
            corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3] = side, u, v
            ring.append(number[tuple(corner)] + axis)
        faces += [[ring[0], ring[1], ring[2]], [ring[0], ring[2], ring[3]]]
    for along in range(3):
        i, j = (along + 1) % 3, (along + 2) % 3
        for si, sj in product((-1, 1), repeat=2):
            ends = []
            for way in (-1, 1):
                corner = [0, 0, 0]
                corner[along], corner[i], corner[j] = way, si, sj
                ends.append(number[tuple(corner)])
            faces += [
                [ends[0] + i, ends[1] + i, ends[1] + j],
                [ends[0] + i, ends[1] + j, ends[0] + j],
            ]
    faces += [[3 * n, 3 * n + 1, 3 * n + 2] for n in range(8)]
    return _outwards(Mesh(np.array(vertices), np.array(faces), np.array(normals)))


def _outwards(mesh: Mesh) -> Mesh:
    """Return the mesh with each triangle the way round that its normals say."""
    a, b, c = (mesh.vertices[mesh.faces[:, n]] for n in range(3))
    told = mesh.normals[mesh.faces].sum(axis=1)
    wrong = (np.cross(b - a, c - a) * told).sum(axis=1) < 0
    faces = np.where(wrong[:, None], mesh.faces[:, ::-1], mesh.faces)
    return Mesh(mesh.vertices, faces, mesh.normals)


def turned(axis: str, profile: Sequence[Sequence[float]], sides: int = 24) -> Mesh:
    """Return a surface of revolution about a coordinate axis through the origin.

    profile: (radius, place along the axis), m, in an order that keeps the material on the left.
    """
    line = np.array(profile, float)
    way = np.diff(line, axis=0)
    way /= np.maximum(np.linalg.norm(way, axis=1, keepdims=True), 1e-12)
    outward = np.column_stack([way[:, 1], -way[:, 0]])
    angle = 2 * np.pi * np.arange(sides) / sides
    around = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    vertices, normals, faces = [], [], []

    def ring(place: Array, normal: Array) -> int:
        radius, height = place
        normal = normal / np.linalg.norm(normal)
        vertices.append(np.column_stack([around * radius, np.full(sides, height)]))
        normals.append(np.column_stack([around * normal[0], np.full(sides, normal[1])]))
        return (len(vertices) - 1) * sides

    last = 0
    for n, normal in enumerate(outward):
        smooth = n > 0 and normal @ outward[n - 1] > CREASE
        goes_on = n + 1 < len(outward) and normal @ outward[n + 1] > CREASE
        first = last if smooth else ring(line[n], normal)
        last = ring(line[n + 1], normal + (outward[n + 1] if goes_on else 0))
        for k in range(sides):
            m = (k + 1) % sides
            if line[n, 0] > 1e-9:
                faces.append([first + k, first + m, last + m])
            if line[n + 1, 0] > 1e-9:
                faces.append([first + k, last + m, last + k])
    turn = np.roll(np.arange(3), AXES[axis] - 2)
    mesh = Mesh(
        np.concatenate(vertices)[:, turn], np.array(faces), np.concatenate(normals)[:, turn]
    )
    return _outwards(mesh)


def prism(
    axis: str,
    outline: Sequence[Sequence[float]],
    ends: Sequence[float],
    edge: float,
    corner: float,
    steps: int = 4,
) -> Mesh:
    """Return the convex body between two planes across a coordinate axis, with bevels at both.

    outline: points (N, 2), m, along the other two axes in their order; ends: places of the planes;
    edge: of the bevels; corner: radius of the edges along the axis, of `steps` facets each.
    """
    points = np.array(outline, float)
    points = points[ConvexHull(points).vertices]  # against the clock
    low, high = min(ends), max(ends)
    rings = [(edge, low), (0.0, low + edge), (0.0, high - edge), (edge, high)]
    loops = [_rounded(points, inset, corner, steps) for inset, _ in rings]
    count = len(loops[0])
    flat = [
        np.column_stack([loop, np.full(count, at)])
        for loop, (_, at) in zip(loops, rings, strict=True)
    ]
    n = np.arange(count)
    m = (n + 1) % count
    faces = [np.column_stack([0 * n[1:-1], m[1:-1], n[1:-1]])]
    for ring in range(3):
        a, b = ring * count + n, ring * count + m
        faces += [np.column_stack([a, b, b + count]), np.column_stack([a, b + count, a + count])]
    faces.append(3 * count + np.column_stack([0 * n[1:-1], n[1:-1], m[1:-1]]))
    number = AXES[axis]
    columns = [*(each for each in range(3) if each != number), number]
    vertices, corners = np.empty((4 * count, 3)), np.concatenate(faces)
    vertices[:, columns] = np.concatenate(flat)
    # x and z in their order, y across them: left-handed
    return creased(Mesh(vertices, corners[:, ::-1] if axis == "y" else corners, np.empty((0, 3))))


def _rounded(points: Array, inset: float, corner: float, steps: int) -> Array:
    """Return a convex outline so far inside, with an arc of `steps` facets at each corner."""
    ahead = np.roll(points, -1, axis=0) - points
    length = np.linalg.norm(ahead, axis=1, keepdims=True)
    radius = min(corner, 0.45 * float(length.min()))
    ahead /= length
    outward = np.column_stack([ahead[:, 1], -ahead[:, 0]])
    before = np.roll(outward, 1, axis=0)
    # where the lines that lie `radius` inside meet: the middle of the arc
    lean = (before + outward) / (1 + (before * outward).sum(axis=1))[:, None]
    share = (np.arange(steps + 1) / steps)[None, :, None]
    turn = before[:, None] * (1 - share) + outward[:, None] * share
    turn /= np.linalg.norm(turn, axis=2, keepdims=True)
    middle = points - radius * lean
    result: Array = (middle[:, None] + (radius - inset) * turn).reshape(-1, 2)
    return result


def moved(mesh: Mesh, *by: float) -> Mesh:
    """Return the mesh shifted, m."""
    return Mesh(mesh.vertices + np.array(by), mesh.faces, mesh.normals)


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """Return meshes as one."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    return Mesh(
        np.concatenate([mesh.vertices for mesh in meshes]),
        np.concatenate([mesh.faces + at for mesh, at in zip(meshes, starts, strict=False)]),
        np.concatenate([mesh.normals for mesh in meshes]),
    )


def screw_head(size: float) -> list[tuple[float, float]]:
    """Return the profile of a socket screw's head on z = 0. size: m, its width."""
    half, tall = size / 2, size * 0.45
    return [
        (half, 0), (half, tall * 0.8), (half * 0.86, tall), (half * 0.55, tall),
        (half * 0.5, tall * 0.35), (0, tall * 0.35),
    ]  # fmt: skip
