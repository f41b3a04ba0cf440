"""Forward kinematics of a serial chain, for one pose or for many at once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mrlab_ros.core.errors import Misuse
from mrlab_ros.core.geometry import Array


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

    def tool0(self, positions: Array) -> Array:
        """Return T_base_tip of the chain's last link, (..., 4, 4), for positions (..., J)."""
        return self._poses(positions, last_only=True)[-1]

    def links(self, positions: Array) -> dict[str, Array]:
        """Return T_base_link, (..., 4, 4), of every link for positions (..., J)."""
        return dict(zip(self.link_names, self._poses(positions, last_only=False), strict=True))

    def _poses(self, positions: Array, *, last_only: bool) -> list[Array]:
        positions = np.asarray(positions, dtype=np.float64)
        if positions.ndim == 0 or positions.shape[-1] != self.joint_count:
            raise Misuse(
                f"the positions have shape {positions.shape}; expected (..., {self.joint_count}), "
                "one value a moving joint"
            )
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
