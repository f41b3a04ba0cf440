"""A body as points and its distance on a grid, and convex hulls of it that keep the tolerances."""

from __future__ import annotations

import numpy as np
from convex import HIDDEN, LIFT, Hull, heights, thinned, wrapped
from scipy.ndimage import distance_transform_edt, map_coordinates
from scipy.spatial import ConvexHull, cKDTree
from solids import Array, Solid

from mrlab_ros.adapters.robots.hulls import samples

FINISHED_GAP = 0.0178  # m, by which a hull may stand off the body once lifted, extended, merged
MOST_VERTICES = 72  # of a hull that is extended or merged
BARE = 0.004  # m; a point that sticks out further gets one more hull
SEEN_BARE = 0.0047  # m, the same for the thinned visual meshes
EXACT = 0.03  # m; below, the grid's distances are computed from surface points


class Field:
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
    its distance from the body is measured; most_gap: by which a finished hull may stand off, m;
    lift: outwards, which lets a hull do with fewer vertices, m.
    """

    def __init__(
        self,
        solids: list[Solid],
        faces: Array,
        cells: int = 140,
        fine: float = 1.0,
        most_gap: float = FINISHED_GAP,
        lift: float = LIFT,
    ) -> None:
        self.fine, self.most_gap, self.lift = fine, most_gap, lift
        low = np.min([solid.low for solid in solids], axis=0)
        high = np.max([solid.high for solid in solids], axis=0)
        self.span = float((high - low).max())
        self.cell = min(max(self.span / cells, 0.003), 0.009)
        surface = thinned(samples(faces, self.cell), self.cell / 2)
        self.field = Field(solids, surface, self.cell)
        self.shell = thinned(surface, self.cell * 1.5)
        core = thinned(self.field.inside, self.cell * 3.5)
        self.core = core if len(core) else self.field.inside
        self.depth = self.field.tree.query(self.core)[0]
        self.points = np.concatenate([self.shell, self.core])

    def completed(self, taken: list[Hull], seen: Array) -> list[Array]:
        """Return the vertices of fewer hulls, which hold the surface and what is seen of it."""
        found = [hull.vertices for hull in self._merged(self._needed(taken))]
        return self._mended(self._mended(found, self.field.surface, BARE), seen, SEEN_BARE)

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
                both = self.joined(waiting[number].vertices, hull.vertices)
                if both is not None:
                    waiting[number] = both
                    break
            else:
                done.append(hull)
        return done

    def _mended(self, hulls: list[Array], surface: Array, most: float) -> list[Array]:
        """Hold what sticks out by more than `most`: corners between the points of the cover."""
        # What a hull holds, it holds when it is extended: only the rest is looked at.
        bare = np.min([heights(vertices, surface) for vertices in hulls], axis=0) > HIDDEN
        surface = surface[bare]
        away = [heights(vertices, surface) for vertices in hulls]
        for _ in range(400 if len(surface) else 0):
            outside = np.min(away, axis=0)
            place = int(outside.argmax())
            if outside[place] <= most:
                break
            near = np.linalg.norm(surface - surface[place], axis=1)
            close = surface[(outside > HIDDEN) & (near < 3 * self.cell)]
            order = np.argsort([one[place] for one in away])[:4]
            tries = [(number, reach) for reach in (close, surface[[place]]) for number in order]
            for number, reach in tries:
                both = self.joined(hulls[number], reach)
                if both is not None:
                    hulls[number], away[number] = both.vertices, heights(both.vertices, surface)
                    break
            else:
                body = self.field.surface
                around = np.linalg.norm(body - surface[place], axis=1) < 3 * self.cell
                points = np.concatenate([body[around], surface[[place]]])
                hulls.append(np.round(wrapped(points), 6))
                away.append(heights(hulls[-1], surface))
        return hulls

    def joined(self, one: Array, other: Array) -> Hull | None:
        """Return the hull of both point sets, or None where it stands off the body."""
        points = np.concatenate([one, other])
        hull = ConvexHull(points)
        if len(hull.vertices) > MOST_VERTICES:
            return None
        faces = points[hull.simplices]
        for spacing in (0.03, self.fine * self.cell):
            if self.field(samples(faces, spacing)).max() > self.most_gap:
                return None
        points = points[hull.vertices]
        return self._measured(points)

    def _needed(self, taken: list[Hull]) -> list[Hull]:
        """Return the hulls without those whose surface the others cover, small ones first."""
        shell = slice(0, len(self.shell))
        kept = list(taken)
        for hull in sorted(taken, key=lambda one: np.count_nonzero(one.away[shell] <= BARE)):
            rest = [one.away[shell] for one in kept if one is not hull]
            if rest and np.min(rest, axis=0).max() <= BARE:
                kept.remove(hull)
        return kept

    def gap(self, corners: Array, spacing: float) -> tuple[float, Array]:
        """Return how far the hull of the corners stands off the body, m, and where."""
        points = samples(corners[ConvexHull(corners).simplices], spacing)
        gaps = self.field(points)
        return float(gaps.max()), points[gaps.argmax()]

    def finished(self, corners: Array) -> Hull:
        """Return a hull of few corners around the points."""
        return self._measured(np.round(wrapped(corners, self.lift, self.lift), 6))

    def _measured(self, vertices: Array) -> Hull:
        return Hull(vertices, heights(vertices, self.points))
