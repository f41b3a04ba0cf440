"""Measures of where the tool goes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from mrlab_ros.classroom.rubrics.diagnostics import (
    NO_POSES,
    ONE_POSE_EACH,
    POSE_NOT_TURNED,
    POSE_OUT_OF_REACH,
    POSE_TOO_EARLY,
    POSE_TOO_FAR,
    POSE_TURNED,
    POSES_PASSED,
    WITHIN_NOTHING,
)
from mrlab_ros.classroom.rubrics.rubric import Ground, Measure, Outcome, no_motion
from mrlab_ros.classroom.rubrics.sentences import Form, Gaps, Given
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Array, Pose, Quaternion, Vector, inverse, rotate
from mrlab_ros.core.checking.check_record import Checked, Motion
from mrlab_ros.core.checking.motion import CheckedRobot
from mrlab_ros.core.checking.waypoints import segments


@dataclass(frozen=True)
class Visit:
    """How the tool passes a pose. distance: m; angle: rad, 0 where none is asked for; time: s of
    the motion; early: it does so before the pose that comes first."""

    distance: float
    angle: float
    time: float
    passed: bool
    early: bool = False


@dataclass(frozen=True)
class Passes:
    """tool0 of a robot passes all poses, within m and rad; each: each earns its part."""

    robot: str
    poses: tuple[Pose | Vector, ...]
    length: float
    angle: float | None
    ordered: bool
    each: bool

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        motion = next(iter(checked.played(self.robot)), None)
        if motion is None:
            return no_motion(self.robot, checked)
        found = self.visits(motion)
        passed = sum(visit.passed for visit in found)
        count: dict[str, Any] = {"passed": passed, "count": len(found)}
        if passed == len(found):
            worst = max(visit.distance for visit in found)
            said = POSES_PASSED(**count, value=worst, limit=self.length, unit="m")
            return Outcome(1.0, said)
        number, first = next((i, v) for i, v in enumerate(found, 1) if not v.passed)
        time = first.time + motion.start
        place = position_of(self.poses[number - 1])
        of = {**count, "number": number, "place": place, "time": time}
        if first.early or first.distance > self.length:
            code = POSE_TOO_EARLY if first.early else POSE_TOO_FAR
            said = code(**of, value=first.distance, limit=self.length, unit="m")
        else:
            said = POSE_TURNED(**of, value=first.angle, limit=self.angle, unit="rad")
        return Outcome(passed / len(found) if self.each else 0.0, said, time)

    def visits(self, motion: Motion) -> list[Visit]:
        """Return how each pose is passed; in order, one is looked for behind those before it."""
        tool, times = motion.figures.tool, motion.figures.times
        found = []
        after = 0.0
        for pose in self.poses:
            position = position_of(pose)
            # A place of two numbers is seen from above.
            distances, instants = segments(tool[:, : len(position)], times, np.asarray(position))
            angles = np.zeros_like(distances)
            if self.angle is not None and isinstance(pose, Pose):
                angles = _angles(motion, pose.orientation, instants)
            near = (distances <= self.length) & (angles <= (self.angle or 0.0))
            later = instants >= after if self.ordered else np.ones_like(near)
            hits = np.flatnonzero(near & later)
            if len(hits):
                ends = np.flatnonzero(np.diff(hits) > 1)
                first = hits[: ends[0] + 1] if len(ends) else hits
                at = int(first[distances[first].argmin()])
                # The next may be passed before the tool is nearest to this one.
                after = float(instants[first[0]]) if self.ordered else 0.0
                found.append(Visit(float(distances[at]), float(angles[at]), float(instants[at]),
                                   True))  # fmt: skip
                continue
            early = bool(near.any())
            allowed = np.flatnonzero(near if early else later)
            if not len(allowed):
                allowed = np.arange(len(distances))
            at = int(allowed[distances[allowed].argmin()])
            found.append(
                Visit(float(distances[at]), float(angles[at]), float(instants[at]), False, early)
            )
        return found

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.robot_flaws(self.robot)
        if not self.poses:
            yield NO_POSES()
        if self.each and len(self.poses) == 1:
            yield ONE_POSE_EACH()
        if not self.length > 0:
            yield WITHIN_NOTHING()
        unturned = [i for i, p in enumerate(self.poses, 1) if not isinstance(p, Pose)]
        if self.angle is not None and unturned:
            yield POSE_NOT_TURNED(number=unturned[0])
        robots = ground.of(self.robot)
        for number, pose in enumerate(self.poses, 1):
            if not isinstance(pose, Pose) and len(pose) == 2:
                continue
            short = [nearest(robot, pose, self.angle) for robot in robots]
            if short and min(short) > self.length > 0:
                yield POSE_OUT_OF_REACH(
                    number=number, place=position_of(pose), value=min(short), limit=self.length
                )


def _angles(motion: Motion, orientation: Quaternion, instants: Array) -> Array:
    """Return how far the tool is turned from an orientation at instants, (M,) s, as (M,) rad."""
    local = motion.robot.model.chain.tool0(motion.trajectory.positions)[:, :3, :3]
    q = motion.robot.pose.orientation
    base = np.array([rotate(q, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]).T
    wanted = np.array([rotate(orientation, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]).T
    cosines = (np.einsum("nij,ij->n", base @ local, wanted) - 1) / 2
    angles: Array = np.interp(instants, motion.figures.times, np.arccos(np.clip(cosines, -1, 1)))
    return angles


def position_of(pose: Pose | Vector) -> tuple[float, ...]:
    """Return the position of a pose, m."""
    return pose.position if isinstance(pose, Pose) else pose


def _passes(gaps: Gaps, given: Given, *, ordered: bool = True) -> Measure:
    place = gaps.get("place")
    poses = given.poses if place is None else (place,)
    robot = gaps.get("robot") or ""
    return Passes(robot, poses, gaps["length"], gaps.get("angle"), ordered, given.each)


FAMILY = "poses, beginning and end"
FORMS = (
    Form(
        "passes within LENGTH [and ANGLE] of poses [, in order] [by ROBOT]", _passes,
        "tool0 passes the test's `poses`, one behind the other, at that distance and, where an "
        "angle is named, turned by no more.", poses=True, each=True,
    ),
    Form(
        "passes within LENGTH [and ANGLE] of poses [, ] in any order [by ROBOT]",
        lambda gaps, given: _passes(gaps, given, ordered=False),
        "The same, in whatever order.", poses=True, each=True,
    ),
    Form("passes within LENGTH of PLACE [by ROBOT]", _passes, "tool0 passes one place."),
)  # fmt: skip


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
