"""What is wrong with a rubric before anybody is marked by it."""

from __future__ import annotations

from dataclasses import dataclass

from mrlab_ros.core.base.diagnostic import Severity
from mrlab_ros.core.rubrics.ground import Ground
from mrlab_ros.core.rubrics.marking import Marks
from mrlab_ros.core.rubrics.rubric import Rubric


@dataclass(frozen=True)
class Flaw:
    """One flaw. An ERROR keeps points out of everybody's reach, a WARNING is for the teacher to
    judge. test: empty: of the rubric as a whole. line: 0: not known."""

    severity: Severity
    test: str
    line: int
    message: str


def flaws_of(rubric: Rubric, ground: Ground) -> list[Flaw]:
    """Return what a rubric cannot measure there, and what its readers will miss."""
    found = []
    for test in rubric.tests:
        found += [
            Flaw(Severity.ERROR, test.name, test.line, flaw)
            for flaw in dict.fromkeys(test.measure.flaws(ground))
        ]
        if test.hidden and not test.hint:
            found.append(
                Flaw(
                    Severity.WARNING, test.name, test.line,
                    "it is hidden and has no hint, so a student learns nothing from it; add hint:",
                )
            )  # fmt: skip
    if not rubric.reference:
        found.append(
            Flaw(
                Severity.WARNING, "", 0,
                "it names no reference solution, so nothing shows that full marks can be had; add "
                "reference: solution.mat",
            )
        )  # fmt: skip
    if all(test.hidden for test in rubric.tests):
        found.append(
            Flaw(Severity.WARNING, "", 0, "every test is hidden; students see none of it")
        )
    return found


def flaws_of_reference(rubric: Rubric, marks: Marks) -> list[Flaw]:
    """Return a flaw for each test in which the reference solution loses points."""
    lines = {test.name: test.line for test in rubric.tests}
    return [
        Flaw(
            Severity.ERROR, mark.name, lines[mark.name],
            f"the reference loses {mark.of - mark.points:g} of {mark.of:g} points: {mark.words}",
        )
        for mark in marks.lost
    ]  # fmt: skip
