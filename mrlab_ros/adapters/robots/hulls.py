"""Measures how closely the collision geometry of a robot follows its visual geometry."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import trimesh
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, cKDTree

from mrlab_ros.adapters.robots import urdf
from mrlab_ros.adapters.robots.diagnostics import ROBOT_HULL
from mrlab_ros.adapters.robots.drawing import Assembly, Resolve
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Array

# Tolerances, m: how far the body may stick out of the hulls, and the hulls out of the body.
MOST_SMALLER = 0.005
MOST_LARGER = 0.020
# Points of a hull nearer to the surface than this count as inside the body, m.
NEAR = 0.012
SPACING = 0.008  # m, between the sample points


@dataclass(frozen=True)
class Fit:
    """The fit of one link, m.

    smaller: the largest distance by which the body sticks out of its hulls; larger: the largest
    distance by which the hulls stick out of the body.
    """

    link: str
    smaller: float
    larger: float


def check(text: str, origin: str, resolve: Resolve) -> tuple[Diagnostic, ...]:
    """Return a finding for each link whose hulls are too small or too large."""
    found = []
    for fit in fits(text, origin, resolve):
        if fit.smaller > MOST_SMALLER or fit.larger > MOST_LARGER:
            found.append(
                ROBOT_HULL(
                    where=f"link {fit.link}",
                    link=fit.link,
                    smaller=fit.smaller,
                    larger=fit.larger,
                )
            )
    return tuple(found)


def fits(text: str, origin: str, resolve: Resolve, most: int = 40_000) -> Iterator[Fit]:
    """Yield the fit of each link with visual and collision geometry.

    resolve: returns the file of a mesh URI; most: the number of sample points per surface.
    """
    root = urdf.parse(text, origin)
    seen = _faces(Assembly(root, origin, resolve))
    hulls = _faces(Assembly(root, origin, resolve, collision=True))
    for link in seen:
        if link in hulls:
            body = np.concatenate(seen[link])
            smaller = sticks_out(body, hulls[link], most)
            yield Fit(link, smaller, stands_off(body, hulls[link], most))


def _few(points: Array, most: int) -> Array:
    return points[:: len(points) // most + 1]


def sticks_out(body: Array, hulls: list[Array], most: int) -> float:
    """Return how far the furthest point of the body lies outside all hulls, m.

    body: (F, 3, 3) m, its triangles; hulls: the same of each hull; most: the
    number of sample points.
    """
    points = _few(samples(body, SPACING), most)
    outside = np.full(len(points), np.inf)
    for hull in hulls:
        planes = ConvexHull(hull.reshape(-1, 3)).equations
        for some in np.array_split(np.arange(len(points)), len(points) // 20_000 + 1):
            heights = points[some] @ planes[:, :3].T + planes[:, 3]
            outside[some] = np.minimum(outside[some], heights.max(axis=1))
    furthest = points[np.argsort(-outside)[:40]]
    if not outside.max() > 0:
        return 0.0
    # The height above a plane is the distance except beyond an edge, where that is larger.
    faces = np.concatenate(hulls)
    one, other = np.repeat(furthest, len(faces), axis=0), np.tile(faces, (len(furthest), 1, 1))
    nearest = trimesh.triangles.closest_point(other, one)
    distance = np.linalg.norm(nearest - one, axis=1).reshape(len(furthest), -1).min(axis=1)
    return float(distance[np.sort(-outside)[:40] < 0].max())


def stands_off(body: Array, hulls: list[Array], most: int) -> float:
    """Return how far the furthest point of the hulls lies outside the body, m."""
    # Of a tree that is asked once, building is what takes time.
    skin = cKDTree(samples(body, SPACING), compact_nodes=False, balanced_tree=False)
    points = _few(samples(np.concatenate(hulls), SPACING), most)
    away = skin.query(points)[0]
    order = np.argsort(-away)
    order = order[away[order] > NEAR]
    # The furthest first: the first that is not inside the body is the answer.
    for some in np.array_split(order, len(order) // 128 + 1):
        outside = ~inside(body, points[some])
        if outside.any():
            return float(away[some][outside].max())
    return float(min(away.max(), NEAR))


def inside(body: Array, points: Array) -> NDArray[np.bool_]:
    """Return which points, (N, 3) m, lie inside a closed body, (F, 3, 3) m.

    By the solid angles of the triangles (van Oosterom and Strackee 1983).
    """
    # Dot products of the corners seen from each point, by products of matrices: a.b is
    # A.B - p.(A + B) + p.p, and the triple product n.(A - p) with the normal n, not normalised.
    corners = [body[:, i] for i in range(3)]
    of_point = np.square(points).sum(axis=1)[:, None]

    def dots(i: int, j: int) -> Array:
        here = np.einsum("fc,fc->f", corners[i], corners[j])
        return np.asarray(here - points @ (corners[i] + corners[j]).T + of_point)

    la, lb, lc = (np.sqrt(np.maximum(dots(i, i), 0.0)) for i in range(3))
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    triple = np.einsum("fc,fc->f", corners[0], normal) - points @ normal.T
    rest = la * lb * lc + dots(0, 1) * lc + dots(1, 2) * la + dots(0, 2) * lb
    return np.asarray(np.arctan2(triple, rest).sum(axis=1) > np.pi)


def samples(faces: Array, spacing: float) -> Array:
    """Return points on triangles, (F, 3, 3) m, at most about `spacing` apart."""
    longest = np.linalg.norm(faces - np.roll(faces, 1, axis=1), axis=2).max(axis=1)
    steps = 2 ** np.ceil(np.log2(np.maximum(longest / spacing, 1))).astype(int)
    result = []
    for step in np.unique(steps):
        i, j = np.meshgrid(np.arange(step + 1), np.arange(step + 1))
        keep = i + j <= step
        u, v = i[keep] / step, j[keep] / step
        weights = np.column_stack([u, v, 1 - u - v])
        result.append((weights @ faces[steps == step]).reshape(-1, 3))
    return np.concatenate(result)


def _faces(robot: Assembly) -> dict[str, list[Array]]:
    """Return the triangles, (F, 3, 3) m in the root's frame, of the meshes of each link."""
    found: dict[str, list[Array]] = {}
    for link, mesh, pose in robot.meshes():
        triangles = np.asarray(mesh.triangles) @ pose[:3, :3].T + pose[:3, 3]
        found.setdefault(link, []).append(triangles)
    return found
