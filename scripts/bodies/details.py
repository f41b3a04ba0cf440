"""What meshes of links lack, from a table a robot: lettering, labels, plates, seams, screws.

details/<id>.yaml has lists of them, each at a point near the surface of a link, mm in its frame,
seen from a direction. Where the surface is, is measured: they lie on it when meshes change.
"""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from solids import Array

from mrlab_ros.adapters.robots.packing.surfaces import Material, Mesh

TABLES = Path(__file__).parent / "details"
MM = 0.001
SEARCH = 0.08  # m, before and behind a stated point in which the surface is looked for


def table(name: str) -> dict[str, Any]:
    """Return the table of a model; an empty one where it has none."""
    file = TABLES / f"{name}.yaml"
    found: dict[str, Any] = yaml.safe_load(file.read_text()) if file.is_file() else {}
    return found


def digest(name: str) -> str:
    """Return the sha256 of a model's table."""
    file = TABLES / f"{name}.yaml"
    return hashlib.sha256(file.read_bytes() if file.is_file() else b"").hexdigest()


class Surface:
    """The surface of a link, of pieces of several materials: where lines meet it."""

    def __init__(self, pieces: Sequence[tuple[Material, Mesh]]) -> None:
        self.materials = [material for material, _ in pieces]
        self._triangles = np.concatenate([mesh.vertices[mesh.faces] for _, mesh in pieces])
        self._owner = np.repeat(np.arange(len(pieces)), [len(mesh.faces) for _, mesh in pieces])
        a, b, c = self._triangles.transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        self._normal = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-15)

    def seen(self, points: Array, outwards: Array) -> tuple[Array, Array, Array]:
        """Return the nearest surface on the lines through points that faces along `outwards`.

        The height of each above its point, m (NaN where there is none), its normal, (N, 3), and
        the number of its material.
        """
        right = np.cross(outwards, [0, 0, 1] if abs(outwards[2]) < 0.8 else [1.0, 0, 0])
        right /= np.linalg.norm(right)
        up = np.cross(outwards, right)
        facing = np.flatnonzero(self._normal @ outwards > 0.05)
        corners = self._triangles[facing] @ np.stack([right, up, outwards], axis=1)
        height = np.full(len(points), np.nan)
        found = np.zeros(len(points), dtype=int)
        for n, point in enumerate(points @ np.stack([right, up, outwards], axis=1)):
            flat = corners[..., :2] - point[:2]
            around = (flat.min(axis=1) <= 0).all(axis=1) & (flat.max(axis=1) >= 0).all(axis=1)
            some = np.flatnonzero(around)
            a, b, c = flat[some].transpose(1, 0, 2)
            weights = np.stack([_cross(b, c), _cross(c, a), _cross(a, b)], axis=1)
            inside = (weights >= 0).all(axis=1)
            some, weights = some[inside], weights[inside]
            total = np.maximum(weights.sum(axis=1), 1e-18)
            away = (weights * corners[some, :, 2]).sum(axis=1) / total - point[2]
            near = np.abs(away) < SEARCH
            if near.any():
                # of several the outermost: what is seen
                best = int(np.argmax(np.where(near, away, -np.inf)))
                height[n], found[n] = away[best], facing[some[best]]
        return height, self._normal[found], self._owner[found]


def _cross(a: Array, b: Array) -> Array:
    result: Array = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return result


def unit(vector: Sequence[float] | Array) -> Array:
    result: Array = np.array(vector, float)
    return result / np.linalg.norm(result)


def frame_of(outwards: Array, up: Array) -> Array:
    """Return right, up and outwards, rows; up as near to the wanted one as can be."""
    right = np.cross(up, outwards)
    if np.linalg.norm(right) < 0.1:
        right = np.cross([1.0, 0.0, 0.0] if abs(outwards[0]) < 0.9 else [0.0, 1.0, 0.0], outwards)
    right = unit(right)
    return np.stack([right, np.cross(outwards, right), outwards])
