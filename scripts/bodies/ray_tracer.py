"""Renders meshes as a PNG by ray casting on the CPU, without a display."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray
from PIL import Image
from scipy.ndimage import gaussian_filter

from mrlab_ros.core.base.geometry import Array

FLOOR_COLOUR = (0.80, 0.81, 0.82)
SKY_COLOUR = (0.93, 0.945, 0.96)
SUN = np.array([0.45, -0.62, 0.95]) / np.linalg.norm([0.45, -0.62, 0.95])
SUN_SIZE = 0.06
OCCLUSION_RAYS = 6
CHUNK = 400_000
# What is further away than this keeps no light of the sky off, m.
REACH = 1.2
# How dark the shadow below a cut-out is at most.
SHADOW = 0.55
# Share of the picture's width over which that shadow fades out towards the edges.
FADE = 0.14


@dataclass(frozen=True, eq=False)
class Surface:
    """A mesh in world coordinates and its material.

    vertices, normals: (V, 3); faces: (F, 3); colour: sRGB 0 to 1; metalness, roughness: 0 to 1.
    """

    vertices: Array
    normals: Array
    faces: NDArray[np.int64]
    colour: tuple[float, float, float]
    metalness: float = 0.0
    roughness: float = 0.5


@dataclass(frozen=True)
class Camera:
    """The camera: eye and target in m, vertical field of view in degrees."""

    eye: tuple[float, float, float]
    target: tuple[float, float, float]
    opening_deg: float = 30.0


def draw(
    surfaces: Sequence[Surface], camera: Camera, size: tuple[int, int], samples: int, path: Path
) -> None:
    """Write the picture, `size` (width, height) in pixels, with `samples` rays a pixel."""
    width, height = size
    linear = _render(_Tables(surfaces), camera, size, samples)[:, :3]
    pixels = np.clip(_to_srgb(linear), 0, 1).reshape(height, width, 3)
    path.parent.mkdir(parents=True, exist_ok=True)
    image = Image.fromarray((pixels * 255 + 0.5).astype(np.uint8))
    # A palette takes a third of the bytes, and the grain of the rays hides its steps.
    image.quantize(256, dither=Image.Dither.NONE).save(path, optimize=True)


def cut_out(
    surfaces: Sequence[Surface], camera: Camera, size: tuple[int, int], samples: int, near: float
) -> Image.Image:
    """Return the picture without floor and sky, but with the shadow on the floor: RGBA.

    near: what is further away than this casts no shadow, m. The floor lies below the lowest point.
    """
    width, height = size
    lowest = min(float(part.vertices[:, 2].min()) for part in surfaces)
    found = _render(_Tables(surfaces, lowest), camera, size, samples, near)
    light, solid = found[:, :3], found[:, 3:4]
    alpha = solid + SHADOW * _soft(found[:, 4], solid[:, 0], size)
    # The shadow is black: of what is there, the share that is solid is bright.
    colour = np.clip(_to_srgb(light / np.maximum(solid, 1e-6)), 0, 1) * solid
    pixels = np.concatenate([colour / np.maximum(alpha, 1e-6), alpha], axis=1)
    return Image.fromarray((pixels.reshape(height, width, 4) * 255 + 0.5).astype(np.uint8))


def _soft(shadow: Array, solid: Array, size: tuple[int, int]) -> Array:
    """Return the shadow without its grain, (pixels, 1); it ends before the picture does."""
    width, height = size
    of_floor = 1 - solid

    def blurred(values: Array) -> Array:
        soft: Array = gaussian_filter(values.reshape(height, width), width / 80)
        return soft.ravel()

    smooth = blurred(shadow) / np.maximum(blurred(of_floor), 1e-3) * of_floor
    y, x = np.mgrid[0:height, 0:width]
    edge = np.minimum.reduce([x, y, width - 1 - x, height - 1 - y]).ravel() / (FADE * width)
    result: Array = (smooth * np.clip(edge, 0, 1) ** 2)[:, None]
    return result


def _render(
    tables: _Tables, camera: Camera, size: tuple[int, int], samples: int, near: float = REACH
) -> Array:
    """Return (pixels, 5), row by row: light of all or of what is solid, its share, the shadow's.

    See _shade for the columns.
    """
    width, height = size
    rng = np.random.default_rng(0)
    total = np.zeros((width * height, 5))
    rows, columns = np.divmod(np.arange(width * height), width)
    for _ in range(samples):
        x = (columns + rng.random(len(columns))) / width * 2 - 1
        y = 1 - (rows + rng.random(len(rows))) / height * 2
        directions = _directions(camera, x * width / height, y)
        for start in range(0, len(directions), CHUNK):
            part = slice(start, start + CHUNK)
            total[part] += _shade(tables, np.array(camera.eye), directions[part], rng, near)
    return total / samples


def to_linear(srgb: Sequence[float] | Array) -> Array:
    """Return linear light for sRGB values."""
    values = np.asarray(srgb, dtype=np.float64)
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


def _to_srgb(linear: Array) -> Array:
    # A soft shoulder keeps highlights from clipping to flat white.
    bright = np.where(linear > 0.8, 0.8 + 0.2 * np.tanh((linear - 0.8) / 0.35), linear)
    return np.where(bright <= 0.0031308, bright * 12.92, 1.055 * bright ** (1 / 2.4) - 0.055)


def _directions(camera: Camera, x: Array, y: Array) -> Array:
    eye, target = np.array(camera.eye), np.array(camera.target)
    ahead = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    scale = np.tan(np.radians(camera.opening_deg) / 2)
    rays = ahead + scale * (x[:, None] * right + y[:, None] * up)
    result: Array = rays / np.linalg.norm(rays, axis=1, keepdims=True)
    return result


class _Tables:
    """All surfaces as one scene, with a row of material for each triangle; the floor is last.

    floor_at: height of the floor, m, of a picture that shows only the shadow on it.
    """

    def __init__(self, surfaces: Sequence[Surface], floor_at: float | None = None) -> None:
        self.alone = floor_at is not None
        at = floor_at or 0.0
        floor = np.array([[-60.0, -60, at], [60, -60, at], [60, 60, at], [-60, 60, at]])
        ground = Surface(
            floor,
            np.tile([0.0, 0, 1], (4, 1)),
            np.array([[0, 1, 2], [0, 2, 3]]),
            FLOOR_COLOUR,
            0.0,
            0.9,
        )
        parts = [*surfaces, ground]
        offsets = np.cumsum([0, *(len(part.vertices) for part in parts)])
        faces = [part.faces + at for part, at in zip(parts, offsets, strict=False)]
        vertices = np.concatenate([part.vertices for part in parts])
        self.faces = np.concatenate(faces)
        self.normals = np.concatenate([part.normals for part in parts])
        rows = [
            np.tile(
                [*to_linear(part.colour), part.metalness, part.roughness], (len(part.faces), 1)
            )
            for part in parts
        ]
        self.material = np.concatenate(rows)
        a, b, c = np.swapaxes(vertices[self.faces], 0, 1)
        flat = np.cross(b - a, c - a)
        self.flat = flat / np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-12)
        self.scene = EmbreeScene()
        TriangleMesh(self.scene, vertices[self.faces].astype(np.float32))

    def hit(self, origins: Array, directions: Array) -> dict[str, NDArray[np.float32]]:
        """Return embree's answer: primID (-1: nothing), tfar, u, v, one a ray."""
        answer: dict[str, NDArray[np.float32]] = self.scene.run(
            origins.astype(np.float32), directions.astype(np.float32), output=True
        )
        return answer

    def blocked(self, origins: Array, directions: Array, within: float) -> NDArray[np.bool_]:
        """Return which rays hit something nearer than `within`, m."""
        answer = self.hit(origins, directions)
        met: NDArray[np.bool_] = (answer["primID"] >= 0) & (answer["tfar"] < within)
        return met


