"""Convex hulls of points: few vertices around them, heights above them, triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, QhullError
from solids import Array
from trimesh.triangles import closest_point

LIFT = 0.003  # m, outwards, which lets a hull do with fewer vertices
OUTSIDE = 0.0045  # m, by which drawn points may lie outside all hulls of a link
HIDDEN = 0.003  # m, by which the body may stick out of a finished hull


def _cube() -> Array:
    steps = np.array(np.meshgrid(*[[-1.0, 0.0, 1.0]] * 3)).reshape(3, -1).T
    lengths = np.linalg.norm(steps, axis=1, keepdims=True)
    return steps[lengths[:, 0] > 0] / lengths[lengths[:, 0] > 0]


CUBE = _cube()


@dataclass(frozen=True, eq=False)
class Hull:
    """vertices (V, 3) m; away: how far each point of the cover lies outside, m, below 0 inside."""

    vertices: Array
    away: Array


def heights(vertices: Array, points: Array) -> Array:
    """Return how far each point lies outside the hull of the vertices, m; below 0 inside."""
    equations = ConvexHull(vertices).equations
    result = np.empty(len(points))
    for some in np.array_split(np.arange(len(points)), len(points) // 20_000 + 1):
        result[some] = (points[some] @ equations[:, :3].T + equations[:, 3]).max(axis=1)
    return result


def held(hulls: list[Array], points: Array) -> list[Array]:
    """Return the vertices of hulls, grown where one of the points lies outside all of them.

    What lies furthest outside becomes a vertex of the nearest hull until all points are held.
    """
    grown = list(hulls)
    away = np.array([heights(vertices, points) for vertices in grown])
    # Beyond an edge a point is further away than above the planes of its two faces.
    few = np.flatnonzero(away.min(axis=0) > OUTSIDE / 2)
    points = points[few]
    away = np.array([_distances(vertices, points) for vertices in grown])
    while len(points) and (least := away.min(axis=0)).max() > OUTSIDE:
        furthest = int(least.argmax())
        nearest = int(away[:, furthest].argmin())
        vertices = np.vstack([grown[nearest], points[furthest]])
        grown[nearest] = vertices[ConvexHull(vertices).vertices]
        away[nearest] = _distances(grown[nearest], points)
    return grown


def _distances(vertices: Array, points: Array) -> Array:
    """Return the distances of points outside the hull of the vertices, m; 0 inside."""
    if not len(points):
        return np.empty(0)
    result = np.maximum(heights(vertices, points), 0.0)
    faces = triangles(vertices)
    for place in np.flatnonzero((result > 0) & (result < 4 * OUTSIDE)):
        nearest = closest_point(faces, np.tile(points[place], (len(faces), 1)))
        result[place] = np.linalg.norm(nearest - points[place], axis=1).min()
    return result


def thinned(points: Array, spacing: float) -> Array:
    """Return one of the points in each cube of `spacing`."""
    _, first = np.unique(np.round(points / spacing).astype(int), axis=0, return_index=True)
    return points[np.sort(first)]


def hull_of(points: Array) -> ConvexHull | None:
    if len(points) < 8:
        return None
    try:
        return ConvexHull(points)
    except QhullError:
        return None


def wrapped(points: Array, lift: float = LIFT, hidden: float = HIDDEN) -> Array:
    """Return few vertices, `lift` outside the points, whose hull holds these to `hidden`."""
    hull = ConvexHull(points)
    normals = np.zeros_like(points)
    for corner in range(3):
        np.add.at(normals, hull.simplices[:, corner], hull.equations[:, :3])
    inner, normals = points[hull.vertices], normals[hull.vertices]
    outer = inner + lift * normals / np.linalg.norm(normals, axis=1, keepdims=True)
    chosen = list(np.unique((inner @ CUBE.T).argmax(axis=0)))
    tried = set(chosen)
    while True:
        few = ConvexHull(outer[chosen])
        away = (inner @ few.equations[:, :3].T + few.equations[:, 3]).max(axis=1)
        furthest = int(away.argmax())
        chosen = [chosen[place] for place in few.vertices]
        if away[furthest] <= hidden or furthest in tried:
            return np.asarray(outer[chosen])
        tried.add(furthest)
        chosen.append(furthest)


def triangles(vertices: Array) -> Array:
    """Return the hull of the vertices as triangles (F, 3, 3), counter-clockwise from outside."""
    hull = ConvexHull(vertices)
    faces = vertices[hull.simplices]
    normal = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    inward = (normal * hull.equations[:, :3]).sum(axis=1) < 0
    faces[inward] = faces[inward][:, ::-1]
    return faces
