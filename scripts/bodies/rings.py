"""Bare metal where links meet: a turned collar at the end of a round casting, about its joint.

Where a casting is round about a joint's axis and where it ends is read from its surface, so the
collars follow the castings when these change.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from details import frame_of, unit
from facets import turned
from materials import BLACK, ORANGE, STEEL
from solids import Array

from mrlab_ros.adapters.robots.hulls import samples
from mrlab_ros.adapters.robots.packing.occlusion import Around
from mrlab_ros.adapters.robots.packing.pieces import Piece
from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh
from mrlab_ros.core.base.geometry import inverse_transform, transform_from_xyz_rpy

PAINTED = {ORANGE.name, BLACK.name}  # castings; covers of plastic have no collars
SPACING = 0.004  # m, between the points at which a surface is looked at
SLICE = 0.005  # m, along the axis
SECTORS = 36  # about it
SIDES = 36  # of a collar
EVEN = 0.012  # of the radius, by which a round slice may be off
ROUND = 0.75  # of the sectors in which a round slice is that even
SHORTEST = 0.02  # m, of a round part that has a collar
WIDE = (0.05, 0.004, 0.009)  # of the radius; at least and at most, m
PROUD, CHAMFER, INTO = 0.0012, 0.0007, 0.004  # m
BURIED = 0.3  # of the light: less reaches collars that are inside the next link


def collars(
    figures: dict[str, Any],
    bodies: Mapping[str, Sequence[tuple[Material, Mesh]]],
    around: Mapping[str, Around],
) -> dict[str, list[Piece]]:
    """Return the collars of each link, in its own frame."""
    found: dict[str, list[Piece]] = {link: [] for link in bodies}
    points = {
        link: samples(np.concatenate([m.vertices[m.faces] for _, m in own]), SPACING)
        for link, own in bodies.items()
        if any(material.name in PAINTED for material, _ in own)
    }
    for joint in figures["joints"]:
        if joint["type"] not in ("revolute", "continuous"):
            continue
        pose = transform_from_xyz_rpy(joint["xyz"], joint["rpy"])
        turn = np.eye(4)
        turn[:3, :3] = frame_of(unit(joint["axis"]), np.array([0.0, 0.3, 1.0])).T
        child, parent = joint["child"], joint["parent"]
        if child not in bodies or parent not in bodies:
            continue
        for link, frame, beside in ((child, turn, parent), (parent, pose @ turn, child)):
            if link not in points:
                continue
            here = _along(points[link], frame)
            next_to = np.concatenate([mesh.vertices for _, mesh in bodies[beside]])
            lift = pose if beside == child else inverse_transform(pose)
            next_to = next_to @ lift[:3, :3].T + lift[:3, 3]
            towards = float(_along(next_to, frame)[:, 2].mean())
            for radius, low, high in _round_parts(here):
                wide = float(np.clip(WIDE[0] * radius, *WIDE[1:]))
                start = low + wide if abs(low - towards) < abs(high - towards) else high - 2 * wide
                mesh = _placed(_collar(radius, start, wide), frame)
                light = around[link].light(mesh.vertices, mesh.normals)
                if light.mean() > BURIED:
                    found[link].append(Piece(STEEL, mesh, light))
    return found


def _along(points: Array, frame: Array) -> Array:
    """Return points in the frame (4, 4) whose z is the axis."""
    result: Array = (points - frame[:3, 3]) @ frame[:3, :3]
    return result


def _round_parts(points: Array) -> Iterator[tuple[float, float, float]]:
    """Yield radius, start and end along z, m, of what is round about z."""
    height = np.floor(points[:, 2] / SLICE).astype(int)
    away = np.hypot(points[:, 0], points[:, 1])
    sector = ((np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi) + 0.5) * SECTORS).astype(int)
    low = int(height.min())
    outer = np.zeros((int(height.max()) - low + 1, SECTORS))
    np.maximum.at(outer, (height - low, sector % SECTORS), away)
    radius = np.median(outer, axis=1)
    even = np.abs(outer - radius[:, None]) < EVEN * radius[:, None]
    is_round = (even.mean(axis=1) > ROUND) & (radius > 0)
    start = 0
    for n in range(1, len(radius) + 1):
        goes_on = (
            n < len(radius)
            and is_round[n]
            and is_round[start]
            and abs(radius[n] - radius[n - 1]) < EVEN * radius[n]
        )
        if goes_on:
            continue
        if is_round[start] and (n - start) * SLICE >= SHORTEST:
            around = float(np.median(radius[start:n]))
            yield around, (low + start) * SLICE, (low + n) * SLICE
        start = n


def _collar(radius: float, start: float, wide: float) -> Mesh:
    outer, end = radius + PROUD, start + wide
    profile = [
        (radius - INTO, start),
        (outer, start + CHAMFER),
        (outer, end - CHAMFER),
        (radius - INTO, end),
    ]
    return turned("z", profile, SIDES)


def _placed(mesh: Mesh, frame: Array) -> Mesh:
    turn = frame[:3, :3]
    return Mesh(mesh.vertices @ turn.T + frame[:3, 3], mesh.faces, mesh.normals @ turn.T)
