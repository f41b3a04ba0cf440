"""A rubric: what a motion is for, and named tests with points.

With it stands all that measures share: quantities as people write them (5 mm, 30 deg, 80%), the
robots, objects and surfaces that a sentence may name, and figures against their limits.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Protocol, cast

from mrlab_ros.classroom.rubrics.diagnostics import (
    BEYOND_MOST,
    MEMBER_WAITS_FOREVER,
    NEVER_HELD,
    NEVER_LOST,
    NO_MOTION_OF,
    NO_UNIT,
    NOT_A_NUMBER,
    OBJECT_IS_FIXED,
    OBJECT_NOT_IN_SCENE,
    OTHER_UNIT,
    PARTIAL_GIVES_NOTHING,
    QUANTITY,
    STANDS_STILL,
    THING_NOT_IN_SCENE,
)
from mrlab_ros.core.base.diagnostic import Code, Diagnostic
from mrlab_ros.core.base.diagnostics import NO_ROBOT_IN_SCENE
from mrlab_ros.core.base.errors import BadInput
from mrlab_ros.core.base.names import close_to
from mrlab_ros.core.checking.check_record import Checked, Motion
from mrlab_ros.core.checking.evidence import CLOSE
from mrlab_ros.core.checking.motion import CheckedRobot
from mrlab_ros.core.physics.catalogue import ObjectType
from mrlab_ros.core.scene.document import SceneDocument
from mrlab_ros.core.scene.surfaces import FLOOR

ITSELF = "itself"


@dataclass(frozen=True, eq=False)
class Ground:
    """Everything that a rubric may name. robots: all of the scene, or the one of the rubric.

    types: of the objects, by their names. cell: whether a cell is marked; None: not known.
    reference: whether the rubric names a reference solution.
    """

    scene: SceneDocument
    robots: tuple[CheckedRobot, ...]
    types: Mapping[str, ObjectType] = field(default_factory=dict)
    cell: bool | None = None
    reference: bool = False

    @cached_property
    def surfaces(self) -> tuple[str, ...]:
        """Return the surfaces; a scene without any has a floor."""
        return tuple(s.name for s in self.scene.surfaces) or (FLOOR,)

    def of(self, robot: str) -> tuple[CheckedRobot, ...]:
        """Return the robots of a name or of a model; empty: all."""
        return tuple(r for r in self.robots if robot in ("", r.name, r.model.id))

    def robot_flaws(self, *robots: str) -> Iterator[Diagnostic]:
        """Yield what is wrong with names of robots; empty ones are left out."""
        names = [r.name for r in self.robots]
        for robot in robots:
            if robot and not self.of(robot):
                yield NO_ROBOT_IN_SCENE(robot=robot, known=names, close=close_to(robot, names))

    def object_flaws(self, thing: str) -> Iterator[Diagnostic]:
        """Yield what is wrong with the name of an object."""
        names = [o.name for o in self.scene.objects]
        if thing and thing not in names:
            yield OBJECT_NOT_IN_SCENE(object=thing, known=names, close=close_to(thing, names))

    def thing_flaws(self, thing: str) -> Iterator[Diagnostic]:
        """Yield what is wrong with the name of an object, a surface or a robot."""
        names = [o.name for o in self.scene.objects]
        names += [*self.surfaces, *(r.name for r in self.robots), ITSELF]
        if thing and thing not in names:
            yield THING_NOT_IN_SCENE(thing=thing, known=names, close=close_to(thing, names))

    def graspable_flaws(self, thing: str) -> Iterator[Diagnostic]:
        """Yield what is wrong with an object that shall be held."""
        yield from self.object_flaws(thing)
        kind = self.types.get(thing)
        if kind is not None and kind.mass <= 0:
            yield OBJECT_IS_FIXED(object=thing)


# A number and, behind it, its unit or whatever stands there.
WRITTEN = r"[-+]?[\d.,]*\d[\d.,]*(?:e[-+]?\d+)?\s?(?:%|°|[a-zµ]+(?:/[a-z]+)?)?"
_PARTS = re.compile(r"([-+]?[\d.,]*\d[\d.,]*(?:e[-+]?\d+)?)\s?(.*)")


@dataclass(frozen=True)
class Quantity:
    """A kind of quantity. units: what each is in SI, the first is that of the example; si: the
    unit in SI. most: of SI, beyond which a value is a slip."""

    noun: str
    units: dict[str, float]
    si: str
    example: str
    most: float

    def read(self, text: str, unit: str = "") -> float:
        """Return the value in SI; unit: where the text has none. Raises BadInput."""
        match = _PARTS.fullmatch(text.strip())
        number, given = (match[1], match[2].strip() or unit) if match else (text, unit)
        try:
            value = float(number)
        except ValueError:
            better = number.replace(",", ".") if "," in number else None
            raise BadInput(
                NOT_A_NUMBER(text=text, better=better, expected=self.expected)
            ) from None
        if given not in self.units:
            if not given:
                raise BadInput(NO_UNIT(text=text, expected=self.expected))
            raise BadInput(OTHER_UNIT(text=text, given=given, expected=self.expected))
        value *= self.units[given]
        if not -self.most <= value <= self.most or not math.isfinite(value):
            raise BadInput(
                BEYOND_MOST(text=text, limit=self.most, unit=self.si, expected=self.expected)
            )
        return value

    @property
    def expected(self) -> Diagnostic:
        units = [unit for unit in self.units if unit]
        return QUANTITY(quantity=self.noun, example=self.example, units=units)


LENGTH = Quantity("length", {"mm": 1e-3, "cm": 1e-2, "m": 1.0}, "m", "5 mm", 100.0)
DISTANCE = Quantity("length", {"m": 1.0, "cm": 1e-2, "mm": 1e-3}, "m", "1.5 m", 1e4)
ANGLE = Quantity(
    "angle",
    {"deg": math.pi / 180, "°": math.pi / 180, "rad": 1.0},
    "rad", "10 deg", 4 * math.pi,
)  # fmt: skip
TIME = Quantity(
    "time", {"s": 1.0, "ms": 1e-3, "min": 60.0, "sec": 1.0, "seconds": 1.0}, "s", "4 s", 1e6
)
SPEED = Quantity("speed", {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3}, "m/s", "250 mm/s", 100.0)
SHARE = Quantity("share", {"%": 0.01}, "%", "80%", 10.0)
NUMBER = Quantity("number", {"": 1.0}, "", "-3", 1e6)


@dataclass(frozen=True)
class Outcome:
    """The result of a measure. share: of the points, 0 to 1; found: for the student, with
    value, limit and unit where the measure is a number.

    time: s, the instant at which points are lost, None where there is none.
    """

    share: float
    found: Diagnostic
    time: float | None = None


class Measure(Protocol):
    """One expectation, as a sentence of a rubric states it."""

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        """Return what a file that holds a motion gets; reference: the solution's motion."""
        ...

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        """Yield why it cannot be measured there."""
        ...


