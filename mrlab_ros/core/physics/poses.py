"""Poses as position (x, y, z) in m and unit quaternion (x, y, z, w)."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mrlab_ros.core.errors import BadInput
from mrlab_ros.core.scene import Pose

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


def checked_vector(values: Sequence[float], what: str, limit: float = 1000.0) -> Vector:
    """Return three finite numbers inside +-limit; raise BadInput otherwise."""
    if len(values) != 3 or not all(abs(v) <= limit for v in values):
        raise BadInput(
            f"{what} is {tuple(values)}; expected three finite numbers within +-{limit:g}"
        )
    x, y, z = values
    return (float(x), float(y), float(z))


def add(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a: Vector, factor: float) -> Vector:
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def turned(q: Quaternion, v: Vector) -> Vector:
    """Return `v` rotated by `q`."""
    axis = (q[0], q[1], q[2])
    t = scale(cross(axis, v), 2.0)
    return add(add(v, scale(t, q[3])), cross(axis, t))


def times(a: Quaternion, b: Quaternion) -> Quaternion:
    """Return the rotation b followed by a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def conjugate(q: Quaternion) -> Quaternion:
    return (-q[0], -q[1], -q[2], q[3])


def unit(q: Quaternion) -> Quaternion:
    norm = math.hypot(*q)
    return (q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm)


def compose(a: Pose, b: Pose) -> Pose:
    """Return T_a_b seen from where `a` is given: a then b in a's frame."""
    return Pose(
        add(a.position, turned(a.orientation, b.position)),
        unit(times(a.orientation, b.orientation)),
    )


def inverse(a: Pose) -> Pose:
    q = conjugate(a.orientation)
    return Pose(turned(q, scale(a.position, -1.0)), q)


def relative(a: Pose, b: Pose) -> Pose:
    """Return `b` in the frame `a`, both given in one frame."""
    return compose(inverse(a), b)
