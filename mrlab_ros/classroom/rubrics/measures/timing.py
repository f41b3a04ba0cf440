"""Measures of time, and of how a cell is played."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mrlab_ros.classroom.rubrics.diagnostics import (
    CYCLE_TIME,
    MEMBER_WAITS_FOREVER,
    MODE_OF_ONE_MOTION,
    MODE_USED,
    NO_CELL,
    OTHER_MODE,
    TOTAL_TIME,
)
from mrlab_ros.classroom.rubrics.measures.contacts import recording
from mrlab_ros.classroom.rubrics.rubric import (
    TIME,
    Figure,
    Ground,
    Measure,
    Outcome,
    Threshold,
    WorstFigure,
    stands,
)
from mrlab_ros.classroom.rubrics.sentences import Form, Gaps, Given
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.checking.check_record import Checked, Motion


@dataclass(frozen=True)
class TotalTime:
    """The time of all that is played, waits and dwells included."""

    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        value = recording(checked).duration
        stuck = recording(checked).stuck
        if stuck:
            robot, wait = next(iter(stuck.items()))
            return Outcome(0.0, MEMBER_WAITS_FOREVER(robot=robot, wait=wait), value)
        if standing := stands(checked.motions):
            return standing
        # From the limit on it lasts too long.
        at = min(self.threshold.limit, value)
        return self.threshold.outcome(TOTAL_TIME, value, at)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from self.threshold.flaws()


@dataclass(frozen=True)
class Mode:
    """A cell is played in parallel or one after another."""

    mode: str

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        if not checked.mode:
            return Outcome(0.0, NO_CELL(mode=self.mode), 0.0)
        if checked.mode == self.mode:
            return Outcome(1.0, MODE_USED(mode=self.mode))
        return Outcome(0.0, OTHER_MODE(found=checked.mode, mode=self.mode), 0.0)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        if ground.cell is False:
            yield MODE_OF_ONE_MOTION()


def _cycle(motion: Motion, threshold: Threshold) -> Figure:
    """Return the time from a robot's first motion to its last, s, and when it is too long."""
    value = motion.figures.cycle
    return Figure(value, min(threshold.limit, value), CYCLE_TIME)


def _mode(mode: str) -> Form:
    def build(gaps: Gaps, given: Given) -> Measure:
        return Mode(mode)

    return Form(f"{mode} mode used", build, f"The cell that is handed in says `mode: {mode}`.")


FAMILY = "time and mode"
FORMS = (
    Form(
        "cycle [of ROBOT] < TIME",
        lambda gaps, given: WorstFigure(
            gaps.get("robot") or "",
            _cycle,
            Threshold(TIME, gaps["time"], given.until),
            moving=True,
        ),
        "From the first motion of a joint to the last; of several robots the longest.",
        until=TIME,
    ),
    Form(
        "total time < TIME",
        lambda gaps, given: TotalTime(Threshold(TIME, gaps["time"], given.until)),
        "Of all that is played, waits and dwells included.",
        until=TIME,
    ),
    _mode("parallel"),
    _mode("sequential"),
)
