"""Two motions side by side: which instant of one belongs to which of the other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.geometry import Array

SAMPLES = 200  # of each motion


@dataclass(frozen=True, eq=False)
class Apart:
    """How far aligned motions are apart. most: at `row` of the first motion's samples; rms: over
    all of them."""

    most: float
    rms: float
    row: int


def sampled(times: Array, values: Array) -> tuple[Array, Array]:
    """Return SAMPLES instants, s, evenly over a motion, and its (SAMPLES, D) values there."""
    instants = np.linspace(times[0], times[-1], SAMPLES)
    columns = [np.interp(instants, times, column) for column in values.T]
    return instants, np.stack(columns, axis=1)


def aligned(first: Array, second: Array) -> NDArray[np.intp]:
    """Return the pairs (P, 2) of samples, (N, D) and (M, D), that belong together.

    Dynamic time warping (Sakoe and Chiba 1978): both begin and end together, neither goes back,
    and the sum of the squared distances is the least. Costs N x M; computed along antidiagonals.
    """
    n, m = len(first), len(second)
    cost = ((first[:, None, :] - second[None, :, :]) ** 2).sum(axis=2)
    total = np.full((n + 1, m + 1), np.inf)
    total[0, 0] = 0.0
    for diagonal in range(2, n + m + 1):
        i = np.arange(max(1, diagonal - m), min(n, diagonal - 1) + 1)
        j = diagonal - i
        before = np.minimum(np.minimum(total[i - 1, j - 1], total[i - 1, j]), total[i, j - 1])
        total[i, j] = cost[i - 1, j - 1] + before
    pairs: list[tuple[int, int]] = []
    a, b = n, m
    while a or b:
        pairs.append((a - 1, b - 1))
        steps = ((a - 1, b - 1), (a - 1, b), (a, b - 1))
        a, b = min(steps, key=lambda step: float(total[step]))
    return np.array(pairs[::-1], dtype=np.intp)


def apart(first: Array, second: Array, *, largest: bool) -> Apart:
    """Return how far samples (N, D) are from the aligned ones of (M, D).

    A sample is compared with the straight way between the samples beside its partner. largest:
    the largest of the D differences counts; else their Euclidean length.
    """
    pairs = aligned(first, second)
    distances = np.full(len(first), np.inf)
    for offset in (-1, 0):
        start = np.clip(pairs[:, 1] + offset, 0, len(second) - 1)
        end = np.clip(start + 1, 0, len(second) - 1)
        way = second[end] - second[start]
        length = np.maximum((way**2).sum(axis=1), 1e-18)
        off = first[pairs[:, 0]] - second[start]
        share = np.clip((off * way).sum(axis=1) / length, 0.0, 1.0)
        off = off - share[:, None] * way
        norms = np.abs(off).max(axis=1) if largest else np.linalg.norm(off, axis=1)
        np.minimum.at(distances, pairs[:, 0], norms)
    row = int(distances.argmax())
    return Apart(float(distances[row]), float(np.sqrt((distances**2).mean())), row)
