"""Marks: what a checked file gets for each test of a rubric.

The linter finds flaws of a rubric before anybody is marked by it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from mrlab_ros.classroom.rubrics.diagnostics import (
    ALL_HIDDEN,
    CAPPED,
    EARNED_STANDING,
    HIDDEN_WITHOUT_HINT,
    LOST_BY_NONE,
    NO_MOTION_TO_MARK,
    NO_REFERENCE,
    REFERENCE_LOSES,
    REQUIRED_HIDDEN_LOST,
    REQUIRED_LOST,
)
from mrlab_ros.classroom.rubrics.rubric import Ground, Rubric, Test
from mrlab_ros.core.base.diagnostic import Diagnostic, Severity, plain
from mrlab_ros.core.checking.check_record import Checked
from mrlab_ros.core.checking.report import rounded

# Points are given in hundredths, rounded down.
HUNDREDTHS = 100
ROUNDING = 1e-9


@dataclass(frozen=True)
class Mark:
    """The result of a test. points: of `of`, on top of those of the others where it is a bonus.
    time: s, the instant at which points were lost."""

    name: str
    points: float
    of: float
    passed: bool
    found: Diagnostic
    hint: str = ""
    hidden: bool = False
    time: float | None = None
    bonus: bool = False

    def plain(self) -> dict[str, Any]:
        """Return the mark as a mapping for JSON; numbers with six decimals."""
        found: dict[str, Any] = rounded({**vars(self), "found": plain(self.found)})
        return found


@dataclass(frozen=True)
class Marks:
    """All marks of a file, in the order of the rubric. hints: of hidden tests that lost points,
    where the tests themselves are left out. note: why there was no motion to mark. most: points
    beyond which the whole earns nothing more. total: points and of how many, where tests are left
    out: the student sees the sum that the teacher sees."""

    tests: tuple[Mark, ...]
    hints: tuple[str, ...] = ()
    note: Diagnostic | None = None
    most: float = math.inf
    total: tuple[float, float] | None = None

    @property
    def points(self) -> float:
        if self.total is not None:
            return self.total[0]
        earned = math.fsum(mark.points for mark in self.tests if mark.points > 0)
        taken = math.fsum(mark.points for mark in self.tests if mark.points < 0)
        return round(min(earned, self.most) + taken, 6)

    @property
    def of(self) -> float:
        if self.total is not None:
            return self.total[1]
        return round(math.fsum(mark.of for mark in self.tests if not mark.bonus), 6)

    @property
    def lost(self) -> tuple[Mark, ...]:
        """Return the tests that lost points."""
        return tuple(mark for mark in self.tests if not mark.passed)

    def public(self) -> Marks:
        """Return what a student sees: of hidden tests the hints alone, where points were lost."""
        hints = (mark.hint for mark in self.lost if mark.hidden and mark.hint)
        return Marks(
            tuple(mark for mark in self.tests if not mark.hidden),
            tuple(dict.fromkeys(hints)),
            self.note,
            total=(self.points, self.of),
        )

    def plain(self) -> dict[str, Any]:
        """Return the marks as a mapping for JSON."""
        return {
            "points": self.points,
            "of": self.of,
            "tests": [mark.plain() for mark in self.tests],
            "hints": list(self.hints),
            "note": None if self.note is None else rounded(plain(self.note)),
        }


def mark(
    rubric: Rubric, checked: Checked, reference: Checked | None = None, late: int = 0
) -> Marks:
    """Return what a checked file gets; one without a motion gets nothing.

    reference: the checked file of `rubric.reference`, for the tests that compare with it. late:
    days that have begun since it was due.
    """
    if not marked(checked):
        return Marks(tuple(map(_without_motion, rubric.tests)), note=_refused(checked))
    alone = {test.name: _marked(test, checked, reference) for test in rubric.tests}
    tests = tuple(_bound(test, rubric, alone) for test in rubric.tests)
    caps = [test.cap for test in rubric.tests if test.cap is not None and _lost(test, alone)]
    return _taken(rubric, Marks(tests, most=min(caps, default=math.inf)), late)


def _taken(rubric: Rubric, marks: Marks, days: int) -> Marks:
    """Return marks without what a late submission loses."""
    rule = rubric.late
    if rule is None or not days:
        return marks
    taken = points_of(marks.points, rule.share(days))
    *tests, last = marks.tests
    row = replace(last, points=-taken or 0.0, passed=not taken, found=rule.found(days))
    return replace(marks, tests=(*tests, row))


def marked(checked: Checked) -> bool:
    """Return whether there is a motion that can be marked."""
    return bool(checked.motions) and checked.recorded is not None


def _without_motion(test: Test) -> Mark:
    return unmarked(test, NO_MOTION_TO_MARK())


def unmarked(test: Test, why: Diagnostic) -> Mark:
    """Return the mark of a test for which there is nothing to be marked; its hint is about a
    motion."""
    passed = not test.points  # it gives none
    return Mark(test.name, 0.0, test.points, passed, why, "", test.hidden, bonus=test.bonus)


def _lost(test: Test, alone: Mapping[str, Mark]) -> bool:
    return not alone[test.name].passed


def _bound(test: Test, rubric: Rubric, alone: Mapping[str, Mark]) -> Mark:
    """Return the mark of a test after the tests that it requires, gates and caps."""
    mark = alone[test.name]
    missing = _missing(test, {each.name: each for each in rubric.tests}, alone)
    if missing is None:
        gates = (t for t in rubric.tests if t.gate and t is not test and _lost(t, alone))
        missing = next(gates, None)
    if missing is not None:
        found = REQUIRED_HIDDEN_LOST() if missing.hidden else REQUIRED_LOST(test=missing.name)
        time = alone[missing.name].time
        return replace(mark, points=0.0, passed=False, found=found, time=time)
    if test.cap is not None and not mark.passed:
        found = CAPPED(found=mark.found, most=test.cap, severity=mark.found.severity)
        return replace(mark, found=found)
    return mark


def _missing(test: Test, tests: Mapping[str, Test], alone: Mapping[str, Mark]) -> Test | None:
    """Return the first test that is lost of all that a test requires, and that those require."""
    for name in test.requires:
        if _lost(tests[name], alone):
            return tests[name]
        if (missing := _missing(tests[name], tests, alone)) is not None:
            return missing
    return None


def _marked(test: Test, checked: Checked, reference: Checked | None) -> Mark:
    found = test.measure.assess(checked, reference)
    passed = found.share >= 1.0 - ROUNDING
    points = test.points if passed else points_of(test.points, found.share)
    severity = Severity.INFO if passed else Severity.WARNING if points else Severity.ERROR
    return Mark(
        test.name,
        points,
        test.points,
        passed,
        replace(found.found, severity=severity),
        test.hint,
        test.hidden,
        None if passed else found.time,
        test.bonus,
    )


def points_of(points: float, share: float) -> float:
    """Return a share, 0 to 1, of points, in hundredths that are rounded down."""
    share = min(max(share, 0.0), 1.0)
    hundredths = math.floor(points * share * HUNDREDTHS + ROUNDING)
    return min(hundredths / HUNDREDTHS, points)


def _refused(checked: Checked) -> Diagnostic:
    """Return why there is no motion: what the conversion said first."""
    first = next((f for f in checked.report.findings if f.refuses), None)
    return first or NO_MOTION_TO_MARK()


@dataclass(frozen=True)
class Flaw:
    """One flaw. An ERROR keeps points out of everybody's reach, a WARNING is for the teacher to
    judge. test: empty: of the rubric as a whole. line: 0: not known."""

    found: Diagnostic
    test: str = ""
    line: int = 0

    def plain(self) -> dict[str, Any]:
        """Return the flaw as a mapping for JSON."""
        return {**plain(self.found), "test": self.test, "line": self.line}


def flaws_of(rubric: Rubric, ground: Ground) -> list[Flaw]:
    """Return what a rubric cannot measure there, and what its readers will miss."""
    return [*_of_tests(rubric, ground), *map(Flaw, _of_rubric(rubric))]


def _of_tests(rubric: Rubric, ground: Ground) -> Iterator[Flaw]:
    for test in rubric.tests:
        for flaw in dict.fromkeys(test.measure.flaws(ground)):
            yield Flaw(flaw, test.name, test.line)
        if test.hidden and not test.hint:
            yield Flaw(HIDDEN_WITHOUT_HINT(), test.name, test.line)


def _of_rubric(rubric: Rubric) -> Iterator[Diagnostic]:
    if not rubric.reference:
        yield NO_REFERENCE()
    if all(test.hidden for test in rubric.tests if test.points):
        yield ALL_HIDDEN()


def flaws_of_reference(rubric: Rubric, marks: Marks) -> list[Flaw]:
    """Return a flaw for each test in which the reference solution loses points."""
    lines = {test.name: test.line for test in rubric.tests}
    return [
        Flaw(
            REFERENCE_LOSES(lost=mark.of - mark.points, of=mark.of, why=mark.found),
            mark.name,
            lines[mark.name],
        )
        for mark in marks.lost
        if not mark.bonus
    ]


def flaws_of_trials(rubric: Rubric, standing: Marks, others: Sequence[Marks]) -> Iterator[Flaw]:
    """Yield a flaw for each test that earns points without a motion, or that no trial loses.

    standing: the marks of a motion that stands still; others: of motions that are wrong.
    """
    for number, test in enumerate(rubric.tests):
        still = standing.tests[number]
        if not test.points:
            continue
        if all(marks.tests[number].passed for marks in (standing, *others)):
            yield Flaw(LOST_BY_NONE(), test.name, test.line)
        elif still.points:
            found = EARNED_STANDING(points=still.points, of=still.of)
            yield Flaw(found, test.name, test.line)