def _sky(directions: Array) -> Array:
    """Light from above: a soft bright ceiling, grey walls, a dim floor."""
    height = directions[:, 2:3]
    wall = np.array([0.62, 0.64, 0.67])
    ceiling, ground = np.array([1.15, 1.15, 1.15]), np.array([0.34, 0.33, 0.32])
    up, down = np.clip(height, 0, 1) ** 0.6, np.clip(-height, 0, 1) ** 0.5
    light: Array = wall + (ceiling - wall) * up + (ground - wall) * down
    # A strip light to the left gives metal and lacquer something to mirror.
    side = directions @ np.array([-0.55, -0.75, 0.37])
    strip: Array = light + 1.6 * np.clip((side[:, None] - 0.86) / 0.08, 0, 1)
    return strip


def _shade(
    tables: _Tables, eye: Array, directions: Array, rng: np.random.Generator, near: float
) -> Array:
    """Return (rays, 5): the light; where the floor is left out 1 for a surface; the shadow."""
    count = len(directions)
    answer = tables.hit(np.tile(eye, (count, 1)), directions)
    seen = np.flatnonzero(answer["primID"] >= 0)
    result = np.zeros((count, 5))
    if not tables.alone:
        result[:, :3] = to_linear(SKY_COLOUR)
    if not len(seen):
        return result
    triangle = answer["primID"][seen]
    u, v = answer["u"][seen, None], answer["v"][seen, None]
    corners = tables.normals[tables.faces[triangle]]
    normal = (1 - u - v) * corners[:, 0] + u * corners[:, 1] + v * corners[:, 2]
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-9)
    view = -directions[seen]
    # Both towards the viewer; a smoothed normal alone may lean away where a face does not.
    flat = tables.flat[triangle]
    flat = np.where((flat * view).sum(axis=1, keepdims=True) < 0, -flat, flat)
    normal = np.where((normal * flat).sum(axis=1, keepdims=True) < 0, -normal, normal)
    distance = answer["tfar"][seen]
    point = eye + directions[seen] * distance[:, None] + flat * 1e-4
    material = tables.material[triangle]
    colour, metal, rough = material[:, :3], material[:, 3:4], material[:, 4:5]

    open_sky = np.zeros((len(seen), 1))
    for _ in range(OCCLUSION_RAYS):
        around = rng.normal(size=(len(seen), 3))
        around = normal + around / np.linalg.norm(around, axis=1, keepdims=True)
        around /= np.maximum(np.linalg.norm(around, axis=1, keepdims=True), 1e-9)
        open_sky += ~tables.blocked(point, around, near)[:, None]
    open_sky /= OCCLUSION_RAYS
    toward = SUN + rng.normal(scale=SUN_SIZE, size=(len(seen), 3))
    toward /= np.linalg.norm(toward, axis=1, keepdims=True)
    lit = ~tables.blocked(point, toward, 1e6)[:, None]
    sun = lit * np.clip((normal * toward).sum(axis=1, keepdims=True), 0, 1)

    diffuse = colour * (1 - metal) * (0.62 * _sky(normal) * (0.25 + 0.75 * open_sky) + 0.95 * sun)
    facing = np.clip((normal * view).sum(axis=1, keepdims=True), 0, 1)
    base = 0.04 * (1 - metal) + colour * metal
    fresnel = base + (1 - rough) * (np.maximum(1 - base, 0)) * 0.6 * (1 - facing) ** 5
    mirror = 2 * facing * normal - view
    blurred = (1 - rough**2) * _sky(mirror) + rough**2 * _sky(normal)
    half = toward + view
    half /= np.maximum(np.linalg.norm(half, axis=1, keepdims=True), 1e-9)
    power = 2 / np.maximum(rough, 0.08) ** 4 - 2
    glint = (power + 2) / 8 * np.clip((normal * half).sum(axis=1, keepdims=True), 0, 1) ** power
    shine = fresnel * (blurred * (0.35 + 0.65 * open_sky) + np.minimum(glint, 12) * sun)
    shaded = diffuse + shine
    if tables.alone:
        solid = (triangle < len(tables.faces) - 2)[:, None]
        result[seen] = np.hstack([shaded * solid, solid, (1 - open_sky) * ~solid])
        return result
    far = np.clip((distance[:, None] - 14) / 30, 0, 1)
    result[seen, :3] = shaded * (1 - far) + to_linear(SKY_COLOUR) * far
    return result
