"""Measures of how near the joints come to their limits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mrlab_ros.classroom.rubrics.diagnostics import (
    LIMIT_NOT_STATED,
    LIMIT_USED,
    NO_SHARE_OF_LIMITS,
    NO_SUCH_LIMIT,
)
from mrlab_ros.classroom.rubrics.rubric import SHARE, Ground, Outcome, Threshold, no_motion, stands
from mrlab_ros.classroom.rubrics.sentences import Form
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.checking.check_record import Checked, Motion

RANGES, SPEEDS, ACCELERATIONS, JERKS = "ranges", "speeds", "acceleration", "jerk"


@dataclass(frozen=True)
class WithinLimits:
    """No joint uses more than a share of its limits. of: which; of a range, half of it is to
    either side of its middle."""

    robot: str
    of: tuple[str, ...]
    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        motions = checked.played(self.robot)
        if not motions:
            return no_motion(self.robot, checked)
        if standing := stands(motions):
            return standing
        uses = [use for motion in motions for use in self._uses(motion)]
        if not uses:
            return Outcome(0.0, NO_SUCH_LIMIT(of=self.of[0]), 0.0)
        share, time, joint, of = max(uses, key=lambda use: use[0])
        return self.threshold.outcome(LIMIT_USED, share, time, joint=joint, of=of)

    def _uses(self, motion: Motion) -> Iterator[tuple[float, float, str, str]]:
        """Yield of each joint the share of a limit that it uses, when, s, its name and which."""
        q = motion.trajectory.positions
        for column, one in enumerate(motion.figures.joints):
            joint, start = one.joint, motion.start
            if RANGES in self.of and np.isfinite([joint.lower, joint.upper]).all():
                middle, half = (joint.lower + joint.upper) / 2, (joint.upper - joint.lower) / 2
                shares = np.abs(q[:, column] - middle) / half
                at = int(shares.argmax())
                time = start + float(motion.figures.times[at])
                yield float(shares[at]), time, joint.name, RANGES
            if SPEEDS in self.of:
                yield one.speed_share, start + one.speed_time, joint.name, SPEEDS
            for what, value, time in (
                (ACCELERATIONS, one.acceleration, one.acceleration_time),
                (JERKS, one.jerk, one.jerk_time),
            ):
                limit = getattr(one.stated, what) if what in self.of else None
                if limit is not None:
                    yield value / limit, start + time, joint.name, what

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.robot_flaws(self.robot)
        yield from self.threshold.flaws()
        if not 0 < self.threshold.limit <= 1:
            yield NO_SHARE_OF_LIMITS(value=self.threshold.limit)
        for what in (ACCELERATIONS, JERKS):
            if what not in self.of:
                continue
            for robot in ground.of(self.robot):
                missing = [
                    joint.name
                    for joint in robot.model.joints
                    if getattr(robot.stated.get(joint.name), what, None) is None
                ]
                if missing:
                    yield LIMIT_NOT_STATED(model=robot.model.id, of=what, joints=missing)


def _limits(text: str, of: tuple[str, ...], about: str) -> Form:
    return Form(
        f"within SHARE of {text} [by ROBOT]",
        lambda gaps, given: WithinLimits(
            gaps.get("robot") or "", of, Threshold(SHARE, gaps["share"], given.until)
        ),
        about,
        until=SHARE,
    )


FAMILY = "limits"
FORMS = (
    _limits("limits", (RANGES, SPEEDS), "Of the range, from its middle, and of the speed."),
    _limits("ranges", (RANGES,), "Of the range of each joint, from its middle."),
    _limits("speed limits", (SPEEDS,), "Of the largest speed of each joint."),
    _limits("acceleration limits", (ACCELERATIONS,), "Only where `robot.yaml` states it."),
    _limits("jerk limits", (JERKS,), "Only where `robot.yaml` states it."),
)
