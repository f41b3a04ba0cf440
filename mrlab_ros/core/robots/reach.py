"""The reach of an arm from its kinematics, by its vendor's definition."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mrlab_ros.core.base.checks import bad_value
from mrlab_ros.core.base.diagnostics import ONE_OF
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.robots.diagnostics import NO_SPHERICAL_WRIST
from mrlab_ros.core.robots.model import KinematicChain, RobotModel

Distance = Callable[[Array], Array]


def wrist_centre(chain: KinematicChain, joints: int = 6) -> Array:
    """Return where the axes of the last three joints meet, (3,) m, with all joints at zero.

    Raises BadInput where they miss each other by more than 0.1 mm.
    """
    poses = chain.links(np.zeros(joints))
    lines = []
    for segment in [s for s in chain.segments if s.axis is not None][-3:]:
        pose = poses[segment.link]
        lines.append((pose[:3, 3], pose[:3, :3] @ np.asarray(segment.axis)))
    # The point nearest to all three lines, by least squares.
    across = [np.eye(3) - np.outer(axis, axis) for _, axis in lines]
    right = sum((p @ origin for p, (origin, _) in zip(across, lines, strict=True)), np.zeros(3))
    point: Array = np.linalg.solve(np.sum(across, axis=0), right)
    miss = max(
        float(np.linalg.norm(p @ (point - origin)))
        for p, (origin, _) in zip(across, lines, strict=True)
    )
    if miss > 1e-4:
        raise BadInput(NO_SPHERICAL_WRIST(distance=float(miss)))
    return point


def reach(model: RobotModel, definition: str) -> float:
    """Return the reach, m, from axis 1 horizontally.

    definition: `wrist_centre`, the furthest the wrist centre gets within the limits of joints 2
    and 3; `flange`, the furthest the chain's tip gets within all limits; `stretched`, the tip
    with all joints at zero.
    """
    chain, count = model.chain, len(model.joints)
    axis_1 = _axis_1(chain, count)
    low = np.array([joint.lower for joint in model.joints])
    high = np.array([joint.upper for joint in model.joints])

    def tip(positions: Array) -> Array:
        return _norm(chain.tool0(positions)[..., :2, 3] - axis_1)

    if definition == "stretched":
        return float(tip(np.zeros(count)))
    if definition == "flange":
        return _largest(tip, low, high, range(1, count))
    if definition == "wrist_centre":
        moving = [segment for segment in chain.segments if segment.axis is not None]
        carrier = moving[-4].link
        centre = np.append(wrist_centre(chain, count), 1.0)
        local = np.linalg.inv(chain.links(np.zeros(count))[carrier]) @ centre

        def wrist(positions: Array) -> Array:
            place = (chain.links(positions)[carrier] @ local)[..., :2] - axis_1
            return _norm(place)

        return _largest(wrist, low, high, range(1, count - 3))
    raise bad_value(
        "reach_definition", definition, ONE_OF(choices=["wrist_centre", "flange", "stretched"])
    )


def _norm(flat: Array) -> Array:
    length: Array = np.hypot(flat[..., 0], flat[..., 1])
    return length


def _axis_1(chain: KinematicChain, joints: int) -> Array:
    first = next(segment.link for segment in chain.segments if segment.axis is not None)
    place: Array = chain.links(np.zeros(joints))[first][:2, 3]
    return place


def _largest(distance: Distance, low: Array, high: Array, free: range) -> float:
    """Return the largest value over the ranges of the free joints; the others are as near 0 as
    their limits allow."""
    rng = np.random.default_rng(0)
    rest = np.clip(0.0, low, high)
    sample = np.tile(rest, (4096, 1))
    for joint in free:
        sample[:, joint] = rng.uniform(low[joint], high[joint], len(sample))
    values = distance(sample)
    best = sample[np.argsort(values)[-24:]]
    width = (high - low) / 8
    # A pattern search from the best samples; the width shrinks below a nanoradian.
    for _ in range(120):
        for joint in free:
            tries = np.repeat(best[:, None, :], 3, axis=1)
            tries[:, 0, joint] -= width[joint]
            tries[:, 2, joint] += width[joint]
            tries = np.clip(tries, low, high)
            best = tries[np.arange(len(best)), distance(tries).argmax(axis=1)]
        width = width * 0.82
    return float(distance(best).max())
