"""Measures of where the tool goes, and of how a motion begins and ends."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.checking.joints import REST_SHARE
from mrlab_ros.core.checking.waypoints import segments
from mrlab_ros.core.geometry import Array, Pose, Quaternion, Vector, rotate
from mrlab_ros.core.rubrics.checked import Checked, Motion
from mrlab_ros.core.rubrics.ground import Ground
from mrlab_ros.core.rubrics.quantities import ANGLE, LENGTH
from mrlab_ros.core.rubrics.reachable import nearest
from mrlab_ros.core.rubrics.rubric import Measure, Outcome
from mrlab_ros.core.rubrics.sentences import Form, Gaps, Given
from mrlab_ros.core.rubrics.threshold import Threshold

HOME = float(np.radians(1.0))


def no_robot(robot: str, checked: Checked) -> Outcome:
    """Return what a test gets whose robot has no motion, or has not played it to its end."""
    for motion in checked.of(robot):
        if (wait := checked.stuck.get(motion.robot.name)) is not None:
            words = f"{motion.robot.name} waits for ever: '{wait}' does not come true."
            return Outcome(0.0, words, motion.start)
    names = ", ".join(m.robot.name for m in checked.motions)
    return Outcome(0.0, f"{robot} has no motion in this file; those that have: {names}.", 0.0)


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
            return no_robot(self.robot, checked)
        found = self.visits(motion)
        passed = sum(visit.passed for visit in found)
        share = passed / len(found)
        worst = max(visit.distance for visit in found)
        limit, unit = self.length, "m"
        if passed == len(found):
            words = (
                "The tool passes it" if len(found) == 1 else f"It passes all {len(found)} poses"
            )
            words = f"{words}, at most {LENGTH.words(worst)} away."
            return Outcome(1.0, words, None, worst, limit, unit)
        number, first = next((i, v) for i, v in enumerate(found, 1) if not v.passed)
        name = f"pose {number} ({_place(self.poses[number - 1])})"
        if first.early:
            words = f"The tool passes {name} before the one that comes first"
        elif first.distance > self.length:
            words = f"The tool passes {name} at {LENGTH.words(first.distance)}"
        else:
            words = f"The tool passes {name} turned by {ANGLE.words(first.angle)}"
        within = LENGTH.words(self.length)
        if self.angle is not None:
            within += f" and {ANGLE.words(self.angle)}"
        of = f"; {passed} of {len(found)} poses passed" if len(found) > 1 else ""
        return Outcome(
            share if self.each else 0.0,
            f"{words} at {first.time + motion.start:.2f} s; expected within {within}{of}.",
            first.time + motion.start,
            first.distance,
            limit,
            unit,
        )

    def visits(self, motion: Motion) -> list[Visit]:
        """Return how each pose is passed; in order, one is looked for behind those before it."""
        tool, times = motion.figures.tool, motion.figures.times
        found = []
        after = 0.0
        for pose in self.poses:
            position = pose.position if isinstance(pose, Pose) else pose
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

    def flaws(self, ground: Ground) -> Iterator[str]:
        yield from ground.robot_flaws(self.robot)
        if not self.poses:
            yield "it names no poses; add poses: [[0.4, 0.2, 0.3]], m in world"
        if self.each and len(self.poses) == 1:
            yield "'partial: each' gives no part of the points: there is one pose"
        if not self.length > 0:
            yield "within 0 mm no motion passes anything; take 1 mm or more"
        unturned = [i for i, p in enumerate(self.poses, 1) if not isinstance(p, Pose)]
        if self.angle is not None and unturned:
            yield (
                f"an angle is asked for, and pose {unturned[0]} has no orientation; add rpy_deg: "
                "[180, 0, 0] to its position, or leave the angle out"
            )
        robots = ground.of(self.robot)
        for number, pose in enumerate(self.poses, 1):
            if not isinstance(pose, Pose) and len(pose) == 2:
                continue
            short = [nearest(robot, pose, self.angle) for robot in robots]
            if short and min(short) > self.length > 0:
                yield (
                    f"pose {number} ({_place(pose)}) is out of reach: the tool comes within "
                    f"{LENGTH.words(min(short))} of it, not within {LENGTH.words(self.length)}"
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


def _place(pose: Pose | Vector) -> str:
    position = pose.position if isinstance(pose, Pose) else pose
    return ", ".join(f"{v:.4g}" for v in position)


@dataclass(frozen=True)
class End:
    """A motion begins (`last` False) or ends at a place of tool0, m in world."""

    robot: str
    place: Vector
    last: bool
    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        motion = next(iter(checked.played(self.robot)), None)
        if motion is None:
            return no_robot(self.robot, checked)
        at = -1 if self.last else 0
        tool = motion.figures.tool[at]
        count = len(self.place)
        off = float(np.linalg.norm(tool[:count] - np.asarray(self.place)))
        verb = "ends" if self.last else "begins"
        words = f"The tool {verb} {{}} away from ({_place(self.place)})"
        return self.threshold.outcome(off, words, _instant(motion, self.last))

    def flaws(self, ground: Ground) -> Iterator[str]:
        yield from ground.robot_flaws(self.robot)
        yield from self.threshold.flaws()
        robots = ground.of(self.robot)
        short = [nearest(robot, self.place, None) for robot in robots if len(self.place) == 3]
        if short and min(short) > self.threshold.limit:
            yield (
                f"({_place(self.place)}) is out of reach: the tool comes within "
                f"{LENGTH.words(min(short))} of it"
            )


@dataclass(frozen=True)
class AtJoints:
    """A motion begins or ends at its robot's home pose, or (`back`) ends where it began."""

    robot: str
    last: bool
    back: bool
    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        motions = checked.played(self.robot)
        if not motions:
            return no_robot(self.robot, checked)
        found = []
        for motion in motions:
            q = motion.trajectory.positions
            model = motion.robot.model
            wanted = q[0] if self.back else model.home
            off = np.abs(q[-1 if self.last else 0] - wanted)
            worst = int(off.argmax())
            found.append((float(off[worst]), model.joint_names[worst], motion))
        off, joint, motion = max(found, key=lambda each: each[0])
        where = "where it began" if self.back else "home"
        verb = "ends" if self.last else "begins"
        words = f"{joint} {verb} {{}} away from {where}"
        return self.threshold.outcome(off, words, _instant(motion, self.last))

    def flaws(self, ground: Ground) -> Iterator[str]:
        yield from ground.robot_flaws(self.robot)
        yield from self.threshold.flaws()


