"""The record of what one matrix of a file is; `survey` fills it, the other modules read it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.candidates import Candidate
from mrlab_ros.core.conversion.evidence.cartesian import PoseEvidence
from mrlab_ros.core.conversion.evidence.clock_columns import ClockColumn
from mrlab_ros.core.conversion.evidence.names import Name
from mrlab_ros.core.conversion.evidence.relations import PoseMatch
from mrlab_ros.core.conversion.evidence.unit_range import UnitEvidence
from mrlab_ros.core.conversion.gripper import has_states
from mrlab_ros.core.conversion.preview import preview
from mrlab_ros.core.conversion.workspace import Variable
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

RADIANS, NO_POSES = UnitEvidence("rad"), PoseEvidence()


@dataclass(frozen=True, eq=False)
class Assessment:
    """What one matrix is, as far as its numbers, its name and its company say.

    low, high: (C,) range of each column, NaN where it is not finite. clocks: columns that count
    time. fits: it has one column a joint, or one more with a gripper. unit: of its first J
    columns. unfilled: first and last row, from 1, of zeros that were never filled. coarse: its
    rows are waypoints. between_zeros: it begins and ends at 0, as velocities do. poses: what
    speaks for poses. velocity_of: the matrix whose derivative it is. rates: Hz, those at which
    other matrices are its derivatives, with their paths. tool_of: the matrix at whose joint
    positions its points are the tool's. tool_path: the matrix of poses that agrees with it.
    other_tool_path: one that claims to be the tool's path and does not agree, with how far it is
    away. twin: the same motion, measured or commanded. copies: the matrices with the same
    numbers. objections: why it is no joint positions. doubts: what a person should check.
    reasons: what its points were made from; points: 0 to about 1.5, larger is likelier.
    """

    variable: Variable
    name: Name
    low: Array
    high: Array
    finite: bool
    fits: bool
    by_name: bool
    clocks: tuple[ClockColumn, ...] = ()
    unit: UnitEvidence = RADIANS
    unfilled: tuple[int, int] | None = None
    coarse: bool = False
    still: bool = False
    between_zeros: bool = False
    smooth: bool | None = None
    last_is_joint: bool = False
    poses: PoseEvidence = NO_POSES
    velocity_of: str = ""
    is_acceleration: bool = False
    rates: tuple[tuple[str, float], ...] = ()
    tool_of: str = ""
    tool_path: str = ""
    other_tool_path: tuple[str, PoseMatch] | None = None
    twin: str = ""
    copies: tuple[str, ...] = ()
    objections: tuple[Diagnostic, ...] = ()
    doubts: tuple[Diagnostic, ...] = ()
    reasons: tuple[Diagnostic, ...] = ()
    points: float = 0.0

    @property
    def score(self) -> float:
        """Return how much it is like joint positions, 0 to 1."""
        return round(min(max(self.points, 0.0), 1.0), 3)

    @property
    def path(self) -> str:
        return self.variable.path

    @property
    def values(self) -> NDArray[Any]:
        assert self.variable.values is not None
        return self.variable.values

    @property
    def rows(self) -> int:
        return self.variable.shape[0]

    @property
    def columns(self) -> int:
        return self.variable.shape[1]

    @property
    def confirmed(self) -> bool:
        """Say whether something beside its name shows that it holds joint positions."""
        return bool(self.tool_path) or self.by_name or self.variable.is_message

    def candidate(self) -> Candidate:
        """Return what a person can choose."""
        ends = np.array([self.low, self.high])
        ends = ends[:, np.isfinite(ends).all(axis=0)]
        return Candidate(
            self.path,
            self.variable.shape,
            self.score,
            (*self.reasons, *self.doubts, *self.objections),
            float(ends[0].min()) if ends.size else math.nan,
            float(ends[1].max()) if ends.size else math.nan,
            preview(self.variable),
        )


def blocking_clocks(assessment: Assessment, robot: RobotModel) -> tuple[ClockColumn, ...]:
    """Return the columns of time that keep a matrix from being taken as it is.

    A column that only may be time blocks where the joints are complete without it and where the
    last column does not open and close a gripper: then the time is a column too many.
    """
    joints = len(robot.joints)
    if assessment.by_name or assessment.variable.is_message:
        return ()
    clocks = tuple(c for c in assessment.clocks if c.likely)
    certain = tuple(c for c in assessment.clocks if c.certain)
    if certain or assessment.columns == joints:
        return certain
    if assessment.columns == joints + 1:
        last = assessment.values[:, joints]
        grips = has_states(last) and float(last.min()) < float(last.max())
        return () if grips else clocks
    return clocks
