"""Flat outlines as signed distances on a grid of pixels."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from scipy.ndimage import distance_transform_edt, map_coordinates
from scipy.spatial import cKDTree
from shapely.geometry import Polygon
from shapely.ops import unary_union
from solids import Array

FAR = 0.05  # m, between two sections where one is empty


class Raster:
    """Signed distances to flat outlines on a grid of pixels."""

    def __init__(self, low: Array, high: Array, closed: float) -> None:
        self.closed = closed  # m, half the width of gaps between outlines that are closed
        self.cell = float(np.clip((high - low).max() / 330, 0.0008, 0.003))
        self.low = low - 6 * self.cell
        counts = np.ceil((high - low) / self.cell).astype(int) + 13
        self.axes = [self.low[i] + self.cell * np.arange(counts[i]) for i in range(2)]
        self.shape = tuple(counts)

    def distances(self, outlines: list[Array], holes: Sequence[Array] = ()) -> Array:
        """Return the distance of each pixel to the outlines, below 0 inside."""
        if not outlines:
            return np.full(self.shape, FAR)
        shape = unary_union([Polygon(points).buffer(0) for points in outlines])
        if holes:
            shape = shape.difference(unary_union([Polygon(points).buffer(0) for points in holes]))
        if self.closed:
            shape = shape.buffer(self.closed).buffer(-self.closed)
        shapely.prepare(shape)
        grid = np.stack(np.meshgrid(*self.axes, indexing="ij"), axis=-1)
        inside = shapely.contains_xy(shape, grid[..., 0], grid[..., 1])
        away = np.where(
            inside, 0.5 - distance_transform_edt(inside), distance_transform_edt(~inside) - 0.5
        )
        # Near the outline by its points, further off by whole pixels.
        near = np.abs(away) < 3
        rim = shapely.get_coordinates(shapely.segmentize(shape.boundary, self.cell / 2))
        exact = cKDTree(rim).query(grid[near])[0]
        away *= self.cell
        away[near] = np.where(inside[near], -exact, exact)
        return np.asarray(away)

    def __call__(self, values: Array, points: Array) -> Array:
        place = (points - self.low) / self.cell
        return np.asarray(map_coordinates(values, place.T, order=1, mode="nearest"))


def ends_at(place: Array, values: Array) -> tuple[float, float]:
    """Return the first and the last place at which the values cross 0; nan where all are above."""
    inside = np.flatnonzero(values < 0)
    if not len(inside):
        return np.nan, np.nan
    found = []
    for at, step in ((inside[0], -1), (inside[-1], 1)):
        beside = min(max(at + step, 0), len(place) - 1)
        share = values[at] / (values[at] - values[beside]) if beside != at else 0.0
        found.append(float(place[at] + share * (place[beside] - place[at])))
    return found[0], found[1]
