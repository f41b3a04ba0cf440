"""Covers a body with few convex hulls that stay close to its surface, for collision geometry.

Hulls may overlap. A candidate hull starts from the points of a region: one of the primitives that
the body was modelled from, or a ball around a point that no hull covers yet. Where the hull stands
off the body by more than the tolerance, a half-space is cut away, each time the one that loses the
fewest points, until it keeps the tolerance everywhere. The candidate that covers the most
uncovered points is chosen, until all points are covered.
"""

from __future__ import annotations

import numpy as np
from convex import CUBE, HIDDEN, Hull, hull_of
from cover import BARE, Cover
from numpy.typing import NDArray
from solids import Array, Solid

Marks = NDArray[np.bool_]

LARGEST_GAP = 0.0152  # m, by which a candidate hull may stand off the body
POINT = 4000.0  # the weight of an uncovered surface point
COVERED_COUNTS = 0.0005  # of a point that is not covered yet
INSIDE_COUNTS = 0.5  # of a point of the surface
BALLS = (0.12, 0.3, 1.0)  # radii of the regions around bare places, in sizes of the body
REGIONS = (0.004, 0.05)  # m, how far regions reach beyond their primitives


def _sphere(count: int) -> Array:
    n = np.arange(count) + 0.5
    polar, turn = np.arccos(1 - 2 * n / count), np.pi * (1 + 5**0.5) * n
    return np.column_stack(
        [np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)]
    )


DIRECTIONS = np.concatenate([CUBE, _sphere(110)])


def cover_all(parts: list[tuple[Solid, Array]], seen: Array) -> list[Array]:
    """Return the vertices of convex hulls that hold all parts.

    parts: solids, each with the triangles of its surface, (F, 3, 3) m; seen: the corners, (N, 3)
    m, of the thinned meshes that are drawn, which stray a little from these surfaces.
    """
    solids = [solid for solid, _ in parts]
    return _Grown(solids, np.concatenate([faces for _, faces in parts])).hulls(seen)


class _Grown(Cover):
    """The cover of a body that was modelled from primitives."""

    def __init__(self, solids: list[Solid], faces: Array) -> None:
        super().__init__(solids, faces)
        self.pieces = [piece for solid in solids for piece in solid.pieces]
        # Rounded: the last bits of a product differ between machines.
        self.heights = np.round(self.points @ DIRECTIONS.T, 6)
        self.outside = np.full(len(self.points), np.inf)

    def hulls(self, seen: Array) -> list[Array]:
        """Return the vertices of hulls that together hold the surface."""
        waiting = self._from_pieces()
        taken: list[Hull] = []
        bare = self.outside[: len(self.shell)]
        while bare.max() > BARE:
            if self._extended(taken, int(bare.argmax())):
                continue
            scores = [self._score(hull) for hull in waiting]
            highest = max(scores, default=0.0)
            if highest < 0.06 * np.count_nonzero(bare > HIDDEN):
                waiting += self._from_balls(highest)
                scores = [self._score(hull) for hull in waiting]
            if scores and max(scores) > 0:
                best = waiting.pop(int(np.argmax(scores)))
            else:
                middle = self.shell[bare.argmax()]
                near = np.linalg.norm(self.points - middle, axis=1) < 4 * self.cell
                best = self.finished(self.points[near])
            np.minimum(self.outside, best.away, out=self.outside)
            taken.append(best)
        return self.completed(taken, seen)

    def _extended(self, taken: list[Hull], place: int) -> bool:
        """Extend a hull that comes near to the bare point at `place`; say whether one could."""
        middle = self.points[place]
        near = np.linalg.norm(self.shell - middle, axis=1)
        near_bare = (self.outside[: len(self.shell)] > HIDDEN) & (near < 5 * self.cell)
        for reach in (self.shell[near_bare], middle[None]):
            for number in np.argsort([hull.away[place] for hull in taken])[:3]:
                hull = self.joined(taken[number].vertices, reach)
                if hull is not None:
                    taken[number] = hull
                    np.minimum(self.outside, hull.away, out=self.outside)
                    return True
        return False

    def _score(self, hull: Hull) -> float:
        gained = (self.outside > HIDDEN) & (hull.away <= HIDDEN)
        return float(
            gained[: len(self.shell)].sum() + INSIDE_COUNTS * gained[len(self.shell) :].sum()
        )

    def _from_pieces(self) -> list[Hull]:
        found = []
        for piece in self.pieces:
            distance = piece.distance(self.points)
            depth = np.minimum(self.depth, -distance[len(self.shell) :])
            seed = self.core[depth.argmax()]
            for reach in REGIONS:
                weight = self._weights(distance < 0.002, 0.02)
                found.append(self._grown(seed, weight, distance < reach))
        return [hull for hull in found if hull is not None]

    def _from_balls(self, best: float) -> list[Hull]:
        """Grow hulls around the place that sticks out most and the deepest that is not held.

        best: the score that they should reach.
        """
        least = POINT * best
        bare = self.outside > HIDDEN
        weight = self._weights(bare, COVERED_COUNTS)
        barest = self.shell[self.outside[: len(self.shell)].argmax()]
        far = np.linalg.norm(self.core - barest, axis=1)
        # A cut that takes the barest place away is the last choice.
        weight[np.linalg.norm(self.points - barest, axis=1) < 2 * self.cell] *= 50
        seeds = [self._deepest(far <= far.min() * 1.01 + 0.03)]
        if bare[len(self.shell) :].any():
            seeds.append(self._deepest(bare[len(self.shell) :]))
        found = []
        for seed in seeds:
            away = np.linalg.norm(self.points - seed, axis=1)
            found += [self._grown(seed, weight, away < self.span * size, least) for size in BALLS]
        return [hull for hull in found if hull is not None]

    def _deepest(self, of: Marks) -> Array:
        choice = np.flatnonzero(of)
        return np.asarray(self.core[choice[self.depth[choice].argmax()]])

    def _weights(self, wanted: Marks, other: float) -> Array:
        # Whole numbers, so that a sum is the same in any order.
        weight = np.where(wanted, POINT, np.round(POINT * other))
        weight[len(self.shell) :] *= INSIDE_COUNTS
        return weight

    def _grown(self, seed: Array, weight: Array, region: Marks, least: float = 0) -> Hull | None:
        """Return a hull around `seed` of points of the region, or None where there is none.

        least: the weight of its points below which a hull is of no use.
        """
        keep = np.flatnonzero(region)
        middle = np.round(seed @ DIRECTIONS.T, 6)
        for _ in range(60):
            hull = hull_of(self.points[keep])
            if hull is None or weight[keep].sum() < least:
                return None
            corners = hull.points[hull.vertices]
            gap, worst = self.gap(corners, max(3 * self.cell, 0.01))
            if gap <= LARGEST_GAP:
                gap, worst = self.gap(corners, self.cell)
            if gap <= LARGEST_GAP:
                return self.finished(corners)
            near = self.field.nearest(worst)
            lift = (worst - near) @ DIRECTIONS.T
            height = near @ DIRECTIONS.T + np.minimum(LARGEST_GAP * 0.3, lift * 0.5)
            height = np.round(height, 6) - 2.5e-7
            useful = (lift > 0.25 * gap) & (middle < height - self.cell / 2)
            choice = np.flatnonzero(useful)
            if not len(choice):
                return None
            below = self.heights[np.ix_(keep, choice)] < height[choice]
            keep = keep[below[:, int((weight[keep] @ below).argmax())]]
        return None
