"""A rubric: what a motion is for, and named tests with points."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from mrlab_ros.core.base.diagnostic import Diagnostic
from mrlab_ros.core.checking.checked import Checked
from mrlab_ros.core.checking.evidence import CLOSE
from mrlab_ros.core.rubrics.ground import Ground


@dataclass(frozen=True)
class Outcome:
    """What a measure found. share: of the points, 0 to 1; found: for the one who is marked, with
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


@dataclass(frozen=True)
class Test:
    """One test. expect: its sentence. hint: what a student reads who loses points.

    hidden: a student sees neither its name nor its numbers. partial: the rule by which a part of
    the points is given, as the rubric has it; empty: all or nothing. line: in the rubric's file.
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
    def points(self) -> float:
        """Return the points of all tests."""
        return sum(test.points for test in self.tests)
