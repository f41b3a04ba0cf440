"""Measures of how a motion begins and ends."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from mrlab_ros.classroom.rubrics.diagnostics import (
    AT_REST,
    JOINT_FROM,
    NOT_AT_REST,
    OUT_OF_REACH,
    TOOL_FROM_PLACE,
)
from mrlab_ros.classroom.rubrics.measures.poses import nearest
from mrlab_ros.classroom.rubrics.rubric import (
    ANGLE,
    LENGTH,
    Figure,
    Ground,
    Outcome,
    Threshold,
    WorstFigure,
    no_motion,
)
from mrlab_ros.classroom.rubrics.sentences import Form
from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.base.geometry import Array, Vector
from mrlab_ros.core.checking.check_record import Checked, Motion
from mrlab_ros.core.checking.joint_limits import REST_SHARE

# How near every joint is to its home where the sentence names no angle, rad.
HOME = float(np.radians(1.0))


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
            return no_motion(self.robot, checked)
        at = -1 if self.last else 0
        tool = motion.figures.tool[at]
        count = len(self.place)
        off = float(np.linalg.norm(tool[:count] - np.asarray(self.place)))
        time = motion.start + _instant(motion, self.last)
        return self.threshold.outcome(
            TOOL_FROM_PLACE, off, time, place=self.place, instant=_name(self.last)
        )

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.robot_flaws(self.robot)
        yield from self.threshold.flaws()
        robots = ground.of(self.robot)
        short = [nearest(robot, self.place, None) for robot in robots if len(self.place) == 3]
        if short and min(short) > self.threshold.limit:
            yield OUT_OF_REACH(place=self.place, value=min(short), limit=self.threshold.limit)


@dataclass(frozen=True)
class AtRest:
    """Every joint begins or ends at no more than 2% of its largest speed."""

    robot: str
    last: bool

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        motions = checked.played(self.robot)
        if not motions:
            return no_motion(self.robot, checked)
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
        of: dict[str, Any] = {
            "instant": _name(self.last),
            "value": share,
            "limit": REST_SHARE,
            "unit": "%",
        }
        if share <= REST_SHARE:
            return Outcome(1.0, AT_REST(**of))
        time = motion.start + _instant(motion, self.last)
        return Outcome(0.0, NOT_AT_REST(**of, joint=joint), time)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.robot_flaws(self.robot)


def _first_off_home(motion: Motion, threshold: Threshold) -> Figure:
    """Return how far the farthest joint begins from its robot's home, rad."""
    return _farthest(motion, motion.robot.model.home, False, "home")


def _last_off_home(motion: Motion, threshold: Threshold) -> Figure:
    """Return how far the farthest joint ends from its robot's home, rad."""
    return _farthest(motion, motion.robot.model.home, True, "home")


def _off_start(motion: Motion, threshold: Threshold) -> Figure:
    """Return how far the farthest joint ends from where the motion began, rad."""
    return _farthest(motion, motion.trajectory.positions[0], True, "start")


def _farthest(motion: Motion, wanted: Array, last: bool, origin: str) -> Figure:
    """Return how far the farthest joint begins or ends from `wanted`, (J,) rad."""
    off = np.abs(motion.trajectory.positions[-1 if last else 0] - wanted)
    worst = int(off.argmax())
    joint = motion.robot.model.joint_names[worst]
    values = {"joint": joint, "instant": _name(last), "origin": origin}
    return Figure(float(off[worst]), _instant(motion, last), JOINT_FROM, values)


def _name(last: bool) -> str:
    return "end" if last else "start"


def _instant(motion: Motion, last: bool) -> float:
    """Return when a motion begins or ends, s of the motion."""
    return float(motion.figures.times[-1]) if last else 0.0


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


def _near(text: str, figure: Callable[[Motion, Threshold], Figure], about: str) -> Form:
    return Form(
        f"{text} [within ANGLE] [by ROBOT]",
        lambda gaps, given: WorstFigure(
            gaps.get("robot") or "", figure,
            Threshold(ANGLE, HOME if gaps.get("angle") is None else gaps["angle"], given.until),
        ),
        about, until=ANGLE,
    )  # fmt: skip


FAMILY = "poses, beginning and end"
FORMS = (
    _end(False),
    _end(True),
    _near(
        "begins at home", _first_off_home,
        "Every joint of the first frame, within 1 deg by itself.",
    ),
    _near(
        "ends at home", _last_off_home,
        "Every joint of the last frame.",
    ),
    _near("ends where it began", _off_start, "Every joint of the last frame."),
    Form(
        "begins at rest [by ROBOT]", lambda gaps, given: AtRest(gaps.get("robot") or "", False),
        "No joint faster than 2% of its limit in the first frame.",
    ),
    Form(
        "ends at rest [by ROBOT]", lambda gaps, given: AtRest(gaps.get("robot") or "", True),
        "The same, in the last frame.",
    ),
)  # fmt: skip
