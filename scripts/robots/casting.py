"""Castings from measured outlines: sections blended along an axis, within three silhouettes.

A table of a link (scripts/robots/sections) holds, in mm and in the link's frame, outlines of the
link in equally spaced planes across one axis, and its outlines seen along all three. Between two
sections the signed distances to their outlines are blended, which gives smooth walls also where
outlines part or join. How far the blend has come at a height is taken from the silhouettes, so a
shoulder stands where it was measured, not half-way between two sections.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import distance_transform_edt, map_coordinates
from scipy.spatial import cKDTree
from shapely.geometry import Polygon
from shapely.ops import unary_union
from solids import Array, Solid

MM = 0.001
CORNER_DEG = 42.0  # an outline turns at a corner by more, on an arc by less
LOOSE = 0.0006  # m, by which silhouettes lie outside the sections: these make the surface
ROUNDED = 0.002  # m, radius of the edge between a silhouette and a section
STEPS = 10  # between two sections, at which the silhouettes are asked
FAR = 0.05  # m, between two sections where one is empty
STATION = 0.004  # m, between the places along an axis at which drums are looked for
DRUM_VOTES = 0.3  # of the directions in which the surface must lie at a drum's radius
DRUM_SHARE, DRUM_OFF = 0.012, (0.004, 0.009)  # of the size; m: what counts as the drum's surface
SMALLEST = 2.5e-4  # m^2; smaller outlines are screws and lugs


def casting(table: dict[str, Any]) -> Solid:
    """Return the casting of a link in the link's frame."""
    low, high = np.array(table["box"], float) * MM
    along = "xyz".index(table["slice_axis"])
    first, second = ("xyz".index(letter) for letter in table["section_axes"])
    gap = table.get("gap", 0) * MM / 2
    raster = _Raster(low[[first, second]], high[[first, second]], gap)
    sections = [_outlines(section["outlines"]) for section in table["sections"]]
    heights = np.array([section["at"] for section in table["sections"]]) * MM
    stack = np.stack([raster.distances(outlines) for outlines in sections])
    seen = {}
    for plane, outline in table["silhouettes"].items():
        i, j = ("xyz".index(letter) for letter in plane)
        flat = _Raster(low[[i, j]], high[[i, j]], gap)
        shape = flat.distances(_outlines(outline["outer"]), _outlines(outline.get("holes", [])))
        seen[i, j] = (flat, shape)
    blend = _Blend(
        raster, heights, stack, _extents(seen, along, (first, second)), low[along], high[along]
    )

    def distance(p: Array) -> Array:
        d = blend(p[:, along], p[:, [first, second]])
        for (i, j), (flat, shape) in seen.items():
            d = _smooth_max(d, flat(shape, p[:, [i, j]]) - LOOSE)
        ends = np.maximum(low[along] - p[:, along], p[:, along] - high[along])
        return np.maximum(d, ends)

    return Solid(distance, low, high)


