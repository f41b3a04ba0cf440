"""Rigid-body geometry: poses, unit quaternions and homogeneous transforms.

Quaternions are (x, y, z, w), as in geometry_msgs. Transforms are (4, 4) matrices T_parent_child
that map coordinates in the child frame to the parent frame. Lengths are in m, angles in rad.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostics import BAD_QUATERNION, BAD_VECTOR, POSE_NOT_FINITE
from mrlab_ros.core.base.errors import BadInput

Array = NDArray[np.float64]
Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

# Objects and robots are at most this far from the origin along each axis, m.
WORLD_SIZE = 100.0


@dataclass(frozen=True)
class Pose:
    """Position in m and orientation as a unit quaternion; raises BadInput where it is not one.

    The frame is `world` unless the owner of the pose says otherwise.
    """

    position: Vector = (0.0, 0.0, 0.0)
    orientation: Quaternion = (0.0, 0.0, 0.0, 1.0)

    def __post_init__(self) -> None:
        if not all(map(math.isfinite, self.position + self.orientation)):
            raise BadInput(POSE_NOT_FINITE(found=[*self.position, *self.orientation]))
        norm = math.hypot(*self.orientation)
        if abs(norm - 1) > 0.01:
            raise BadInput(BAD_QUATERNION(found=[*self.orientation], length=norm))


def transform_from_xyz_rpy(xyz: Sequence[float], rpy: Sequence[float]) -> Array:
    """Return the (4, 4) transform of a URDF origin: xyz in m, fixed-axis rpy in rad.

    R = Rz(yaw) Ry(pitch) Rx(roll), as the URDF specification defines it.
    """
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, xyz[0]],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, xyz[1]],
            [-sp, cp * sr, cp * cr, xyz[2]],
            [0.0, 0.0, 0.0, 1.0],
        ]
    )


def inverse_transform(pose: Array) -> Array:
    """Return the inverse of rigid transforms (..., 4, 4)."""
    result = np.zeros_like(pose)
    rotation = np.swapaxes(pose[..., :3, :3], -1, -2)
    result[..., :3, :3] = rotation
    result[..., :3, 3] = -(rotation @ pose[..., :3, 3:])[..., 0]
    result[..., 3, 3] = 1.0
    return result


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Return the quaternion of fixed-axis roll, pitch and yaw, rad, as URDF defines them."""
    (cr, cp, cy), (sr, sp, sy) = (
        [f(angle / 2) for angle in (roll, pitch, yaw)] for f in (math.cos, math.sin)
    )
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def pose_from_transform(transform: Array) -> Pose:
    """Return a (4, 4) homogeneous transform as a pose.

    The quaternion is computed by Shepperd's method (J. Guidance and Control 1, 1978): the
    largest of the four components is found first, so that no small number divides.
    """
    m = transform
    choices = np.array([m[0, 0], m[1, 1], m[2, 2], m[0, 0] + m[1, 1] + m[2, 2]])
    k = int(choices.argmax())
    q = np.empty(4)
    if k == 3:
        q[:] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], 1 + choices[3]
    else:
        i, j = (k + 1) % 3, (k + 2) % 3
        q[k] = 1 + m[k, k] - m[i, i] - m[j, j]
        q[i], q[j] = m[i, k] + m[k, i], m[j, k] + m[k, j]
        q[3] = m[j, i] - m[i, j]
    q /= np.linalg.norm(q)
    x, y, z = (float(v) for v in m[:3, 3])
    return Pose((x, y, z), (float(q[0]), float(q[1]), float(q[2]), float(q[3])))


def checked_vector(values: Sequence[float], what: str, limit: float = 1000.0) -> Vector:
    """Return three finite numbers inside +-limit; raise BadInput otherwise.

    what: position, velocity or angular_velocity.
    """
    if len(values) != 3 or not all(abs(v) <= limit for v in values):
        raise BadInput(BAD_VECTOR(what=what, found=[*values], limit=limit))
    x, y, z = values
    return (float(x), float(y), float(z))


def add(a: Vector, b: Vector) -> Vector:
    """Return the sum of two vectors."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a: Vector, b: Vector) -> Vector:
    """Return `a` minus `b`."""
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a: Vector, factor: float) -> Vector:
    """Return a vector times a factor."""
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def dot(a: Vector, b: Vector) -> float:
    """Return the scalar product of two vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product a x b, right-handed."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def rotate(q: Quaternion, v: Vector) -> Vector:
    """Return `v` rotated by `q`."""
    axis = (q[0], q[1], q[2])
    t = scale(cross(axis, v), 2.0)
    return add(add(v, scale(t, q[3])), cross(axis, t))


def rotation(q: Quaternion) -> Array:
    """Return the (3, 3) matrix that rotates as `q` does."""
    return np.column_stack([rotate(q, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))])


def multiply(a: Quaternion, b: Quaternion) -> Quaternion:
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
    """Return the inverse of the rotation `q`."""
    return (-q[0], -q[1], -q[2], q[3])


def normalized(q: Quaternion) -> Quaternion:
    """Return `q` scaled to length 1."""
    norm = math.hypot(*q)
    return (q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm)


def compose(a: Pose, b: Pose) -> Pose:
    """Return the pose `b`, given in the frame `a`, in the parent frame of `a`: T_a * T_b."""
    return Pose(
        add(a.position, rotate(a.orientation, b.position)),
        normalized(multiply(a.orientation, b.orientation)),
    )


def inverse(a: Pose) -> Pose:
    """Return the pose of the parent frame in the frame `a`."""
    q = conjugate(a.orientation)
    return Pose(rotate(q, scale(a.position, -1.0)), q)


def relative(a: Pose, b: Pose) -> Pose:
    """Return `b` in the frame `a`; both are given in the same parent frame."""
    return compose(inverse(a), b)


def pose_between(a: Pose, b: Pose, share: float) -> Pose:
    """Return the pose at `share` (0 to 1) of the straight way from `a` to `b`; turns are short."""
    sign = (
        1.0 if sum(x * y for x, y in zip(a.orientation, b.orientation, strict=True)) >= 0 else -1.0
    )
    x, y, z, w = (
        p + share * (sign * q - p) for p, q in zip(a.orientation, b.orientation, strict=True)
    )
    position = add(a.position, scale(subtract(b.position, a.position), share))
    return Pose(position, normalized((x, y, z, w)))
