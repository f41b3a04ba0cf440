"""A small picture of a robot for where nothing draws in 3D: print, and browsers without WebGL."""

from __future__ import annotations

import base64
import io
from collections.abc import Mapping, Sequence

import numpy as np
import trimesh
from numpy.typing import NDArray
from PIL import Image

from mrlab_ros.adapters.robots import drawing
from mrlab_ros.adapters.robots.library import RobotLibrary
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.robots.model import ShownRobot

SIZE = 440  # pixels, width and height
FINER = 2  # points are drawn so many times finer and averaged
CLOSE = 1.1  # points for each of the finer pixels along a side
MARGIN = 1.08
AMBIENT = 0.45


def poster(library: RobotLibrary, robot: ShownRobot, positions: Mapping[str, float]) -> str:
    """Return a picture of a robot at joint positions, rad or m by name, as a data: URL."""
    content = io.BytesIO()
    image(library, robot.model, robot.end_effector, positions).save(content, "WEBP", quality=80)
    return "data:image/webp;base64," + base64.b64encode(content.getvalue()).decode("ascii")


def image(
    library: RobotLibrary, model: str, end_effector: str, positions: Mapping[str, float]
) -> Image.Image:
    """Return a picture of a robot at joint positions, rad or m by name."""
    return Image.fromarray(
        picture(drawing.bodies(library, model, end_effector or None, positions))
    )


def picture(parts: Sequence[trimesh.Trimesh]) -> NDArray[np.uint8]:
    """Return (SIZE, SIZE, 3) uint8: the meshes on white, drawn as points with a depth buffer."""
    back = drawing.VIEW
    right = np.cross([0, 0, 1], back)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(back, right), back])
    corners = np.concatenate([part.triangles for part in parts])
    normals = np.concatenate([part.face_normals for part in parts])
    colours = np.concatenate(
        [np.broadcast_to(drawing.colour(part), (len(part.faces), 3)) for part in parts]
    )
    light = np.abs(normals @ drawing.LIGHT)
    shaded = np.clip(colours * (AMBIENT + (1 - AMBIENT) * light)[:, None], 0, 1)

    size = SIZE * FINER
    seen = corners @ axes.T
    flat = seen.reshape(-1, 3)
    low, high = flat.min(axis=0), flat.max(axis=0)
    scale = size / (float((high - low)[:2].max()) * MARGIN)
    seen = (seen - (low + high) / 2) * scale
    owner, points = _points(seen)
    place = (points[:, :2] + size / 2).astype(np.intp)
    pixel = (size - 1 - place[:, 1]) * size + place[:, 0]
    order = np.argsort(points[:, 2])  # the nearest is written last and stays
    canvas = np.full((size * size, 3), 255, np.uint8)
    canvas[pixel[order]] = (shaded * 255).astype(np.uint8)[owner[order]]
    fine = canvas.reshape(SIZE, FINER, SIZE, FINER, 3)
    averaged: NDArray[np.uint8] = fine.mean(axis=(1, 3)).round().astype(np.uint8)
    return averaged


def _points(triangles: Array) -> tuple[NDArray[np.int32], NDArray[np.float32]]:
    """Return the triangle of each point, and points on triangles (T, 3, 3), a pixel apart at most.

    The triangles are in pixels; each is a grid along its two shorter sides, of which the half that
    lies within is kept. Long thin triangles take a third of the points that way.
    """
    corners = triangles.astype(np.float32)
    opposite = np.roll(corners, -1, axis=1) - np.roll(corners, 1, axis=1)
    furthest = np.linalg.norm(opposite[..., :2], axis=2).argmax(axis=1)
    turned = (furthest[:, None] + np.arange(3)) % 3
    corners = np.take_along_axis(corners, turned[..., None], axis=1)
    start, sides = corners[:, 0], corners[:, 1:] - corners[:, :1]
    counts = np.ceil(np.linalg.norm(sides[..., :2], axis=2) * CLOSE).astype(np.int32) + 1
    steps = sides / counts[..., None].astype(np.float32)
    along, across = counts.T
    made = (along + 1) * (across + 1)
    owner = np.repeat(np.arange(len(corners), dtype=np.int32), made)
    first = np.repeat(np.cumsum(made, dtype=np.int32) - made, made)
    number = np.arange(len(owner), dtype=np.int32) - first
    u, v = np.divmod(number, (across + 1)[owner])
    within = u * across[owner] + v * along[owner] <= (along * across)[owner]
    owner, u, v = owner[within], u[within, None], v[within, None]
    points = start[owner] + u.astype(np.float32) * steps[owner, 0]
    points += v.astype(np.float32) * steps[owner, 1]
    return owner, points