def turned_true(body: Solid, pose: Array) -> Solid:
    """Return the body with exact drums about the z axis of `pose` where it has nearly such."""
    middle, turn = pose[:3, 3], pose[:3, :3]
    corners = np.array(np.meshgrid(*zip(body.low, body.high, strict=True))).reshape(3, -1).T
    span = (corners - middle) @ turn
    tolerance = float(np.clip((body.high - body.low).max() * DRUM_SHARE, *DRUM_OFF))
    stations = np.arange(span[:, 2].min() + STATION / 2, span[:, 2].max(), STATION)
    radii = np.arange(0.015, float(np.hypot(span[:, 0], span[:, 1]).max()), STATION)
    angle = np.arange(0, 2 * np.pi, np.radians(5))
    s, a, r = np.meshgrid(stations, angle, radii, indexing="ij")
    grid = np.stack([r * np.cos(a), r * np.sin(a), s], axis=-1).reshape(-1, 3)
    values = body.distance(grid @ turn.T + middle).reshape(s.shape)
    leaves = (values[:, :, :-1] < 0) & (values[:, :, 1:] >= 0)
    share = values[:, :, :-1] / (values[:, :, :-1] - values[:, :, 1:] + 1e-12)
    crossing = np.where(leaves, radii[:-1] + np.clip(share, 0, 1) * STATION, np.nan)
    drums: list[tuple[float, float, float]] = []
    tries = np.arange(radii[0], radii[-1], 0.001)
    for station, found in zip(stations, crossing, strict=True):
        flat = np.sort(found[np.isfinite(found)])
        votes = np.searchsorted(flat, tries + 0.002) - np.searchsorted(flat, tries - 0.002)
        if not len(flat) or votes.max() < DRUM_VOTES * len(angle):
            continue
        best = tries[votes.argmax()]
        radius = float(np.median(flat[np.abs(flat - best) < 0.003]))
        if drums and station - drums[-1][1] < 1.1 * STATION and abs(radius - drums[-1][2]) < 0.002:
            first, _, before = drums[-1]
            drums[-1] = (first, station, 0.7 * before + 0.3 * radius)
        else:
            drums.append((station, station, radius))
    drums = [drum for drum in drums if drum[1] - drum[0] > 2.5 * STATION]

    def distance(p: Array) -> Array:
        d = body.distance(p)
        q = (p - middle) @ turn
        across = np.hypot(q[:, 0], q[:, 1])
        for first, last, radius in drums:
            within = (q[:, 2] > first - STATION / 2) & (q[:, 2] < last + STATION / 2)
            some = np.flatnonzero(within & (np.abs(across - radius) < 2 * tolerance))
            off = across[some] - radius
            weight = np.clip(2 - 2 * np.abs(off - d[some]) / tolerance, 0, 1)
            d[some] += weight * weight * (3 - 2 * weight) * (off - d[some])
        return d

    return Solid(distance, body.low, body.high)


def _smooth_max(a: Array, b: Array) -> Array:
    u = np.maximum(ROUNDED + np.stack([a, b]), 0.0)
    return np.minimum(-ROUNDED, np.maximum(a, b)) + np.sqrt((u * u).sum(axis=0))


def _outlines(flat: list[list[float]]) -> list[Array]:
    polygons = [_rounded(np.array(points, float).reshape(-1, 2) * MM) for points in flat]
    return [points for points in polygons if abs(_area(points)) > SMALLEST] or polygons[:1]


def _area(points: Array) -> float:
    x, y = points.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _rounded(points: Array) -> Array:
    """Return the outline with arcs where its corners lie on one, as measured ones of drums do."""
    way = np.roll(points, -1, axis=0) - points
    points, way = points[keep := np.linalg.norm(way, axis=1) > 1e-5], way[keep]
    way = np.roll(points, -1, axis=0) - points
    length = np.linalg.norm(way, axis=1)
    heading = np.arctan2(way[:, 1], way[:, 0])
    turn = (heading - np.roll(heading, 1) + np.pi) % (2 * np.pi) - np.pi
    result = []
    for n, start in enumerate(points):
        result.append(start)
        a, b = turn[n], turn[(n + 1) % len(points)]
        beside = max(length[n - 1], length[(n + 1) % len(points)])
        on_arc = a * b > 0 and max(abs(a), abs(b)) < np.radians(CORNER_DEG)
        if on_arc and length[n] < 2.5 * beside and min(abs(a), abs(b)) > 0.03:
            angle = (
                (a + b) / 2
                if abs(a) < 2 * abs(b) < 4 * abs(a)
                else np.sign(a) * min(abs(a), abs(b))
            )
            count = max(int(abs(angle) / 0.06), 2)
            across = np.array([way[n, 1], -way[n, 0]])
            for t in np.arange(1, count) / count:
                # A circular arc over the chord.
                bulge = np.tan(angle / 4) / 2 * 4 * t * (1 - t)
                result.append(start + t * way[n] + bulge * across)
    return np.array(result)


class _Raster:
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


