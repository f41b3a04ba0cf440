"""Numbers of matrices against one another and against poses of a tool.

Which matrix is the derivative of which, which poses belong to which joint positions, and what
speaks for poses in one matrix.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.diagnostics import POSE_HINT, POSE_RANGES, QUATERNIONS
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

MOST_ROWS = 4000  # rows that a derivative is looked for in: those where most moves
WINDOWS = 256
FEWEST_ROWS = 8
EXPLAINED = 0.95  # share of the motion that a velocity explains when it is integrated
EXPLAINED_OF_JOINT = 0.8
LEAST_RATE, MOST_RATE = 0.5, 20_000.0  # Hz; what a derivative's factor may be

POSES = 48  # rows that poses are compared at
AGREED, AGREED_M = 0.02, 2e-3  # of the path's extent, m: what poses may differ by
DIFFERS, DIFFERS_M = 0.06, 4e-3
LONGEST_TOOL, FARTHEST_BASE = 0.8, 5.0  # m
MILLIMETRES = 20.0  # coordinates beyond are not metres
# turns of the base about the vertical that are in use: URDF and controllers differ by them
BASE_TURNS = (0.0, np.pi, np.pi / 2, -np.pi / 2)


def busiest(values: NDArray[Any], most: int = MOST_ROWS) -> slice:
    """Return the at most `most` neighbouring rows in which a long matrix moves most."""
    rows = len(values)
    if rows <= most:
        return slice(0, rows)
    chosen = np.linspace(0, rows - 1, 512).astype(int)
    with np.errstate(all="ignore"):
        travel = np.nan_to_num(np.abs(np.diff(values[chosen].astype(np.float64), axis=0)))
    middle = int(chosen[int(travel.sum(axis=1).argmax())])
    start = min(max(middle - most // 2, 0), rows - most)
    return slice(start, start + most)


@dataclass(frozen=True, eq=False)
class Course:
    """Neighbouring rows of a matrix, prepared for comparisons.

    positions: (K, C). summed: (K,
    C), the sum of the means of each row and the next up to row i; summed_short: the sum of the
    rows before row i, for a matrix with a row less, as diff gives it.
    """

    positions: Array
    summed: Array
    summed_short: Array


def course(values: NDArray[Any], part: slice) -> Course | None:
    """Prepare the rows `part` of a matrix, (N, C); None where they are not finite, or too few."""
    v = values[part].astype(np.float64)
    if len(v) < FEWEST_ROWS or not np.isfinite(v).all():
        return None
    nothing = np.zeros((1, v.shape[1]))
    means = np.vstack([nothing, np.cumsum((v[1:] + v[:-1]) / 2, axis=0)])
    return Course(v, means, np.vstack([nothing, np.cumsum(v, axis=0)]))


def derivative_rate(
    positions: Course, velocities: Course, *, shorter: bool = False
) -> float | None:
    """Return the factor k, Hz, where velocities are k times the step from row to row, else None.

    shorter: the velocities have a row less, as diff gives them. The sum of the velocities over
    windows of rows is compared with the way travelled, so noise averages out. Where the
    velocities are per second, k is the rate of the rows.
    """
    q = positions.positions
    total = velocities.summed_short if shorter else velocities.summed
    rows = min(len(q), len(total))
    if q.shape[1] != total.shape[1] or rows < FEWEST_ROWS:
        return None
    window = max(2, rows // 32)
    starts = np.unique(np.linspace(0, rows - 1 - window, min(rows - window, WINDOWS)).astype(int))
    way = q[starts + window] - q[starts]
    summed = total[starts + window] - total[starts]
    moved = float((way * way).sum())
    across = float((way * summed).sum())
    if moved <= 1e-12 or across <= 0:
        return None
    rate = float((summed * summed).sum()) / across
    if not LEAST_RATE <= rate <= MOST_RATE:
        return None
    left = ((way - summed / rate) ** 2).sum(axis=0)
    if float(left.sum()) > (1 - EXPLAINED) * moved:
        return None
    of_joint = (way * way).sum(axis=0)
    moves = of_joint > 1e-4 * moved
    if (left[moves] > (1 - EXPLAINED_OF_JOINT) * of_joint[moves]).any():
        return None
    return rate


@dataclass(frozen=True)
class PoseMatch:
    """How poses agree with the tool of a robot at joint positions: rms and extent in m."""

    error: float
    extent: float

    @property
    def agrees(self) -> bool:
        return self.error <= AGREED * self.extent + AGREED_M and self.extent > 10 * AGREED_M

    @property
    def differs(self) -> bool:
        return self.error > DIFFERS * self.extent + DIFFERS_M


def tool_points(values: NDArray[Any]) -> Array | None:
    """Return the positions, (N, 3), of poses as matrices hold them, or None.

    values: (N, 3) positions, (N, 6) or (N, 7) with an orientation behind them, or (4, 4, N)
    transforms. The unit is that of the values.
    """
    if values.ndim == 3 and values.shape[:2] == (4, 4):
        return np.asarray(values[:3, 3, :].T, dtype=np.float64)
    if values.ndim == 2 and values.shape[1] in (3, 6, 7):
        return np.asarray(values[:, :3], dtype=np.float64)
    return None


def compare_poses(poses: Array, points: Array) -> PoseMatch | None:
    """Compare poses of a flange in its base, (K, 4, 4), with points, (K, 3) m or mm.

    The tool on the flange and the place of the base are not known: the offset of the tool and the
    base's position are fitted, the base's turn is tried. None where nothing can be said.
    """
    if len(points) < FEWEST_ROWS or not np.isfinite(points).all():
        return None
    if float(np.abs(points).max()) > MILLIMETRES:
        points = points / 1e3
    extent = float(np.sqrt(((points - points.mean(axis=0)) ** 2).sum(axis=1).mean()))
    if extent < 1e-3:
        return None
    flange, turns = poses[:, :3, 3], poses[:, :3, :3]
    best = np.inf
    for angle in BASE_TURNS:
        cos, sin = np.cos(angle), np.sin(angle)
        base = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1.0]])
        # base @ (flange + turns @ tool) + place = points
        unknown = np.concatenate(
            [base @ turns, np.broadcast_to(np.eye(3), turns.shape)], axis=2
        ).reshape(-1, 6)
        wanted = (points - flange @ base.T).reshape(-1)
        found = np.linalg.lstsq(unknown, wanted, rcond=1e-6)[0]
        if np.linalg.norm(found[:3]) > LONGEST_TOOL or np.linalg.norm(found[3:]) > FARTHEST_BASE:
            found = np.zeros(6)
        left = (unknown @ found - wanted).reshape(-1, 3)
        best = min(best, float(np.sqrt((left**2).sum(axis=1).mean())))
    return PoseMatch(best, extent)


def rows_to_compare(count: int) -> NDArray[np.intp]:
    """Return which of `count` rows poses are compared at."""
    return np.unique(np.linspace(0, count - 1, min(count, POSES)).astype(np.intp))


ROWS = 512
UNIT_LENGTH = 2e-3  # what the length of a quaternion may differ from 1 by
TOOL = 0.5  # m; how much farther than the flange a tool reaches
NEAR_BASE = 0.08  # of the reach; tools stay farther from the base than this
BELOW_BASE = 1.0  # m
POINTING_DOWN = 0.03  # rad
STILL = 1e-6
WRAPPED = 0.01  # rad; what angles that atan2 made may pass pi by, as they are noisy


def is_transforms(values: NDArray[Any] | None) -> bool:
    """Say whether an array, (4, 4, N), holds homogeneous transforms, one a page."""
    if values is None or values.ndim != 3 or values.shape[:2] != (4, 4) or not values.shape[2]:
        return False
    pages = np.linspace(0, values.shape[2] - 1, min(values.shape[2], ROWS)).astype(int)
    sample = np.moveaxis(values[:, :, pages].astype(np.float64), 2, 0)
    if not np.isfinite(sample).all():
        return False
    turns = sample[:, :3, :3]
    left = np.abs(turns @ turns.transpose(0, 2, 1) - np.eye(3)).max()
    last = np.abs(sample[:, 3] - [0, 0, 0, 1]).max()
    return bool(left <= UNIT_LENGTH and last <= 1e-9)


@dataclass(frozen=True)
class PoseEvidence:
    """strong: why these are poses. hints: what makes poses likely. possible: in reach."""

    strong: Diagnostic | None = None
    hints: tuple[Diagnostic, ...] = ()
    possible: bool = False


def evidence(values: NDArray[Any], robot: RobotModel) -> PoseEvidence:
    """Say how much values, (N, 6) or (N, 7), are like poses x y z and an orientation."""
    rows = np.linspace(0, len(values) - 1, min(len(values), ROWS)).astype(int)
    sample = values[rows].astype(np.float64)
    if not np.isfinite(sample).all() or sample.shape[1] not in (6, 7):
        return PoseEvidence()
    point, rest = sample[:, :3], sample[:, 3:]
    largest_point = float(np.abs(point).max())
    if sample.shape[1] == 7 and _is_quaternion(rest):
        return PoseEvidence(QUATERNIONS())
    turn = rest[:, :3]
    largest_turn = float(np.abs(turn).max())
    within = robot.reach + TOOL
    limits = np.array([(j.lower, j.upper) for j in robot.joints])[:, :3] if robot.joints else None
    if limits is not None and largest_point > 4 * np.pi and sample.shape[1] == 6:
        ranges: dict[str, Any] = {"far": largest_point, "near": largest_turn}
        in_mm = bool((np.linalg.norm(point, axis=1) <= 1e3 * (within + 1)).all())
        # millimetres beside radians, or beside degrees that no joint would reach; a wrist that
        # rests at 0 is no orientation where the arm may be in degrees
        beyond = 1.2 * float(np.degrees(np.abs(limits).max()))
        oriented = largest_turn > 0 or largest_point > beyond
        small = largest_turn <= 2 * np.pi + 1e-3 and largest_point > 12 * largest_turn
        if oriented and small and in_mm:
            return PoseEvidence(POSE_RANGES(angles="rad", **ranges))
        if largest_turn <= 180.5 and largest_point > beyond and in_mm and largest_turn > 7:
            return PoseEvidence(POSE_RANGES(angles="deg", **ranges))
    if sample.shape[1] != 6 or not _in_reach(point, within):
        return PoseEvidence()
    return PoseEvidence(None, tuple(_hints(point, turn)), possible=True)


def _is_quaternion(rest: Array) -> bool:
    """Say whether four columns are unit quaternions, and not joints and a gripper at rest."""
    if np.abs(np.linalg.norm(rest, axis=1) - 1).max() > UNIT_LENGTH:
        return False
    used = np.abs(rest).max(axis=0) > 0.01
    return bool(np.ptp(rest, axis=0).max() > STILL or used.sum() >= 2)


def _in_reach(point: Array, within: float) -> bool:
    """Say whether points are where a robot's tool can be, m."""
    far = np.linalg.norm(point, axis=1)
    return bool(
        (far <= within).all()
        and (far >= NEAR_BASE * within).all()
        and (point[:, 2] >= -BELOW_BASE).all()
    )


