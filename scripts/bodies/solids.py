"""Solids as signed distance functions: primitives, unions that blend like a casting, cuts.

Lengths in m. A distance is negative inside. Castings have fillets wherever two volumes meet, and
a blend of distances gives exactly that at no cost; a boundary representation (build123d) fails
on the many tangent fillets such shapes need, and plain booleans (manifold3d) have none.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Point = Sequence[float]
AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True, eq=False)
class Solid:
    """A distance function of points (N, 3) -> (N,) and a box that holds the solid.

    made_of: the primitives that it was united from, before anything was cut away.
    """

    distance: Callable[[Array], Array]
    low: Array
    high: Array
    made_of: tuple[Solid, ...] = ()

    @property
    def pieces(self) -> tuple[Solid, ...]:
        """The primitives that it was united from; itself where it is one."""
        return self.made_of or (self,)

    def __or__(self, other: Solid) -> Solid:
        return self.blend(other, 0.0)

    def __sub__(self, other: Solid) -> Solid:
        return self.cut(other, 0.0)

    def __and__(self, other: Solid) -> Solid:
        return Solid(
            lambda p: np.maximum(self.distance(p), other.distance(p)),
            np.maximum(self.low, other.low),
            np.minimum(self.high, other.high),
            self.pieces,
        )

    def blend(self, other: Solid, fillet: float) -> Solid:
        """Unite with `other`; concave edges get about the radius `fillet`.

        A blend swells where faces of the two are flush; the box of both stays the limit.
        """
        low, high = np.minimum(self.low, other.low), np.maximum(self.high, other.high)
        middle, half = (low + high) / 2, (high - low) / 2

        def distance(p: Array) -> Array:
            both = _smooth_min(self.distance(p), other.distance(p), fillet)
            return (
                both if fillet <= 0 else np.maximum(both, (np.abs(p - middle) - half).max(axis=1))
            )

        return Solid(distance, low, high, self.pieces + other.pieces)

    def cut(self, other: Solid, fillet: float = 0.0) -> Solid:
        """Take `other` away; the edges of the cut get about the radius `fillet`."""
        return Solid(
            lambda p: -_smooth_min(-self.distance(p), other.distance(p), fillet),
            self.low,
            self.high,
            self.pieces,
        )

    def moved(self, *xyz: float) -> Solid:
        """Return the solid shifted by xyz."""
        shift = np.array(xyz)
        return Solid(
            lambda p: self.distance(p - shift),
            self.low + shift,
            self.high + shift,
            tuple(piece.moved(*xyz) for piece in self.made_of),
        )

    def turned(self, axis: str, degrees: float) -> Solid:
        """Return the solid turned about a coordinate axis through the origin."""
        i = AXES[axis]
        j, k = (i + 1) % 3, (i + 2) % 3
        cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        matrix = np.eye(3)
        matrix[j, j] = matrix[k, k] = cos
        matrix[j, k], matrix[k, j] = -sin, sin
        corners = np.array(np.meshgrid(*zip(self.low, self.high, strict=True))).reshape(3, -1)
        turned = matrix @ corners
        return Solid(
            lambda p: self.distance(p @ matrix),
            turned.min(axis=1),
            turned.max(axis=1),
            tuple(piece.turned(axis, degrees) for piece in self.made_of),
        )

    def mirrored(self, axis: str) -> Solid:
        """Return the mirror image in the plane through the origin across `axis`."""
        sign = np.ones(3)
        sign[AXES[axis]] = -1
        ends = np.sort(np.stack([self.low * sign, self.high * sign]), axis=0)
        return Solid(
            lambda p: self.distance(p * sign),
            ends[0],
            ends[1],
            tuple(piece.mirrored(axis) for piece in self.made_of),
        )


def _smooth_min(a: Array, b: Array, fillet: float) -> Array:
    if fillet <= 0:
        return np.minimum(a, b)
    # The circular blend: exact for faces at right angles, where the fillet's radius is `fillet`.
    u = np.maximum(fillet - np.stack([a, b]), 0.0)
    return np.maximum(fillet, np.minimum(a, b)) - np.sqrt((u * u).sum(axis=0))


def _box(*half: float) -> tuple[Array, Array]:
    extent = np.array(half)
    return -extent, extent


def _extruded(flat: Array, along: Array, half: float, edge: float) -> Array:
    """Distance to a flat shape, distance `flat`, extruded by +-half with rounded rims."""
    u, v = flat + edge, np.abs(along) - half + edge
    return np.hypot(np.maximum(u, 0), np.maximum(v, 0)) + np.minimum(np.maximum(u, v), 0) - edge


def _planes(axis: str) -> tuple[int, int, int]:
    """Return (first, second, along): flat shapes lie in xz for y, in yz for x, in xy for z."""
    return {"x": (1, 2, 0), "y": (0, 2, 1), "z": (0, 1, 2)}[axis]


def block(size: Point, edge: float = 0.0) -> Solid:
    """Return a box about the origin with rounded edges."""
    half = np.array(size) / 2
    edge = min(edge, float(half.min()) * 0.999)

    def distance(p: Array) -> Array:
        q = np.abs(p) - half + edge
        outside = np.linalg.norm(np.maximum(q, 0), axis=1)
        return outside + np.minimum(q.max(axis=1), 0) - edge

    return Solid(distance, -half, half)


def disc(axis: str, radius: float, length: float, edge: float = 0.0) -> Solid:
    """Return a cylinder about the origin with rounded rims."""
    i, j, k = _planes(axis)
    half = np.full(3, radius)
    half[k] = length / 2
    edge = min(edge, radius * 0.999, length / 2 * 0.999)
    return Solid(
        lambda p: _extruded(np.hypot(p[:, i], p[:, j]) - radius, p[:, k], length / 2, edge),
        -half,
        half,
    )


def ring(axis: str, radius: float, tube: float) -> Solid:
    """Return a torus about the origin."""
    i, j, k = _planes(axis)
    half = np.full(3, radius + tube)
    half[k] = tube
    return Solid(
        lambda p: np.hypot(np.hypot(p[:, i], p[:, j]) - radius, p[:, k]) - tube, -half, half
    )


def ball(radius: float) -> Solid:
    """Return a sphere about the origin."""
    return Solid(lambda p: np.linalg.norm(p, axis=1) - radius, *_box(radius, radius, radius))


def rod(a: Point, b: Point, radius: float, radius_b: float | None = None) -> Solid:
    """Return a capsule from a to b; with radius_b a cone between two balls."""
    start, end = np.array(a, float), np.array(b, float)
    second = radius if radius_b is None else radius_b
    way = end - start
    square = float(way @ way)
    slope = radius - second
    rest = square - slope**2

    def distance(p: Array) -> Array:
        pa = p - start
        y = pa @ way
        x = pa * square - y[:, None] * way
        x2 = (x * x).sum(axis=1)
        y2, z = y * y * square, y - square
        z2 = z * z * square
        k = np.sign(slope) * slope * slope * x2
        far = np.sqrt(x2 + z2) / square - second
        near = np.sqrt(x2 + y2) / square - radius
        side = (np.sqrt(x2 * rest / square) + y * slope) / square - radius
        return np.where(
            np.sign(z) * rest * z2 > k, far, np.where(np.sign(y) * rest * y2 < k, near, side)
        )

    ends = np.stack([start - radius, start + radius, end - second, end + second])
    return Solid(distance, ends.min(axis=0), ends.max(axis=0))


def plate(
    axis: str, outline: Sequence[Point], length: float, edge: float = 0.0, corner: float = 0.0
) -> Solid:
    """Return a polygon extruded along `axis` about the origin.

    corner: the radius of the outline's convex corners; edge: that of the rims. The polygon is
    the outer contour: rounding removes material.
    """
    i, j, k = _planes(axis)
    points = np.array(outline, float)
    if corner > 0:
        points = _inset(points, corner)
    following = np.roll(points, -1, axis=0)

    def distance(p: Array) -> Array:
        flat = p[:, [i, j]]
        nearest = np.full(len(p), np.inf)
        inside = np.zeros(len(p), dtype=bool)
        for a, b in zip(points, following, strict=True):
            way, rel = b - a, flat - a
            share = np.clip((rel @ way) / (way @ way), 0, 1)
            off = rel - share[:, None] * way
            nearest = np.minimum(nearest, (off * off).sum(axis=1))
            with np.errstate(divide="ignore", invalid="ignore"):
                crosses = (a[1] > flat[:, 1]) != (b[1] > flat[:, 1])
                left = flat[:, 0] < way[0] * rel[:, 1] / way[1] + a[0]
            inside ^= crosses & left
        d = np.where(inside, -1.0, 1.0) * np.sqrt(nearest) - corner
        return _extruded(d, p[:, k], length / 2, edge)

    low, high = np.zeros(3), np.zeros(3)
    low[[i, j]], high[[i, j]] = points.min(axis=0) - corner, points.max(axis=0) + corner
    low[k], high[k] = -length / 2, length / 2
    return Solid(distance, low, high)


def _inset(points: Array, by: float) -> Array:
    """Return the polygon moved inwards by `by`, edge by edge."""
    following, before = np.roll(points, -1, axis=0), np.roll(points, 1, axis=0)
    area = float(np.sum(points[:, 0] * following[:, 1] - following[:, 0] * points[:, 1]))
    turn = np.sign(area)

    def normal(a: Array, b: Array) -> Array:
        way = (b - a) / np.linalg.norm(b - a, axis=1, keepdims=True)
        return turn * np.column_stack([-way[:, 1], way[:, 0]])

    n1, n2 = normal(before, points), normal(points, following)
    middle = n1 + n2
    return points + by * 2 * middle / (middle * middle).sum(axis=1, keepdims=True)


def lathe(axis: str, profile: Sequence[Point], edge: float = 0.0) -> Solid:
    """Return a solid of revolution; profile: (radius, place along the axis) pairs, closed."""
    flat = plate("z", profile, 2.0, 0.0, edge)
    i, j, k = _planes(axis)
    points = np.array(profile, float)
    low, high = np.full(3, -points[:, 0].max()), np.full(3, points[:, 0].max())
    low[k], high[k] = points[:, 1].min(), points[:, 1].max()

    def distance(p: Array) -> Array:
        radius = np.hypot(p[:, i], p[:, j])
        return flat.distance(np.column_stack([radius, p[:, k], np.zeros(len(p))]))

    return Solid(distance, low, high)


def union(*solids: Solid, fillet: float = 0.0) -> Solid:
    """Unite the solids, one after the other."""
    result = solids[0]
    for solid in solids[1:]:
        result = result.blend(solid, fillet)
    return result
