"""Covers a casting with convex hulls by cutting it in two until each part's hull stays close.

A casting from outlines has no primitives from which hulls.py could grow: there the whole body is
the only region to start from, and it took minutes a link. Cuts take seconds.
"""

from __future__ import annotations

from contextlib import suppress

import numpy as np
from hulls import LARGEST_GAP, Cover
from scipy.spatial import ConvexHull, QhullError
from solids import Array, Solid

from mrlab_ros.adapters.robots.hulls import samples

CELLS = 90  # along the longest side of the body
FINE = 1.5  # cells between the places at which a hull's distance is measured
COARSE = 0.015  # m, the same while cuts are compared
SHARED = 1.2  # cells on both sides of a cut that belong to both parts
SHARES = (0.3, 0.5, 0.7)  # of a part, where it may be cut
LEAST = 0.02  # m, the length of the shortest part


def cover_all(parts: list[tuple[Solid, Array]], seen: Array) -> list[Array]:
    """Return the vertices of convex hulls that hold all parts, as hulls.cover_all does.

    parts: the casting first, then what stands proud of it by less than the tolerance.
    """
    solid, faces = parts[0]
    cover = Cover([solid], faces, CELLS, FINE)
    taken = []
    for part in _parts(cover, cover.shell):
        with suppress(QhullError):  # flat: the hulls beside it hold it, or it is mended
            taken.append(cover.finished(part))
    return cover.completed(taken, seen)


def _parts(cover: Cover, points: Array) -> list[Array]:
    corners = _corners(points)
    if corners is None:
        return []
    gap, worst = cover.gap(corners, COARSE)
    if gap <= LARGEST_GAP:
        gap, worst = cover.gap(corners, FINE * cover.cell)
    if gap <= LARGEST_GAP:
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
    return float(np.maximum(away - LARGEST_GAP * 0.7, 0).sum())


def _corners(points: Array) -> Array | None:
    if len(points) < 5:
        return None
    try:
        return np.asarray(points[ConvexHull(points).vertices])
    except QhullError:
        return None
