"""Draws the parts of an object as binary glTF, for an object that has no mesh of its own."""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.physics.engine import Part, Shape

Faces = NDArray[np.int64]
AROUND = 48  # corners of a circle
# glTF's numbers for component types and buffer targets.
FLOAT, SHORT = 5126, 5123
VERTICES, INDICES = 34962, 34963


def glb(parts: Sequence[Part], color: Sequence[float], name: str) -> bytes:
    """Return boxes, cylinders and spheres as a GLB in the object's frame, m.

    color: red, green, blue, alpha, sRGB, 0 to 1. The same parts give the same bytes.
    """
    blob = bytearray()
    views: list[dict[str, Any]] = []
    accessors: list[dict[str, Any]] = []

    def store(array: NDArray[Any], kind: str, component: int, target: int) -> int:
        data = array.tobytes()
        views.append(
            {"buffer": 0, "byteOffset": len(blob), "byteLength": len(data), "target": target}
        )
        blob.extend(data + b"\0" * (-len(data) % 4))
        accessor = {"bufferView": len(views) - 1, "componentType": component, "type": kind}
        accessors.append({**accessor, "count": len(array), **_range(array, target)})
        return len(accessors) - 1

    meshes = []
    for part in parts:
        points, normals, faces = surface(part)
        attributes = {
            "POSITION": store(points.astype("<f4"), "VEC3", FLOAT, VERTICES),
            "NORMAL": store(normals.astype("<f4"), "VEC3", FLOAT, VERTICES),
        }
        indices = store(faces.astype("<u2").ravel(), "SCALAR", SHORT, INDICES)
        primitive = {"attributes": attributes, "indices": indices, "material": 0}
        meshes.append({"primitives": [primitive]})
    document = {
        "asset": {"version": "2.0", "generator": "mrlab"},
        "scene": 0,
        "scenes": [{"name": name, "nodes": list(range(len(meshes)))}],
        "nodes": [
            {"mesh": i, "translation": part.pose.position, "rotation": part.pose.orientation}
            for i, part in enumerate(parts)
        ],
        "meshes": meshes,
        "materials": [_material(color)],
        "buffers": [{"byteLength": len(blob)}],
        "bufferViews": views,
        "accessors": accessors,
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    return b"".join(
        (
            struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(blob)),
            struct.pack("<I4s", len(text), b"JSON"),
            text,
            struct.pack("<I4s", len(blob), b"BIN\0"),
            bytes(blob),
        )
    )


def surface(part: Part) -> tuple[Array, Array, Faces]:
    """Return (V, 3) points in m, (V, 3) normals and (T, 3) faces of a box, cylinder or sphere."""
    if part.shape is Shape.BOX:
        return _box(part.size)
    if part.shape is Shape.CYLINDER:
        return _cylinder(*part.size)
    return _sphere(*part.size)


def _box(size: Sequence[float]) -> tuple[Array, Array, Faces]:
    """Return six faces with four corners each, so that the edges are sharp."""
    points, normals = [], []
    for axis in range(3):
        for sign in (1.0, -1.0):
            normal, u, v = np.roll(np.eye(3), axis, axis=0) * [[sign], [1.0], [sign]]
            points += [normal - u - v, normal + u - v, normal + u + v, normal - u + v]
            normals += [normal] * 4
    faces = [corner + 4 * i for i in range(6) for corner in np.array([[0, 1, 2], [0, 2, 3]])]
    return np.array(points) * np.array(size) / 2, np.array(normals), np.array(faces)


def _cylinder(radius: float, length: float) -> tuple[Array, Array, Faces]:
    angles = np.linspace(0, 2 * math.pi, AROUND + 1)
    around = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
    up = np.array([0.0, 0.0, length / 2])
    circles = [around * radius - up, around * radius + up]
    flat = [np.tile([0.0, 0.0, sign], (AROUND + 1, 1)) for sign in (-1.0, 1.0)]
    # The two circles of the side, then those of the caps: the edges between them are sharp.
    points, normals = circles * 2, [around, around, *flat]
    n = AROUND + 1
    i = np.arange(AROUND)
    side = [np.stack([i, i + 1, i + n + 1], 1), np.stack([i, i + n + 1, i + n], 1)]
    # Fans over the first corner of each cap.
    fan = np.arange(1, AROUND - 1)
    low = np.stack([np.full_like(fan, 2 * n), 2 * n + fan + 1, 2 * n + fan], 1)
    high = np.stack([np.full_like(fan, 3 * n), 3 * n + fan, 3 * n + fan + 1], 1)
    return np.concatenate(points), np.concatenate(normals), np.concatenate([*side, low, high])


def _sphere(radius: float) -> tuple[Array, Array, Faces]:
    rings = AROUND // 2
    down, turn = np.meshgrid(
        np.linspace(0, math.pi, rings + 1), np.linspace(0, 2 * math.pi, AROUND + 1), indexing="ij"
    )
    across = np.sin(down)
    normals = np.stack([across * np.cos(turn), across * np.sin(turn), np.cos(down)], -1)
    normals = normals.reshape(-1, 3)
    n = AROUND + 1
    start = (np.arange(rings)[:, None] * n + np.arange(AROUND)).ravel()
    lower = np.stack([start, start + n, start + n + 1], 1)
    upper = np.stack([start, start + n + 1, start + 1], 1)
    return normals * radius, normals, np.concatenate([lower, upper])


def _range(array: NDArray[Any], target: int) -> dict[str, list[float]]:
    """Return the bounds that glTF wants of points."""
    if target != VERTICES:
        return {}
    return {"min": array.min(axis=0).tolist(), "max": array.max(axis=0).tolist()}


def _material(color: Sequence[float]) -> dict[str, Any]:
    *rgb, alpha = color
    linear = [round(c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4, 5) for c in rgb]
    return {
        "pbrMetallicRoughness": {
            "baseColorFactor": [*linear, alpha],
            "metallicFactor": 0.0,
            "roughnessFactor": 0.8,
        },
        **({"alphaMode": "BLEND"} if alpha < 1 else {}),
    }
