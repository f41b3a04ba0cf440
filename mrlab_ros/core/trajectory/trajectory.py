"""A joint trajectory at a fixed frame rate: no node, no publisher, no clock.

The lab's own unit is the radian. Degrees appear in the trajectory file alone
(`mrlab_ros.core.trajectory.document`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.trajectory import gripper_states
from mrlab_ros.core.trajectory.diagnostics import (
    CHANNEL_SHAPE,
    FRAME_RATE_NOT_POSITIVE,
    OF_ANOTHER_END_EFFECTOR,
    OF_ANOTHER_MODEL,
    OF_OTHER_JOINTS,
    POSITIONS_NOT_FINITE,
    POSITIONS_SHAPE,
)

Array = NDArray[np.float64]

# A position this close to a frame, in frames, is that frame: i / f * f need not round to i.
ON_FRAME = 1e-6


@dataclass(frozen=True)
class Source:
    """The source of a trajectory: file name without folder, variable, sha256 of the file."""

    file: str
    variable: str
    sha256: str


@dataclass(frozen=True)
class Channels:
    """Derived signals of a trajectory.

    velocities: (N, J) rad/s; effort_proxy: (N, J) N*m nominal, for display only and not a
    torque.
    """

    velocities: Array
    effort_proxy: Array


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Joint positions sampled at a fixed rate, checked when made and never changed after.

    positions: (N, J) rad, columns in joint_names order, N >= 2. gripper: (N,) bool, true where
    closed, or None for an arm without one. frame_rate: Hz. owner: user whose it is, empty: the
    lab's; version: from 1; shared: everybody may see it.

    Raises BadInput when a shape, a value or the frame rate is not as said above.
    """

    id: str
    robot_model: str
    end_effector: str | None
    joint_names: tuple[str, ...]
    frame_rate: float
    positions: Array
    gripper: NDArray[np.bool_] | None
    channels: Channels
    source: Source
    created_ns: int = 0
    warnings: tuple[Diagnostic, ...] = field(default=())
    owner: str = ""
    version: int = 1
    shared: bool = True

    def __post_init__(self) -> None:
        rows, columns = self.positions.shape if self.positions.ndim == 2 else (0, 0)
        if rows < 2 or columns != len(self.joint_names):
            size, joints = size_of(self.positions.shape), len(self.joint_names)
            raise BadInput(POSITIONS_SHAPE(id=self.id, size=size, joints=joints))
        if not np.isfinite(self.positions).all():
            raise BadInput(POSITIONS_NOT_FINITE(id=self.id))
        if not (np.isfinite(self.frame_rate) and self.frame_rate > 0):
            raise BadInput(FRAME_RATE_NOT_POSITIVE(id=self.id, value=self.frame_rate))
        if self.gripper is not None and self.gripper.shape != (rows,):
            raise self._misshapen("gripper", self.gripper.shape, (rows,))
        arrays = [self.positions, *vars(self.channels).values()]
        for array in arrays:
            if array.shape != self.positions.shape:
                raise self._misshapen("derived", array.shape, self.positions.shape)
            array.setflags(write=False)
        if self.gripper is not None:
            self.gripper.setflags(write=False)

    def _misshapen(
        self, channel: str, found: tuple[int, ...], expected: tuple[int, ...]
    ) -> BadInput:
        size, wanted = size_of(found), size_of(expected)
        return BadInput(CHANNEL_SHAPE(id=self.id, channel=channel, size=size, expected=wanted))

    @cached_property
    def frame_count(self) -> int:
        return len(self.positions)

    @cached_property
    def duration(self) -> float:
        """Time of the last frame, s from the first: t_i = i / frame_rate."""
        return (self.frame_count - 1) / self.frame_rate

    def frame_at(self, position: float) -> int:
        """Return the last frame whose time is not after `position` (s).

        Before the first frame that is 0, after the last frame the last one.
        """
        frame = math.floor(position * self.frame_rate + ON_FRAME)
        return min(max(frame, 0), self.frame_count - 1)

    def at(self, position: float) -> tuple[int, Array, Array]:
        """Return the frame, the joint positions and the velocities at `position` (s).

        Positions (J,) rad and velocities (J,) rad/s are exactly the frame's values on a frame,
        linear between two frames, the first frame's before it and the last frame's after it.
        """
        frame = self.frame_at(position)
        positions, velocities = self.positions, self.channels.velocities
        share = position * self.frame_rate - frame
        if share <= ON_FRAME or frame == self.frame_count - 1:
            return frame, positions[frame], velocities[frame]
        return (
            frame,
            positions[frame] + share * (positions[frame + 1] - positions[frame]),
            velocities[frame] + share * (velocities[frame + 1] - velocities[frame]),
        )

    def accelerations(self, position: float) -> Array:
        """Return how fast the velocities change at `position` (s), (J,) rad/s^2, at rate 1.

        The difference of the velocities a frame before and after it, one-sided at the ends.
        """
        step = 1 / self.frame_rate
        first, last = max(position - step, 0.0), min(position + step, self.duration)
        change: Array = (self.at(last)[2] - self.at(first)[2]) / (last - first)
        return change

    def sample(self, position: float) -> Array:
        """Return the joint positions, (J,) rad, at `position` (s), as at() does."""
        return self.at(position)[1]

    def gripper_at(self, position: float) -> bool | None:
        """Return the gripper state at `position` (s): the last frame's, never interpolated."""
        if self.gripper is None:
            return None
        return gripper_states.state_at(self.gripper, self.frame_at(position))

    @cached_property
    def grasp_frames(self) -> tuple[tuple[int, bool], ...]:
        """Return (frame, closed) for each frame at which the gripper changes its state."""
        return () if self.gripper is None else gripper_states.changes(self.gripper)


def size_of(shape: tuple[int, ...]) -> str:
    """Return the dimensions of an array as MATLAB's whos writes them, such as 450x6."""
    return "x".join(map(str, shape))


# A model, its joints in order (empty: unknown), and an end effector (empty: none).
Arm = tuple[str, tuple[str, ...], str]


def check_fits(trajectory_id: str, made_for: Arm, robot: Arm) -> None:
    """Raise BadInput where a trajectory that was made for one arm cannot be played on another."""
    model, joints, end_effector = made_for
    found, found_joints, carried = robot
    if model != found:
        raise BadInput(OF_ANOTHER_MODEL(id=trajectory_id, made_for=model, robot_model=found))
    if joints and joints != found_joints:
        raise BadInput(OF_OTHER_JOINTS(id=trajectory_id, found=joints, expected=found_joints))
    if end_effector not in ("", carried):
        raise BadInput(
            OF_ANOTHER_END_EFFECTOR(id=trajectory_id, made_for=end_effector, carried=carried)
        )
