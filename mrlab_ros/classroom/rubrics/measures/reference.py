"""Measures of how far a motion is from that of the reference solution.

Both motions are aligned in time first.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mrlab_ros.classroom.rubrics.diagnostics import (
    FROM_REFERENCE,
    NO_REFERENCE_MOTION,
    NO_REFERENCE_NAMED,
    NO_REFERENCE_OF_MODEL,
    REFERENCE_WITHIN_NOTHING,
)
from mrlab_ros.classroom.rubrics.rubric import (
    ANGLE,
    LENGTH,
    Ground,
    Measure,
    Outcome,
    Threshold,
    no_motion,
)
from mrlab_ros.classroom.rubrics.sentences import Form, Gaps, Given
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Array
from mrlab_ros.core.checking.check_record import Checked, Motion

SAMPLES = 200  # of each motion


@dataclass(frozen=True, eq=False)
class Apart:
    """How far aligned motions are apart. most: at `row` of the first motion's samples; rms: over
    all samples of the one from the other, whichever is larger."""

    most: float
    rms: float
    row: int


def sampled(times: Array, values: Array) -> tuple[Array, Array]:
    """Return SAMPLES instants, s, evenly over a motion, and its (SAMPLES, D) values there."""
    instants = np.linspace(times[0], times[-1], SAMPLES)
    columns = [np.interp(instants, times, column) for column in values.T]
    return instants, np.stack(columns, axis=1)


def aligned(first: Array, second: Array) -> NDArray[np.intp]:
    """Return the pairs (P, 2) of samples, (N, D) and (M, D), that belong together.

    Dynamic time warping (Sakoe and Chiba 1978): both begin and end together, neither goes back,
    and the sum of the squared distances is the least. Costs N x M; computed along antidiagonals.
    """
    n, m = len(first), len(second)
    cost = ((first[:, None, :] - second[None, :, :]) ** 2).sum(axis=2)
    total = np.full((n + 1, m + 1), np.inf)
    total[0, 0] = 0.0
    for diagonal in range(2, n + m + 1):
        i = np.arange(max(1, diagonal - m), min(n, diagonal - 1) + 1)
        j = diagonal - i
        before = np.minimum(np.minimum(total[i - 1, j - 1], total[i - 1, j]), total[i, j - 1])
        total[i, j] = cost[i - 1, j - 1] + before
    pairs: list[tuple[int, int]] = []
    a, b = n, m
    while a or b:
        pairs.append((a - 1, b - 1))
        steps = ((a - 1, b - 1), (a - 1, b), (a, b - 1))
        a, b = min(steps, key=lambda step: float(total[step]))
    return np.array(pairs[::-1], dtype=np.intp)


def apart(first: Array, second: Array, *, largest: bool) -> Apart:
    """Return how far samples (N, D) and the aligned ones of (M, D) are apart.

    A sample is compared with the straight way between the samples beside its partner, of either
    motion: a part of the second that the first leaves out counts. largest: the largest of the D
    differences counts; else their Euclidean length.
    """
    pairs = aligned(first, second)
    mine = _distances(first, second, pairs, largest=largest)
    others = _distances(second, first, pairs[:, ::-1], largest=largest)
    rms = max(float(np.sqrt((each**2).mean())) for each in (mine, others))
    if mine.max() >= others.max():
        row = int(mine.argmax())
    else:
        row = int(pairs[pairs[:, 1] == others.argmax(), 0][0])
    return Apart(float(max(mine.max(), others.max())), rms, row)


def _distances(first: Array, second: Array, pairs: NDArray[np.intp], *, largest: bool) -> Array:
    """Return the distance (N,) of each sample of the first from the way of the second."""
    distances = np.full(len(first), np.inf)
    for offset in (-1, 0):
        start = np.clip(pairs[:, 1] + offset, 0, len(second) - 1)
        end = np.clip(start + 1, 0, len(second) - 1)
        way = second[end] - second[start]
        length = np.maximum((way**2).sum(axis=1), 1e-18)
        off = first[pairs[:, 0]] - second[start]
        share = np.clip((off * way).sum(axis=1) / length, 0.0, 1.0)
        off = off - share[:, None] * way
        norms = np.abs(off).max(axis=1) if largest else np.linalg.norm(off, axis=1)
        np.minimum.at(distances, pairs[:, 0], norms)
    return distances


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


FAMILY = "reference"
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
