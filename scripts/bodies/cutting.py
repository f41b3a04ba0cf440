"""Cuts triangle meshes along lines on their surface: where a value given at the vertices is 0."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from solids import Array

from mrlab_ros.adapters.robots.packing.surfaces import Faces

Mask = NDArray[np.bool_]
SNAP = 1e-4  # m; a vertex as near to the line lies on it: no slivers


def cut(rows: Array, faces: Faces, height: Array, within: Mask) -> tuple[Array, Faces, Faces]:
    """Return rows and faces with the faces of `within` cut where `height` is 0, and their origin.

    rows: (V, K), the place in the first three columns, m; what follows is interpolated.
    height: (V,), m. within: (F,). The third value is the face that each face was a part of.
    Neighbours of a face that is cut are cut at the same points, so no gap opens.
    """
    _, first, place = np.unique(
        np.round(rows[:, :3], 6), axis=0, return_index=True, return_inverse=True
    )
    place = place.ravel()
    level = height[first]
    level = np.where(np.abs(level) < SNAP, 0.0, level)
    ends = np.sort(place[faces[:, [[0, 1], [1, 2], [2, 0]]]], axis=2)  # (F, 3, 2)
    key = ends[..., 0] * len(first) + ends[..., 1]
    crossed = level[ends[..., 0]] * level[ends[..., 1]] < 0
    cuts = np.unique(key[crossed & within[:, None]])
    hit = np.isin(key, cuts)
    touched = np.flatnonzero(hit.any(axis=1))
    fresh: dict[tuple[int, int], int] = {}
    made: list[tuple[int, int, float]] = []
    pieces: list[list[int]] = []
    origin: list[int] = []

    def between(a: int, b: int) -> int:
        a, b = min(a, b), max(a, b)
        if (a, b) not in fresh:
            fresh[a, b] = len(rows) + len(made)
            low, high = level[place[a]], level[place[b]]
            made.append((a, b, float(low / (low - high))))
        return fresh[a, b]

    for number in touched.tolist():
        face = faces[number].tolist()
        ring: list[int] = []
        new: list[int] = []
        for n in range(3):
            ring.append(face[n])
            if hit[number, n]:
                new.append(len(ring))
                ring.append(between(face[n], face[(n + 1) % 3]))
        ring = ring[new[0] :] + ring[: new[0]]
        fan = [[ring[0], ring[n], ring[n + 1]] for n in range(1, len(ring) - 1)]
        pieces += fan
        origin += [number] * len(fan)
    if not made:
        return rows, faces, np.arange(len(faces))
    a, b = np.array([one[:2] for one in made]).T
    share = np.array([one[2] for one in made])[:, None]
    kept = np.flatnonzero(~hit.any(axis=1))
    return (
        np.concatenate([rows, rows[a] * (1 - share) + rows[b] * share]),
        np.concatenate([faces[kept], np.array(pieces, dtype=np.int64)]),
        np.concatenate([kept, np.array(origin, dtype=np.int64)]),
    )
