"""A robot model: joints, limits, home pose and forward kinematics of its serial chain."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mrlab_ros.core.base.errors import Misuse
from mrlab_ros.core.base.geometry import Array, Pose, Quaternion, Vector, pose_from_transform
from mrlab_ros.core.robots.diagnostics import POSITION_COUNT


@dataclass(frozen=True)
class Joint:
    """One moving joint: limits in rad (m where prismatic), rad/s, N*m or None if unknown."""

    name: str
    lower: float
    upper: float
    max_velocity: float
    max_effort: float | None = None


@dataclass(frozen=True, eq=False)
class RobotModel:
    """A robot model of the library.

    home: (J,) rad, in joint order. payload: kg. reach: m, as its vendor defines it. chain leads
    from base_link through all joints to tool0. others: ids of the other robots of its library.
    """

    id: str
    manufacturer: str
    product: str
    robot_class: str
    payload: float
    reach: float
    joints: tuple[Joint, ...]
    home: Array
    chain: KinematicChain
    others: tuple[str, ...] = ()

    @cached_property
    def joint_names(self) -> tuple[str, ...]:
        return tuple(joint.name for joint in self.joints)


def _frame_with_z_along(axis: Array) -> Array:
    """Return a rotation (4, 4) whose z column is `axis`; exact for a coordinate axis."""
    helper = np.eye(3)[int(np.argmin(np.abs(axis)))]
    x = np.cross(helper, axis)
    x /= np.linalg.norm(x)
    frame = np.eye(4)
    frame[:3, :3] = np.column_stack([x, np.cross(axis, x), axis])
    return frame


@dataclass(frozen=True, eq=False)
class Segment:
    """One joint and the link behind it.

    T_parent_joint: (4, 4), the joint's frame in the parent link's at position 0. axis: (3,) unit
    vector in the joint's frame, None where the joint is fixed. prismatic: the position is a way
    in m along the axis instead of an angle in rad about it.
    """

    link: str
    T_parent_joint: Array
    axis: Array | None = None
    prismatic: bool = False


@dataclass(frozen=True, eq=False)
class KinematicChain:
    """A chain of segments from `base` to the link of the last one.

    Positions are (..., J) in the order of the moving segments; every leading shape is kept, so
    one pose (J,) and a batch (N, J) go through the same call.
    """

    base: str
    segments: tuple[Segment, ...]

    @cached_property
    def joint_count(self) -> int:
        return sum(segment.axis is not None for segment in self.segments)

    @cached_property
    def link_names(self) -> tuple[str, ...]:
        return (self.base, *(segment.link for segment in self.segments))

    @cached_property
    def _aligned(self) -> tuple[tuple[Array, Array], ...]:
        """Each segment with its joint's axis turned onto z: (before the joint, after it)."""
        pairs = []
        for segment in self.segments:
            turn = np.eye(4) if segment.axis is None else _frame_with_z_along(segment.axis)
            pairs.append((segment.T_parent_joint @ turn, turn.T))
        return tuple(pairs)

    @cached_property
    def _steps(self) -> tuple[tuple[Vector, Quaternion, bool], ...]:
        """The transform before each moving joint, its axis on z, and whether it is prismatic.

        A last step, which moves nothing, leads to the tip.
        """
        steps: list[tuple[Vector, Quaternion, bool]] = []
        pending = np.eye(4)
        for segment, (before, after) in zip(self.segments, self._aligned, strict=True):
            pending = pending @ before
            if segment.axis is not None:
                pose = pose_from_transform(pending)
                steps.append((pose.position, pose.orientation, segment.prismatic))
                pending = after
        pose = pose_from_transform(pending)
        return (*steps, (pose.position, pose.orientation, True))

    def tip(self, positions: Sequence[float]) -> Pose:
        """Return the pose of the chain's last link in `base`, for one position a moving joint.

        As tool0(), but without numpy, whose calls take longer than one pose.
        """
        if len(positions) != self.joint_count:
            raise Misuse(POSITION_COUNT(count=len(positions), joints=self.joint_count))
        x = y = z = qx = qy = qz = 0.0
        qw = 1.0
        for ((px, py, pz), (ax, ay, az, aw), prismatic), value in zip(
            self._steps, (*positions, 0.0), strict=True
        ):
            tx, ty, tz = 2 * (qy * pz - qz * py), 2 * (qz * px - qx * pz), 2 * (qx * py - qy * px)
            x += px + qw * tx + qy * tz - qz * ty
            y += py + qw * ty + qz * tx - qx * tz
            z += pz + qw * tz + qx * ty - qy * tx
            qx, qy, qz, qw = (
                qw * ax + qx * aw + qy * az - qz * ay,
                qw * ay - qx * az + qy * aw + qz * ax,
                qw * az + qx * ay - qy * ax + qz * aw,
                qw * aw - qx * ax - qy * ay - qz * az,
            )
            if prismatic:
                x += 2 * (qx * qz + qw * qy) * value
                y += 2 * (qy * qz - qw * qx) * value
                z += (1 - 2 * (qx * qx + qy * qy)) * value
            else:
                s, c = math.sin(value / 2), math.cos(value / 2)
                qx, qy, qz, qw = qx * c + qy * s, qy * c - qx * s, qz * c + qw * s, qw * c - qz * s
        norm = math.copysign(math.hypot(qx, qy, qz, qw), max(qx, qy, qz, qw, key=abs))
        return Pose((x, y, z), (qx / norm, qy / norm, qz / norm, qw / norm))

    def tool0(self, positions: Array) -> Array:
        """Return T_base_tip of the chain's last link, (..., 4, 4), for positions (..., J)."""
        return self._poses(positions, last_only=True)[-1]

    def links(self, positions: Array) -> dict[str, Array]:
        """Return T_base_link, (..., 4, 4), of every link for positions (..., J)."""
        return dict(zip(self.link_names, self._poses(positions, last_only=False), strict=True))

    def _poses(self, positions: Array, *, last_only: bool) -> list[Array]:
        positions = np.asarray(positions, dtype=np.float64)
        if positions.ndim == 0 or positions.shape[-1] != self.joint_count:
            count = positions.shape[-1] if positions.ndim else 1
            raise Misuse(POSITION_COUNT(count=count, joints=self.joint_count))
        shape = positions.shape[:-1]
        columns = positions.reshape(int(np.prod(shape)), self.joint_count).T
        count = columns.shape[1]
        # Component-major, so that each step is one matrix product and a few row operations.
        pose = np.zeros((3, 4, count))
        for i in range(3):
            pose[i, i] = 1.0
        poses = [] if last_only else [_pose_major(pose, shape)]
        pending = np.eye(4)
        joint = 0
        for segment, (before, after) in zip(self.segments, self._aligned, strict=True):
            pending = pending @ before
            if segment.axis is not None:
                pose = np.matmul(pending.T, pose)
                pending = after
                if segment.prismatic:
                    pose[:, 3] += columns[joint] * pose[:, 2]
                else:
                    cos, sin = np.cos(columns[joint]), np.sin(columns[joint])
                    x, y = pose[:, 0], pose[:, 1]
                    pose[:, 0], pose[:, 1] = cos * x + sin * y, cos * y - sin * x
                joint += 1
            if not last_only:
                poses.append(_pose_major(np.matmul(pending.T, pose), shape))
        if last_only:
            poses.append(_pose_major(np.matmul(pending.T, pose), shape))
        return poses


def _pose_major(pose: Array, shape: tuple[int, ...]) -> Array:
    """Turn component-major (3, 4, N) into (*shape, 4, 4)."""
    result = np.zeros((pose.shape[2], 4, 4))
    result[:, :3] = pose.transpose(2, 0, 1)
    result[:, 3, 3] = 1.0
    return result.reshape(*shape, 4, 4)


@dataclass(frozen=True)
class ShownJoint:
    """A moving joint. kind: revolute, continuous or prismatic; limits rad or m, None: no limit."""

    name: str
    kind: str
    lower: float | None
    upper: float | None
    velocity: float | None


@dataclass(frozen=True)
class ShownRobot:
    """A robot to draw. urdf: with package:// URIs, its end effector included. product: its name
    for people; empty: none is known."""

    model: str
    end_effector: str
    urdf: str
    joints: tuple[ShownJoint, ...]
    product: str = ""
