"""Castings from measured outlines: sections blended along an axis, within three silhouettes.

A table of a link (scripts/bodies/sections) holds, in mm and in the link's frame, outlines of the
link in equally spaced planes across one axis, and its outlines seen along all three. Between two
sections the signed distances to their outlines are blended (blend.py), which gives smooth walls
also where outlines part or join.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from blend import Blend
from raster import Raster, ends_at
from solids import Array, Solid

MM = 0.001
CORNER_DEG = 42.0  # an outline turns at a corner by more, on an arc by less
LOOSE = 0.0006  # m, by which silhouettes lie outside the sections: these make the surface
ROUNDED = 0.002  # m, radius of the edge between a silhouette and a section
SMALLEST = 2.5e-4  # m^2; smaller outlines are screws and lugs


def casting(table: dict[str, Any]) -> Solid:
    """Return the casting of a link in the link's frame."""
    low, high = np.array(table["box"], float) * MM
    along = "xyz".index(table["slice_axis"])
    first, second = ("xyz".index(letter) for letter in table["section_axes"])
    gap = table.get("gap", 0) * MM / 2
    raster = Raster(low[[first, second]], high[[first, second]], gap)
    sections = [_outlines(section["outlines"]) for section in table["sections"]]
    heights = np.array([section["at"] for section in table["sections"]]) * MM
    stack = np.stack([raster.distances(outlines) for outlines in sections])
    seen = {}
    for plane, outline in table["silhouettes"].items():
        i, j = ("xyz".index(letter) for letter in plane)
        flat = Raster(low[[i, j]], high[[i, j]], gap)
        shape = flat.distances(_outlines(outline["outer"]), _outlines(outline.get("holes", [])))
        seen[i, j] = (flat, shape)
    blend = Blend(raster, heights, stack, _extents(seen, along, (first, second)))

    def distance(p: Array) -> Array:
        d = blend(p[:, along], p[:, [first, second]])
        for (i, j), (flat, shape) in seen.items():
            d = _smooth_max(d, flat(shape, p[:, [i, j]]) - LOOSE)
        ends = np.maximum(low[along] - p[:, along], p[:, along] - high[along])
        return np.maximum(d, ends)

    return Solid(distance, low, high)


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
                found[k, 2 * n : 2 * n + 2] = ends_at(place, flat(shape, line))
        return found

    return ask
