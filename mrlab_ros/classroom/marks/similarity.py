"""Which motions of a class are nearly the same, however they are timed.

A motion is compared by its signature: where its joints are at equal shares of their way. Delays,
pauses, another speed and another frame rate do not change it, and noise below a degree hardly. How
near is near depends on the class: where all come near one solution, only what is much nearer than
usual is named.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.base.geometry import Array

SAMPLES = 48
STEP = 0.5  # deg that some joint must have gone for the way to go on: noise is less
MOST = 0.6  # deg RMS; never called near above it
USUAL = 0.1  # of the usual distance of two motions of the class
LEAST = 0.02  # deg RMS: rounding of what is stored
BLOCK = 512
MANY = 0.2  # of a class: so many equal ones are the solution that was handed out, or an easy task


@dataclass(frozen=True)
class Group:
    """Students whose motions are nearly the same, by key in order. apart: deg RMS, the most
    between two that were found near; equal: their files are the same, byte by byte."""

    keys: tuple[str, ...]
    apart: float
    equal: bool


@dataclass(frozen=True)
class Similar:
    """Motions of a class. threshold: deg RMS, below it two motions are near; usual: the
    median distance of two. as_reference: keys of those that are near the reference."""

    groups: tuple[Group, ...] = ()
    threshold: float = 0.0
    usual: float | None = None
    as_reference: tuple[str, ...] = ()


def signature(positions: Array) -> Array:
    """Return (SAMPLES, J) deg: the joints at equal shares of their way. positions: (N, J) rad.

    The way is taken through the points at which a joint has gone STEP from the last one.
    """
    degrees = np.degrees(positions)
    kept = [0]
    block = 64  # frames that are compared at once
    start = 1
    while start < len(degrees):
        ahead = np.abs(degrees[start : start + block] - degrees[kept[-1]]).max(axis=1) >= STEP
        found = int(ahead.argmax()) if ahead.any() else -1
        if found < 0:
            start += block
            continue
        kept.append(start + found)
        start = kept[-1] + 1
    points = degrees[kept]
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    if along[-1] <= 0.0:
        resampled: Array = np.repeat(points[:1], SAMPLES, axis=0)
    else:
        at = np.linspace(0.0, along[-1], SAMPLES)
        resampled = np.stack(
            [np.interp(at, along, points[:, j]) for j in range(points.shape[1])], axis=1
        )
    rounded: Array = resampled.round(3)
    return rounded


def similar(
    signatures: Mapping[str, Sequence[Sequence[float]]],
    digests: Mapping[str, str],
    reference: Sequence[Sequence[float]] = (),
) -> Similar:
    """Return which motions are nearly the same.

    signatures: by student, of motions that were found. digests: sha256 of the files, by student.
    The cost grows with the square of the class, in a product of matrices: 10,000 take seconds.
    """
    keys = sorted(key for key, rows in signatures.items() if len(rows) == SAMPLES)
    by_joints: dict[int, list[str]] = {}
    for key in keys:
        by_joints.setdefault(len(signatures[key][0]), []).append(key)
    near: list[tuple[str, str, float]] = []
    usual_of: list[float] = []
    widest = 0.0
    as_reference: list[str] = []
    for joints, members in sorted(by_joints.items()):
        rows = np.array([signatures[key] for key in members]).reshape(len(members), -1)
        usual = _usual(rows, joints)
        if usual is not None:
            usual_of.append(usual)
        limit = _limit(usual)
        widest = max(widest, limit)
        own = np.array(reference, dtype=float).reshape(-1)
        away = np.full(len(members), np.inf)
        if own.size == rows.shape[1]:
            away = np.sqrt(((rows - own) ** 2).mean(axis=1))
            as_reference += [k for k, d in zip(members, away, strict=True) if d <= limit]
        for i, j, apart in _near(rows, limit):
            if away[i] > limit or away[j] > limit:
                near.append((members[i], members[j], apart))
    equal = _equal(digests, len(signatures), set(as_reference))
    groups = _groups(near, equal, digests)
    return Similar(groups, widest, max(usual_of, default=None), tuple(sorted(as_reference)))


def distances(
    signatures: Mapping[str, Sequence[Sequence[float]]], keys: Sequence[str]
) -> list[list[float | None]]:
    """Return how far each of `keys` is from those before it, deg RMS; None: their motions cannot
    be compared."""
    rows = [np.array(signatures.get(key, ()), dtype=float) for key in keys]
    return [
        [
            round(float(np.sqrt(((one - other) ** 2).mean())), 4)
            if one.size and one.shape == other.shape
            else None
            for other in rows[:place]
        ]
        for place, one in enumerate(rows)
    ]


def _limit(usual: float | None) -> float:
    return MOST if usual is None else max(min(MOST, USUAL * usual), LEAST)


def _usual(rows: Array, joints: int) -> float | None:
    """Return the median distance of two motions, deg RMS; None: there are too few to know.

    Of a large class, each with some others: the same ones every time.
    """
    count = len(rows)
    if count < 4:
        return None
    offsets = range(1, count) if count <= 200 else range(1, count, max(1, count // 50))
    distances = [
        np.sqrt(((rows - np.roll(rows, -offset, axis=0)) ** 2).mean(axis=1)) for offset in offsets
    ]
    return float(np.median(np.concatenate(distances)))


def _near(rows: Array, limit: float) -> list[tuple[int, int, float]]:
    """Return the pairs that are nearer than `limit` deg RMS: first roughly, in blocks of float32,
    then exactly."""
    centred = (rows - rows.mean(axis=0)).astype(np.float32)
    norms = (centred**2).sum(axis=1)
    size = rows.shape[1]
    slack = size * limit**2 + 1e-5 * float(norms.max(initial=0.0)) + 1.0
    found = []
    for start in range(0, len(rows), BLOCK):
        block = centred[start : start + BLOCK]
        squares = norms[start : start + BLOCK, None] + norms[None, start:]
        squares -= 2.0 * (block @ centred[start:].T)
        for i, j in np.argwhere(squares <= slack):
            first, second = start + int(i), start + int(j)
            if first >= second:
                continue
            apart = float(np.sqrt(((rows[first] - rows[second]) ** 2).mean()))
            if apart <= limit:
                found.append((first, second, apart))
    return found


def _equal(digests: Mapping[str, str], size: int, left_out: set[str]) -> list[tuple[str, str]]:
    """Return pairs of students whose files are the same; not where much of the class has them."""
    counts = Counter(digests.values())
    first: dict[str, str] = {}
    pairs = []
    for key in sorted(digests):
        found = digests[key]
        if not found or key in left_out or counts[found] < 2:
            continue
        if counts[found] > max(3, MANY * size):
            continue
        if found in first:
            pairs.append((first[found], key))
        else:
            first[found] = key
    return pairs


def _groups(
    near: Sequence[tuple[str, str, float]],
    equal: Sequence[tuple[str, str]],
    digests: Mapping[str, str],
) -> tuple[Group, ...]:
    """Return the students that pairs connect, the nearest groups first."""
    parent: dict[str, str] = {}

    def root(key: str) -> str:
        while parent.setdefault(key, key) != key:
            parent[key] = parent[parent[key]]
            key = parent[key]
        return key

    for one, other in [(a, b) for a, b, _ in near] + list(equal):
        parent[max(root(one), root(other))] = min(root(one), root(other))
    members: dict[str, list[str]] = {}
    for key in sorted(parent):
        members.setdefault(root(key), []).append(key)
    apart: dict[str, float] = {}
    for one, _, distance in near:
        apart[root(one)] = max(apart.get(root(one), 0.0), distance)
    groups = [
        Group(
            tuple(keys),
            round(apart.get(first, 0.0), 4),
            len({digests.get(key, key) for key in keys}) == 1,
        )
        for first, keys in members.items()
        if len(keys) > 1
    ]
    return tuple(sorted(groups, key=lambda g: (not g.equal, g.apart, g.keys)))