class Taking(Measure, Protocol):
    """The rule for late submissions, in the place of a measure."""

    def days(self, handed_in: float | None, late: bool) -> int: ...
    def share(self, days: int) -> float: ...
    def found(self, days: int) -> Diagnostic: ...


@dataclass(frozen=True)
class Test:
    """One test. expect: its sentence. hint: what a student reads who loses points.

    hidden: a student sees neither its name nor its numbers. partial: the rule by which a part of
    the points is given, as the rubric has it; empty: all or nothing. line: in the rubric's file.

    requires: names of tests that must be passed for this one to earn points. gate: where it is
    not passed, no other test earns points. cap: the most that the whole earns then, None: no
    limit. bonus: its points come on top of those of the others.
    """

    __test__ = False  # no test of pytest's

    name: str
    expect: str
    measure: Measure
    points: float
    hint: str = ""
    hidden: bool = False
    partial: str = ""
    line: int = 0
    requires: tuple[str, ...] = ()
    gate: bool = False
    cap: float | None = None
    bonus: bool = False


@dataclass(frozen=True)
class Rubric:
    """A rubric. robot: a model, empty: that of the file or the scene. scene: a name, or a file.

    reference: a file whose motion must get full marks; scene and reference are relative to the
    folder of the rubric's file where they are files. closest: m, below it a distance is a warning.
    files: a pattern of the names of files that are handed in. origin: where the rubric was read.
    plain: what it was read from, for a digest.
    """

    name: str
    tests: tuple[Test, ...]
    robot: str = ""
    tool: str = ""
    scene: str = ""
    reference: str = ""
    closest: float = CLOSE
    files: str = ""
    about: str = ""
    origin: str = ""
    plain: Mapping[str, Any] | None = None

    @property
    def late(self) -> Taking | None:
        """Return the rule for late submissions, whose row is the last one; None: there is none."""
        last = self.tests[-1] if self.tests else None
        return None if last is None or last.points else cast("Taking", last.measure)

    @property
    def points(self) -> float:
        """Return the points of all tests, without those on top."""
        return sum(test.points for test in self.tests if not test.bonus)


