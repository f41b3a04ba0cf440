"""Descriptions of bodies: links, their parts and materials; and shapes that robots share.

Every body is modelled in the base frame with all joints at zero, where the axes of an arm lie
along the coordinate axes; the generator carries each link into its own frame.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from solids import Array, Solid, block, disc, lathe

from mrlab_ros.adapters.robots.packing.surfaces import Material


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
