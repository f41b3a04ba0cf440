"""What speaks for poses of a tool instead of joint positions, in the numbers of one matrix."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.conversion.diagnostics import POSE_HINT, POSE_RANGES, QUATERNIONS
from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

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
        # millimetres beside radians, or beside degrees that no joint would reach
        if largest_turn <= 2 * np.pi + 1e-3 and largest_point > 12 * largest_turn and in_mm:
            return PoseEvidence(POSE_RANGES(angles="rad", **ranges))
        beyond = 1.2 * float(np.degrees(np.abs(limits).max()))
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
