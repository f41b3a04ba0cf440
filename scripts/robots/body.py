"""Descriptions of bodies: links, their parts and materials; and shapes that robots share.

Every body is modelled in the base frame with all joints at zero, where the axes of an arm lie
along the coordinate axes; the generator carries each link into its own frame.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from solids import Array, Solid, block, disc, lathe, rod


@dataclass(frozen=True)
class Material:
    """A name and the glTF metallic-roughness values; colour is sRGB, 0 to 1."""

    name: str
    colour: tuple[float, float, float]
    metalness: float
    roughness: float


# KUKA's colours by their RAL numbers: 2003, 9005, 9010.
ORANGE = Material("orange", (0.965, 0.471, 0.157), 0.0, 0.42)
BLACK = Material("black", (0.075, 0.075, 0.082), 0.0, 0.5)
WHITE = Material("white", (0.93, 0.925, 0.915), 0.0, 0.38)
GREY = Material("grey", (0.33, 0.335, 0.345), 0.0, 0.5)
LIGHT_GREY = Material("light_grey", (0.74, 0.75, 0.76), 0.6, 0.38)
STEEL = Material("steel", (0.66, 0.67, 0.69), 1.0, 0.32)
RUBBER = Material("rubber", (0.045, 0.045, 0.05), 0.0, 0.8)
UR_BLUE = Material("ur_blue", (0.49, 0.678, 0.8), 0.0, 0.4)
UR_SILVER = Material("ur_silver", (0.76, 0.77, 0.78), 0.85, 0.36)
UR_DARK = Material("ur_dark", (0.278, 0.278, 0.285), 0.2, 0.42)


@dataclass(frozen=True, eq=False)
class Part:
    """One solid of one material."""

    material: Material
    solid: Solid


@dataclass(frozen=True, eq=False)
class Body:
    """The parts of each link, in the base frame with all joints at zero."""

    links: dict[str, list[Part]] = field(default_factory=dict)

    def add(self, link: str, material: Material, *solids: Solid) -> None:
        """Add solids of one material to a link."""
        parts = self.links.setdefault(link, [])
        parts += [Part(material, solid) for solid in solids]


def drum(axis: str, start: float, end: float, radius: float, edge: float = 0.01) -> Solid:
    """Return a cylinder about a coordinate axis through the origin, from start to end on it."""
    shift = np.zeros(3)
    shift["xyz".index(axis)] = (start + end) / 2
    return disc(axis, radius, abs(end - start), edge).moved(*shift)


def slab(low: Sequence[float], high: Sequence[float], edge: float = 0.01) -> Solid:
    """Return a rounded box between two corners."""
    a, b = np.minimum(low, high), np.maximum(low, high)
    return block(b - a, edge).moved(*((a + b) / 2))


def cone(
    axis: str, start: float, end: float, radii: tuple[float, float], edge: float = 0.008
) -> Solid:
    """Return a truncated cone about a coordinate axis through the origin."""
    if end < start:
        start, end, radii = end, start, radii[::-1]
    return lathe(axis, [(-0.001, start), (radii[0], start), (radii[1], end), (-0.001, end)], edge)


def motor(axis: str, start: float, end: float, radius: float) -> Solid:
    """Return a servo motor: a ribbed can with a connector box at its end."""
    way = 1 if end > start else -1
    length = abs(end - start)
    can = drum(axis, start, end, radius, radius * 0.22)
    for share in (0.3, 0.42, 0.54, 0.66):
        place = start + way * share * length
        groove = drum(axis, place, place + 0.035 * length, radius * 1.2, 0.0) - drum(
            axis, place - length, place + length, radius * 0.93, 0.0
        )
        can = can - groove
    return can


def bolts(axis: str, place: float, circle: float, count: int, radius: float) -> Solid:
    """Return the heads of a circle of screws on the plane at `place`."""
    i, j, k = {"x": (1, 2, 0), "y": (0, 2, 1), "z": (0, 1, 2)}[axis]
    height = radius * 0.7
    pitch = 2 * np.pi / count

    def distance(p: Array) -> Array:
        # One head, repeated by folding the angle.
        angle = np.arctan2(p[:, j], p[:, i])
        angle = angle - pitch * np.round(angle / pitch)
        across = np.hypot(p[:, i], p[:, j])
        x, y = across * np.cos(angle) - circle, across * np.sin(angle)
        return np.maximum(np.hypot(x, y) - radius, np.abs(p[:, k] - place) - height)

    half = np.full(3, circle + radius)
    half[k] = height
    middle = np.zeros(3)
    middle[k] = place
    return Solid(distance, middle - half, middle + half)


def cap(axis: str, place: float, outwards: int, radius: float, thick: float = 0.006) -> Solid:
    """Return a round cover on the plane at `place`, its face outwards (+1 or -1)."""
    face = drum(axis, place - outwards * thick, place + outwards * thick, radius, thick * 0.6)
    ditch = drum(axis, place + outwards * thick * 0.4, place + outwards * 3 * thick, radius * 0.72)
    return face - (ditch - drum(axis, place - 1, place + 1, radius * 0.66, 0))


def hose(points: Sequence[Sequence[float]], radius: float) -> Solid:
    """Return a hose through the points, as a chain of capsules."""
    pieces = [rod(a, b, radius) for a, b in itertools.pairwise(points)]
    result = pieces[0]
    for piece in pieces[1:]:
        result = result.blend(piece, radius * 0.3)
    return result


def curve(points: Sequence[Sequence[float]], steps: int = 6) -> list[list[float]]:
    """Return points on a smooth curve through `points` (Catmull-Rom)."""
    p = np.array([points[0], *points, points[-1]], float)
    result = []
    for n in range(1, len(p) - 2):
        for t in np.arange(steps) / steps:
            a, b, c, d = p[n - 1 : n + 3]
            result.append(
                0.5
                * (
                    2 * b
                    + (c - a) * t
                    + (2 * a - 5 * b + 4 * c - d) * t**2
                    + (3 * b - a - 3 * c + d) * t**3
                )
            )
    return [list(q) for q in [*result, p[-1]]]
