"""Measures of the tool's path."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mrlab_ros.classroom.rubrics.diagnostics import PATH_LENGTH, SMOOTHNESS, TOOL_SPEED
from mrlab_ros.classroom.rubrics.rubric import (
    DISTANCE,
    NUMBER,
    SPEED,
    Figure,
    Quantity,
    Threshold,
    WorstFigure,
)
from mrlab_ros.classroom.rubrics.sentences import Form
from mrlab_ros.core.checking.check_record import Motion


def _length(motion: Motion, threshold: Threshold) -> Figure:
    """Return the length of the path, m, and when it is too long."""
    ways = np.cumsum(np.linalg.norm(np.diff(motion.figures.tool, axis=0), axis=1))
    at = min(int(np.searchsorted(ways, threshold.limit)), len(ways) - 1)
    time = float(motion.figures.times[at + 1])
    return Figure(float(ways[-1]), time, PATH_LENGTH)


def _speed(motion: Motion, threshold: Threshold) -> Figure:
    """Return the largest speed of the tool, m/s."""
    at = int(motion.figures.speeds.argmax())
    time = float(motion.figures.times[at])
    return Figure(float(motion.figures.speeds[at]), time, TOOL_SPEED)


def _smoothness(motion: Motion, threshold: Threshold) -> Figure:
    """Return SPARC at the largest change of the tool's speed."""
    changes = np.abs(np.diff(motion.figures.speeds))
    time = float(motion.figures.times[int(changes.argmax())])
    return Figure(motion.figures.smoothness or 0.0, time, SMOOTHNESS)


def _form(text: str, gap: str, quantity: Quantity, figure: Callable[[Motion, Threshold], Figure],
          about: str, *, at_least: bool = False) -> Form:  # fmt: skip
    return Form(
        f"{text} [of ROBOT] {'>' if at_least else '<'} {gap.upper()}",
        lambda gaps, given: WorstFigure(
            gaps.get("robot") or "", figure,
            Threshold(quantity, gaps[gap], given.until, at_least), moving=True,
        ),
        about, until=quantity,
    )  # fmt: skip


FAMILY = "path"
FORMS = (
    _form("path length", "way", DISTANCE, _length, "The way of tool0 from frame to frame."),
    _form("tool speed", "speed", SPEED, _speed,
          "The largest speed of tool0; 250 mm/s is that of the reduced mode of ISO 10218."),
    _form("smoothness", "number", NUMBER, _smoothness,
          "SPARC of the tool's speed: the nearer to 0 the smoother.", at_least=True),
)  # fmt: skip
