"""What measures of a robot's motions share."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from mrlab_ros.core.base.diagnostic import Code, Diagnostic
from mrlab_ros.core.checking.checked import Checked, Motion
from mrlab_ros.core.rubrics.diagnostics import MEMBER_WAITS_FOREVER, NO_MOTION_OF
from mrlab_ros.core.rubrics.ground import Ground
from mrlab_ros.core.rubrics.rubric import Outcome
from mrlab_ros.core.rubrics.threshold import Threshold


@dataclass(frozen=True)
class Figure:
    """A figure of a motion. value: in SI; time: s of the motion, the instant that stands for it;
    code: what is found, with `values` beside the figure and its limit."""

    value: float
    time: float
    code: Code
    values: Mapping[str, Any] = field(default_factory=dict)


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
        time = motion.start + worst.time
        return self.threshold.outcome(worst.code, worst.value, time, **worst.values)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.robot_flaws(self.robot)
        yield from self.threshold.flaws()


def no_motion(robot: str, checked: Checked) -> Outcome:
    """Return what a test gets whose robot has no motion, or has not played it to its end."""
    for motion in checked.of(robot):
        if (wait := checked.stuck.get(motion.robot.name)) is not None:
            found = MEMBER_WAITS_FOREVER(robot=motion.robot.name, wait=wait)
            return Outcome(0.0, found, motion.start)
    names = [m.robot.name for m in checked.motions]
    return Outcome(0.0, NO_MOTION_OF(robot=robot, robots=names), 0.0)
