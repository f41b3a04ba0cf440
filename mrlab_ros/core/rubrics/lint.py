"""What is wrong with a rubric before anybody is marked by it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mrlab_ros.core.base.diagnostic import Diagnostic, plain
from mrlab_ros.core.rubrics.diagnostics import (
    ALL_HIDDEN,
    HIDDEN_WITHOUT_HINT,
    NO_REFERENCE,
    REFERENCE_LOSES,
)
from mrlab_ros.core.rubrics.ground import Ground
from mrlab_ros.core.rubrics.marking import Marks
from mrlab_ros.core.rubrics.rubric import Rubric


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