def _hints(point: Array, turn: Array) -> list[Diagnostic]:
    hints = []
    moves = np.ptp(point, axis=0) > STILL
    still = bool(np.ptp(turn, axis=0).max() <= STILL)
    length = np.linalg.norm(turn, axis=1)
    down = np.abs(np.abs(turn) - np.pi) <= POINTING_DOWN
    if moves.sum() >= 2 and (
        (down.all(axis=0).sum() == 1 and np.median(np.abs(turn), axis=0).min() <= POINTING_DOWN)
        or (np.abs(length - np.pi).max() <= POINTING_DOWN and length.any())
    ):
        hints.append("down")
    if moves.sum() >= 2 and still:
        hints.append("still")
    if moves.any() and _wraps(turn) and not _wraps(point):
        hints.append("wraps")
    if _is_circle(point):
        hints.append("circle")
    return [POSE_HINT(hint=hint) for hint in hints]


def _wraps(angles: Array) -> bool:
    """Say whether angles within -pi and pi jump by a full turn from one row to another."""
    if np.abs(angles).max() > np.pi + WRAPPED:
        return False
    return bool(np.abs(np.diff(angles, axis=0)).max() > 2 * np.pi - 0.5)


def _is_circle(point: Array) -> bool:
    """Say whether two columns run on a circle while the third stands still or rises evenly."""
    if len(point) < 16:
        return False
    for a, b, c in ((0, 1, 2), (0, 2, 1), (1, 2, 0)):
        x, y, third = point[:, a], point[:, b], point[:, c]
        if min(np.ptp(x), np.ptp(y)) < 1e-3 or np.ptp(third) > STILL:
            continue
        # x^2 + y^2 = 2 x0 x + 2 y0 y + k, by least squares
        left = np.column_stack([x, y, np.ones(len(x))])
        fit, *_ = np.linalg.lstsq(left, x**2 + y**2, rcond=None)
        radius = np.hypot(x - fit[0] / 2, y - fit[1] / 2)
        around = np.unwrap(np.arctan2(y - fit[1] / 2, x - fit[0] / 2))
        if np.ptp(radius) < 0.01 * radius.mean() and np.ptp(around) > np.pi:
            return True
    return False
