"""What the numbers of joint positions say by themselves: whether they are a motion."""

from __future__ import annotations

import numpy as np

from mrlab_ros.core.robots.model import RobotModel
from mrlab_ros.core.trajectory.trajectory import Array

# Rows that are as far apart as any two: the mean square of the steps over twice the variance is 1
# for random rows and far below it for a motion (von Neumann's ratio).
RANDOM = 0.5
ENOUGH_ROWS = 50
LEAST_STEP = 0.2  # rad; smaller steps are noise
MOSTLY = 0.5  # share of the steps that are too fast
SAME_PLACE, JUMPING = 2e-3, 0.3  # m and rad
SAMPLE = 4000


def fault(arm: Array, rate: float, robot: RobotModel) -> str:
    """Return why joint positions, (N, J) rad at `rate` Hz, are no motion: random, pose, or empty.

    Rows that a robot could follow at that rate are a motion, in whatever order they come.
    """
    steps = np.abs(np.diff(arm[:SAMPLE], axis=0))
    fastest = np.array([joint.max_velocity for joint in robot.joints])
    too_fast = (steps * rate > fastest).any(axis=1)
    if not len(steps) or np.count_nonzero(too_fast) < MOSTLY * len(steps):
        return ""
    if float(np.median(steps.max(axis=1))) < LEAST_STEP:
        return ""
    if len(arm) >= ENOUGH_ROWS:
        spread = arm[:SAMPLE].var(axis=0)
        moving = spread > 1e-6
        ratio = (steps[:, moving] ** 2).mean(axis=0) / (2 * spread[moving])
        return "random" if moving.any() and float(ratio.mean()) > RANDOM else ""
    if robot.chain is None or len(arm) < 3:
        return ""
    places = robot.chain.tool0(arm)[:, :3, 3]
    jumps = float(steps.max(axis=1).min()) > JUMPING
    return "pose" if jumps and float(np.ptp(places, axis=0).max()) < SAME_PLACE else ""
