"""Turns points at times of their own into frames at an even rate."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.trajectory.trajectory import Array

Nanoseconds = NDArray[np.int64]
# ns; how far a point may lie from a frame and be that frame: both are rounded to whole ns
SAME_TIME_NS = 1


def even_rate(times_ns: Nanoseconds) -> float | None:
    """Return the rate, Hz, of points in even steps, None where their steps differ.

    times_ns: (K,), strictly rising. Even means that each point is within a nanosecond or two of
    where the rate puts it, which is how finely a message can say it.
    """
    elapsed = times_ns - times_ns[0]
    rate = (len(elapsed) - 1) * 1e9 / float(elapsed[-1])
    if abs(rate - round(rate)) < 1e-6 * rate:
        rate = float(round(rate))
    expected = np.arange(len(elapsed)) * (1e9 / rate)
    return rate if np.abs(elapsed - expected).max() <= 2 * SAME_TIME_NS else None


def frame_count(times_ns: Nanoseconds, rate: float) -> int:
    """Return how many frames at `rate` Hz reach from the first point to the last or just past."""
    duration = (int(times_ns[-1]) - int(times_ns[0]) - SAME_TIME_NS) * 1e-9
    return int(np.ceil(duration * rate)) + 1


def _segments(times_ns: Nanoseconds, rate: float) -> tuple[NDArray[np.intp], Array]:
    """Return for each frame the point that it follows, and the time since that point, s.

    A frame within SAME_TIME_NS of a point follows that point by 0; frames past the last point
    are at the last point.
    """
    frames = np.arange(frame_count(times_ns, rate))
    at_ns = np.minimum(np.rint(frames * (1e9 / rate)).astype(np.int64) + times_ns[0], times_ns[-1])
    follows = np.searchsorted(times_ns, at_ns + SAME_TIME_NS, side="right") - 1
    since_ns = at_ns - times_ns[follows]
    since_ns[np.abs(since_ns) <= SAME_TIME_NS] = 0
    return follows, since_ns * 1e-9


def resample(
    times_ns: Nanoseconds, positions: Array, velocities: Array | None, rate: float
) -> Array:
    """Return the positions, (N, J), at every 1 / rate s from the first point on.

    times_ns: (K,), strictly rising; positions: (K, J); velocities: (K, J) in the positions' unit
    a second, or None. Straight lines between points, or cubic Hermite splines where there are
    velocities. A frame at a point has exactly the point's positions; the last frame has those of
    the last point, which lies less than 1 / rate s before it.
    """
    follows, since = _segments(times_ns, rate)
    frames = positions[follows]
    between = np.flatnonzero(since)
    start = follows[between]
    step = (np.diff(times_ns) * 1e-9)[start, np.newaxis]
    s = since[between, np.newaxis] / step
    p0, p1 = positions[start], positions[start + 1]
    if velocities is None:
        frames[between] = p0 + s * (p1 - p0)
        return frames
    # Hermite's cubic: p(0) = p0, p(1) = p1, p'(0) = m0, p'(1) = m1
    m0, m1 = velocities[start] * step, velocities[start + 1] * step
    a, b = 2 * (p0 - p1) + m0 + m1, 3 * (p1 - p0) - 2 * m0 - m1
    frames[between] = ((a * s + b) * s + m0) * s + p0
    return frames


def hold(times_ns: Nanoseconds, states: NDArray[np.bool_], rate: float) -> NDArray[np.bool_]:
    """Return the states, (N,), at every 1 / rate s: each stays until the next point."""
    return states[_segments(times_ns, rate)[0]]
