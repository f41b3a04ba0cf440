"""Centre of mass and inertia of bodies made of parts.

Second moments, the integral of x x^T over the mass, add up where inertias do not: those of solids
are in every table, and those of a closed surface follow from its triangles by the divergence
theorem.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mrlab_ros.core.base.geometry import (
    Array,
    Quaternion,
    Vector,
    pose_from_transform,
    rotation,
)
from mrlab_ros.core.physics.engine import Part, Shape

# Products of inertia below this share of the moments are rounding.
ROUNDING = 1e-6


def mass_properties(parts: Sequence[Part], mass: float) -> tuple[Vector, Array]:
    """Return the centre of mass, m, and the inertia about it, (3, 3) kg*m^2, in the parts' frame.

    Each part is as heavy as its volume and density make it; together they have `mass`, kg. What
    two parts share counts twice. Hulls and meshes need triangles that close around them.
    """
    total, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
    for part in parts:
        volume, at, about = _solid(part)
        turn = rotation(part.pose.orientation)
        place = turn @ at + part.pose.position
        share = part.density * volume
        total += share
        first += share * place
        second += part.density * (turn @ about @ turn.T) + share * np.outer(place, place)
    centre = first / total
    spread = mass / total * (second - total * np.outer(centre, centre))
    x, y, z = centre.tolist()
    return (x, y, z), np.trace(spread) * np.eye(3) - spread


def principal(inertia: Array) -> tuple[Vector, Quaternion]:
    """Return the principal moments, kg*m^2, and the orientation of their axes."""
    products = np.abs(inertia - np.diag(np.diag(inertia))).max()
    moments, axes = np.diag(inertia), np.eye(4)
    if products > ROUNDING * np.trace(inertia):
        moments, axes[:3, :3] = np.linalg.eigh(inertia)
        axes[:3, 2] *= math.copysign(1.0, np.linalg.det(axes))
    x, y, z = moments.tolist()
    return (x, y, z), pose_from_transform(axes).orientation


def _solid(part: Part) -> tuple[float, Array, Array]:
    """Return volume, m^3, centre and second moments about it, of a part in its own frame."""
    size, middle = part.size, np.zeros(3)
    if part.shape is Shape.BOX:
        return math.prod(size), middle, math.prod(size) / 12 * np.diag(np.square(size))
    if part.shape is Shape.CYLINDER:
        radius, length = size
        volume = math.pi * radius**2 * length
        across = radius**2 / 4
        return volume, middle, volume * np.diag([across, across, length**2 / 12])
    if part.shape is Shape.SPHERE:
        volume = 4 / 3 * math.pi * size[0] ** 3
        return volume, middle, volume * size[0] ** 2 / 5 * np.eye(3)
    assert part.vertices is not None
    assert part.triangles is not None
    # Tetrahedra between the corners' mean and each triangle.
    origin = part.vertices.mean(axis=0)
    corners = (part.vertices - origin)[part.triangles]
    sixfold = np.einsum("ti,ti->t", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
    sums = corners.sum(axis=1)
    volume = sixfold.sum() / 6
    centre = sixfold @ sums / 24 / volume
    second = np.einsum("t,tki,tkj->ij", sixfold, corners, corners)
    second += np.einsum("t,ti,tj->ij", sixfold, sums, sums)
    about = second / 120 - volume * np.outer(centre, centre)
    return float(volume), origin + centre, about
