"""Measures of how far a motion is from that of the reference solution."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.checking.checked import Checked, Motion
from mrlab_ros.core.rubrics.alignment import Apart, apart, sampled
from mrlab_ros.core.rubrics.diagnostics import (
    FROM_REFERENCE,
    NO_REFERENCE_MOTION,
    NO_REFERENCE_NAMED,
    NO_REFERENCE_OF_MODEL,
    REFERENCE_WITHIN_NOTHING,
)
from mrlab_ros.core.rubrics.ground import Ground
from mrlab_ros.core.rubrics.motions import no_motion
from mrlab_ros.core.rubrics.quantities import ANGLE, LENGTH
from mrlab_ros.core.rubrics.rubric import Measure, Outcome
from mrlab_ros.core.rubrics.sentences import Form, Gaps, Given
from mrlab_ros.core.rubrics.threshold import Threshold


@dataclass(frozen=True)
class NearReference:
    """The joints, or the tool, stay near those of the reference once both are aligned in time.
    rms: over the whole motion; else the largest distance."""

    robot: str
    tool: bool
    rms: bool
    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        if reference is None or not reference.motions:
            return Outcome(0.0, NO_REFERENCE_MOTION(), 0.0)
        motions = checked.played(self.robot)
        if not motions:
            return no_motion(self.robot, checked)
        found: list[tuple[float, float]] = []
        for number, motion in enumerate(motions):
            other = _partner(motion, number, reference)
            if other is None:
                model = motion.robot.model.id
                return Outcome(0.0, NO_REFERENCE_OF_MODEL(model=model), motion.start)
            time, off = self._apart(motion, other)
            found.append((off.rms if self.rms else off.most, time))
        value, time = max(found, key=lambda each: each[0])
        return self.threshold.outcome(
            FROM_REFERENCE,
            value,
            time,
            what="tool" if self.tool else "joint",
            how="rms" if self.rms else "most",
        )

    def _apart(self, motion: Motion, other: Motion) -> tuple[float, Apart]:
        """Return how far two motions are apart, and when the most, s."""
        times = motion.figures.times
        if self.tool:
            values, others = motion.figures.tool, other.figures.tool
        else:
            values, others = motion.trajectory.positions, other.trajectory.positions
        instants, mine = sampled(times, values)
        off = apart(mine, sampled(other.figures.times, others)[1], largest=not self.tool)
        return motion.start + float(instants[off.row]), off

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.robot_flaws(self.robot)
        yield from self.threshold.flaws()
        if not ground.reference:
            yield NO_REFERENCE_NAMED()
        if not self.threshold.limit > 0:
            yield REFERENCE_WITHIN_NOTHING()


def _partner(motion: Motion, number: int, reference: Checked) -> Motion | None:
    """Return the reference's motion of the same robot; by its name, else the same in order."""
    same = [m for m in reference.motions if m.robot.model.id == motion.robot.model.id]
    named = [m for m in same if m.robot.name == motion.robot.name]
    if named:
        return named[0]
    return same[min(number, len(same) - 1)] if same else None


def _form(text: str, gap: str, *, tool: bool, rms: bool, about: str) -> Form:
    quantity = LENGTH if tool else ANGLE

    def build(gaps: Gaps, given: Given) -> Measure:
        threshold = Threshold(quantity, gaps[gap], given.until)
        return NearReference(gaps.get("robot") or "", tool, rms, threshold)

    what = f"{text} [of ROBOT] within {gap.upper()}{' RMS' if rms else ''} of the reference"
    return Form(what, build, about, until=quantity)


FORMS = (
    _form("joints", "angle", tool=False, rms=True,
          about="The root mean square of the joint that is farthest at each instant."),
    _form("joints", "angle", tool=False, rms=False,
          about="The joint that is farthest from the reference at any instant."),
    _form("tool", "length", tool=True, rms=True,
          about="The root mean square of the distance of tool0 from that of the reference."),
    _form("tool", "length", tool=True, rms=False,
          about="The largest distance of tool0 from that of the reference."),
)  # fmt: skip
