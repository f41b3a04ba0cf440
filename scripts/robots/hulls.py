"""Covers a body with few convex hulls: collision geometry that stays close to what is seen."""

from __future__ import annotations

import numpy as np
from scipy.spatial import ConvexHull, QhullError
from solids import Array, Solid, union

LARGEST_GAP = 0.018  # m, how far a hull may stand off the body
HIDDEN = 0.0025  # m, how far a small part may stick out of the hulls of the large ones
MOST_TOGETHER = 24  # hulls of a link that is cut up as a whole
LIMIT = 72  # hulls a part


def _sphere(count: int) -> Array:
    n = np.arange(count) + 0.5
    polar, turn = np.arccos(1 - 2 * n / count), np.pi * (1 + 5**0.5) * n
    return np.column_stack(
        [np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)]
    )


AROUND = np.concatenate([_sphere(320), np.eye(3), -np.eye(3)])
COARSE = np.concatenate([_sphere(70), np.eye(3), -np.eye(3)])


def thinned(points: Array, directions: Array = AROUND) -> Array:
    """Return the points that are outermost in one of the directions."""
    return points[np.unique((points @ directions.T).argmax(axis=0))]


def _samples(hull: ConvexHull, spacing: float) -> Array:
    triangles = hull.points[hull.simplices]
    longest = np.linalg.norm(triangles - np.roll(triangles, 1, axis=1), axis=2).max(axis=1)
    result = []
    for steps in (2, 4, 8, 16):
        chosen = triangles[
            (longest <= spacing * steps) & (longest > spacing * steps / 2)
            if steps < 16
            else longest > spacing * 8
        ]
        i, j = np.meshgrid(np.arange(steps + 1), np.arange(steps + 1))
        keep = i + j <= steps
        u, v = i[keep] / steps, j[keep] / steps
        weights = np.column_stack([u, v, 1 - u - v])
        result.append(np.einsum("kw,nwc->nkc", weights, chosen).reshape(-1, 3))
    return np.concatenate(result)


def _gap(points: Array, solid: Solid, spacing: float) -> float:
    """Return how far the points' hull stands off the solid, m."""
    try:
        hull = ConvexHull(thinned(points))
    except QhullError:
        return 0.0
    return float(solid.distance(_samples(hull, spacing)).max())


def _volume(points: Array) -> float:
    try:
        return float(ConvexHull(thinned(points, COARSE)).volume)
    except QhullError:
        return 0.0


def cover_all(parts: list[tuple[Solid, Array]]) -> list[Array]:
    """Return the vertices of convex hulls that hold all parts, each with its surface points.

    Either the body is cut up as a whole, or part by part, whichever takes fewer hulls. Part by
    part, large ones come first, and what lies inside their hulls already gets none of its own.
    """
    whole = union(*(solid for solid, _ in parts))
    spacing = max(_span(whole) / 60, 0.004)
    everything = np.concatenate([surface for _, surface in parts])
    together = cover(whole, whole, everything, spacing, MOST_TOGETHER)
    found: list[Array] = []
    planes: list[Array] = []
    for solid, surface in sorted(parts, key=lambda part: -_volume(part[1])):
        outside = np.full(len(surface), np.inf)
        for equations in planes:
            away = (surface @ equations[:, :3].T + equations[:, 3]).max(axis=1)
            outside = np.minimum(outside, away)
        if outside.max() <= HIDDEN:
            continue
        pieces = cover(solid, whole, surface, min(spacing, _span(solid) / 12))
        found += pieces
        planes += [ConvexHull(piece).equations for piece in pieces]
    return together if len(together) < min(len(found), MOST_TOGETHER) else found


def _span(solid: Solid) -> float:
    return float((solid.high - solid.low).max())


def cover(
    solid: Solid, whole: Solid, surface: Array, spacing: float, limit: int = LIMIT
) -> list[Array]:
    """Return the vertices of convex hulls that together hold the `surface` points of `solid`.

    Gaps count against `whole`, which `solid` is part of. spacing: of the grid, m, that finds the
    cross-sections where a body is cut in two.
    """
    axes = [np.arange(a, b, spacing) for a, b in zip(solid.low, solid.high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    inside = grid[solid.distance(grid) < 0]
    _, first = np.unique(np.round(surface / spacing * 2).astype(int), axis=0, return_index=True)
    # Each piece carries all its surface, a thin sample of it, its inside, and where it was cut.
    waiting = [(surface, surface[np.sort(first)], inside, np.empty((0, 3)))]
    finished: list[Array] = []
    while waiting:
        shell, sample, core, sections = waiting.pop()
        points = np.concatenate([shell, sections])
        full = len(waiting) + len(finished) + 1 >= limit
        if full or _gap(points, whole, max(0.01, spacing)) <= LARGEST_GAP:
            finished.append(points)
            continue
        best, choice = np.inf, None
        low, high = points.min(axis=0), points.max(axis=0)
        for axis in range(3):
            if high[axis] - low[axis] < 4 * spacing:
                continue
            for share in (0.12, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.88):
                plane = low[axis] + share * (high[axis] - low[axis])
                cut = _section(sample, core, axis, plane, spacing)
                sides = _sides((sample, sections), axis, plane)
                if any(
                    len(shells) < 12 or np.ptp(shells[:, axis]) < spacing for shells, _ in sides
                ):
                    continue
                size = sum(_volume(np.concatenate([*side, cut])) for side in sides)
                if size < best:
                    best, choice = size, (axis, plane)
        if choice is None:
            finished.append(points)
            continue
        axis, plane = choice
        cut = _section(shell, core, axis, plane, spacing)
        for side in _sides((shell, sample, core, sections), axis, plane):
            waiting.append((side[0], side[1], side[2], np.concatenate([side[3], cut])))
    return [_wrapped(points) for points in finished if _volume(points) > 0]


def _wrapped(points: Array) -> Array:
    """Return few of the points whose hull holds all of them to within HIDDEN."""
    chosen = thinned(points, COARSE)
    while True:
        equations = ConvexHull(chosen).equations
        away = (points @ equations[:, :3].T + equations[:, 3]).max(axis=1)
        if away.max() <= HIDDEN:
            return chosen
        chosen = np.unique(
            np.concatenate([chosen, thinned(points[away > HIDDEN], COARSE)]), axis=0
        )


def _sides(groups: tuple[Array, ...], axis: int, plane: float) -> list[list[Array]]:
    return [[group[sign * (group[:, axis] - plane) >= 0] for group in groups] for sign in (1, -1)]


def _section(shell: Array, core: Array, axis: int, plane: float, spacing: float) -> Array:
    """Return points on the plane that span the body's cross-section there."""
    near = [group[np.abs(group[:, axis] - plane) <= spacing * 0.75] for group in (shell, core)]
    section = np.concatenate(near)
    section[:, axis] = plane
    return section


def triangles(vertices: Array) -> Array:
    """Return the hull of the vertices as triangles (F, 3, 3), counter-clockwise from outside."""
    hull = ConvexHull(vertices)
    faces = vertices[hull.simplices]
    normal = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    inward = (normal * hull.equations[:, :3]).sum(axis=1) < 0
    faces[inward] = faces[inward][:, ::-1]
    return faces