@dataclass(frozen=True)
class AtRest:
    """Every joint begins or ends at no more than 2% of its largest speed."""

    robot: str
    last: bool

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        motions = checked.played(self.robot)
        if not motions:
            return no_robot(self.robot, checked)
        share, joint, motion = max(
            (
                (
                    (j.last_speed if self.last else j.first_speed) / j.joint.max_velocity,
                    j.joint.name,
                    motion,
                )
                for motion in motions
                for j in motion.figures.joints
            ),
            key=lambda each: each[0],
        )
        verb = "ends" if self.last else "begins"
        if share <= REST_SHARE:
            return Outcome(1.0, f"It {verb} at rest.", None, share, REST_SHARE)
        words = f"{joint} {verb} at {100 * share:.3g}% of its largest speed; expected at most 2%."
        return Outcome(0.0, words, _instant(motion, self.last), share, REST_SHARE)

    def flaws(self, ground: Ground) -> Iterator[str]:
        yield from ground.robot_flaws(self.robot)


def _instant(motion: Motion, last: bool) -> float:
    return motion.start + (float(motion.figures.times[-1]) if last else 0.0)


def _passes(gaps: Gaps, given: Given, *, ordered: bool = True) -> Measure:
    place = gaps.get("place")
    poses = given.poses if place is None else (place,)
    robot = gaps.get("robot") or ""
    return Passes(robot, poses, gaps["length"], gaps.get("angle"), ordered, given.each)


def _end(last: bool) -> Form:
    verb = "ends" if last else "begins"
    return Form(
        f"{verb} within LENGTH of PLACE [by ROBOT]",
        lambda gaps, given: End(
            gaps.get("robot") or "", gaps["place"], last,
            Threshold(LENGTH, gaps["length"], given.until),
        ),
        f"Where tool0 is in the {'last' if last else 'first'} frame.", until=LENGTH,
    )  # fmt: skip


def _home(text: str, last: bool, about: str, *, back: bool = False) -> Form:
    return Form(
        f"{text} [within ANGLE] [by ROBOT]",
        lambda gaps, given: AtJoints(
            gaps.get("robot") or "", last, back,
            Threshold(ANGLE, HOME if gaps.get("angle") is None else gaps["angle"], given.until),
        ),
        about, until=ANGLE,
    )  # fmt: skip


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
    _end(False),
    _end(True),
    _home("begins at home", False, "Every joint of the first frame, within 1 deg by itself."),
    _home("ends at home", True, "Every joint of the last frame."),
    _home("ends where it began", True, "Every joint of the last frame.", back=True),
    Form(
        "begins at rest [by ROBOT]", lambda gaps, given: AtRest(gaps.get("robot") or "", False),
        "No joint faster than 2% of its limit in the first frame.",
    ),
    Form(
        "ends at rest [by ROBOT]", lambda gaps, given: AtRest(gaps.get("robot") or "", True),
        "The same, in the last frame.",
    ),
)  # fmt: skip
