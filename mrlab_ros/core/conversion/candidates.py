"""Judges one matrix: how much it is like joint positions of a robot, and why."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.conversion.named_columns import misnamed, names_joints
from mrlab_ros.core.conversion.preview import Preview, preview
from mrlab_ros.core.conversion.variable_names import Hint, hint
from mrlab_ros.core.conversion.workspace import Variable
from mrlab_ros.core.robots.model import RobotModel

NAME_SCORES = {
    Hint.POSITIONS: 0.3,
    Hint.NEUTRAL: 0.0,
    Hint.DOUBTFUL: -0.3,
    Hint.AGAINST: -0.55,
}
# Mean step between samples over the range of a motion; unordered samples have about 1/3.
ROUGH = 0.15
FEW_ROWS = 10
ENOUGH_ROWS = 20
# Share of a gripper's samples that may be on their way, and of its range that counts as an end.
ON_ITS_WAY, AN_END = 0.2, 0.02
EVEN_STEPS = 1e-3  # relative deviation of the steps of a time vector
SPARKS = "▁▂▃▄▅▆▇█"
SPARK_WIDTH = 24


@dataclass(frozen=True, eq=False)
class Candidate:
    """A matrix that could be the joint positions.

    path: as MATLAB writes it. shape: as MATLAB's size() gives it. score: 0 to 1, larger is
    likelier. minimum, maximum: in the matrix's own unit.
    """

    path: str
    shape: tuple[int, ...]
    score: float
    why: str
    minimum: float
    maximum: float
    preview: Preview

    @property
    def size(self) -> str:
        """Return the dimensions as MATLAB's whos writes them, such as 450x6."""
        return "x".join(str(n) for n in self.shape)

    def sparkline(self) -> str:
        """Return the course of the column that moves most, as text."""
        values = self.preview.values
        if not np.isfinite([self.minimum, self.maximum]).all():
            return ""
        sample = values[np.linspace(0, len(values) - 1, SPARK_WIDTH).astype(int)].astype(float)
        spans = np.ptp(sample, axis=0)
        column = sample[:, int(spans.argmax())]
        span = float(spans.max()) or 1.0
        return "".join(SPARKS[int(7 * (x - column.min()) / span)] for x in column)


def is_time(column: NDArray[Any]) -> bool:
    """Say whether a column rises in even steps, as a clock does."""
    if len(column) < 3 or not np.isfinite(column).all():
        return False
    steps = np.diff(column.astype(np.float64))
    mean = float(steps.mean())
    return mean > 0 and bool(np.abs(steps - mean).max() <= max(EVEN_STEPS * mean, 1e-9))


def between_ends(column: NDArray[Any]) -> int:
    """Return how many samples of a finite column are at neither end of its range."""
    low, high = float(column.min()), float(column.max())
    margin = AN_END * (high - low)
    return int(np.count_nonzero((column > low + margin) & (column < high - margin)))


def is_gripper(column: NDArray[Any]) -> bool:
    """Say whether a column is mostly at one of its two ends, as a gripper is."""
    return between_ends(column) <= ON_ITS_WAY * len(column)


def score(variable: Variable, robot: RobotModel, *, has_time: bool = False) -> Candidate:
    """Judge a matrix with as many columns as the robot has joints, or one more."""
    values = variable.values
    assert values is not None
    if variable.is_message:
        why = "it is a JointTrajectory for these joints"
        return _candidate(variable, 1.0, [why], float(values.min()), float(values.max()))
    rows, columns = values.shape
    joints = len(robot.joints)
    reasons: list[str] = []
    points = 0.5
    said = hint(variable.path)
    if names_joints(variable, robot):
        points += 0.4
        reasons.append("its columns are named as the joints")
    else:
        points += NAME_SCORES[said]
        reasons.append(said.value)
    minimum, maximum = float(values.min()), float(values.max())
    if not np.isfinite([minimum, maximum]).all():
        reasons.append("it holds NaN or Inf")
        return _candidate(variable, points, reasons, minimum, maximum)
    arm = values[:, :joints]
    low, high = arm.min(axis=0), arm.max(axis=0)
    limits = np.array([(j.lower, j.upper) for j in robot.joints])
    if (low >= limits[:, 0] - 1e-3).all() and (high <= limits[:, 1] + 1e-3).all():
        points += 0.1
    else:
        points -= 0.2
        reasons.append("it leaves the joint limits")
    span = high.astype(np.float64) - low
    if not span.any():
        points -= 0.2
        reasons.append("it never moves")
    elif rows >= ENOUGH_ROWS:
        sample = arm[:20_000].astype(np.float64)
        moving = span > 1e-6
        travel = np.abs(np.diff(sample[:, moving], axis=0)).mean(axis=0)
        if float((travel / span[moving]).mean()) > ROUGH:
            points -= 0.25
            reasons.append("its rows do not follow one another like a motion")
        else:
            points += 0.1
            reasons.append("it moves smoothly")
    elif rows < FEW_ROWS:
        points -= 0.15
        reasons.append(f"it has {rows} rows only")
    if rows == columns:
        points -= 0.2
        reasons.append("it is square")
    if columns > joints and not is_gripper(values[:, joints]):
        points -= 0.1
        reasons.append("its last column is not a gripper's")
    if has_time:
        points += 0.05
        reasons.append("it has a time vector")
    return _candidate(variable, points, reasons, minimum, maximum)


def _candidate(
    variable: Variable, points: float, reasons: list[str], minimum: float, maximum: float
) -> Candidate:
    score = round(min(max(points, 0.0), 1.0), 3)
    shown = preview(variable)
    return Candidate(
        variable.path, variable.shape, score, "; ".join(reasons), minimum, maximum, shown
    )


def fits(variable: Variable, robot: RobotModel) -> bool:
    """Say whether the matrix has samples as rows and the robot's joints as columns.

    Columns that are named as joints count, in any order; their names have to be the robot's.
    """
    if variable.values is None or variable.shape[0] < 2:
        return False
    if names_joints(variable, robot):
        return misnamed(variable, robot) is None
    return variable.shape[1] - len(robot.joints) in (0, 1)


def columns_of_time(variable: Variable, robot: RobotModel) -> bool:
    """Say whether column 1 is time and the joints begin at column 2."""
    values, joints = variable.values, len(robot.joints)
    if (
        values is None
        or names_joints(variable, robot)
        or values.shape[0] < 3
        or not is_time(values[:, 0])
    ):
        return False
    if values.shape[1] == joints + 1:
        return not is_gripper(values[:, joints])
    return values.shape[1] == joints + 2 and is_gripper(values[:, joints + 1])
