"""The record of what one matrix of a file is, with its score, its objections and its doubts."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.candidates import Candidate, preview
from mrlab_ros.core.conversion.diagnostics import (
    DERIVATIVE_OF,
    FEW_ROWS_ONLY,
    HAS_DERIVATIVE,
    LIKE_POSES,
    MAY_BE_POSES,
    MAY_BE_TIME,
    SEEN,
    TOOL_OF,
    TOOL_PATH,
)
from mrlab_ros.core.conversion.evidence.headings import said_by_units
from mrlab_ros.core.conversion.evidence.names import Hint, Name, describe
from mrlab_ros.core.conversion.evidence.other_columns import ClockColumn, has_states
from mrlab_ros.core.conversion.evidence.relations import PoseEvidence, PoseMatch
from mrlab_ros.core.conversion.evidence.unit_range import UnitEvidence
from mrlab_ros.core.conversion.workspace import Variable
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

NEAR_ZERO = 0.02  # of the range of a column
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


NAME_SCORES = {
    Hint.POSITIONS: 0.3,
    Hint.PARTLY: 0.2,
    Hint.NEUTRAL: 0.0,
    Hint.TWO_FACED: 0.0,
    Hint.DOUBTFUL: -0.3,
    Hint.AGAINST: -0.55,
}
ASKED = 0.4  # points of a topic that is called as another quantity
SHORT = 3  # letters of a topic, with its slash, that say nothing
FEW_ROWS = 10  # fewer than this say little of how a matrix moves


def judged(a: Assessment, robot: RobotModel) -> Assessment:
    """Return the assessment with its score, its objections and its doubts."""
    if a.variable.is_message:
        topic = describe(a.path.rpartition("/")[2])
        if a.path.startswith("/") and topic.hint is Hint.AGAINST and len(a.path) > SHORT:
            return replace(a, name=topic, points=ASKED, reasons=(topic.why,))
        return replace(a, points=1.5, reasons=(SEEN(what="message"),))
    points = 0.5
    reasons: list[Diagnostic] = []
    objections: list[Diagnostic] = []
    doubts: list[Diagnostic] = []
    hint = a.name.hint
    if a.by_name:
        points += 0.4
        reasons.append(SEEN(what="named"))
    else:
        points += NAME_SCORES[hint]
        reasons.append(a.name.why)
    if not a.finite:
        reasons.append(SEEN(what="not_finite"))
        points -= 0.0 if a.by_name or hint.of_joints else 0.3
        return replace(a, points=points, reasons=tuple(reasons))
    if a.fits:
        points += _judge_range(a, reasons)
        points += _judge_motion(a, reasons)
        objections += _objections(a)
        doubts += _doubts(a, robot)
    if a.tool_path:
        points += 0.3
        reasons.append(TOOL_PATH(other=a.tool_path))
    if a.rates and not hint.against:
        points += 0.15
        reasons.append(HAS_DERIVATIVE(other=a.rates[0][0]))
    if a.rows == a.columns:
        points -= 0.2
        reasons.append(SEEN(what="square"))
    if a.last_is_joint:
        points -= 0.1
        reasons.append(SEEN(what="last_column"))
    if a.between_zeros and hint in (Hint.NEUTRAL, Hint.TWO_FACED) and not (a.tool_path or a.rates):
        points -= 0.25
        reasons.append(SEEN(what="between_zeros"))
    may_be_poses = a.poses.possible and hint in (Hint.TWO_FACED, Hint.DOUBTFUL)
    if may_be_poses and a.poses.hints and not a.tool_path:
        points -= 0.25
    if any(c.likely for c in a.clocks) and not a.by_name and a.columns == len(robot.joints):
        points -= 0.3
    if objections:
        points = min(points, 0.2)
    return replace(
        a,
        points=points,
        reasons=tuple(reasons),
        objections=tuple(objections),
        doubts=tuple(doubts),
    )


def _judge_range(a: Assessment, reasons: list[Diagnostic]) -> float:
    in_degrees = a.unit.unit == "deg" and _in_degrees(a)
    if a.by_name or a.unit.unit == "rad" or in_degrees:
        return 0.1
    reasons.append(a.unit.why or SEEN(what="limits"))
    return -0.2


def _in_degrees(a: Assessment) -> bool:
    unit = said_by_units(a.variable.units).unit
    return unit is not None and unit.name == "deg"


def _judge_motion(a: Assessment, reasons: list[Diagnostic]) -> float:
    if a.still:
        reasons.append(SEEN(what="still"))
        return -0.2
    if a.smooth is not None:
        reasons.append(SEEN(what="smooth" if a.smooth else "rough"))
        return 0.1 if a.smooth else -0.25
    if a.rows < FEW_ROWS:
        reasons.append(FEW_ROWS_ONLY(rows=a.rows))
        return -0.15
    return 0.0


def _objections(a: Assessment) -> Iterable[Diagnostic]:
    if a.velocity_of:
        order = "second" if a.is_acceleration else "first"
        yield DERIVATIVE_OF(order=order, other=a.velocity_of)
    if a.tool_of:
        yield TOOL_OF(other=a.tool_of)
    if a.poses.strong:
        yield LIKE_POSES(why=a.poses.strong)
    if not (a.low.any() or a.high.any()):
        yield SEEN(what="zeros")


def _doubts(a: Assessment, robot: RobotModel) -> Iterable[Diagnostic]:
    if a.poses.possible and a.poses.hints and not (a.tool_path or a.rates or a.by_name):
        yield MAY_BE_POSES(why=a.poses.hints)
    for clock in a.clocks:
        if not (a.by_name or clock in blocking_clocks(a, robot)):
            yield MAY_BE_TIME(column=clock.index + 1, why=clock.why)
    if a.still and (a.low.any() or a.high.any()):
        yield SEEN(what="still")
    # Also under the name of positions: the speeds of a motion from rest to rest look like this,
    # where the robot's own place to rest is not zero.
    named = a.name.hint is Hint.POSITIONS and not (a.tool_path or a.rates or a.by_name)
    if named and a.between_zeros and _one_sided(a) and robot.home.any():
        yield SEEN(what="between_zeros")


def _one_sided(a: Assessment) -> bool:
    """Return whether each column keeps to one side of zero."""
    nearest = np.minimum(np.abs(a.low), np.abs(a.high))
    return bool((nearest <= NEAR_ZERO * (a.high - a.low)).all())
