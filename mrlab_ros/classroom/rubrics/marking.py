"""Marks: what a checked file gets for each test of a rubric.

The linter finds flaws of a rubric before anybody is marked by it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from mrlab_ros.classroom.rubrics.diagnostics import (
    ALL_HIDDEN,
    HIDDEN_WITHOUT_HINT,
    NO_MOTION_TO_MARK,
    NO_REFERENCE,
    REFERENCE_LOSES,
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
    """The result of a test. points: of `of`. time: s, the instant at which points were lost."""

    name: str
    points: float
    of: float
    passed: bool
    found: Diagnostic
    hint: str = ""
    hidden: bool = False
    time: float | None = None

    def plain(self) -> dict[str, Any]:
        """Return the mark as a mapping for JSON; numbers with six decimals."""
        found: dict[str, Any] = rounded({**vars(self), "found": plain(self.found)})
        return found


@dataclass(frozen=True)
class Marks:
    """All marks of a file, in the order of the rubric. hints: of hidden tests that lost points,
    where the tests themselves are left out. note: why there was no motion to mark."""

    tests: tuple[Mark, ...]
    hints: tuple[str, ...] = ()
    note: Diagnostic | None = None

    @property
    def points(self) -> float:
        return round(math.fsum(mark.points for mark in self.tests), 6)

    @property
    def of(self) -> float:
        return round(math.fsum(mark.of for mark in self.tests), 6)

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


def mark(rubric: Rubric, checked: Checked, reference: Checked | None = None) -> Marks:
    """Return what a checked file gets; one without a motion gets nothing.

    reference: the checked file of `rubric.reference`, for the tests that compare with it.
    """
    tests = tuple(_marked(test, checked, reference) for test in rubric.tests)
    return Marks(tests, note=None if marked(checked) else _refused(checked))


def marked(checked: Checked) -> bool:
    """Return whether there is a motion that can be marked."""
    return bool(checked.motions) and checked.recorded is not None


def _marked(test: Test, checked: Checked, reference: Checked | None) -> Mark:
    if not marked(checked):
        return Mark(
            test.name, 0.0, test.points, False, NO_MOTION_TO_MARK(), test.hint, test.hidden
        )
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
    if all(test.hidden for test in rubric.tests):
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
    ]
