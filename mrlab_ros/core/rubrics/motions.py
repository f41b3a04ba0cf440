"""What measures of a robot's motions share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from mrlab_ros.core.rubrics.checked import Checked, Motion
from mrlab_ros.core.rubrics.ground import Ground
from mrlab_ros.core.rubrics.rubric import Outcome
from mrlab_ros.core.rubrics.threshold import Threshold


@dataclass(frozen=True)
class Figure:
    """A figure of a motion. value: in SI; time: s of the motion, the instant that stands for it;
    words: a sentence without its end, {} where the value is."""

    value: float
    time: float
    words: str


@dataclass(frozen=True)
class WorstFigure:
    """A figure of the motions of a robot, of all of them where `robot` is empty: the worst.

    figure: a function of a module, for rubrics are pickled on their way to other processes.
    """

    robot: str
    figure: Callable[[Motion, Threshold], Figure]
    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        motions = checked.played(self.robot)
        if not motions:
            return no_motion(self.robot, checked)
        sign = -1 if self.threshold.at_least else 1
        found = ((motion, self.figure(motion, self.threshold)) for motion in motions)
        motion, worst = max(found, key=lambda each: sign * each[1].value)
        return self.threshold.outcome(worst.value, worst.words, motion.start + worst.time)

    def flaws(self, ground: Ground) -> Iterator[str]:
        yield from ground.robot_flaws(self.robot)
        yield from self.threshold.flaws()


def no_motion(robot: str, checked: Checked) -> Outcome:
    """Return what a test gets whose robot has no motion, or has not played it to its end."""
    for motion in checked.of(robot):
        if (wait := checked.stuck.get(motion.robot.name)) is not None:
            words = f"{motion.robot.name} waits for ever: '{wait}' does not come true."
            return Outcome(0.0, words, motion.start)
    names = ", ".join(m.robot.name for m in checked.motions)
    return Outcome(0.0, f"{robot} has no motion in this file; those that have: {names}.", 0.0)
