"""Covers a body with few convex hulls that stay close to its surface, for collision geometry.

Hulls may overlap. A candidate hull starts from the points of a region: one of the primitives that
the body was modelled from, or a ball around a point that no hull covers yet. Where the hull stands
off the body by more than the tolerance, a half-space is cut away, each time the one that loses the
fewest points, until it keeps the tolerance everywhere. The candidate that covers the most
uncovered points is chosen, until all points are covered.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, map_coordinates
from scipy.spatial import ConvexHull, QhullError, cKDTree
from solids import Array, Solid

from mrlab_ros.adapters.robots.hulls import samples

Marks = NDArray[np.bool_]

LARGEST_GAP = 0.0152  # m, by which a candidate hull may stand off the body
FINISHED_GAP = 0.0178  # m, the same after a hull was lifted, extended and merged
LIFT = 0.003  # m, outwards, which lets a hull do with fewer vertices
HIDDEN = 0.003  # m, by which the body may stick out of a finished hull
MOST_VERTICES = 72  # of a hull that is extended or merged
BARE = 0.004  # m; a point that sticks out further gets one more hull
SEEN_BARE = 0.0047  # m, the same for the thinned visual meshes
EXACT = 0.03  # m; below, the grid's distances are computed from surface points
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


def _cube() -> Array:
    steps = np.array(np.meshgrid(*[[-1.0, 0.0, 1.0]] * 3)).reshape(3, -1).T
    lengths = np.linalg.norm(steps, axis=1, keepdims=True)
    return steps[lengths[:, 0] > 0] / lengths[lengths[:, 0] > 0]


CUBE = _cube()
DIRECTIONS = np.concatenate([CUBE, _sphere(110)])


@dataclass(frozen=True, eq=False)
class Hull:
    """vertices (V, 3) m; away: how far each point of the cover lies outside, m, below 0 inside."""

    vertices: Array
    away: Array


def cover_all(parts: list[tuple[Solid, Array]], seen: Array) -> list[Array]:
    """Return the vertices of convex hulls that hold all parts.

    parts: solids, each with the triangles of its surface, (F, 3, 3) m; seen: the corners, (N, 3)
    m, of the thinned meshes that are drawn, which stray a little from these surfaces.
    """
    solids = [solid for solid, _ in parts]
    return Cover(solids, np.concatenate([faces for _, faces in parts])).hulls(seen)


class _Field:
    """The distance to a body, 0 inside it, on a grid of `cell`."""

    def __init__(self, solids: list[Solid], surface: Array, cell: float) -> None:
        self.cell = cell
        self.low = np.min([solid.low for solid in solids], axis=0) - EXACT - cell
        high = np.max([solid.high for solid in solids], axis=0) + EXACT + cell
        counts = np.ceil((high - self.low) / cell).astype(int) + 1
        axes = [self.low[i] + cell * np.arange(counts[i]) for i in range(3)]
        filled = np.zeros(counts, dtype=bool)
        for solid in solids:
            first = np.floor((solid.low - self.low) / cell).astype(int)
            last = np.ceil((solid.high - self.low) / cell).astype(int) + 1
            box = tuple(slice(a, b) for a, b in zip(first, last, strict=True))
            grid = np.stack(
                np.meshgrid(*(axes[i][box[i]] for i in range(3)), indexing="ij"), axis=-1
            )
            inside = solid.distance(grid.reshape(-1, 3)) < 0
            filled[box] |= inside.reshape(grid.shape[:3])
        self.surface = surface
        self.tree = cKDTree(surface)
        everywhere = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
        values = distance_transform_edt(~filled).ravel() * cell
        near = np.flatnonzero((values > 0) & (values < EXACT))
        values[near] = self.tree.query(everywhere[near])[0]
        self.values = values.reshape(counts)
        self.inside = everywhere[filled.ravel()]

    def __call__(self, points: Array) -> Array:
        place = (points - self.low) / self.cell
        return np.asarray(map_coordinates(self.values, place.T, order=1, mode="nearest"))

    def nearest(self, point: Array) -> Array:
        return np.asarray(self.surface[self.tree.query(point)[1]])


class Cover:
    """A body as points, and hulls of them that keep the tolerances.

    cells: of the grid along the longest side; fine: cells between the places on a hull at which
    its distance from the body is measured.
    """

    def __init__(
        self, solids: list[Solid], faces: Array, cells: int = 140, fine: float = 1.0
    ) -> None:
        self.fine = fine
        low = np.min([solid.low for solid in solids], axis=0)
        high = np.max([solid.high for solid in solids], axis=0)
        self.span = float((high - low).max())
        self.cell = min(max(self.span / cells, 0.003), 0.009)
        surface = _thinned(samples(faces, self.cell), self.cell / 2)
        self.field = _Field(solids, surface, self.cell)
        self.pieces = [piece for solid in solids for piece in solid.pieces]
        self.shell = _thinned(surface, self.cell * 1.5)
        core = _thinned(self.field.inside, self.cell * 3.5)
        self.core = core if len(core) else self.field.inside
        self.depth = self.field.tree.query(self.core)[0]
        self.points = np.concatenate([self.shell, self.core])
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

    def completed(self, taken: list[Hull], seen: Array) -> list[Array]:
        """Return the vertices of fewer hulls, which hold the surface and what is seen of it."""
        found = [hull.vertices for hull in self._merged(self._needed(taken))]
        return self._mended(self._mended(found, self.field.surface, BARE), seen, SEEN_BARE)

    def _extended(self, taken: list[Hull], place: int) -> bool:
        """Extend a hull that comes near to the bare point at `place`; say whether one could."""
        middle = self.points[place]
        near = np.linalg.norm(self.shell - middle, axis=1)
        near_bare = (self.outside[: len(self.shell)] > HIDDEN) & (near < 5 * self.cell)
        for reach in (self.shell[near_bare], middle[None]):
            for number in np.argsort([hull.away[place] for hull in taken])[:3]:
                hull = self._joined(taken[number].vertices, reach)
                if hull is not None:
                    taken[number] = hull
                    np.minimum(self.outside, hull.away, out=self.outside)
                    return True
        return False

    def _merged(self, hulls: list[Hull]) -> list[Hull]:
        """Join two hulls into one wherever that stays close to the body, small ones first."""
        waiting = sorted(hulls, key=lambda one: -np.count_nonzero(one.away <= 0))
        done: list[Hull] = []
        while waiting:
            hull = waiting.pop()
            away = [
                float(np.linalg.norm(other.vertices.mean(axis=0) - hull.vertices.mean(axis=0)))
                for other in waiting
            ]
            for number in np.argsort(away)[:12]:
                both = self._joined(waiting[number].vertices, hull.vertices)
                if both is not None:
                    waiting[number] = both
                    break
            else:
                done.append(hull)
        return done

    def _mended(self, hulls: list[Array], surface: Array, most: float) -> list[Array]:
        """Hold what sticks out by more than `most`: corners between the points of the cover."""
        away = [_heights(vertices, surface) for vertices in hulls]
        for _ in range(400):
            outside = np.min(away, axis=0)
            place = int(outside.argmax())
            if outside[place] <= most:
                break
            near = np.linalg.norm(surface - surface[place], axis=1)
            close = surface[(outside > HIDDEN) & (near < 3 * self.cell)]
            order = np.argsort([heights[place] for heights in away])[:4]
            tries = [(number, reach) for reach in (close, surface[[place]]) for number in order]
            for number, reach in tries:
                both = self._joined(hulls[number], reach)
                if both is not None:
                    hulls[number], away[number] = both.vertices, _heights(both.vertices, surface)
                    break
            else:
                body = self.field.surface
                around = np.linalg.norm(body - surface[place], axis=1) < 3 * self.cell
                points = np.concatenate([body[around], surface[[place]]])
                hulls.append(np.round(_wrapped(points), 6))
                away.append(_heights(hulls[-1], surface))
        return hulls

    def _joined(self, one: Array, other: Array) -> Hull | None:
        """Return the hull of both point sets, or None where it stands off the body."""
        points = np.concatenate([one, other])
        points = points[ConvexHull(points).vertices]
        for spacing in (0.03, self.fine * self.cell):
            if len(points) > MOST_VERTICES or self.gap(points, spacing)[0] > FINISHED_GAP:
                return None
        return self._measured(points)

    def _score(self, hull: Hull) -> float:
        gained = (self.outside > HIDDEN) & (hull.away <= HIDDEN)
        return float(
            gained[: len(self.shell)].sum() + INSIDE_COUNTS * gained[len(self.shell) :].sum()
        )

    def _needed(self, taken: list[Hull]) -> list[Hull]:
        """Return the hulls without those whose surface the others cover, small ones first."""
        shell = slice(0, len(self.shell))
        kept = list(taken)
        for hull in sorted(taken, key=lambda one: np.count_nonzero(one.away[shell] <= BARE)):
            rest = [one.away[shell] for one in kept if one is not hull]
            if rest and np.min(rest, axis=0).max() <= BARE:
                kept.remove(hull)
        return kept

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
            hull = _hull(self.points[keep])
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

    def gap(self, corners: Array, spacing: float) -> tuple[float, Array]:
        """Return how far the hull of the corners stands off the body, m, and where."""
        points = samples(corners[ConvexHull(corners).simplices], spacing)
        gaps = self.field(points)
        return float(gaps.max()), points[gaps.argmax()]

    def finished(self, corners: Array) -> Hull:
        """Return a hull of few corners around the points."""
        return self._measured(np.round(_wrapped(corners), 6))

    def _measured(self, vertices: Array) -> Hull:
        return Hull(vertices, _heights(vertices, self.points))


def _heights(vertices: Array, points: Array) -> Array:
    """Return how far each point lies outside the hull of the vertices, m; below 0 inside."""
    equations = ConvexHull(vertices).equations
    result = np.empty(len(points))
    for some in np.array_split(np.arange(len(points)), len(points) // 20_000 + 1):
        result[some] = (points[some] @ equations[:, :3].T + equations[:, 3]).max(axis=1)
    return result


def _thinned(points: Array, spacing: float) -> Array:
    """Return one of the points in each cube of `spacing`."""
    _, first = np.unique(np.round(points / spacing).astype(int), axis=0, return_index=True)
    return points[np.sort(first)]


def _hull(points: Array) -> ConvexHull | None:
    if len(points) < 8:
        return None
    try:
        return ConvexHull(points)
    except QhullError:
        return None


def _wrapped(points: Array) -> Array:
    """Return few vertices, LIFT outside the points, whose hull holds these to within HIDDEN."""
    hull = ConvexHull(points)
    normals = np.zeros_like(points)
    for corner in range(3):
        np.add.at(normals, hull.simplices[:, corner], hull.equations[:, :3])
    inner, normals = points[hull.vertices], normals[hull.vertices]
    outer = inner + LIFT * normals / np.linalg.norm(normals, axis=1, keepdims=True)
    chosen = list(np.unique((inner @ CUBE.T).argmax(axis=0)))
    tried = set(chosen)
    while True:
        few = ConvexHull(outer[chosen])
        away = (inner @ few.equations[:, :3].T + few.equations[:, 3]).max(axis=1)
        furthest = int(away.argmax())
        chosen = [chosen[place] for place in few.vertices]
        if away[furthest] <= HIDDEN or furthest in tried:
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
