"""Finds drums about a joint's axis in a casting, and makes them exactly round."""

from __future__ import annotations

import numpy as np
from solids import Array, Solid

STATION = 0.004  # m, between the places along an axis at which drums are looked for
DRUM_VOTES = 0.3  # of the directions in which the surface must lie at a drum's radius
DRUM_SHARE, DRUM_OFF = 0.014, (0.004, 0.010)  # of the size; m: what counts as the drum's surface


def turned_true(body: Solid, pose: Array) -> Solid:
    """Return the body with exact drums about the z axis of `pose` where it has nearly such."""
    middle, turn = pose[:3, 3], pose[:3, :3]
    corners = np.array(np.meshgrid(*zip(body.low, body.high, strict=True))).reshape(3, -1).T
    span = (corners - middle) @ turn
    tolerance = float(np.clip((body.high - body.low).max() * DRUM_SHARE, *DRUM_OFF))
    stations = np.arange(span[:, 2].min() + STATION / 2, span[:, 2].max(), STATION)
    radii = np.arange(0.015, float(np.hypot(span[:, 0], span[:, 1]).max()), STATION)
    angle = np.arange(0, 2 * np.pi, np.radians(5))
    s, a, r = np.meshgrid(stations, angle, radii, indexing="ij")
    grid = np.stack([r * np.cos(a), r * np.sin(a), s], axis=-1).reshape(-1, 3)
    values = body.distance(grid @ turn.T + middle).reshape(s.shape)
    leaves = (values[:, :, :-1] < 0) & (values[:, :, 1:] >= 0)
    share = values[:, :, :-1] / (values[:, :, :-1] - values[:, :, 1:] + 1e-12)
    crossing = np.where(leaves, radii[:-1] + np.clip(share, 0, 1) * STATION, np.nan)
    drums: list[tuple[float, float, float]] = []
    tries = np.arange(radii[0], radii[-1], 0.001)
    for station, found in zip(stations, crossing, strict=True):
        flat = np.sort(found[np.isfinite(found)])
        votes = np.searchsorted(flat, tries + 0.002) - np.searchsorted(flat, tries - 0.002)
        if not len(flat) or votes.max() < DRUM_VOTES * len(angle):
            continue
        best = tries[votes.argmax()]
        radius = float(np.median(flat[np.abs(flat - best) < 0.003]))
        if drums and station - drums[-1][1] < 1.1 * STATION and abs(radius - drums[-1][2]) < 0.002:
            first, _, before = drums[-1]
            drums[-1] = (first, station, 0.7 * before + 0.3 * radius)
        else:
            drums.append((station, station, radius))
    drums = [drum for drum in drums if drum[1] - drum[0] > 2.5 * STATION]

    def distance(p: Array) -> Array:
        d = body.distance(p)
        q = (p - middle) @ turn
        across = np.hypot(q[:, 0], q[:, 1])
        for first, last, radius in drums:
            within = (q[:, 2] > first - STATION / 2) & (q[:, 2] < last + STATION / 2)
            some = np.flatnonzero(within & (np.abs(across - radius) < 2 * tolerance))
            off = across[some] - radius
            weight = np.clip(2 - 2 * np.abs(off - d[some]) / tolerance, 0, 1)
            d[some] += weight * weight * (3 - 2 * weight) * (off - d[some])
        return d

    return Solid(distance, body.low, body.high)
