"""How near a robot's tool can come to a pose."""

from __future__ import annotations

import numpy as np

from mrlab_ros.core.base.geometry import Array, Pose, Vector, inverse, rotate
from mrlab_ros.core.checking.motion import CheckedRobot

SAMPLES, STARTS, STEPS = 4000, 24, 40
DAMPING = 1e-3
DIFFERENCE = 1e-6  # rad or m, of the numeric Jacobian
TURN = 0.3  # m, that a turn by 1 rad weighs as much as


def nearest(robot: CheckedRobot, pose: Pose | Vector, angle: float | None) -> float:
    """Return how near, m, tool0 comes to a pose inside the ranges of the joints.

    angle: rad, by which the tool may be turned from the pose; None: by any. Damped least squares
    (Wampler 1986) from the nearest of drawn configurations: an upper bound, the same each time.
    """
    turned = angle is not None and isinstance(pose, Pose)
    position = pose.position if isinstance(pose, Pose) else pose
    to_base = inverse(robot.pose)
    target = np.add(to_base.position, rotate(to_base.orientation, position))
    wanted = np.eye(3)
    if isinstance(pose, Pose):
        axes = [
            rotate(to_base.orientation, rotate(pose.orientation, axis))
            for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))
        ]
        wanted = np.array(axes).T
    chain, joints = robot.model.chain, robot.model.joints
    low = np.array([max(j.lower, -np.pi) for j in joints])
    high = np.array([min(j.upper, np.pi) for j in joints])

    def error(q: Array) -> Array:
        """Return what lacks at configurations (..., J), as (..., 3 or 6) m."""
        tool = chain.tool0(q)
        off: Array = target - tool[..., :3, 3]
        if not turned:
            return off
        r = np.swapaxes(tool[..., :3, :3], -1, -2) @ wanted
        spin = np.stack(
            [
                r[..., 2, 1] - r[..., 1, 2],
                r[..., 0, 2] - r[..., 2, 0],
                r[..., 1, 0] - r[..., 0, 1],
            ],
            axis=-1,
        )
        # In the tool's frame, as long as the angle; half a turn has no axis and is left as it is.
        sine = np.linalg.norm(spin, axis=-1) / 2
        cosine = (np.trace(r, axis1=-2, axis2=-1) - 1) / 2
        turn = np.arctan2(sine, cosine)
        lacks = spin / (2 * np.maximum(sine, 1e-9))[..., None]
        lacks = lacks * np.maximum(turn - (angle or 0.0), 0.0)[..., None]
        return np.concatenate([off, TURN * lacks], axis=-1)

    drawn = np.random.default_rng(0).uniform(low, high, (SAMPLES, len(joints)))
    order = np.linalg.norm(error(drawn), axis=-1).argsort()[:STARTS]
    q = drawn[order]
    best = np.inf
    for _ in range(STEPS):
        lacking = error(q)
        best = min(best, float(np.linalg.norm(lacking, axis=-1).min()))
        if best < DIFFERENCE:
            break
        moved = q[:, None, :] + DIFFERENCE * np.eye(len(joints))
        jacobian = np.swapaxes(lacking[:, None, :] - error(moved), -1, -2) / DIFFERENCE
        square = jacobian @ np.swapaxes(jacobian, -1, -2)
        square += DAMPING * np.eye(square.shape[-1])
        step = np.linalg.solve(square, lacking[..., None])
        q = np.clip(q + (np.swapaxes(jacobian, -1, -2) @ step)[..., 0], low, high)
    return best
