"""Measures of the tool's path."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from mrlab_ros.core.rubrics.checked import Checked, Motion
from mrlab_ros.core.rubrics.ground import Ground
from mrlab_ros.core.rubrics.poses import no_robot
from mrlab_ros.core.rubrics.quantities import DISTANCE, NUMBER, SPEED, Quantity
from mrlab_ros.core.rubrics.rubric import Outcome
from mrlab_ros.core.rubrics.sentences import Form
from mrlab_ros.core.rubrics.threshold import Threshold

# A figure of a motion, and the instant that stands for it, s of the motion.
Figure = Callable[[Motion, Threshold], tuple[float, float]]


@dataclass(frozen=True)
class PathFigure:
    """One figure of the tool's path. words: with {} where its value is."""

    robot: str
    words: str
    figure: Figure
    threshold: Threshold

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        motions = checked.played(self.robot)
        if not motions:
            return no_robot(self.robot, checked)
        sign = -1 if self.threshold.at_least else 1
        found = [(m, *self.figure(m, self.threshold)) for m in motions]
        motion, value, time = max(found, key=lambda each: sign * each[1])
        return self.threshold.outcome(value, self.words, motion.start + time)

    def flaws(self, ground: Ground) -> Iterator[str]:
        yield from ground.robot_flaws(self.robot)
        yield from self.threshold.flaws()


def _length(motion: Motion, threshold: Threshold) -> tuple[float, float]:
    """Return the length of the path, m, and when it is too long."""
    ways = np.cumsum(np.linalg.norm(np.diff(motion.figures.tool, axis=0), axis=1))
    at = min(int(np.searchsorted(ways, threshold.limit)), len(ways) - 1)
    return float(ways[-1]), float(motion.figures.times[at + 1])


def _speed(motion: Motion, threshold: Threshold) -> tuple[float, float]:
    at = int(motion.figures.speeds.argmax())
    return float(motion.figures.speeds[at]), float(motion.figures.times[at])


def _smoothness(motion: Motion, threshold: Threshold) -> tuple[float, float]:
    """Return SPARC, 0 where nothing moves, and the largest change of the tool's speed."""
    changes = np.abs(np.diff(motion.figures.speeds))
    value = motion.figures.smoothness
    return (0.0 if value is None else value), float(motion.figures.times[int(changes.argmax())])


def _form(text: str, words: str, gap: str, quantity: Quantity, figure: Figure, about: str,
          *, at_least: bool = False) -> Form:  # fmt: skip
    return Form(
        f"{text} [of ROBOT] {'>' if at_least else '<'} {gap.upper()}",
        lambda gaps, given: PathFigure(
            gaps.get("robot") or "", words, figure,
            Threshold(quantity, gaps[gap], given.until, at_least),
        ),
        about, until=quantity,
    )  # fmt: skip


FORMS = (
    _form("path length", "The tool's path is {} long", "way", DISTANCE, _length,
          "The way of tool0 from frame to frame."),
    _form("tool speed", "The tool moves with {}", "speed", SPEED, _speed,
          "The largest speed of tool0; 250 mm/s is that of the reduced mode of ISO 10218."),
    _form("smoothness", "The smoothness is {}", "number", NUMBER, _smoothness,
          "SPARC of the tool's speed: the nearer to 0 the smoother.", at_least=True),
)  # fmt: skip
