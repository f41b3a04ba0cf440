"""Measures of time, and of how a cell is played."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mrlab_ros.core.rubrics.checked import Checked
from mrlab_ros.core.rubrics.contacts import recording
from mrlab_ros.core.rubrics.ground import Ground
from mrlab_ros.core.rubrics.poses import no_robot
from mrlab_ros.core.rubrics.quantities import TIME
from mrlab_ros.core.rubrics.rubric import Measure, Outcome
from mrlab_ros.core.rubrics.sentences import Form, Gaps, Given
from mrlab_ros.core.rubrics.threshold import Threshold


@dataclass(frozen=True)
class Cycle:
    """The longest time of a robot from its first motion to its last; or (`total`) of all that is
    played, waits and dwells included."""

    robot: str
    total: bool
    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        if self.total:
            value = recording(checked).duration
            stuck = recording(checked).stuck
            if stuck:
                robot, wait = next(iter(stuck.items()))
                words = f"{robot} waits for ever: '{wait}' does not come true."
                return Outcome(0.0, words, value, None, self.threshold.limit, "s")
            return self._judged(value, "The whole lasts {}", 0.0)
        motions = checked.played(self.robot)
        if not motions:
            return no_robot(self.robot, checked)
        longest = max(motions, key=lambda m: m.figures.cycle)
        return self._judged(longest.figures.cycle, "The cycle lasts {}", longest.start)

    def _judged(self, value: float, words: str, start: float) -> Outcome:
        # From this instant on it lasts too long.
        return self.threshold.outcome(value, words, start + min(self.threshold.limit, value))

    def flaws(self, ground: Ground) -> Iterator[str]:
        yield from ground.robot_flaws(self.robot)
        yield from self.threshold.flaws()


@dataclass(frozen=True)
class Mode:
    """A cell is played in parallel or one after another."""

    mode: str

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        if not checked.mode:
            return Outcome(0.0, f"It is one motion; expected a cell in {self.mode} mode.", 0.0)
        if checked.mode == self.mode:
            return Outcome(1.0, f"The cell is played in {self.mode} mode.")
        words = f"The cell is played in {checked.mode} mode; expected {self.mode}."
        return Outcome(0.0, words, 0.0)

    def flaws(self, ground: Ground) -> Iterator[str]:
        if ground.cell is False:
            yield "the reference is one motion, which has no mode; name a cell (.yaml)"


def _time(total: bool) -> Form:
    return Form(
        "total time < TIME" if total else "cycle [of ROBOT] < TIME",
        lambda gaps, given: Cycle(
            gaps.get("robot") or "", total, Threshold(TIME, gaps["time"], given.until)
        ),
        "Of all that is played, waits and dwells included." if total
        else "From the first motion of a joint to the last; of several robots the longest.",
        until=TIME,
    )  # fmt: skip


def _mode(mode: str) -> Form:
    def build(gaps: Gaps, given: Given) -> Measure:
        return Mode(mode)

    return Form(f"{mode} mode used", build, f"The cell that is handed in says `mode: {mode}`.")


FORMS = (_time(False), _time(True), _mode("parallel"), _mode("sequential"))