def _extents(seen: dict[Any, Any], along: int, axes: tuple[int, int]) -> Any:
    """Return a function of heights: least and largest u and v of the silhouettes there, (N, 4)."""

    def ask(height: Array) -> Array:
        found = np.full((len(height), 4), np.nan)
        for n, axis in enumerate(axes):
            i, j = sorted((along, axis))
            flat, shape = seen[i, j]
            place = flat.axes[1 if i == along else 0]
            for k, h in enumerate(height):
                line = np.empty((len(place), 2))
                line[:, 0 if i == along else 1] = h
                line[:, 1 if i == along else 0] = place
                inside = place[flat(shape, line) < 0]
                if len(inside):
                    found[k, 2 * n : 2 * n + 2] = inside[0], inside[-1]
        return found

    return ask


class _Blend:
    def __init__(
        self, raster: _Raster, heights: Array, stack: Array, extents: Any, low: float, high: float
    ) -> None:
        self.raster, self.heights, self.stack = raster, heights, stack
        count = len(heights)
        self.slope = PchipInterpolator(np.arange(count), stack, axis=0).derivative()(
            np.arange(count)
        )
        places, progress = [heights[0]], [0.0]
        for k in range(count - 1):
            inner = heights[k] + np.arange(1, STEPS) / STEPS * (heights[k + 1] - heights[k])
            places += [*inner, heights[k + 1]]
            progress += [*(k + self._progress(k, extents(inner))), k + 1.0]
        self.places, self.progress = np.array(places), np.array(progress)

    def _at(self, k: int, t: float) -> Array:
        a, b, m, n = self.stack[k], self.stack[k + 1], self.slope[k], self.slope[k + 1]
        return (
            (2 * t**3 - 3 * t**2 + 1) * a
            + (t**3 - 2 * t**2 + t) * m
            + (-2 * t**3 + 3 * t**2) * b
            + (t**3 - t**2) * n
        )

    def _progress(self, k: int, wanted: Array) -> Array:
        """Return the share of section k + 1 at the heights with the extents `wanted`."""
        even = np.arange(1, STEPS) / STEPS
        tries = np.linspace(0, 1, 21)
        found = np.full((len(tries), 4), np.nan)
        for n, t in enumerate(tries):
            inside = self._at(k, t) < 0
            for axis in range(2):
                line = np.flatnonzero(inside.any(axis=1 - axis))
                if len(line):
                    found[n, 2 * axis : 2 * axis + 2] = self.raster.axes[axis][line[[0, -1]]]
        telling = np.abs(found[-1] - found[0]) > 0.0025
        if (
            not telling.any()
            or np.isnan(found[:, telling]).any()
            or np.isnan(wanted[:, telling]).any()
        ):
            return even
        off = np.minimum(np.abs(found[None, :, telling] - wanted[:, None, telling]), 0.04).sum(
            axis=2
        )
        cost = off + 0.0015 * np.abs(tries[None] - even[:, None])
        # The cheapest course that never goes back.
        best = np.empty_like(cost)
        best[0] = cost[0]
        origin = np.zeros(cost.shape, int)
        for n in range(1, len(cost)):
            running = np.minimum.accumulate(best[n - 1])
            place = np.maximum.accumulate(
                np.where(best[n - 1] <= running, np.arange(len(tries)), 0)
            )
            best[n], origin[n] = running + cost[n], place
        course = [int(best[-1].argmin())]
        for n in range(len(cost) - 1, 0, -1):
            course.append(int(origin[n][course[-1]]))
        return tries[course[::-1]]

    def __call__(self, height: Array, flat: Array) -> Array:
        place = np.interp(height, self.places, self.progress)
        k = np.clip(place.astype(int), 0, len(self.heights) - 2)
        t = place - k
        spot = ((flat - self.raster.low) / self.raster.cell).T
        a, b, m, n = (
            map_coordinates(values, [k + step, *spot], order=1, mode="nearest")
            for values, step in (
                (self.stack, 0),
                (self.stack, 1),
                (self.slope, 0),
                (self.slope, 1),
            )
        )
        return (
            (2 * t**3 - 3 * t**2 + 1) * a
            + (t**3 - 2 * t**2 + t) * m
            + (-2 * t**3 + 3 * t**2) * b
            + (t**3 - t**2) * n
        )