# Of a limit that is met but for a last decimal.
ROUNDING = 1e-9


@dataclass(frozen=True)
class Threshold:
    """limit: in SI; a figure shall be at most that, or at least where `at_least`. until: where no
    points are left, None: just beyond the limit."""

    quantity: Quantity
    limit: float
    until: float | None = None
    at_least: bool = False

    def share(self, value: float) -> float:
        """Return the share of the points, 0 to 1: all up to the limit, then evenly less."""
        beyond = self.limit - value if self.at_least else value - self.limit
        if beyond <= ROUNDING * max(1.0, abs(self.limit)):
            return 1.0
        if self.until is None:
            return 0.0
        span = abs(self.until - self.limit)
        return max(1.0 - beyond / span, 0.0) if span > 0 else 0.0

    @property
    def _unholdable(self) -> bool:
        """Return whether no figure is at most, or at least, the limit: SPARC is below 0, all other
        figures above."""
        if self.at_least:
            return self.quantity is NUMBER and self.limit >= 0
        return self.limit < 0 or (self.quantity is TIME and self.limit == 0)

    def outcome(self, code: Code, value: float, time: float | None, /, **values: Any) -> Outcome:
        """Return what a figure gets; code: what is found, with a limit."""
        of: dict[str, Any] = {"value": value, "limit": self.limit, "unit": self.quantity.si}
        return Outcome(self.share(value), code(**of, **values), time)

    def flaws(self) -> Iterator[Diagnostic]:
        """Yield why no motion can hold the limit, or why no part of the points can be given."""
        if self._unholdable:
            yield NEVER_HELD(limit=self.limit, unit=self.quantity.si)
        if self.at_least and self.quantity is not NUMBER and self.limit <= 0:
            yield NEVER_LOST(limit=self.limit, unit=self.quantity.si)
        if self.until is None:
            return
        if self.until >= self.limit if self.at_least else self.until <= self.limit:
            yield PARTIAL_GIVES_NOTHING(
                until=self.until,
                side="below" if self.at_least else "above",
                limit=self.limit,
                unit=self.quantity.si,
            )


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
    moving: a robot that stands still gets nothing.
    """

    robot: str
    figure: Callable[[Motion, Threshold], Figure]
    threshold: Threshold
    moving: bool = False

    def assess(self, checked: Checked, reference: Checked | None) -> Outcome:
        motions = checked.played(self.robot)
        if not motions:
            return no_motion(self.robot, checked)
        if self.moving and (standing := stands(motions)):
            return standing
        sign = -1 if self.threshold.at_least else 1
        found = ((motion, self.figure(motion, self.threshold)) for motion in motions)
        motion, worst = max(found, key=lambda each: sign * each[1].value)
        time = motion.start + worst.time
        return self.threshold.outcome(worst.code, worst.value, time, **worst.values)

    def flaws(self, ground: Ground) -> Iterator[Diagnostic]:
        yield from ground.robot_flaws(self.robot)
        yield from self.threshold.flaws()


def stands(motions: Sequence[Motion]) -> Outcome | None:
    """Return what a test of a motion gets whose robot stands still, None where all move."""
    for motion in motions:
        if motion.figures.cycle <= 0:
            return Outcome(0.0, STANDS_STILL(robot=motion.robot.name), motion.start)
    return None


def no_motion(robot: str, checked: Checked) -> Outcome:
    """Return what a test gets whose robot has no motion, or has not played it to its end."""
    for motion in checked.of(robot):
        if (wait := checked.stuck.get(motion.robot.name)) is not None:
            found = MEMBER_WAITS_FOREVER(robot=motion.robot.name, wait=wait)
            return Outcome(0.0, found, motion.start)
    names = [m.robot.name for m in checked.motions]
    return Outcome(0.0, NO_MOTION_OF(robot=robot, robots=names), 0.0)
