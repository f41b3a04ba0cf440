"""Seams, screws and clamps: grooves cut into the surface of a link, and what is set on it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from cutting import cut
from details import MM, Surface, frame_of, unit
from materials import BLACK, STEEL
from solids import Array

from mrlab_ros.adapters.robots.packing.occlusion import Around
from mrlab_ros.adapters.robots.packing.pieces import Piece, piece_of, rows_of
from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh

DARK = 0.3  # of the light at the bottom of a groove
WIDE, DEEP = 2.5, 1.5  # mm, of a groove
ABOVE = 3e-4  # m, of a strip above the surface
SPACING = 0.006  # m, along a strip
STEP = 0.003  # m; a surface with a higher one carries no strip there
EVEN = 0.6  # cosine between a surface and the direction from which a strip on it is seen
SIDES = 8  # of a screw's head
UPRIGHT = 0.9  # cosine between a screw and the surface that it stands on
# Of a clamp, across its hose, in radii of this, against the clock; its foot is on the surface.
BLOCK = ((-1.6, -1.0), (1.6, -1.0), (1.6, 0.9), (1.2, 1.4), (-1.2, 1.4), (-1.6, 0.9))
INTO = 0.008  # m, of a clamp below the surface
MATERIALS: dict[str, Material] = {"steel": STEEL, "black": BLACK}


def grooved(pieces: Sequence[Piece], seams: Sequence[dict[str, Any]]) -> list[Piece]:
    """Return the pieces of a link with grooves cut along the seams that go round it.

    A seam with `count` is there so often, `pitch` mm apart: the fins of a motor.
    """
    result = list(pieces)
    for seam in seams:
        for number in range(seam.get("count", 1) if "at" in seam else 0):
            place = {**seam, "at": seam["at"] + number * seam.get("pitch", 0.0)}
            result = [_grooved(piece, place) for piece in result]
    return result


def _grooved(piece: Piece, seam: dict[str, Any]) -> Piece:
    axis = "xyz".index(seam["axis"])
    slope = np.eye(3)[axis]
    half = seam.get("width", WIDE) * MM / 2
    deep = seam.get("depth", DEEP) * MM
    low, high = (np.array(corner, float) * MM for corner in seam["within"])
    rows, faces = rows_of(piece), piece.mesh.faces

    def height() -> Array:
        result: Array = rows[:, axis] - seam["at"] * MM
        return result

    def within() -> Array:
        a, b, c = rows[faces, :3].transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        upright = np.abs(normal[:, axis]) < 0.6 * np.linalg.norm(normal, axis=1)
        middle = (a + b + c) / 3
        result: Array = ((middle > low) & (middle < high)).all(axis=1) & upright
        return result

    for shift in (-half, half, 0.0):
        rows, faces, _ = cut(rows, faces, height() - shift, within())
    away = height()[faces].mean(axis=1)
    band = np.flatnonzero(within() & (np.abs(away) < half))
    if not len(band):
        return piece
    # The band's faces get vertices of their own: its edges and its bottom are sharp.
    key = np.stack([faces[band].ravel(), np.repeat(away[band] > 0, 3)], axis=1)
    used, index = np.unique(key, axis=0, return_inverse=True)
    fresh = rows[used[:, 0]].copy()
    outer = fresh[:, 3:6].copy()
    bottom = np.abs(height()[used[:, 0]]) < half / 2
    fresh[bottom, :3] -= deep * outer[bottom]
    fresh[bottom, 6] *= DARK
    leaning = outer + np.where(used[:, 1:] > 0, -1.0, 1.0) * slope * (deep / half)
    fresh[:, 3:6] = leaning / np.linalg.norm(leaning, axis=1, keepdims=True)
    faces = faces.copy()
    faces[band] = len(rows) + index.reshape(-1, 3)
    return piece_of(piece.material, np.concatenate([rows, fresh]), faces, piece.drawing)


def lined(seams: Sequence[dict[str, Any]], surface: Surface, around: Around) -> list[Piece]:
    """Return the seams of covers: strips on the surface, dark along their middle."""
    result = []
    for seam in seams:
        if "at" in seam:
            continue
        outwards = unit(seam["from"])
        path, ahead = outline(seam, outwards)
        away, normals, owner = surface.seen(path, outwards)
        here = np.isfinite(away) & (normals @ outwards > EVEN)
        if not here.any():
            continue
        across = np.cross(outwards, ahead) * seam.get("width", WIDE) * MM / 2
        middle = path + np.where(here, away, 0)[:, None] * outwards + ABOVE * normals
        count = len(path)
        rows = []
        for side, shade in ((-1.0, 0.85), (0.0, DARK), (0.0, DARK), (1.0, 0.85)):
            lean = across / np.linalg.norm(across, axis=1, keepdims=True)
            wall = normals + (0.7 if len(rows) < 2 else -0.7) * lean
            wall /= np.linalg.norm(wall, axis=1, keepdims=True)
            light = shade * around.light(middle, normals)
            rows.append(np.column_stack([middle + side * across, wall, light]))
        nearby = np.abs(np.roll(away, -1) - away) < STEP
        n = np.flatnonzero(here & np.roll(here, -1) & nearby)
        m = (n + 1) % count
        faces = [
            np.stack(
                [low * count + n, low * count + m, high * count + m, high * count + n], axis=1
            )
            for low, high in ((0, 1), (2, 3))
        ]
        quads = np.concatenate(faces)
        triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
        material = surface.materials[int(np.bincount(owner[here]).argmax())]
        result.append(piece_of(material, np.concatenate(rows), triangles, None))
    return result


def outline(seam: dict[str, Any], outwards: Array) -> tuple[Array, Array]:
    """Return points along a closed seam, against the clock as seen, and its way there, (N, 3) m.

    A circle of `radius` about `centre`, or a rectangle of half its sides, `half`, with rounded
    corners, along the axes that `outwards` is not.
    """
    if "radius" in seam:
        half, corner = np.zeros(2), seam["radius"] * MM
    else:
        half = np.array(seam["half"], float) * MM
        corner = 0.25 * float(half.min())
        half = half - corner
    flat = np.delete(np.eye(3), int(np.abs(outwards).argmax()), axis=0)
    if np.cross(flat[0], flat[1]) @ outwards < 0:
        flat, half = flat[::-1], half[::-1]
    points, ways = [], []
    count = max(int(np.pi / 2 * corner / SPACING), 3)
    for quarter, (x, y) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        angles = np.pi / 2 * (quarter + np.arange(count + 1) / count)
        points += [
            (x * half[0] + corner * np.cos(a), y * half[1] + corner * np.sin(a)) for a in angles
        ]
        ways += [(-np.sin(a), np.cos(a)) for a in angles]
        side = 2 * half[quarter % 2]
        steps = max(int(side / SPACING), 1)
        way = ways[-1]
        start = np.array(points[-1])
        points += [tuple(start + way * np.array(side * n / steps)) for n in range(1, steps)]
        ways += [way] * (steps - 1)
    centre = np.array(seam["centre"], float) * MM
    return centre + np.array(points) @ flat, np.array(ways) @ flat


def screwed(screws: Sequence[dict[str, Any]], surface: Surface, around: Around) -> list[Piece]:
    """Return the heads of the screws of a link, where its surface is even enough for one."""
    result = []
    for entry in screws:
        outwards = unit(entry["from"])
        size = entry["size"] * MM
        stated = places(entry, outwards)
        away, normals, _ = surface.seen(stated, outwards)
        flat = np.isfinite(away) & (normals @ outwards > UPRIGHT)
        for place, height, normal in zip(stated[flat], away[flat], normals[flat], strict=True):
            frame = frame_of(normal, np.array([0.31, 0.53, 0.79]))
            mesh, shade = _head(size)
            middle = place + height * outwards
            placed = Mesh(mesh.vertices @ frame + middle, mesh.faces, mesh.normals @ frame)
            light = around.light(placed.vertices, placed.normals) * shade
            result.append(Piece(MATERIALS[entry.get("material", "black")], placed, light))
    return result


def clamped(clamps: Sequence[dict[str, Any]], surface: Surface, around: Around) -> list[Piece]:
    """Return the blocks that hold hoses of a link, each from the surface up and about its hose."""
    result = []
    for entry in clamps:
        outwards, along = unit(entry["from"]), unit(entry["along"])
        across = np.cross(outwards, along)
        at, radius = np.array(entry["at"], float) * MM, entry["radius"] * MM
        foot = surface.seen(at[None], outwards)[0][0]
        if not np.isfinite(foot):
            raise ValueError(f"clamp on {entry['link']} at {entry['at']}: no surface below it")
        x, y = np.array(BLOCK).T * radius
        y = np.where(y < 0, foot - INTO, y)
        corners = [
            at + side * radius * along + np.outer(x, across) + np.outer(y, outwards)
            for side in (-1.0, 1.0)
        ]
        quads = np.stack([np.arange(len(x)), (np.arange(len(x)) + 1) % len(x)], axis=1)
        low, high = corners
        sides = [np.array([low[a], low[b], high[b], high[a]]) for a, b in quads]
        vertices, faces, normals = [], [], []
        for ring in (*sides, low[::-1], high):
            normal = unit(np.cross(ring[1] - ring[0], ring[2] - ring[0]))
            first = sum(len(each) for each in vertices)
            vertices.append(ring)
            normals.append(np.tile(normal, (len(ring), 1)))
            faces += [[first, first + n, first + n + 1] for n in range(1, len(ring) - 1)]
        mesh = Mesh(np.concatenate(vertices), np.array(faces), np.concatenate(normals))
        result.append(Piece(BLACK, mesh, around.light(mesh.vertices, mesh.normals)))
    return result


def places(entry: dict[str, Any], outwards: Array) -> Array:
    """Return where the screws of a circle, or those listed, are looked for, (N, 3) m."""
    if "places" in entry:
        return np.array(entry["places"], float) * MM
    right, up, _ = frame_of(outwards, np.array([0.0, 0.0, 1.0]))
    count = entry["count"]
    angle = np.radians(entry.get("start", 0.0)) + 2 * np.pi * np.arange(count) / count
    ring = np.cos(angle)[:, None] * right + np.sin(angle)[:, None] * up
    result: Array = (np.array(entry["centre"], float) + entry["radius"] * ring) * MM
    return result


def _head(size: float) -> tuple[Mesh, Array]:
    """Return the head of a socket screw about z that stands on z = 0, and its own shade.

    size: m, its width.
    """
    half, tall = size / 2, size * 0.45
    # Rings: radius, height, outward and upward part of the normal, light.
    rings = [
        (half, 0.0, 1.0, 0.0, 0.5),
        (half * 0.93, tall, 0.8, 0.6, 1.0),
        (half * 0.93, tall, 0.0, 1.0, 1.0),
        (half * 0.52, tall, 0.0, 1.0, 1.0),
        # the socket: its depth is not seen at arm's length, that it is dark is
        (half * 0.52, tall, 0.0, 1.0, 0.15),
    ]
    angle = 2 * np.pi * np.arange(SIDES) / SIDES
    way = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    vertices, normals, light = [], [], []
    for radius, height, out, upward, shade in rings:
        vertices.append(np.column_stack([way * radius, np.full(SIDES, height)]))
        normals.append(np.column_stack([way * out, np.full(SIDES, upward)]))
        light.append(np.full(SIDES, shade))
    faces = []
    for ring in (0, 2):
        for n in range(SIDES):
            a, b = ring * SIDES + n, ring * SIDES + (n + 1) % SIDES
            faces += [[a, b, b + SIDES], [a, b + SIDES, a + SIDES]]
    last = (len(rings) - 1) * SIDES
    faces += [[last, last + n, last + n + 1] for n in range(1, SIDES - 1)]
    mesh = Mesh(np.concatenate(vertices), np.array(faces), np.concatenate(normals))
    return mesh, np.concatenate(light)
