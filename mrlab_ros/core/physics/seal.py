"""The seal of a vacuum cup: how its lip lies on the surface under it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Pose, Vector, add, cross, dot, rotate, scale, subtract
from mrlab_ros.core.physics.diagnostics import NO_SEAL_AT_EDGE, NO_SEAL_CURVED, NO_SEAL_TILTED
from mrlab_ros.core.physics.engine import Hit

POINTS = 16  # of the lip that are looked at
# The lip is searched from so far within the cup to so far beyond it, m.
WITHIN, BEYOND = 0.010, 0.014
# The most that the bellows and the lip of a cup give way.
TILT = math.radians(10.0)
PLAY = 0.0015  # m, of a lip that follows a curved surface
OUT = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Lip:
    """The rays that look at a lip. axis: unit, out of the cup; middle: m, of the lip; both in
    world."""

    middle: Vector
    axis: Vector
    starts: tuple[Vector, ...]
    ends: tuple[Vector, ...]


def lip(tool: Pose, depth: float, radius: float) -> Lip:
    """Return the rays about the axis z of a tool; depth: m from its origin to the lip."""
    axis = rotate(tool.orientation, OUT)
    middle = add(tool.position, scale(axis, depth))
    starts, ends = [], []
    for k in range(POINTS):
        turn = 2 * math.pi * k / POINTS
        out = rotate(tool.orientation, (radius * math.cos(turn), radius * math.sin(turn), 0.0))
        point = add(middle, out)
        starts.append(subtract(point, scale(axis, WITHIN)))
        ends.append(add(point, scale(axis, BEYOND)))
    return Lip(middle, axis, tuple(starts), tuple(ends))


def leak(name: str, found: Lip, hits: Sequence[Hit | None]) -> Diagnostic | None:
    """Return why the cup does not seal on object `name`; None where it does."""
    touched = [
        (subtract(end, start), start, hit)
        for start, end, hit in zip(found.starts, found.ends, hits, strict=True)
        if hit is not None
    ]
    if len(touched) < POINTS:
        return NO_SEAL_AT_EDGE(object=name, share=len(touched) / POINTS)
    points = [add(start, scale(way, hit.share)) for way, start, hit in touched]
    normal = _plane(points, found.axis)
    tilt = math.acos(min(max(-dot(normal, found.axis), -1.0), 1.0))
    if tilt > TILT:
        # To whole degrees: what is said does not change with every step.
        tilt = math.radians(round(math.degrees(tilt)))
        return NO_SEAL_TILTED(object=name, tilt=tilt, most=TILT)
    heights = [dot(point, normal) for point in points]
    bent = [dot(hit.normal, normal) for _, _, hit in touched]
    gap = max(heights) - min(heights)
    # A lip that lies round a ball is at one height and yet looks at its slope.
    slope = math.acos(min(max(min(bent), -1.0), 1.0))
    if gap > PLAY or slope > 2 * TILT:
        return NO_SEAL_CURVED(object=name)
    return None


def _plane(points: Sequence[Vector], axis: Vector) -> Vector:
    """Return the unit normal, against the axis, of the plane that fits a ring of points best:
    the sum of the areas between opposite points (Newell's method)."""
    total: Vector = (0.0, 0.0, 0.0)
    for a, b in zip(points, [*points[1:], points[0]], strict=True):
        total = add(total, cross(a, b))
    size = math.hypot(*total) or 1.0
    normal = scale(total, 1.0 / size)
    return scale(normal, -1.0) if dot(normal, axis) > 0 else normal
