"""Covers a casting with few convex hulls: cuts it in two until each part's hull stays close, then
grows a part over its neighbours for as long as that stays close, the one that gains most first.

A casting from outlines has no primitives from which hulls.py could start. Parts alone would be
many: they are cut across an axis and share nothing, where hulls may overlap.
"""

from __future__ import annotations

import numpy as np
from convex import heights, thinned
from cover import Cover
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError, cKDTree
from solids import Array, Solid

from mrlab_ros.adapters.robots.hulls import samples

CELLS = 90  # along the longest side of the body
FINE = 1.5  # cells between the places at which a hull's distance is measured
COARSE = 0.03  # m, the same while cuts and growth are compared
GRAIN = 2.2  # cells between the points that are cut and grown over
SUNK = 0.0025  # m, by which these points lie under the surface: hulls may be smaller too
GAP = 0.0173  # m, by which a hull of such points may stand off the body
LIFT = 0.0012  # m, outwards, which lets a hull do with fewer vertices
FINISHED_GAP = 0.0188  # m, the same for finished hulls
SHARED = 1.2  # cells on both sides of a cut that belong to both parts
SHARES = (0.3, 0.5, 0.7)  # of a part, where it may be cut
LEAST = 0.02  # m, the length of the shortest part
CLUSTERS = 14  # along the longest side; what a hull grows by
TRIES = 8  # clusters in vain, one after the other, until a hull is grown
STARTS = 1  # parts that are grown, of which the best is taken
HELD = 0.0005  # m; a point that sticks out less is held
REST = 0.004  # of the points, which the hulls nearby are extended to
FEWEST = 5  # points of a hull

Marks = NDArray[np.bool_]


def cover_all(parts: list[tuple[Solid, Array]], seen: Array) -> list[Array]:
    """Return the vertices of convex hulls that hold all parts, as hulls.cover_all does.

    parts: the casting first, then what stands proud of it by less than the tolerance.
    """
    solid, faces = parts[0]
    cover = Cover([solid], faces, CELLS, FINE, FINISHED_GAP, LIFT)
    points = _sunk(thinned(cover.shell, GRAIN * cover.cell), faces)
    grown = _Growth(cover, points).hulls(_parts(cover, points))
    return cover.completed([cover.finished(corners) for corners in grown], seen)


def _sunk(points: Array, faces: Array) -> Array:
    normal = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    return np.asarray(points - SUNK * normal[cKDTree(faces.mean(axis=1)).query(points)[1]])


class _Growth:
    """Hulls of points (N, 3) m, and the clusters of these by which a hull grows."""

    def __init__(self, cover: Cover, points: Array) -> None:
        self.cover, self.points = cover, points
        size = max(cover.span / CLUSTERS, 4 * cover.cell)
        place = np.floor(points / size).astype(int)
        _, cluster = np.unique(place, axis=0, return_inverse=True)
        self.cluster = cluster.ravel()
        self.spacing = max(FINE * cover.cell, COARSE / 2)

    def hulls(self, parts: list[Array]) -> list[Array]:
        """Return the corners of few hulls that hold nearly all points."""
        held = np.array([heights(part, self.points) <= HELD for part in parts])
        bare = np.ones(len(self.points), dtype=bool)
        taken = []
        while bare.sum() > REST * len(bare):
            gains = (held & bare).sum(axis=1)
            starts = [n for n in np.argsort(-gains, kind="stable")[:STARTS] if gains[n]]
            if not starts:
                break
            found = [self._grown(parts[n], bare) for n in starts]
            corners, left = min(found, key=lambda one: int(one[1].sum()))
            taken.append(corners)
            bare = left
        return taken

    def _grown(self, corners: Array, bare: Marks) -> tuple[Array, Marks]:
        """Return the corners of a hull that grew over bare points, and which stay bare."""
        for share in (1.0, 0.5):
            tried = np.zeros(self.cluster.max() + 1, dtype=bool)
            wanted = np.flatnonzero(bare)
            vain = 0
            while vain < TRIES:
                out = heights(corners, self.points[wanted])
                wanted, out = wanted[out > HELD], out[out > HELD]
                cluster = self.cluster[wanted]
                furthest = np.zeros(len(tried))
                np.maximum.at(furthest, cluster, out)
                furthest[tried | (furthest == 0)] = np.inf
                nearest = int(furthest.argmin())
                if furthest[nearest] == np.inf:
                    break
                tried[nearest] = True
                own = np.flatnonzero(cluster == nearest)
                own = own[np.argsort(out[own])][: max(int(share * len(own)), 1)]
                both = self._joined(corners, self.points[wanted[own]])
                vain = vain + 1 if both is None else 0
                corners = corners if both is None else both
        left = bare.copy()
        left[bare] = heights(corners, self.points[bare]) > HELD
        return corners, left

    def _joined(self, corners: Array, more: Array) -> Array | None:
        """Return the corners of the hull of both, or None where its new faces stand off."""
        points = np.concatenate([corners, more])
        hull = ConvexHull(points)
        new = points[hull.simplices[(hull.simplices >= len(corners)).any(axis=1)]]
        for spacing in (2 * COARSE, self.spacing):
            if len(new) and self.cover.field(samples(new, spacing)).max() > GAP:
                return None
        return np.asarray(points[hull.vertices])


def _parts(cover: Cover, points: Array) -> list[Array]:
    corners = _corners(points)
    if corners is None:
        return []
    gap, worst = cover.gap(corners, COARSE)
    if gap <= GAP:
        gap, worst = cover.gap(corners, FINE * cover.cell)
    if gap <= GAP:
        return [corners]
    low, high = points.min(axis=0), points.max(axis=0)
    best, halves = np.inf, None
    for axis in range(3):
        length = high[axis] - low[axis]
        for place in (worst[axis], *(low[axis] + share * length for share in SHARES)):
            if min(place - low[axis], high[axis] - place) < LEAST / 2:
                continue
            two = [
                points[points[:, axis] < place + SHARED * cover.cell],
                points[points[:, axis] > place - SHARED * cover.cell],
            ]
            left = sum(_left(cover, part) for part in two)
            if left < best and max(len(part) for part in two) < len(points):
                best, halves = left, two
    if halves is None:
        return [corners]
    return _parts(cover, halves[0]) + _parts(cover, halves[1])


def _left(cover: Cover, points: Array) -> float:
    """Return how much of the hull of the points stands off the body."""
    corners = _corners(points)
    if corners is None:
        return 0.0
    away = cover.field(samples(corners[ConvexHull(corners).simplices], COARSE))
    return float(np.maximum(away - GAP * 0.7, 0).sum())


def _corners(points: Array) -> Array | None:
    if len(points) < FEWEST:
        return None
    try:
        return np.asarray(points[ConvexHull(points).vertices])
    except QhullError:
        return None
